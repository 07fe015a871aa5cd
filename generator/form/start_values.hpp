// SPDX-License-Identifier: GPL-3.0-or-later
// Values of expressions at the default parameters and the start, for checks of what they must be.
#pragma once

#include "form/system.hpp"
#include "symbolic/bounds.hpp"

namespace dalembert {

/// What is asked of expressions at the start, for those who ask it again of other values.
struct ValueCondition {
    enum class Rule {
        above_zero,      ///< what has no value breaks this rule alone
        not_below_zero,
        share,           ///< from 0 to 1
        below,           ///< the first is below the second
        not_above,       ///< the first is not above the second
        square_of_one,
        rising,          ///< from 0 to 1
        inertia,         ///< a tensor, row by row, that a body can have
    };
    Rule rule;
    std::vector<GiNaC::ex> values;
    /// A sentence for people without a full stop, with {} in the places of values, of the root of a square, or of the principal moments of
    /// an inertia.
    std::string text;
};
using ValueConditions = std::vector<ValueCondition>;
const char* to_string(ValueCondition::Rule rule);

class StartValues {
public:
    /// The values of the model file.
    explicit StartValues(const System& system);
    /// `conditions` gets whatever is checked.
    StartValues(const System& system, const Values& values, ValueConditions* conditions = nullptr);

    /// Nothing where it has none.
    std::optional<GiNaC::numeric> operator()(const GiNaC::ex& e) const;
    bool depends_on_input(const GiNaC::ex& e) const;
    /// Notes what is checked elsewhere.
    void note(ValueCondition condition) const {
        if (conditions_ != nullptr) conditions_->push_back(std::move(condition));
    }
    /// Throws Failure (value-out-of-range): "WHAT is VALUE UNIT at the start, but must be above zero". What has no value breaks no rule but
    /// this one.
    void check(const SignRule& rule, const GiNaC::ex& e, const Span& place, const std::string& what) const;
    void positive(const GiNaC::ex& e, const Span& place, const std::string& what, const char* unit) const;

    /// An expression with curves must keep the rule at every value that their arguments can have: variables go through their declared
    /// ranges, or everywhere; parameters have their values. `of_letters` are bounds of letters that the model does not have. Throws Failure
    /// (value-out-of-range), which names the curve and a place. Part of check().
    void check_curves(const SignRule& rule, const GiNaC::ex& e, const Span& place, const std::string& what,
                      const BoundsOfLetters& of_letters = {}) const;
    /// Of a value while all that moves stays in its declared range.
    Bounds bounds(const GiNaC::ex& e) const;

private:
    Bounds bounds(const Variable& variable) const;
    /// Written with the letters of what moves alone: definitions are inserted, parameters are numbers.
    GiNaC::ex of_what_moves(const GiNaC::ex& e) const;

    const System& system_;
    const char* when_ = "at the start";
    GiNaC::exmap start_;
    ValueConditions* conditions_ = nullptr;
    GiNaC::exmap parameters_;  ///< what does not move; empty without curves
};

}  // namespace dalembert
