// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that are the same for expressions that are equal, and hardly ever for others: a hint what is worth a proof.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "symbolic/symbols.hpp"

namespace dalembert {

/// Values modulo a prime, with letters as random numbers, (cos, sin) of each part of an angle as a random point of the unit circle, and
/// quaternions of attitudes of norm one. The same on every run and machine.
class Fingerprints {
public:
    static constexpr std::uint64_t prime = (std::uint64_t(1) << 61) - 1;

    explicit Fingerprints(const Symbols& symbols);
    std::uint64_t operator()(const GiNaC::ex& e);
    /// Of a letter that stands for something.
    void set(const GiNaC::ex& letter, std::uint64_t print) { known_[letter] = print; }

private:
    std::uint64_t made(const GiNaC::ex& e);
    std::uint64_t wave(const GiNaC::ex& angle, bool is_sine);

    GiNaC::exhashmap<std::uint64_t> known_;
};

}  // namespace dalembert
