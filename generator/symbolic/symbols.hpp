// SPDX-License-Identifier: GPL-3.0-or-later
// The letters of the derivation: every GiNaC symbol of a scene, made once and in the order of declaration.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/scene.hpp"
#include "symbolic/derivative.hpp"

namespace dalembert {

enum class SymbolKind {
    parameter,
    definition,
    time,
    input,
    coordinate,
    velocity,
    state,
    acceleration,
    state_rate,
    grid,
    letter,
    jerk,
    multiplier,
    multiplier_rate,
    residual,
    costate,  ///< one a state: lambda of note [Hessian]
    adjoint,  ///< one an unknown of the motion: w of it
};

/// One scalar of the scene. For a member of a family, base and index say which.
struct Variable {
    SymbolKind kind;
    std::size_t position;  ///< among those of its kind
    std::string name;      ///< as in the model: "phi[2]", "dot(phi[2])"
    std::string base;      ///< "phi"
    int index;             ///< of a family, else 0
    bool is_member;
    std::string unit;      ///< in SI
    std::string doc;
    const Quantity* declared;  ///< with unit and range; null for what is not declared itself, as velocities
    bool is_positive;  ///< by its declared range
    bool is_root;      ///< a state that is the square root of what the model calls so
    /// As the model calls it, also where its root is what is integrated.
    std::string recorded_name() const { return is_root ? name.substr(5, name.size() - 6) : name; }

    GiNaC::ex symbol;  ///< an ex, because a GiNaC::symbol by value forgets that it is real or positive
};

/// The unit, in SI, of the first or second derivative by time: "rad" becomes "rad/s" or "rad/s^2".
std::string per_second(const Unit& unit, int times = 1);

class Symbols;

/// A letter of parameters alone that the derivation adds to the definitions, because what it stands for is too large to be written
/// out wherever it is needed.
struct Step {
    std::string name;      ///< as people read it: "exchange_factor[furnace, 1, 2]"
    std::string identifier;  ///< "furnace_exchange_1_2"
    std::string doc;
    GiNaC::ex value;       ///< of parameters, definitions and earlier steps
    /// Its derivative by a parameter, where that has a closed form; else it follows from the value.
    std::function<GiNaC::ex(const Symbols&, std::size_t parameter)> slope = {};
    /// For proofs halfway down: a letter with a meaning of its own, which stays, or is what this says instead of its value.
    bool stays = false;
    GiNaC::ex instead = 0;
};

/// How far down proofs write steps out.
enum class Depth {
    shallow,  ///< only those that are small
    halfway,  ///< down to those that stay
    full,     ///< down to parameters
};

class Symbols {
public:
    /// Positivity comes from the declared range only. Parameters and definitions are positive letters; what moves may leave its range,
    /// so its letter is only real, and its range is an assumption of proofs.
    Symbols(const Scene& scene, const Names& names);

    const std::vector<Variable>& all(SymbolKind kind) const { return variables_[static_cast<std::size_t>(kind)]; }
    std::size_t count(SymbolKind kind) const { return all(kind).size(); }
    const GiNaC::ex& get(SymbolKind kind, std::size_t position) const { return all(kind)[position].symbol; }
    const GiNaC::ex& time() const { return get(SymbolKind::time, 0); }

    /// Degrees of freedom and number of plain states.
    std::size_t degrees() const { return count(SymbolKind::coordinate); }
    std::size_t states() const { return count(SymbolKind::state); }
    /// Coordinates that have a value: all but those of attitudes, of which there is only the rate.
    std::size_t positions() const { return degrees() - 3 * attitudes_.size(); }
    bool has_value(std::size_t coordinate) const { return places_[coordinate].has_value(); }
    /// Where a coordinate that has a value, a velocity or a plain state stands in x = [q; v; z].
    std::size_t place(SymbolKind kind, std::size_t position) const;
    /// The variables of x, in its order.
    std::vector<const Variable*> state_variables() const;
    std::size_t state_count() const { return positions() + degrees() + states(); }

