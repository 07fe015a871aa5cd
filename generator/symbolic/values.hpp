// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers for the letters: defaults from the model, or what a run or the command line sets. All exact and in SI.
#pragma once

#include <cln/real.h>

#include <optional>
#include <set>

#include "symbolic/parts.hpp"
#include "symbolic/translate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Values of all parameters of the model, and of everything else where it was set.
class Values {
public:
    /// Defaults of the model. Throws Failure (value-out-of-range) when one is outside its range.
    Values(const Scene& scene, const Translator& translate);

    /// "m_W = 1.2", "phi[2] = 0.1", "dot(s) = -0.3": a parameter, coordinate, velocity, state or input, in SI.
    /// A family name without index sets all members. Throws Failure when nothing in the scene has that name.
    /// Throws Failure (value-out-of-range, unknown-name).
    void set(const Expression& variable, const Expression& value, unsigned allowed, const Indices& indices = {});

    /// Whether the model or a setting gives a start value, so that constraints must not find another.
    bool is_written(SymbolKind kind, std::size_t i) const { return written_.contains(key(kind, i)); }
    /// A coordinate or velocity that constraints determine.
    void find(SymbolKind kind, std::size_t i, const GiNaC::ex& number) { values_[key(kind, i)] = number; }

    const GiNaC::ex& parameter(std::size_t i) const { return values_.at(key(SymbolKind::parameter, i)); }
    /// q, then qd, then z
    std::vector<GiNaC::ex> state() const;
    std::vector<GiNaC::ex> inputs() const;

    /// The value of a variable beside its declared range, where it is outside of it by more than `tolerance`, a part of the larger bound.
    /// `place` is that of the value.
    std::optional<Diagnostic> outside_range(const Variable& variable, const GiNaC::ex& number, const Span& place, double tolerance) const {
        return variable.declared == nullptr ? std::nullopt : outside_range(*variable.declared, variable.name, number, place, tolerance);
    }

    /// The time of the values, in seconds; 0 if it is never set.
    void set_time(const GiNaC::ex& time) { time_ = time; }

    /// Every letter that has a value: parameters, definitions but for steps, states, inputs, and the time.
    GiNaC::exmap substitution() const;

private:
    static std::pair<SymbolKind, std::size_t> key(SymbolKind kind, std::size_t i) { return {kind, i}; }
    void assign(const Variable& variable, const GiNaC::ex& value, const Span& place);
    void check_fixed() const;
    void check_range(const Quantity& ranged, const std::string& name, const GiNaC::ex& number, const Span& place) const;
    std::optional<Diagnostic> outside_range(const Quantity& ranged, const std::string& name, const GiNaC::ex& number, const Span& place,
                                            double tolerance) const;

    const Scene& scene_;
    const Translator& translate_;
    GiNaC::ex time_ = 0;
    std::map<std::pair<SymbolKind, std::size_t>, GiNaC::ex> values_;
    std::set<std::pair<SymbolKind, std::size_t>> written_;
};

/// What values_at and the like compute with beyond the digits that are asked for.
inline constexpr int guard_digits = 20;

/// Numbers for letters, as floats of so many digits: what is the same for many expressions is made once.
class FloatPoint {
public:
    FloatPoint(const GiNaC::exmap& constants, int digits);
    /// Nothing where it does not exist or is not real.
    std::optional<cln::cl_R> value(const GiNaC::ex& e) const;

private:
    mutable WithLetters floats_;
    int digits_;
    bool has_value_ = true;
};

/// The value computed with so many digits, with numbers for every letter; nothing where it does not exist or is not real.
std::optional<cln::cl_R> value_at(const GiNaC::ex& e, const GiNaC::exmap& constants, int digits);

/// Adds the values of steps to a point, with so many digits. What has no value there is left out.
void add_steps(GiNaC::exmap& point, const Symbols& symbols, int digits);

}  // namespace dalembert
