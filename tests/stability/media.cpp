// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of media keep their digits over the whole range, also next to the reference, where everything in (3.79) cancels.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "media.hpp"

namespace {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
template <class Scalar>
using System = media::full::System<Scalar>;

template <class Scalar>
typename System<Scalar>::Output properties(const System<Scalar>& system, const std::array<double, 4>& state) {
    typename System<Scalar>::State x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = static_cast<Scalar>(state[i]);
    typename System<Scalar>::Output y;
    system.output(x, {}, Scalar(0), y);
    return y;
}

/// The energy as it is printed: what cancels costs its digits.
template <class Scalar>
Scalar printed_energy(const media::full::Parameters<Scalar>& m, Scalar p, Scalar T) {
    using std::exp;
    return m.c_o * (T - m.T_0) + (m.p_0 + m.beta - m.T_0 * m.alpha * m.beta + (T * m.alpha * m.beta - p - m.beta) * exp(m.alpha * (T - m.T_0)) * exp(-(p - m.p_0) / m.beta)) / m.rho_0;
}

/// Units of the last place by which Scalar is off, beyond the condition: the relative change of a property when each state and parameter
/// changes by its own share.
template <class Scalar>
double worst_error(bool as_printed = false) {
    // Parameters that Scalar has exactly, the same for 50 digits.
    media::full::Parameters<Scalar> rounded;
    media::full::Parameters<Digits50> same;
    constexpr std::size_t parameters = media::full::parameter_count;
    for (std::size_t i = 0; i < parameters; ++i) reinterpret_cast<Digits50*>(&same)[i] = reinterpret_cast<const Scalar*>(&rounded)[i];
    const System<Scalar> system(rounded);
    const System<Digits50> exact(same);
    const Digits50 share("1e-20");
    double worst = 0;
    std::vector<double> pressures{1e5, 100001, 100100, 99000, 1e3, 1e4, 2e5, 1e6, 1e7, 1e8, 1e9};
    for (const double above : {0.0078125, 0.5, 1.0, 64.0}) pressures.push_back(1e5 + above);
    for (const double p : pressures)
        for (const double T : {200.0, 272.75, 273.0, 273.0 + 1.0 / 1024, 274.0, 300.0, 350.5, 500.0})
            for (const double rho : {850.0, 850.0 + 1.0 / 4096, 849.5, 851.0, 700.0, 1200.0}) {
                const std::array<double, 4> state{p, T, rho, T};
                auto computed = properties(system, state);
                if (as_printed) computed[media::full::output::e_p] = printed_energy<Scalar>(rounded, static_cast<Scalar>(p), static_cast<Scalar>(T));
                const auto reference = properties(exact, state);
                std::array<Digits50, media::full::output_count> condition{};
                const auto add = [&](const auto& moved) {
                    for (std::size_t k = 0; k < condition.size(); ++k)
                        if (reference[k] != 0) condition[k] += abs((moved[k] - reference[k]) / (share * reference[k]));
                };
                for (std::size_t i = 0; i < 4; ++i) {
                    typename System<Digits50>::State x;
                    for (std::size_t k = 0; k < 4; ++k) x[k] = state[k];
                    x[i] *= 1 + share;
                    typename System<Digits50>::Output y;
                    exact.output(x, {}, 0, y);
                    add(y);
                }
                for (std::size_t i = 0; i < parameters; ++i) {
                    auto moved = same;
                    reinterpret_cast<Digits50*>(&moved)[i] *= 1 + share;
                    add(properties(System<Digits50>(moved), state));
                }
                for (std::size_t k = 0; k < condition.size(); ++k) {
                    if (reference[k] == 0) {
                        CHECK((computed[k] == 0 || as_printed));
                        continue;
                    }
                    const Digits50 error = abs((Digits50(computed[k]) - reference[k]) / reference[k]) / std::numeric_limits<Scalar>::epsilon();
                    worst = std::max(worst, static_cast<double>(error - condition[k]));
                }
            }
    return worst;
}

}  // namespace

TEST_CASE("densities and energies of media are within 4 units of the last place beyond their condition") {
    CHECK(worst_error<float>() <= 4);
    CHECK(worst_error<double>() <= 4);
    CHECK(worst_error<long double>() <= 4);
    CHECK(worst_error<double>(true) > 1000);
}
