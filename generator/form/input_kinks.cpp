// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/input_kinks.hpp"

#include <cln/float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "form/expression_writer.hpp"
#include "symbolic/switches.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr int kink_parts = 1000;
constexpr int most_parts = 100000;
constexpr int kink_digits = 40;

/// How fast what sines and cosines are of rises at t = 0.
std::vector<ex> waving_rates(const ex& function, const ex& time) {
    std::vector<ex> rates;
    for (auto part = function.preorder_begin(); part != function.preorder_end(); ++part) {
        if (!is_ex_the_function(*part, GiNaC::sin) && !is_ex_the_function(*part, GiNaC::cos)) continue;
        try {
            rates.push_back(partial(part->op(0), time).subs(time == 0, GiNaC::subs_options::no_pattern));
        } catch (const GiNaC::pole_error&) {  // it has none
        }
    }
    return rates;
}

class Kinks {
public:
    Kinks(const ex& switch_function, const ex& time, double until) : function_(switch_function), time_(time), until_(until) {}

    /// Adds to the kinks. Those that are known already divide the run: what stands inside others has its own.
    void find(std::set<double>& kinks) const {
        std::vector<double> times;
        const int parts = parts_of_run();
        for (int i = 0; i <= parts; ++i) times.push_back(until_ * i / parts);
        double last = 0;
        for (const double kink : kinks) {
            for (int k = 1; k < 4; ++k) times.push_back(last + (kink - last) * k / 4);
            times.push_back(kink);
            last = kink + std::max(kink, until_) * std::numeric_limits<double>::epsilon();
            times.push_back(last);
        }
        for (int k = 1; k < 4; ++k) times.push_back(last + (until_ - last) * k / 4);
        std::sort(times.begin(), times.end());
        std::optional<int> before = sign_at(0);
        for (std::size_t i = 1; i < times.size() && before; ++i) {
            if (times[i] == times[i - 1]) continue;
            const std::optional<int> sign = sign_at(times[i]);
            if (sign && *sign != *before) kinks.insert(last_with(*before, times[i - 1], times[i]));
            before = sign;
        }
    }

private:
    /// At least four looks between two zeros of sines and cosines of the time.
    int parts_of_run() const {
        double fastest = 0;
        for (const ex& waving : waving_rates(function_, time_)) {
            const auto rate = value_at(waving, {}, kink_digits);
            if (rate) fastest = std::max(fastest, std::fabs(cln::double_approx(*rate)));
        }
        const double parts = 4 * fastest * until_ / std::acos(-1.0);
        if (parts > most_parts)
            throw Failure(Diagnostic{
                Id::too_large,
                {},
                fmt::format("up to {:.6g} s there are about {:.0f} kinks or jumps at known times; the limit is {}, so choose a shorter run",
                            until_, parts / 4, most_parts / 4)});
        return std::max(kink_parts, static_cast<int>(parts));
    }

    std::optional<int> sign_at(double t) const {
        const auto value = value_at(function_, {{time_, GiNaC::numeric(cln::rational(cln::cl_DF(t)))}}, kink_digits);
        if (!value) return std::nullopt;
        return cln::zerop(*value) ? 0 : cln::minusp(*value) ? -1 : 1;
    }

    /// The last of the numbers between the two times that has the sign.
    double last_with(int sign, double with, double without) const {
        const double least = (without - with) * std::numeric_limits<double>::epsilon();
        while (true) {
            const double middle = with + (without - with) / 2;
            if (!(middle > with && middle < without) || without - with < least) return with;
            (sign_at(middle) == sign ? with : without) = middle;
        }
    }

    const ex& function_;
    const ex& time_;
    double until_;
};

/// Whether time is all that moves in e, but for letters that stand for numbers.
bool is_of_time_alone(const ex& e, const ex& time, const GiNaC::exset& letters) {
    if (!e.has(time)) return false;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part) && !part->is_equal(time) && !letters.contains(*part)) return false;
    return true;
}

