// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/seen_step.hpp"

#include <algorithm>
#include <cmath>

#include "elements/model.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// How the time stands in expressions.
class InTime {
public:
    explicit InTime(const ex& time) : time_(time) {}

    /// Whether in few factors of the kinds that seen_step names.
    bool takes(const ex& e) {
        const auto factors = factors_of(e);
        return factors && *factors <= most;
    }
    /// A product of so many such factors is no narrower than this.
    double width() const { return 1 / (static_cast<double>(most) * fastest_); }

private:
    static constexpr std::size_t most = 4;

    /// How many factors with the time a product in it has at most; none where it stands in another way.
    std::optional<std::size_t> factors_of(const ex& e) {
        if (e.is_equal(time_)) return 1;
        const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
        std::size_t largest = 0, all = 0;
        for (const ex& part : e) {
            const auto own = factors_of(part);
            if (!own) return std::nullopt;
            largest = std::max(largest, *own);
            all += *own;
        }
        if (all == 0) return 0;
        if (is_sum) return largest;
        if (GiNaC::is_a<GiNaC::mul>(e)) return all;
        if (GiNaC::is_a<GiNaC::power>(e)) return factors_of_power(e, largest);
        return GiNaC::is_a<GiNaC::function>(e) ? factors_of_function(GiNaC::ex_to<GiNaC::function>(e)) : std::nullopt;
    }
    std::optional<std::size_t> factors_of_power(const ex& e, std::size_t of_base) const {
        const ex& exponent = e.op(1);
        if (!exponent.info(GiNaC::info_flags::posint) || exponent > ex(static_cast<unsigned long>(most))) return std::nullopt;
        return of_base * static_cast<std::size_t>(GiNaC::ex_to<GiNaC::numeric>(exponent).to_int());
    }
    std::optional<std::size_t> factors_of_function(const GiNaC::function& f) {
        const std::string name = f.get_name();
        if (name != "sin" && name != "cos" && name != "exp") return std::nullopt;
        const auto rate = value_at(f.op(0).diff(GiNaC::ex_to<GiNaC::symbol>(time_)), {}, 20);
        if (!rate) return std::nullopt;  // it follows a state or a parameter
        fastest_ = std::max(fastest_, std::fabs(cln::double_approx(*rate)));
        return 1;
    }

    const ex time_;
    double fastest_ = 0;  ///< rate
};

}  // namespace

double seen_step(const System& system, const std::vector<ex>& inputs) {
    if (!system.guards.empty() || !system.scene.modes.empty() || !system.heat.fields.empty() || !system.motion.multipliers.empty())
        return 0;
    const Symbols& symbols = system.symbols;
    const Motion& motion = system.motion;
    std::vector<ex> acting = inputs;
    acting.insert(acting.end(), motion.residual.begin(), motion.residual.end());
    acting.insert(acting.end(), system.state_rates.begin(), system.state_rates.end());
    for (const auto& [coordinate, acceleration] : motion.accelerations) acting.push_back(acceleration);
    for (const ConstraintEquation& c : system.constraints) acting.push_back(c.whole_rate);
    for (std::size_t i = 0, written = acting.size(); i < written; ++i)
        for (const std::size_t step : symbols.steps_in(acting[i])) acting.push_back(symbols.definition_values()[step]);
    InTime time(symbols.time());
    return std::all_of(acting.begin(), acting.end(), [&](const ex& e) { return time.takes(e); }) ? time.width() : 0;
}

}  // namespace dalembert