    /// The derivative along a coordinate at fixed others: by the coordinate, or for one of an attitude in the direction in which the
    /// quaternion moves when the body turns about that axis.
    GiNaC::ex along(const GiNaC::ex& e, std::size_t coordinate) const;
    /// By position: the coordinates about x, y and z, and the quaternion among the plain states.
    struct AttitudeSymbols {
        std::array<std::size_t, 3> coordinates;
        std::array<std::size_t, 4> parts;
    };
    const std::vector<AttitudeSymbols>& attitudes() const { return attitudes_; }
    /// Null when the scene has none of that name.
    const AttitudeSymbols* find_attitude(const std::string& name) const;
    /// d(part of the quaternion)/d(angle turned about an axis): linear in the quaternion.
    GiNaC::ex quaternion_slope(const AttitudeSymbols& attitude, std::size_t part, std::size_t axis) const;

    /// Whether neither a coordinate, a velocity, another state, an input nor the time occurs in it; definitions count as letters.
    bool is_constant(const GiNaC::ex& e) const;

    /// Null when the scene has no such variable.
    const Variable* find(SymbolKind kind, const std::string& base, int index) const;
    const Variable* find(const GiNaC::ex& symbol) const;

    /// A further letter, as the variable of a law; not part of the scene.
    GiNaC::ex letter(const std::string& name);
    /// A number on the grid of a rod: known before the parameters are.
    GiNaC::ex grid_letter(const std::string& name);

    /// Gives the definitions (of parameters alone) their values, in terms of parameters and other definitions.
    void define(std::vector<GiNaC::ex> values);
    /// Adds a definition behind those of the model. Not before define().
    GiNaC::ex add_step(Step step);
    /// Of the definitions, those of the model come first; the steps of derivations stand behind them.
    std::size_t model_definitions() const { return expanded_definitions_.size(); }
    const std::vector<GiNaC::ex>& definition_values() const { return definition_values_; }
    /// The expression with definitions replaced by what they stand for, down to parameters. Steps stay letters where they would make
    /// it larger than can be worked with.
    GiNaC::ex without_definitions(const GiNaC::ex& e, Depth depth = Depth::full) const;
    /// The same, with all steps left letters.
    GiNaC::ex without_model_definitions(const GiNaC::ex& e) const;
    /// The steps in an expression and those that they need, each behind what it needs.
    std::vector<std::size_t> steps_in(const GiNaC::ex& e) const;

    /// Total time derivative by the chain rule: q -> qd -> qdd, z -> zd, t -> 1; in a machine that switches also qdd and multipliers ->
    /// their rates.
    GiNaC::ex time_derivative(const GiNaC::ex& e) const;
    /// The same, with derivatives of sums that are kept whole kept so, too.
    GiNaC::ex time_derivative_of_kept(const GiNaC::ex& e) const;
    /// Partial derivative by a parameter, definitions followed by the chain rule.
    GiNaC::ex derivative_by_parameter(const GiNaC::ex& e, std::size_t parameter) const;

private:
    struct Origin {
        std::string base;
        int index = 0;
        bool is_member = false;
        std::string unit = {};
        std::string doc = {};
        const Quantity* declared = nullptr;
        bool is_root = false;
    };
    void add(SymbolKind kind, const std::string& name, bool positive, Origin origin);
    void find_attitudes(const Scene& scene);
    GiNaC::ex rate_of(const GiNaC::ex& symbol) const;
    GiNaC::ex slope(std::size_t step, std::size_t parameter) const;
    GiNaC::ex written_out(std::size_t step, Depth depth) const;
    double size_of(const GiNaC::ex& e, const std::vector<double>& sizes) const;
    std::optional<std::size_t> step_of(const GiNaC::ex& symbol) const;

    static constexpr std::size_t kinds = static_cast<std::size_t>(SymbolKind::adjoint) + 1;
    std::array<std::vector<Variable>, kinds> variables_;
    std::unordered_map<std::string, std::pair<SymbolKind, std::size_t>> by_name_;  ///< names are unique in a scene
    std::vector<AttitudeSymbols> attitudes_;
    std::vector<std::optional<std::size_t>> places_;  ///< of coordinates in q
    std::vector<GiNaC::ex> definition_values_;
    std::vector<GiNaC::ex> expanded_definitions_;
    std::vector<Step> steps_;
    std::vector<double> step_sizes_;  ///< how many parts each has when it is written out
    std::vector<double> halfway_sizes_;
    mutable std::map<std::pair<std::size_t, Depth>, GiNaC::ex> written_out_;
    mutable std::map<std::pair<std::size_t, std::size_t>, GiNaC::ex> slopes_;
};

}  // namespace dalembert
