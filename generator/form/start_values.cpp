// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/start_values.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

const char* to_string(ValueCondition::Rule rule) {
    static constexpr const char* names[]{"above_zero", "not_below_zero", "share",  "below",
                                         "not_above",  "square_of_one",  "rising", "inertia"};
    return names[static_cast<std::size_t>(rule)];
}

StartValues::StartValues(const System& system) : StartValues(system, Values(system.scene, system.translate)) {
    when_ = "at the start with the values of the model file";
}

StartValues::StartValues(const System& system, const Values& values, ValueConditions* conditions)
    : system_(system), start_(values.substitution()), conditions_(conditions) {
    add_steps(start_, system.symbols, 30);
}

std::optional<numeric> StartValues::operator()(const ex& e) const {
    const ex number = e.subs(start_, GiNaC::subs_options::no_pattern).evalf();
    if (!GiNaC::is_exactly_a<numeric>(number) || !ex_to<numeric>(number).is_real()) return std::nullopt;
    return ex_to<numeric>(number);
}

bool StartValues::depends_on_input(const ex& e) const {
    for (const Variable& input : system_.symbols.all(SymbolKind::input))
        if (e.has(input.symbol)) return true;
    return false;
}

void StartValues::positive(const ex& e, const Span& place, const std::string& what, const char* unit) const {
    check(above_zero(unit), e, place, what);
}

void StartValues::check(const SignRule& rule, const ex& e, const Span& place, const std::string& what) const {
    using Rule = ValueCondition::Rule;
    note({rule.up_to_one ? Rule::share : rule.is_above_zero ? Rule::above_zero : Rule::not_below_zero,
          {e},
          fmt::format("{} is {{}}{} {}, but {}", what, with_space(rule.unit), when_, broken(rule, -1, -1))});
    const auto number = (*this)(e);
    if (!number && !rule.is_above_zero) return;
    const char* must = number ? broken(rule, number->csgn(), (*number - 1).csgn()) : "must be above zero";
    if (must == nullptr) return;
    const std::string shown = number ? fmt::format("{:.6g}{}", number->to_double(), with_space(rule.unit)) : "no number";
    throw Failure(Diagnostic{Id::value_out_of_range, place, fmt::format("{} is {} {}, but {}", what, shown, when_, must)});
}

}  // namespace dalembert
