// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/circuits.hpp"
#include "read/rules.hpp"

namespace dalembert {

void check_rules(const Entry& e, Branch& branch) {
    if (branch.has_modes() && branch.family)
        e.error(Id::not_allowed_here, branch.family->span,
                fmt::format("{} '{}' is a family, whose members cannot have modes of their own; write each of them out",
                            branch.law == Branch::Law::diode ? "diode" : "switch", e.name()));
    if (branch.law != Branch::Law::motor || e.has("angle") != e.has("position")) return;
    e.error(e.has("angle") ? Id::doubly_determined : Id::missing_key, e.span(),
            fmt::format("motor '{}' needs either the angle or the position that it moves", e.name()));
}

}  // namespace dalembert
