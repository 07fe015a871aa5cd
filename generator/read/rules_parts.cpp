// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/parts.hpp"
#include "read/rules.hpp"

namespace dalembert {

void check_rules(const Entry& e, Use& use) {
    use.file_span = e.span_of("file");
    use.parameters = e.by_name("parameters");
    use.sizes = e.by_name("sizes");
    use.start = e.by_name("start");
    use.ports = e.by_name("ports");
    use.media = e.by_name("media");
    use.effects = e.by_name("effects");
}

void check_rules(const Entry& e, Sampler& sampler) {
    sampler.file_span = e.span_of("file");
    sampler.parameters = e.by_name("parameters");
    sampler.measures = e.by_name("measures");
    sampler.sets = e.by_name("sets");
}

void check_rules(const Entry& e, Port&) {
    const std::string kind = e.text("kind");
    if ((kind == "shaft" || kind == "flange") && !e.has("coordinate") && !e.has("value"))
        e.error(Id::missing_key, e.span(), fmt::format("port '{}' needs a coordinate or a value, which is its place", e.name()));
    if (kind == "signal" && !e.has("input") && !e.has("value"))
        e.error(Id::missing_key, e.span(), fmt::format("port '{}' needs an input that it sets, or a value that it gives", e.name()));
}

}  // namespace dalembert
