// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/start_values.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

StartValues::StartValues(const System& system) : system_(system), start_(Values(system.scene, system.translate).substitution()) {
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
    const auto number = (*this)(e);
    if (number && number->is_positive()) return;
    throw Failure(Diagnostic{Id::value_out_of_range, place,
                             fmt::format("{} is {} {} at the start, but must be above zero", what,
                                         number ? fmt::format("{:.6g}", number->to_double()) : "no number", unit)});
}

void StartValues::at_least_zero(const ex& e, const Span& place, const std::string& what, const char* unit) const {
    const auto number = (*this)(e);
    if (!number || !number->is_negative()) return;
    throw Failure(Diagnostic{Id::value_out_of_range, place,
                             fmt::format("{} is {:.6g} {} at the start, but must not be below zero", what, number->to_double(), unit)});
}

}  // namespace dalembert
