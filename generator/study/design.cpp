// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/design.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>

namespace dalembert {

namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): a number without pattern for each number.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

std::uint64_t mixed(std::uint64_t seed, std::uint64_t number, std::uint64_t place) { return mixed(mixed(mixed(seed) ^ number) ^ place); }

/// The middle of one of 2^52 equal parts: neither 0 nor 1.
double between_zero_and_one(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

}  // namespace

double GridAxis::value(std::size_t i) const {
    if (i + 1 == count) return count == 1 ? low : high;
    return low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
}

std::size_t Design::grid_points() const {
    std::size_t points = 1;
    for (const Variation& one : variations)
        if (const auto* axis = std::get_if<GridAxis>(&one)) points *= axis->count;
    return points;
}

std::size_t Design::random_count() const {
    return static_cast<std::size_t>(std::count_if(variations.begin(), variations.end(),
                                                  [](const Variation& one) { return std::holds_alternative<Distribution>(one); }));
}

struct Points::Sequence {
    boost::random::sobol engine;
    std::uint64_t next;
};

Points::Points(Sampling sampling, std::size_t dimensions, std::uint64_t seed) : dimensions_(dimensions), seed_(seed) {
    if (sampling == Sampling::sobol && dimensions > 0)
        sequence_ = std::make_unique<Sequence>(Sequence{boost::random::sobol(dimensions), 1});
}
Points::~Points() = default;
Points::Points(Points&&) noexcept = default;

std::vector<double> Points::operator()(std::uint64_t number) {
    std::vector<double> point(dimensions_);
    if (!sequence_) {
        for (std::size_t i = 0; i < dimensions_; ++i) point[i] = between_zero_and_one(mixed(seed_, number, i));
        return point;
    }
    // The engine leaves out the first point, which is zero.
    const bool is_first = number == 0;
    if (!is_first && sequence_->next != number) {
        sequence_->engine.seed();
        sequence_->engine.discard((number - 1) * dimensions_);
    }
    if (!is_first) sequence_->next = number + 1;
    // The shift is the same for all points: they stay as even as they are, and the first one is like any other.
    constexpr std::uint64_t of_shifts = ~std::uint64_t{0};
    for (std::size_t i = 0; i < dimensions_; ++i)
        point[i] = between_zero_and_one((is_first ? 0 : sequence_->engine()) ^ mixed(seed_, of_shifts, i));
    return point;
}

ValuesOfRuns::ValuesOfRuns(const Design& design)
    : design_(design), points_(design.sampling, design.random_count() * (design.has_indices ? 2 : 1), design.seed) {}

std::vector<double> ValuesOfRuns::operator()(std::uint64_t run) {
    std::uint64_t rest = run % design_.grid_points();
    const std::uint64_t draw = run / design_.grid_points(), member = draw % design_.group();
    const std::vector<double> point = points_(draw / design_.group());
    const std::size_t count = design_.random_count();
    std::vector<double> values;
    std::size_t random = 0;
    for (const Variation& one : design_.variations) {
        if (const auto* axis = std::get_if<GridAxis>(&one)) {
            values.push_back(axis->value(rest % axis->count));
            rest /= axis->count;
            continue;
        }
        const bool is_of_second = design_.has_indices && (member == 1 || member == random + 2);
        values.push_back(std::get<Distribution>(one).quantile(point[random + (is_of_second ? count : 0)]));
        ++random;
    }
    return values;
}

}  // namespace dalembert
