// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/start_values.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

StartValues::StartValues(const System& system) : StartValues(system, Values(system.scene, system.translate)) {
    when_ = "at the start with the values of the model file";
}

StartValues::StartValues(const System& system, const Values& values) : system_(system), start_(values.substitution()) {
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
    const auto number = (*this)(e);
    if (!number && !rule.is_above_zero) return;
    const char* must = number ? broken(rule, number->csgn(), (*number - 1).csgn()) : "must be above zero";
    if (must == nullptr) return;
    const std::string shown = number ? fmt::format("{:.6g}{}", number->to_double(), with_space(rule.unit)) : "no number";
    throw Failure(Diagnostic{Id::value_out_of_range, place, fmt::format("{} is {} {}, but {}", what, shown, when_, must)});
}

}  // namespace dalembert
