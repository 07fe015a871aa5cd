// SPDX-License-Identifier: GPL-3.0-or-later
#include "dalembert/angle_functions.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace dalembert::detail;

namespace {

/// A type with both in one call, which counts.
struct Pair {
    double value;
    static inline int calls = 0;
};
std::pair<Pair, Pair> sincos(const Pair& x) {
    ++Pair::calls;
    return {{std::sin(x.value)}, {std::cos(x.value)}};
}
[[maybe_unused]] Pair sin(const Pair&) { return {-7}; }
[[maybe_unused]] Pair cos(const Pair&) { return {-7}; }

/// |a - b| in units in the last place of b.
double units(float a, double b) {
    int exponent;
    std::frexp(b, &exponent);
    return std::abs(static_cast<double>(a) - b) / std::ldexp(1.0, (exponent < -125 ? -125 : exponent) - 24);
}

float float_of(std::uint32_t bits) {
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

/// The largest error of both functions at an angle and its opposite, in units in the last place. Double has digits enough: no float is
/// nearer to a zero than 1e-9.
double worst_at(float x) {
    double worst = 0;
    for (const float angle : {x, -x}) {
        float s, c;
        combined_sin_and_cos<float>(angle, s, c);
        worst = std::max({worst, units(s, std::sin(static_cast<double>(angle))), units(c, std::cos(static_cast<double>(angle)))});
    }
    return worst;
}

/// Over every `step`-th float from zero to infinity: up to 512 rad, and beyond.
std::pair<double, double> worst_of_all(std::uint32_t step) {
    constexpr std::uint32_t infinity = 0x7f800000, far = 0x44000000;
    const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::pair<double, double>> worst(threads, {0, 0});
    std::vector<std::thread> running;
    for (unsigned k = 0; k < threads; ++k)
        running.emplace_back([&, k] {
            for (std::uint64_t bits = std::uint64_t{k} * step; bits < infinity; bits += std::uint64_t{threads} * step) {
                double& most = bits < far ? worst[k].first : worst[k].second;
                most = std::max(most, worst_at(float_of(static_cast<std::uint32_t>(bits))));
            }
        });
    for (std::thread& thread : running) thread.join();
    std::pair<double, double> result{0, 0};
    for (const auto& [near, beyond] : worst) result = {std::max(result.first, near), std::max(result.second, beyond)};
    return result;
}

}  // namespace

TEST_CASE("sine and cosine together are the library's, and one call where a type has one") {
    double s, c;
    sin_and_cos<double>(0.7, s, c);
    CHECK(s == std::sin(0.7));
    CHECK(c == std::cos(0.7));
    using Long = boost::multiprecision::cpp_bin_float_50;
    Long ls, lc;
    sin_and_cos<Long>(Long(7) / 10, ls, lc);
    CHECK(abs(ls * ls + lc * lc - 1) < 1e-48);
    CHECK(abs(ls - s) < 1e-15);
    Pair ps, pc;
    sin_and_cos<Pair>(Pair{0.7}, ps, pc);
    CHECK(Pair::calls == 1);
    CHECK(ps.value == s);
    CHECK(pc.value == c);
}

TEST_CASE("combined sine and cosine: other types than float have the library's") {
    double s, c;
    combined_sin_and_cos<double>(1e5, s, c);
    CHECK(s == std::sin(1e5));
    CHECK(c == std::cos(1e5));
    CHECK(combined_sin<double>(0.3) == std::sin(0.3));
    CHECK(combined_cos<double>(0.3) == std::cos(0.3));
}

TEST_CASE("combined sine and cosine in float: digits at every angle") {
    const bool every_float = std::getenv("DALEMBERT_FULL") != nullptr;
    const auto [near, beyond] = worst_of_all(every_float ? 1 : 1009);
    MESSAGE(std::string(every_float ? "every float: " : "every 1009th float: ") << near << " units in the last place up to 512 rad, " << beyond << " beyond");
    CHECK(near < 2.5);
    CHECK(beyond < 2.8);
    CHECK(near > 0.5);  // what is compared differs
}

TEST_CASE("combined sine and cosine in float: next to every multiple of pi/2, and the float that is nearest to one") {
    double worst = 0;
    for (int k = 0; k < 200000; ++k) {
        const auto multiple = static_cast<float>(k * 1.57079632679489662);
        for (const float x : {std::nextafter(multiple, 0.0f), multiple, std::nextafter(multiple, 1e9f)}) worst = std::max(worst, worst_at(x));
    }
    CHECK(worst < 2.8);
    CHECK(worst_at(std::ldexp(16367173.0f, 72)) < 2.8);
    CHECK(worst_at(std::numeric_limits<float>::max()) < 2.8);
}

TEST_CASE("combined sine and cosine in float: what is no angle gives no number, and small ones themselves") {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float x : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
        CHECK(std::isnan(combined_sin<float>(x)));
        CHECK(std::isnan(combined_cos<float>(x)));
    }
    for (const float x : {0.0f, 1e-10f, std::numeric_limits<float>::min(), std::numeric_limits<float>::denorm_min()}) {
        CHECK(combined_sin<float>(x) == x);
        CHECK(combined_sin<float>(-x) == -x);
        CHECK(combined_cos<float>(x) == 1.0f);
    }
}
