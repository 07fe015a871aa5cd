// SPDX-License-Identifier: BSL-1.0
// The functions that forms are rewritten into, and their slopes, against their definitions in 120 digits: around zero down to the smallest
// number there is, at ordinary, huge and negative arguments, and what they make of infinities and of what is no number.
#include <doctest/doctest.h>

#include "dalembert/heat_functions.hpp"
#include "runtime/exact_heat.hpp"

using namespace dalembert::detail;
using namespace exact_heat;

namespace {

/// Below this the definitions lose all digits in 120 of them; the next terms are smaller than 1e-60.
bool is_tiny(const Exact& x) { return abs(x) < Exact("1e-30"); }

struct Function {
    const char* name;
    Formula<1> exact;
    double at_zero;
    double largest;  ///< beyond which exp of an argument, times the argument, is no double
    float (*in_float)(const float&);
    double (*in_double)(const double&);
};

#define BOTH(f) f<float>, f<double>

template <class Scalar>
Scalar growth_mean_slope(const Scalar& x) noexcept {
    return -decay_mean_slope(Scalar(-x));
}

const std::vector<Function>& functions() {
    constexpr double no_limit = std::numeric_limits<double>::max();
    static const std::vector<Function> table{
        {"one_minus_cos", [](const auto& x) { return is_tiny(x[0]) ? Exact(x[0] * x[0] / 2) : Exact(1 - cos(x[0])); }, 0, no_limit, BOTH(one_minus_cos)},
        {"sinc", [](const auto& x) { return x[0] == 0 ? Exact(1) : Exact(sin(x[0]) / x[0]); }, 1, no_limit, BOTH(sinc)},
        {"sinc_slope", [](const auto& x) { return is_tiny(x[0]) ? Exact(-x[0] / 3) : Exact((x[0] * cos(x[0]) - sin(x[0])) / (x[0] * x[0])); }, 0, no_limit, BOTH(sinc_slope)},
        {"cosc", [](const auto& x) { return is_tiny(x[0]) ? Exact(Exact(1) / 2) : Exact((1 - cos(x[0])) / (x[0] * x[0])); }, 0.5, no_limit, BOTH(cosc)},
        {"cosc_slope", [](const auto& x) { return is_tiny(x[0]) ? Exact(-x[0] / 12) : Exact((x[0] * sin(x[0]) - 2 * (1 - cos(x[0]))) / (x[0] * x[0] * x[0])); }, 0, no_limit, BOTH(cosc_slope)},
        {"growth_mean", [](const auto& x) { return is_tiny(x[0]) ? Exact(1 + x[0] / 2) : Exact((exp(x[0]) - 1) / x[0]); }, 1, 700, BOTH(growth_mean)},
        {"growth_mean_slope", [](const auto& x) { return is_tiny(x[0]) ? Exact(Exact(1) / 2 + x[0] / 3) : Exact(((x[0] - 1) * exp(x[0]) + 1) / (x[0] * x[0])); }, 0.5, 700, BOTH(growth_mean_slope)},
        {"logc", [](const auto& x) { return is_tiny(x[0]) ? Exact(1 - x[0] / 2) : Exact(log(1 + x[0]) / x[0]); }, 1, no_limit, BOTH(logc)},
        {"logc_slope", [](const auto& x) { return is_tiny(x[0]) ? Exact(2 * x[0] / 3 - Exact(1) / 2) : Exact((x[0] / (1 + x[0]) - log(1 + x[0])) / (x[0] * x[0])); }, -0.5, no_limit, BOTH(logc_slope)},
    };
    return table;
}

bool is_logarithm(const Function& f) { return std::string(f.name).find("logc") == 0; }

/// Zero, the smallest numbers, powers of two up to 2^40 and between them, the seams of series, multiples of quarter turns; of both signs.
template <class Scalar>
Points<Scalar, 1> arguments(const Function& f) {
    using limits = std::numeric_limits<Scalar>;
    std::vector<Scalar> numbers{Scalar(0), limits::denorm_min(), 12345 * limits::denorm_min(), limits::min(), 3 * limits::min(), limits::epsilon()};
    for (int n = -limits::digits * 2 - 6; n <= 40; ++n)
        for (const Scalar part : {Scalar(1), Scalar(1.3L), Scalar(1.77L)}) numbers.push_back(std::ldexp(part, n));
    for (int n = 1; n <= 60; ++n)
        for (const Scalar close : around(Scalar(1.5707963267948966L) * Scalar(n), 9)) numbers.push_back(close);
    for (const Scalar seam : {Scalar(2), Scalar(4), Scalar(0.5L)})
        for (const Scalar close : around(seam, 5)) numbers.push_back(close);
    const Scalar largest = sizeof(Scalar) == sizeof(float) ? static_cast<Scalar>(std::min(f.largest / 8.4, 1e30)) : static_cast<Scalar>(f.largest);
    Points<Scalar, 1> points;
    for (const Scalar x : numbers) {
        if (x < largest) points.push_back({x});
        if (!is_logarithm(f) || x < 1) points.push_back({-x});
    }
    return points;
}

}  // namespace

TEST_CASE("functions that forms are rewritten into: within 5 units of the last place of what their arguments allow") {
    for (const Function& f : functions()) {
        const Worst in_float = worst_error<float>([&](const auto& x) { return f.in_float(x[0]); }, f.exact, arguments<float>(f));
        const Worst in_double = worst_error<double>([&](const auto& x) { return f.in_double(x[0]); }, f.exact, arguments<double>(f));
        INFO(f.name, ": float ", in_float.error, " at", in_float.place, ", double ", in_double.error, " at", in_double.place);
        CHECK_FALSE(in_float.place.empty());
        CHECK_FALSE(in_double.place.empty());
        CHECK(in_float.error <= 5);
        CHECK(in_double.error <= 5);
    }
}

TEST_CASE("functions that forms are rewritten into: at zeros of both signs, the smallest numbers, infinities, and what is no number") {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (const Function& f : functions()) {
        INFO(f.name);
        CHECK(f.in_double(0.0) == f.at_zero);
        CHECK(f.in_double(-0.0) == f.at_zero);
        CHECK(f.in_float(0.0F) == static_cast<float>(f.at_zero));
        for (const double tiny : {std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::min()}) CHECK(f.in_double(tiny) == doctest::Approx(f.at_zero).epsilon(1e-15));
        CHECK(std::isnan(f.in_double(nan)));
        CHECK(std::isnan(f.in_float(std::numeric_limits<float>::quiet_NaN())));
        // Where there is a limit it is that, or no number; never a number that is wrong.
        const bool grows = std::string(f.name).find("growth") == 0;
        for (const double end : {infinity, -infinity}) {
            const double value = f.in_double(end);
            CAPTURE(end);
            CHECK((std::isnan(value) || value == (grows && end > 0 ? infinity : 0.0)));
        }
    }
}
