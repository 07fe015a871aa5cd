// SPDX-License-Identifier: GPL-3.0-or-later
// Instructions that sine and cosine of one angle take on the board: of the library, and from one reduction.
#include <cmath>

#include "dalembert/angle_functions.hpp"
#include "measure.hpp"

namespace {

struct Angles {
    void library(float angle, float& s, float& c) const noexcept {
        s = std::sin(angle);
        c = std::cos(angle);
    }
    void combined(float angle, float& s, float& c) const noexcept { dalembert::detail::combined_sin_and_cos<float>(angle, s, c); }
};

struct Most {
    std::uint32_t library, combined;
};

/// The most that any of 200 angles takes, each `ratio` times the one before.
Most most(float angle, float ratio) {
    const Probe<Angles> probe;
    Most result{0, 0};
    for (int k = 0; k < 200; ++k, angle *= ratio) {
        float s, c;
        const std::uint32_t library = cost<Angles>(probe, &Angles::library, angle, s, c).instructions;
        const std::uint32_t combined = cost<Angles>(probe, &Angles::combined, angle, s, c).instructions;
        if (library > result.library) result.library = library;
        if (combined > result.combined) result.combined = combined;
    }
    return result;
}

}  // namespace

/// Rows of: up to which angle in rad, most instructions of the library, and of both at once.
int program() {
    board::start_ticks();
    const struct {
        const char* name;
        float first, ratio;
    } ranges[] = {{"1", 1e-3f, 1.035f}, {"100", 1.0f, 1.023f}, {"500", 100.0f, 1.008f}, {"1e6", 600.0f, 1.037f}, {"3e38", 1e6f, 1.45f}};
    for (const auto& range : ranges) {
        const Most found = most(range.first, range.ratio);
        board::write(range.name);
        for (const std::uint32_t number : {found.library, found.combined}) {
            board::write(" ");
            board::write(number, 10);
        }
        board::write("\n");
    }
    return 0;
}
