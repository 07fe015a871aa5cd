// SPDX-License-Identifier: GPL-3.0-or-later
// Which values each run of a study has. Those of a run follow from its number and the seed alone.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "study/distribution.hpp"

namespace dalembert {

struct GridAxis {
    double low, high;
    std::size_t count;
    double value(std::size_t i) const;
};

using Variation = std::variant<GridAxis, Distribution>;

enum class Sampling { random, sobol };

struct Design {
    std::vector<Variation> variations;
    Sampling sampling = Sampling::random;
    bool has_indices = false;  ///< runs are in groups from which Sobol indices follow
    std::uint64_t seed = 1;
    std::size_t runs = 0;

    std::size_t grid_points() const;
    std::size_t random_count() const;
    /// Runs of a group: f(A), f(B), and for each that is varied f(A with that one of B).
    std::size_t group() const { return has_indices ? random_count() + 2 : 1; }
};

/// Points of the unit cube by their number: independent ones, or of a Sobol sequence that the seed shifts. Each thread has its own.
class Points {
public:
    Points(Sampling sampling, std::size_t dimensions, std::uint64_t seed);
    ~Points();
    Points(Points&&) noexcept;
    /// All between 0 and 1, without these.
    std::vector<double> operator()(std::uint64_t number);

private:
    struct Sequence;
    std::unique_ptr<Sequence> sequence_;
    std::size_t dimensions_;
    std::uint64_t seed_;
};

class ValuesOfRuns {
public:
    explicit ValuesOfRuns(const Design& design);
    /// In SI, in the order of the variations. Run 0 is the first one. Grid points take turns: at each of them stand the same random points.
    std::vector<double> operator()(std::uint64_t run);

private:
    const Design& design_;
    Points points_;
};

/// The largest number of quantities that a Sobol sequence can vary.
inline constexpr std::size_t most_sobol_dimensions = 3667;

}  // namespace dalembert
