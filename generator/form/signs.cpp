// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/signs.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

bool is_in_scene(const Expression& name, const System& system) {
    const Named* named = system.names.find(name.name);
    return named == nullptr || system.scene.holds(named->item->when);
}

void check_range(const Written& written, const System& system, const StartValues& value) {
    const Expression& e = written.expression;
    const Named* named = e.kind == Expression::Kind::name ? system.names.find(e.name) : nullptr;
    if (named == nullptr || named->kind != Named::Kind::parameter || !named->quantity().range || !named->quantity().range->low) return;
    const Range& range = *named->quantity().range;
    const auto low = value(system.translate(range.low, {}));
    const SignRule& rule = *written.key.sign;
    if (!low || broken(rule, low->csgn(), (*low - 1).csgn()) == nullptr) return;
    throw Failure(Diagnostic{Id::value_out_of_range,
                             e.span,
                             fmt::format("{} must {}, but the range of '{}' begins at {:.6g}{}", written.what,
                                         rule.is_above_zero ? "be positive" : "not be negative", e.name, low->to_double(),
                                         with_space(rule.unit)),
                             {{range.span, "the range is declared here"}}});
}

}  // namespace dalembert
