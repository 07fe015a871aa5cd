// SPDX-License-Identifier: GPL-3.0-or-later
// Filling and emptying a vessel through an orifice has closed forms. With Pi the ratio of the pressures behind and before the orifice,
// Psi the outflow function (3.157), s = sqrt(1 - Pi^((k-1)/k)) and the rate c = alpha A sqrt(2 R T)/V:
//
//   isothermal filling:  dPi/dt = c Psi(Pi)           choked: Pi grows linearly;      subsonic: ds/dt = -c/2 sqrt((k-1)/k)
//   isothermal emptying: dp/dt = -c p Psi(p_0/p)      choked: p falls exponentially;  subsonic: ds/dt = -c/2 sqrt((k-1)/k) (1-s^2)^(k/(k-1))
//   polytropic filling:  dp/dt = n R T(p)/V mdot      choked: p^(1/n) grows linearly; subsonic, n = k: artanh(s) falls linearly
//   polytropic emptying                               choked: p^(-(n-1)/(2n)) grows linearly
//
// s falls to exactly zero: pressures become equal at a finite time.
#include "vessel.hpp"

#include <doctest/doctest.h>

#include <string>

#include "dalembert/simulate.hpp"
#include "pneumatics/air_reservoir_thermal_isothermal.hpp"

namespace {

using dalembert::Method;
using dalembert::Status;
using Wide = long double;

/// The outflow function at its critical ratio, in closed form.
struct Nozzle {
    Wide k;
    Wide ratio() const { return std::pow(2 / (k + 1), k / (k - 1)); }
    Wide psi() const { return std::sqrt(k / (k + 1)) * std::pow(2 / (k + 1), 1 / (k - 1)); }
    Wide s() const { return std::sqrt((k - 1) / (k + 1)); }
    Wide s_rate() const { return std::sqrt((k - 1) / k) / 2; }
    Wide ratio_of(Wide s) const { return std::pow(1 - s * s, k / (k - 1)); }
};

/// A course of the pressure with a phase that is choked and one that is not.
template <class Choked, class Subsonic>
struct Course {
    Wide change;  ///< s, where the flow ceases to be choked
    Wide equal;   ///< s, where the pressures are equal
    Choked choked;
    Subsonic subsonic;  ///< of the time since the change
    double operator()(double t) const { return static_cast<double>(t < change ? choked(t) : subsonic(std::min(static_cast<Wide>(t), equal) - change)); }
};
template <class Choked, class Subsonic>
Course(Wide, Wide, Choked, Subsonic) -> Course<Choked, Subsonic>;

/// The u with f(u) = value, of a function that grows, between 0 and high.
template <class Function>
Wide inverse(Function f, Wide value, Wide high) {
    Wide low = 0;
    for (int i = 0; i < 70; ++i) {
        const Wide middle = (low + high) / 2;
        (f(middle) < value ? low : high) = middle;
    }
    return (low + high) / 2;
}

template <class Plant>
dalembert::SimulationOptions<Plant> options_of(Method method, double tolerance) {
    dalembert::SimulationOptions<Plant> options;
    options.method = method;
    options.tolerance = tolerance;
    options.intervals = 400;
    options.max_steps = 20000;
    options.scale[1] = 1e5;  // J
    return options;
}

/// The largest difference from the course by the pressure `size`, and the time of the change against its closed form.
template <class Plant, class Known>
void compare(const std::string& name, const Plant& plant, double p, typename Plant::Input u, const Known& known, double size, double until) {
    const auto inputs = [u](const auto&, double) { return u; };
    double largest = 0, latest = 0;
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
        CAPTURE(name);
        CAPTURE(static_cast<int>(method));
        auto options = options_of<Plant>(method, 1e-12);
        double worst = 0;
        typename Plant::State x{p};
        const auto result = dalembert::simulate(plant, inputs, x, 0.0, until, options, [&](const auto& sample) {
            const double off = std::abs(sample.x[0] - known(sample.t)) / size;
            if (!(off <= worst)) worst = off;
        });
        CHECK(result.outcome.status == Status::success);
        CHECK(worst < 1e-10);

        // The change of a run is where its guard is zero: the first end of a run that has one event more than a run that ends sooner.
        options.intervals = 1;
        const auto events = [&](Wide t) {
            typename Plant::State at{p};
            return dalembert::simulate(plant, inputs, at, 0.0, static_cast<double>(t), options, [](const auto&) {}).outcome.events;
        };
        const std::size_t before = events(known.change * (1 - 1e-9L));
        Wide low = known.change * (1 - 1e-9L), high = known.change * (1 + 1e-9L);
        CHECK(events(high) == before + 1);
        for (int i = 0; i < 20; ++i) {
            const Wide middle = (low + high) / 2;
            (events(middle) == before ? low : high) = middle;
        }
        const double late = static_cast<double>(std::abs(high / known.change - 1));
        CHECK(late < 1e-10);
        largest = std::max(largest, worst);
        latest = std::max(latest, late);
    }
    MESSAGE(name, ": pressure off by ", largest, ", change by ", latest);
}

}  // namespace

