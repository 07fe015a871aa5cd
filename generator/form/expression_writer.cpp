// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/expression_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

std::string name_of_function(const ex& e) {
    static const std::map<std::string, std::string> names{{"magnitude", "abs"}, {"sign_of", "sign"}, {"unit_step", "step"},
                                                          {"minimum", "min"},   {"maximum", "max"},  {"floor_of", "floor"}};
    const std::string name = ex_to<GiNaC::function>(e).get_name();
    const auto known = names.find(name);
    return known == names.end() ? name : known->second;
}

}  // namespace

std::string ExpressionWriter::operator()(const ex& e) const {
    if (GiNaC::is_a<GiNaC::symbol>(e)) {
        const Variable* variable = symbols_.find(e);
        return variable != nullptr ? variable->name : ex_to<GiNaC::symbol>(e).get_name();
    }
    if (GiNaC::is_exactly_a<numeric>(e)) return fmt::format("{}", to_string(cln::the<cln::cl_RA>(ex_to<numeric>(e).to_cl_N())));
    if (e.is_equal(GiNaC::Pi)) return "pi";
    if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
    if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
    if (GiNaC::is_a<GiNaC::power>(e))
        return e.op(1).is_equal(numeric(1, 2)) ? "sqrt(" + (*this)(e.op(0)) + ")" : as_factor(e.op(0)) + "^" + as_factor(e.op(1));
    if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return (*this)(e.op(0));
    if (const auto curve = curve_call(e)) return fmt::format("{}({})", name_of_curve_function(*curve), (*this)(e.op(0)));
    if (const auto map = map_call(e)) return fmt::format("{}({}, {})", name_of_map_function(*map), (*this)(e.op(0)), (*this)(e.op(1)));
    std::vector<std::string> arguments;
    for (const ex& argument : e) arguments.push_back((*this)(argument));
    return fmt::format("{}({})", name_of_function(e), fmt::join(arguments, ", "));
}

std::string ExpressionWriter::as_factor(const ex& e) const {
    const std::string text = (*this)(e);
    const bool is_whole = GiNaC::is_a<GiNaC::symbol>(e) || GiNaC::is_a<GiNaC::function>(e) || e.is_equal(GiNaC::Pi) ||
                          e.info(GiNaC::info_flags::nonnegint);
    return is_whole ? text : "(" + text + ")";
}

std::string ExpressionWriter::sum(const ex& e) const {
    std::vector<std::pair<bool, std::string>> terms;
    for (const ex& term : e) terms.emplace_back(GiNaC::is_exactly_a<numeric>(term), (*this)(term));
    const auto unsigned_text = [](const std::string& text) { return text.starts_with('-') ? text.substr(1) : text; };
    std::sort(terms.begin(), terms.end(), [&](const auto& a, const auto& b) {
        return std::pair(a.first, unsigned_text(a.second)) < std::pair(b.first, unsigned_text(b.second));
    });
    std::string text;
    for (const auto& [is_number, term] : terms)
        text += text.empty() ? term : term.starts_with('-') ? " - " + term.substr(1) : " + " + term;
    return text;
}

std::string ExpressionWriter::product(const ex& e) const {
    std::vector<std::string> above, below;
    std::string sign;
    for (const ex& factor : e) {
        if (GiNaC::is_exactly_a<numeric>(factor) && ex_to<numeric>(factor).is_rational()) {
            const numeric& value = ex_to<numeric>(factor);
            if (value.is_negative()) sign = sign.empty() ? "-" : "";
            if (!GiNaC::abs(value.numer()).is_equal(1)) above.push_back((*this)(GiNaC::abs(value.numer())));
            if (!value.denom().is_equal(1)) below.push_back((*this)(value.denom()));
        } else if (GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::negative)) {
            below.push_back(as_factor(1 / factor));
        } else if (GiNaC::is_a<GiNaC::add>(factor)) {
            // GiNaC turns a sum round by the order of its letters, which changes from run to run.
            const std::string text = (*this)(factor);
            const bool is_turned = text.starts_with('-');
            if (is_turned) sign = sign.empty() ? "-" : "";
            above.push_back("(" + (is_turned ? (*this)(-factor) : text) + ")");
        } else {
            above.push_back(as_factor(factor));
        }
    }
    std::sort(above.begin(), above.end());
    std::sort(below.begin(), below.end());
    std::string text = sign + (above.empty() ? "1" : fmt::format("{}", fmt::join(above, "*")));
    for (const std::string& factor : below) text += "/" + factor;
    return text;
}

}  // namespace dalembert