/// The functions whose changes of sign are kinks, where inputs and parameters have these values.
std::vector<ex> functions_of_time(const System& system, const std::vector<ex>& inputs, const GiNaC::exmap& parameters,
                                  const GiNaC::exset& letters) {
    const Symbols& symbols = system.symbols;
    GiNaC::exmap given;
    for (std::size_t i = 0; i < inputs.size(); ++i) given[symbols.get(SymbolKind::input, i)] = inputs[i];
    std::vector<ex> functions;
    const auto add = [&](const ex& e) {
        const ex function = symbols.without_definitions(e).subs(parameters, GiNaC::subs_options::no_pattern);
        const bool is_known = std::any_of(functions.begin(), functions.end(), [&](const ex& known) { return known.is_equal(function); });
        if (!is_known && is_of_time_alone(function, symbols.time(), letters)) functions.push_back(function);
    };
    // What stands inside another comes first.
    const auto add_switches = [&](const ex& e) {
        const std::vector<Switch> switches = switches_in(e);
        for (auto one = switches.rbegin(); one != switches.rend(); ++one) add(one->by);
    };
    for (const ex& input : inputs) add_switches(symbols.without_definitions(input));
    for (const Guard& guard : system.guards) {
        if (guard.ends) continue;
        const ex value = symbols.without_definitions(guard.value).subs(given, GiNaC::subs_options::no_pattern);
        add_switches(value);
        add(value);
    }
    for (const EventEquation& event : system.events)
        if (event.is_watched) add_switches(symbols.without_definitions(event.guard).subs(given, GiNaC::subs_options::no_pattern));
    return functions;
}

std::vector<ex> functions_of_time(const System& system, const std::vector<ex>& inputs, const Values& values, const GiNaC::exset& letters) {
    GiNaC::exmap parameters;
    for (std::size_t i = 0; i < system.symbols.count(SymbolKind::parameter); ++i)
        parameters[system.symbols.get(SymbolKind::parameter, i)] = values.parameter(i);
    return functions_of_time(system, inputs, parameters, letters);
}

}  // namespace

std::vector<SwitchInTime> switches_in_time(const System& system, const std::vector<ex>& inputs, const Values& values,
                                           const GiNaC::exset& letters) {
    std::vector<SwitchInTime> result;
    for (const ex& function : functions_of_time(system, inputs, values, letters))
        result.push_back({function, waving_rates(function, system.symbols.time())});
    return result;
}

bool kinks_move(const System& system, const std::vector<ex>& inputs, const Values& values, const GiNaC::exset& letters) {
    const std::vector<ex> functions = functions_of_time(system, inputs, values, letters);
    return std::any_of(functions.begin(), functions.end(), [&](const ex& function) {
        return std::any_of(letters.begin(), letters.end(), [&](const ex& letter) { return function.has(letter); });
    });
}

std::vector<double> input_kinks(const System& system, const std::vector<ex>& inputs, const Values& values, double until) {
    std::set<double> kinks;
    for (const ex& function : functions_of_time(system, inputs, values, {})) Kinks(function, system.symbols.time(), until).find(kinks);
    // A zero that is a number has one just before it and one on it.
    std::vector<double> result;
    for (const double kink : kinks)
        if (kink > 0 && (result.empty() || kink - result.back() > 4 * std::numeric_limits<double>::epsilon() * kink))
            result.push_back(kink);
    return result;
}

void find_time_switches(const std::vector<std::unique_ptr<System>>& modes) {
    // What stands inside another has fewer switches inside. The text gives the rest an order that does not depend on the run.
    std::map<std::pair<std::size_t, std::string>, ex> found;
    const Symbols& first = modes.front()->symbols;
    const ExpressionWriter write(first);
    for (const auto& system : modes) {
        GiNaC::exset letters;
        GiNaC::exmap to_first;
        std::vector<ex> inputs;
        for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::input})
            for (std::size_t i = 0; i < first.count(kind); ++i) {
                const ex letter = system->symbols.get(kind, i);
                letters.insert(letter);
                to_first[letter] = first.get(kind, i);
                if (kind == SymbolKind::input) inputs.push_back(letter);
            }
        to_first[system->symbols.time()] = first.time();
        for (const ex& function : functions_of_time(*system, inputs, GiNaC::exmap(), letters)) {
            const ex same = function.subs(to_first, GiNaC::subs_options::no_pattern);
            found.emplace(std::pair(switches_in(same).size(), write(same)), same);
        }
    }
    for (const auto& system : modes) {
        GiNaC::exmap to_own;
        for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::input})
            for (std::size_t i = 0; i < first.count(kind); ++i) to_own[first.get(kind, i)] = system->symbols.get(kind, i);
        to_own[first.time()] = system->symbols.time();
        for (const auto& [key, function] : found) {
            const ex own = function.subs(to_own, GiNaC::subs_options::no_pattern);
            system->time_switches.push_back({own, waving_rates(own, system->symbols.time())});
        }
    }
}

}  // namespace dalembert
