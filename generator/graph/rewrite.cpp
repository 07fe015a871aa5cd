// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/rewrite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <unordered_set>

#include <fmt/format.h>

#include "graph/raise.hpp"

namespace dalembert {

namespace {

constexpr int digits = 100;
constexpr int point_count = 420;  ///< what is lost in one corner of the ranges only is seen by few of them
constexpr int most_steps = 8;
constexpr double good_enough = 4;  ///< ulp beyond the condition: what loses no more is left as it is
constexpr double least_gain = 2;       ///< of one step,
constexpr double least_whole_gain =
    6;  ///< and of all together: what gains less is not seen in compiled code, where terms come in another order
constexpr double vanishing = 1e-100;   ///< what is smaller in any units has fewer digits, and a condition that overflows

double distance(double computed, const DoubleDouble& exact) { return std::fabs((computed - exact.high) - exact.low); }

/// Sums that are left as they are, of the machine that was measured last: its modes have most of them in common. The text stands for all
/// that a measurement depends on.
struct LeftAsTheyAre {
    std::string machine;
    std::unordered_set<std::string> sums;
};

LeftAsTheyAre& left_as_they_are(const std::string& machine) {
    static thread_local LeftAsTheyAre memory;
    if (memory.machine != machine) memory = {machine, {}};
    return memory;
}

/// Every scalar that a point has a value of.
std::vector<const Variable*> scalars(const Symbols& symbols) {
    std::vector<const Variable*> variables;
    for (const SymbolKind kind :
         {SymbolKind::parameter, SymbolKind::time, SymbolKind::input, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state,
          SymbolKind::acceleration, SymbolKind::state_rate, SymbolKind::multiplier, SymbolKind::multiplier_rate, SymbolKind::residual})
        for (const Variable& variable : symbols.all(kind)) variables.push_back(&variable);
    return variables;
}

/// Names, ranges by the first points in them, definitions, and the guards that say where the model holds.
std::string text_of_machine(const System& system, const Atoms& atoms, const std::vector<Polynomial>& definitions,
                            const std::vector<Polynomial>& guards) {
    const std::vector<const Variable*> variables = scalars(system.symbols);
    std::string text;
    for (const Variable* variable : variables) text += variable->name + " ";
    EdgePoints points(system, variables, double_arithmetic(), 1);
    for (int i = 0; i < 16; ++i)
        for (const double value : points.next().values) text += fmt::format("{:a} ", value);
    for (const Polynomial& p : definitions) text += atoms.key(p) + ";";
    for (std::size_t i = 0; i < system.guards.size(); ++i)
        if (system.guards[i].ends) text += atoms.key(guards[i]) + ";";
    return text;
}

}  // namespace

Rewriter::Rewriter(const System& system, Atoms& atoms, const std::vector<Polynomial>& definitions, const std::vector<Polynomial>& guards)
    : system_(system), atoms_(atoms), definitions_(definitions), guards_(guards), prover_(system) {}

/// Points at which the model holds, with the definitions there, which are inputs of what is made of them.
void Rewriter::draw(const std::vector<Polynomial>& guards) {
    const std::vector<const Variable*> variables = scalars(system_.symbols);
    EdgePoints edges(system_, variables, double_arithmetic(), 1);
    const std::vector<Variable>& definitions = system_.symbols.all(SymbolKind::definition);
    const std::size_t count = variables.size() + definitions.size();
    for (int tries = 0; points_.size() < static_cast<std::size_t>(point_count) && tries < 10 * point_count; ++tries) {
        std::vector<double> values = edges.next().values;
        values.resize(count, 0);
        std::map<Letter, RoundedPolynomials::Input> inputs;
        for (std::size_t i = 0; i < variables.size(); ++i) inputs[atoms_.symbol(*variables[i])] = {values[i], i};
        RoundedPolynomials at(atoms_, digits, count);
        // One after the other, as often as it takes: each is made of parameters and of others.
        bool changed = true;
        while (changed) {
            changed = false;
            at.set(inputs);
            for (std::size_t i = 0; i < definitions.size(); ++i) {
                const Letter letter = atoms_.symbol(definitions[i]);
                if (inputs.contains(letter)) continue;
                const MaybeExact value = at.value(definitions_[i]);
                if (!value) continue;
                values[variables.size() + i] = cln::double_approx(value->value);
                if (!std::isfinite(values[variables.size() + i])) continue;
                inputs[letter] = {values[variables.size() + i], variables.size() + i};
                changed = true;
            }
        }
        const auto& list = system_.guards;
        const bool holds = std::all_of(list.begin(), list.end(), [&](const Guard& guard) {
            if (!guard.ends) return true;
            const MaybeExact value = at.value(guards[static_cast<std::size_t>(&guard - list.data())]);
            return value && !cln::minusp(value->value);
        });
        if (holds) points_.emplace_back(std::move(at), std::move(values));
    }
}

/// How large an error of a number is that its inputs, at these values, and its own rounding allow.
double Rewriter::unit_of(const ExactNumber& number, const std::vector<double>& values) {
    const Arithmetic& arithmetic = double_arithmetic();
    double unit = arithmetic.ulp(cln::double_approx(number.value));
    for (std::size_t i = 0; i < number.slopes.size(); ++i)
        if (number.slopes[i] != 0) unit += std::fabs(number.slopes[i]) * arithmetic.ulp(values[i]) / 2;
    return unit;
}

std::vector<std::optional<Rewriter::Expected>>& Rewriter::expected(const Polynomial& exact_form) {
    if (points_.empty()) draw(guards_);
    auto& [of, list] = expected_;
    if (!list.empty() && of == exact_form) return list;
    of = exact_form;
    list.clear();
    const Arithmetic& arithmetic = double_arithmetic();
    for (auto& [at, values] : points_) {
        list.emplace_back();
        const std::optional<DoubleDouble> number = at.short_value(exact_form);
        if (!number || !(std::fabs(number->high) <= arithmetic.largest)) continue;
        list.back() = Expected{*number, arithmetic.ulp(number->high)};
    }
    return list;
}

/// Of the sum that is expected.
double Rewriter::unit_at(std::size_t point) {
    auto& [of, list] = expected_;
    std::optional<double>& unit = list[point]->unit;
    if (unit) return *unit;
    auto& [at, values] = points_[point];
    const MaybeExact number = at.exact(of);
    unit = number ? unit_of(*number, values) : std::numeric_limits<double>::quiet_NaN();
    return *unit;
}

/// Whether a form loses no more than `good_enough`. Slopes are taken only where it loses more than the last digits of the value itself.
bool Rewriter::is_good(const Polynomial& exact_form, const Polynomial& computed_form) {
    if (points_.empty()) draw(guards_);
    const Arithmetic& arithmetic = double_arithmetic();
    for (auto& [at, values] : points_) {
        const std::optional<DoubleDouble> number = at.short_value(exact_form);
        if (!number || !(std::fabs(number->high) <= arithmetic.largest)) continue;
        const double computed = at.rounded(computed_form);
        if (!std::isfinite(computed)) return false;
        if (std::fabs(computed) < vanishing && std::fabs(number->high) < vanishing) continue;
        const double error = distance(computed, *number);
        if (error / arithmetic.ulp(number->high) <= good_enough) continue;
        const MaybeExact with_slopes = at.exact(exact_form);
        if (!with_slopes || error / unit_of(*with_slopes, values) > good_enough) return false;
    }
    return true;
}

double Rewriter::Loss::largest() const { return without_value > 0 ? std::numeric_limits<double>::infinity() : error; }

Rewriter::Loss Rewriter::loss(const Polynomial& exact_form, const Polynomial& computed_form, const Loss* better_than) {
    const auto& list = expected(exact_form);
    Loss result;
    for (std::size_t k = 0; k < list.size(); ++k) {
        if (better_than != nullptr && !result.is_less_than(*better_than)) break;
        if (!list[k]) continue;
        const double computed = points_[k].first.rounded(computed_form);
        if (!std::isfinite(computed)) {
            result.without_value += std::isfinite(unit_at(k)) ? 1 : 0;
            continue;
        }
        if (std::fabs(computed) < vanishing && std::fabs(list[k]->value.high) < vanishing) continue;
        const double error = distance(computed, list[k]->value);
        if (error / list[k]->ulp <= result.error) continue;  // the unit is at least an ulp
        if (const double unit = unit_at(k); std::isfinite(unit)) result.error = std::max(result.error, error / unit);
    }
    return result;
}

/// Whether terms that are not zero cancel to the last digit, at a few points.
bool Rewriter::seems_zero(const Polynomial& p) {
    constexpr int enough = 5;
    if (p.size() < 2) return false;
    if (points_.empty()) draw(guards_);
    int seen = 0;
    for (auto& [at, values] : points_) {
        const MaybeExact sum = at.value(p);
        if (!sum) continue;
        cln::cl_R size = 0;
        for (const auto& [monomial, coefficient] : p.terms()) size = size + cln::abs(at.value(Polynomial(coefficient) * monomial)->value);
        if (cln::abs(sum->value) > size * cln::expt(cln::cl_RA(10), -digits / 2)) return false;
        if (++seen == enough) return true;
    }
    return false;
}

std::size_t Rewriter::points_with_value(const Polynomial& exact_form) {
    if (points_.empty()) draw(guards_);
    std::set<Letter> above, below;
    for (const auto& [monomial, coefficient] : exact_form.terms())
        for (const LetterPower& power : monomial) (power.exponent > 0 ? above : below).insert(power.letter);
    const std::vector<Letter> all_above(above.begin(), above.end()), all_below(below.begin(), below.end());
    return static_cast<std::size_t>(
        std::count_if(points_.begin(), points_.end(), [&](auto& point) { return point.first.has_value(all_above, all_below); }));
}

/// Those of one rule in one part are told together.
void Rewriter::note(const Rewriting& one) {
    const auto same =
        std::find_if(log_.begin(), log_.end(), [&](const Rewriting& r) { return r.rule == one.rule && r.where == one.where; });
    if (same == log_.end()) {
        log_.push_back(one);
        return;
    }
    same->places += one.places;
    same->before = std::max(same->before, one.before);
    same->after = std::max(same->after, one.after);
}

Polynomial Rewriter::operator()(const Polynomial& p, const char* where) {
    const auto [known, is_new] = known_.try_emplace(p, p);
    if (!is_new) return known->second;
    const bool is_slope = std::string_view(where) == "Jacobians";
    if (machine_.empty()) machine_ = text_of_machine(system_, atoms_, definitions_, guards_);
    LeftAsTheyAre& memory = left_as_they_are(machine_);
    const std::string key = (is_slope ? "slope " : "") + atoms_.key(p);
    if (memory.sums.contains(key)) return p;
    // Entries of Jacobians that are zero are seen to be so by few who differentiate: quotients of what a parameter is a factor of.
    if (is_slope && seems_zero(p) && prover_.proven_equal(raised(p, atoms_), 0)) {
        note({"a sum that is zero", where, 1, largest_error(p, p), 0});
        return known_.at(p) = Polynomial();
    }
    const auto left = [&] {
        memory.sums.insert(key);
        return p;
    };
    if (other_forms(p, atoms_, forms_).empty()) return left();
    Polynomial best = p;
    // A form that has a value where p is 0/0 is what p should be.
    Polynomial reference = p;
    for (const OtherForm& form : other_forms(p, atoms_, forms_))
        if (form.fills_gaps && points_with_value(form.form) > points_with_value(reference)) reference = form.form;
    if (is_good(reference, p)) return left();
    const Loss before = loss(reference, p);
    Loss now = before;
    std::vector<Rewriting> noted;
    for (int step = 0; step < most_steps && now.largest() > good_enough; ++step) {
        const OtherForm* better = nullptr;
        Loss least = now;
        least.error /= least_gain;
        const std::vector<OtherForm>& forms = other_forms(best, atoms_, forms_);
        for (const OtherForm& form : forms) {
            const Loss one = loss(reference, form.form, &least);
            if (!one.is_less_than(least)) continue;
            least = one;
            better = &form;
        }
        if (better == nullptr) break;
        noted.push_back({better->rule, where, 1, now.largest(), least.largest()});
        best = better->form;
        now = least;
    }
    const bool has_more_values = now.without_value < before.without_value && now.error <= std::max(before.error, good_enough);
    if (noted.empty() || !(has_more_values || now.error * least_whole_gain <= before.error)) return left();
    for (const Rewriting& one : noted) note(one);
    return known_.at(p) = best;
}

}  // namespace dalembert
