// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/dimension.hpp"

#include <fmt/format.h>

#include <numeric>

namespace dalembert {

namespace {

constexpr std::array<const char*, Dimension::count> base_names{"m", "kg", "s", "A", "K", "mol", "cd"};
/// In the order in which people write them: kg*m^2/s^2, not m^2*kg/s^2.
constexpr std::array<std::size_t, Dimension::count> writing_order{1, 0, 2, 3, 4, 5, 6};

std::string power_text(const char* name, const Fraction& exponent) {
    if (exponent.denominator != 1) return fmt::format("{}^({}/{})", name, exponent.numerator, exponent.denominator);
    return exponent.numerator == 1 ? std::string(name) : fmt::format("{}^{}", name, exponent.numerator);
}

}  // namespace

Fraction Fraction::reduced(long long numerator, long long denominator) {
    if (denominator < 0) {
        numerator = -numerator;
        denominator = -denominator;
    }
    const long long divisor = std::gcd(numerator, denominator);
    numerator /= divisor;
    denominator /= divisor;
    // No physical quantity has such an exponent; a fixed absurd one keeps the arithmetic defined and the mismatch visible.
    constexpr long long absurd = 100'003;
    if (std::abs(numerator) > absurd || denominator > absurd) return {static_cast<int>(absurd), 1};
    return {static_cast<int>(numerator), static_cast<int>(denominator)};
}

Dimension Dimension::base(std::size_t index) {
    Dimension result;
    result.exponents_[index] = {1, 1};
    return result;
}

Dimension Dimension::operator*(const Dimension& other) const {
    Dimension result;
    for (std::size_t i = 0; i < count; ++i) {
        const Fraction &a = exponents_[i], &b = other.exponents_[i];
        result.exponents_[i] = Fraction::reduced(1LL * a.numerator * b.denominator + 1LL * b.numerator * a.denominator,
                                                 1LL * a.denominator * b.denominator);
    }
    return result;
}

Dimension Dimension::operator/(const Dimension& other) const { return *this * other.raised({-1, 1}); }

Dimension Dimension::raised(const Fraction& exponent) const {
    Dimension result;
    for (std::size_t i = 0; i < count; ++i)
        result.exponents_[i] =
            Fraction::reduced(1LL * exponents_[i].numerator * exponent.numerator, 1LL * exponents_[i].denominator * exponent.denominator);
    return result;
}

std::string Dimension::in_base_units() const {
    std::string above;
    std::string below;
    for (const std::size_t i : writing_order) {
        Fraction exponent = exponents_[i];
        if (exponent.numerator == 0) continue;
        std::string& part = exponent.numerator > 0 ? above : below;
        exponent.numerator = std::abs(exponent.numerator);
        if (!part.empty()) part += '*';
        part += power_text(base_names[i], exponent);
    }
    if (below.empty()) return above.empty() ? "1" : above;
    if (above.empty()) above += '1';
    return below.find('*') == std::string::npos ? fmt::format("{}/{}", above, below) : fmt::format("{}/({})", above, below);
}

std::string Dimension::usual_unit() const {
    struct Named {
        Dimension dimension;
        const char* name;
    };
    const Dimension surface = length() * length(), ampere = base(3), volt = power() / ampere;
    const std::array named{
        Named{force(), "N"},
        Named{energy(), "J or N*m"},
        Named{power(), "W"},
        Named{pressure(), "Pa"},
        Named{pressure() * time(), "Pa*s"},
        Named{force() / length(), "N/m"},
        Named{force() / speed(), "kg/s or N*s/m"},
        Named{energy() * time(), "J*s or N*m*s"},
        Named{energy() / mass(), "J/kg or m^2/s^2"},
        Named{energy() / mass() / temperature(), "J/(kg*K)"},
        Named{energy() / temperature(), "J/K"},
        Named{power() / temperature(), "W/K"},
        Named{temperature() / power(), "K/W"},
        Named{power() / length() / temperature(), "W/(m*K)"},
        Named{power() / surface, "W/m^2"},
        Named{power() / surface / temperature(), "W/(m^2*K)"},
        Named{power() / volume(), "W/m^3"},
        Named{volt, "V"},
        Named{volt / ampere, "Ohm"},
        Named{ampere / volt, "1/Ohm or A/V"},
        Named{volt * time() / ampere, "H"},
        Named{ampere * time() / volt, "F"},
        Named{volt * time(), "V*s or N*m/A"},
        Named{volt / speed(), "V*s/m or N/A"},
    };
    for (const Named& entry : named)
        if (entry.dimension == *this) return entry.name;
    return in_base_units();
}

}  // namespace dalembert
