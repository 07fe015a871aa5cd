// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/branches.hpp"

#include <fmt/format.h>

#include <set>

#include "symbolic/switches.hpp"

namespace dalembert {

using GiNaC::ex;

Branches::Branches(const ex& e, const Symbols& symbols) {
    const ex written = symbols.without_definitions(e);
    std::set<ex, GiNaC::ex_is_less> known;
    for (auto part = written.preorder_begin(); part != written.preorder_end(); ++part) {
        const auto one = switch_of(*part);
        if (!one) continue;
        const ex& by = one->by;
        if (!known.insert(by).second) continue;
        std::set<std::string> letters;
        bool has_free = false;  // what has a range, or is positive, is drawn from all that it may be
        for (auto inner = by.preorder_begin(); inner != by.preorder_end(); ++inner) {
            if (!GiNaC::is_a<GiNaC::symbol>(*inner)) continue;
            letters.insert(GiNaC::ex_to<GiNaC::symbol>(*inner).get_name());
            const Variable* variable = symbols.find(*inner);
            has_free =
                has_free || variable == nullptr || !(variable->is_positive || (variable->declared != nullptr && variable->declared->range));
        }
        Switch found{by, {}};
        for (const std::string& letter : letters) found.letters += fmt::format("{}'{}'", found.letters.empty() ? "" : ", ", letter);
        if (has_free) switches_.push_back(std::move(found));
    }
}

void Branches::enter(const Prover::Evaluation& evaluate, const Point& point) {
    constexpr int digits = 60;
    for (Switch& one : switches_) {
        if (one.was_positive && one.was_negative) continue;
        const auto value = evaluate(one.by, point, digits);
        if (!value) continue;
        one.was_positive = one.was_positive || cln::plusp(*value);
        one.was_negative = one.was_negative || cln::minusp(*value);
    }
}

std::string Branches::missed() const {
    std::set<std::string> letters;
    for (const Switch& one : switches_)
        if (!one.was_positive || !one.was_negative) letters.insert(one.letters);
    std::string text;
    for (const std::string& one : letters)
        text += (text.empty() ? "" : "; ") +
                fmt::format("no point reached one of the cases that {} decide{}", one, one.find(',') == std::string::npos ? "s" : "");
    return text;
}

}  // namespace dalembert