TEST_CASE("a vessel filled and emptied isothermally") {
    using Plant = air_reservoir_thermal::isothermal::System<double>;
    const Plant plant;
    const auto& c = plant.parameters();
    const Nozzle nozzle{c.kappa};
    const Wide rate = c.alpha_d * c.A_d * std::sqrt(2 * static_cast<Wide>(c.R_s) * c.T_0) / c.V;
    const Wide fall = rate * nozzle.s_rate();
    {
        const Wide first = c.p_0 / static_cast<Wide>(c.p_S);
        const Wide change = (nozzle.ratio() - first) / (rate * nozzle.psi());
        const auto choked = [&](Wide t) { return c.p_S * (first + rate * nozzle.psi() * t); };
        const auto subsonic = [&](Wide t) { return c.p_S * nozzle.ratio_of(nozzle.s() - fall * t); };
        const Course course{change, change + nozzle.s() / fall, choked, subsonic};
        // Until s is a thousandth, and the pressures differ by 3.5 in a million. The rest is a test of its own.
        compare("isothermal filling", plant, c.p_0, {1, 0, 0}, course, c.p_S, static_cast<double>(change + (nozzle.s() - 1e-3L) / fall));
    }
    {
        REQUIRE(c.kappa == doctest::Approx(1.4));
        // With k = 1.4 and u = s/sqrt(1 - s^2), ds/(1 - s^2)^(7/2) is the differential of u + 2/3 u^3 + 1/5 u^5.
        const auto primitive = [](Wide u) { return u * (1 + u * u * (2 / 3.0L + u * u / 5)); };
        const Wide highest = nozzle.s() / std::sqrt(1 - nozzle.s() * nozzle.s());
        const double start = 7e5;
        const Wide change = std::log(start * nozzle.ratio() / c.p_0) / (rate * nozzle.psi());
        const auto choked = [&](Wide t) { return start * std::exp(-rate * nozzle.psi() * t); };
        const auto subsonic = [&](Wide t) {
            const Wide u = inverse(primitive, primitive(highest) - fall * t, highest);
            return c.p_0 / nozzle.ratio_of(u / std::sqrt(1 + u * u));
        };
        const Course course{change, change + primitive(highest) / fall, choked, subsonic};
        compare("isothermal emptying", plant, start, {0, 1, 0}, course, c.p_0, static_cast<double>(change + (primitive(highest) - 1e-3L) / fall));
    }
}

TEST_CASE("a vessel on a polytropic course") {
    using Plant = vessel::full::System<double>;
    for (const double n : {1.0, 1.2, 1.4}) {
        vessel::full::Parameters<double> c;
        c.n = n;
        c.p_r = c.p_0;
        const Plant plant(c);
        const Nozzle nozzle{c.kappa};
        const std::string exponent = ", n = " + std::to_string(n);
        {
            // Mass flow times R T_r/(V p_r): what (p/p_r)^(1/n) grows by in a second, choked.
            const Wide flow = c.alpha * c.A * c.p_s * std::sqrt(2 * c.R_s / static_cast<Wide>(c.T_s)) * c.T_r / c.V / c.p_r;
            const Wide critical = nozzle.ratio() * c.p_s / c.p_r;
            const Wide change = (std::pow(critical, 1 / static_cast<Wide>(n)) - 1) / (flow * nozzle.psi());
            const auto choked = [&](Wide t) { return c.p_r * std::pow(1 + flow * nozzle.psi() * t, static_cast<Wide>(n)); };
            if (n == c.kappa) {
                const Wide fall = flow * std::pow(c.p_s / static_cast<Wide>(c.p_r), -1 / static_cast<Wide>(n)) * (c.kappa - 1) / 2 * std::sqrt(c.kappa / (static_cast<Wide>(c.kappa) - 1));
                const auto subsonic = [&](Wide t) { return c.p_s * nozzle.ratio_of(std::tanh(std::atanh(nozzle.s()) - fall * t)); };
                const Course course{change, change + std::atanh(nozzle.s()) / fall, choked, subsonic};
                compare("isentropic filling" + exponent, plant, c.p_0, {1, 0}, course, c.p_s, static_cast<double>(change + (std::atanh(nozzle.s()) - 1e-3L) / fall));
            } else {
                const Course course{change, change, choked, [&](Wide) { return choked(change); }};
                compare("choked filling" + exponent, plant, c.p_0, {1, 0}, course, c.p_s, static_cast<double>(change));
            }
        }
        {
            const Wide rate = c.alpha * c.A * std::sqrt(2 * static_cast<Wide>(c.R_s) * c.T_r) / c.V;
            const Wide m = (static_cast<Wide>(n) - 1) / (2 * n);
            const double start = 7e5;
            const Wide first = start / static_cast<Wide>(c.p_r);
            const Wide critical = 1 / nozzle.ratio();
            // d(p^-m)/dt = m n rate Psi; isothermally the limit, an exponential.
            const Wide growth = n * rate * nozzle.psi();
            const Wide change = n == 1 ? std::log(first / critical) / growth : (std::pow(critical, -m) - std::pow(first, -m)) / (m * growth);
            const auto choked = [&](Wide t) { return n == 1 ? start * std::exp(-growth * t) : c.p_r * std::pow(std::pow(first, -m) + m * growth * t, -1 / m); };
            const Course course{change, change, choked, [&](Wide) { return choked(change); }};
            compare("choked emptying" + exponent, plant, start, {0, 1}, course, start, static_cast<double>(change));
        }
    }
}
