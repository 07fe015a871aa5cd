// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as data: names, units, sizes, start values, patterns, modes, events, constraints and functions. Printers of languages make their
// text of it, and need nothing else.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "program/statement.hpp"

namespace dalembert {

/// An entry of a vector. Its place in the list is its place in the vector.
struct PlantQuantity {
    std::string identifier;            ///< unique among those of the vector
    std::string name;                  ///< in the model
    std::string unit;                  ///< SI
    std::string doc;
    std::optional<double> low, high;   ///< of the declared range, in SI
};

/// A parameter, or a family of them: an array.
struct PlantParameter {
    std::string identifier;
    std::string unit;                  ///< SI
    std::string doc;
    bool is_array = false;
    std::vector<Value> defaults;       ///< in SI; one where it is no array
};

/// What depends on parameters alone and is kept when they are set.
struct PlantCached {
    std::string identifier;
    std::string doc;
    std::size_t size = 0;              ///< of an array; 0: a number
};

/// See Guard of the form: a function whose sign matters to who integrates.
struct PlantGuard {
    std::string name;
    std::string doc;
    bool ends;
};

/// Which entries of a Jacobian are stored: all, column by column, or those of compressed columns (CSC).
struct PlantPattern {
    bool is_sparse = false;
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<std::size_t> column_starts;  ///< of what is not zero for every motion, also where all are stored
    std::vector<std::size_t> row_indices;
    std::size_t size() const { return is_sparse ? row_indices.size() : rows * columns; }
};

struct PlantEvent {
    std::string identifier;
    std::string name;
    bool at_once = false;              ///< see Event
    bool at_start = false;
};

/// Where an event leads in a mode; numbers of modes.
struct PlantTransition {
    bool is_watched = false;
    std::vector<std::size_t> next, beside, rest;
};

struct PlantModes {
    std::vector<std::string> modes;    ///< names, which are identifiers
    std::vector<PlantEvent> events;
    std::vector<std::vector<PlantTransition>> transitions;  ///< [event][mode]
    std::size_t most_modes() const;    ///< in one list of a transition; at least 1
};

struct PlantConstraint {
    std::string identifier;
    std::string name;
    std::string unit;                  ///< SI: of the position, or of the rate where there is none
    std::string doc;
    bool has_position;
};

/// Where only some of the constraints are solved for, see note [choice].
struct PlantChoice {
    std::size_t rank;
    std::vector<bool> can_be_left_out, at_start;              ///< by constraint
    std::vector<std::pair<std::string, std::size_t>> chosen;  ///< cached members that are 1 where the constraint is chosen, else 0
};

struct PlantConstraints {
    std::vector<PlantConstraint> list;
    std::vector<bool>
        starts_to_find;  ///< of coordinates, then of velocities: those that constraints determine; empty: no start is looked for
    std::optional<std::size_t> start_mode;  ///< in which they are looked for
    std::optional<PlantChoice> choice;
};

struct PlantFunction {
    enum class Result {
        none,       ///< or in arrays that are arguments
        number,
        truth,
    };
    std::string name;
    Result result = Result::none;
    std::vector<std::string> doc;
    std::optional<std::string> operations;
    std::vector<std::string> equations = {};  ///< for the reader; too many of them are not printed
    bool is_large = false;                    ///< equations would drown the code
    FunctionBody body;
};

/// Taylor series of the motion.
struct PlantSeries {
    std::size_t rows;  ///< pairs of series that are multiplied
    FunctionBody body;
};

/// A measured characteristic, see runtime/dalembert/curve_functions.hpp.
struct PlantCurve {
    std::string name;   ///< as people write it
    std::string table;  ///< as headers name it
    std::string doc;
    bool has_two_variables;
    std::vector<std::vector<Value>> rows;  ///< steps and knots, then one a piece; of two variables those of both, places of both, cells
    std::size_t size() const;              ///< of the whole table
    std::string header() const;            ///< a comment that says what the table is
    const char* helper() const { return has_two_variables ? "map_value" : "curve_piece"; }
};

/// When a controller samples, in s, for the default parameters.
struct PlantSampling {
    double period, first, delay;
};

struct Plant {
    std::string model, scene, title;
    std::size_t degrees = 0;
    std::size_t plain_states = 0;             ///< behind coordinates and velocities
    bool is_separable = false;                ///< accelerations depend on coordinates alone
    std::vector<PlantQuantity> states, inputs, outputs, parameters;
    std::vector<PlantParameter> parameter_members;
    std::vector<PlantCached> cached;
    std::vector<PlantGuard> guards;
    std::size_t time_switches = 0;            ///< functions of time that kinks and jumps follow from
    std::vector<double> start_values;         ///< for the default parameters
    PlantPattern by_state, by_input, by_parameter;
    std::optional<PlantSampling> sampling;    ///< of a controller, whose functions are `sample` alone
    std::optional<PlantModes> modes;
    std::optional<PlantConstraints> constraints;
    FunctionBody update;                      ///< fills what is cached
    std::string update_operations;
    FunctionBody start_state;                 ///< of `x`, which begins with zeros
    /// Functions of motion, energies and guards, in the order in which they are printed.
    std::vector<PlantFunction> functions;
    std::vector<PlantFunction> constraint_functions;
    std::optional<PlantSeries> series;
    std::vector<PlantCurve> curves;
    std::set<std::string> helpers;            ///< functions of the runtime that are called
};

/// A rod or block whose cells are computed in loops. Its cells stand one after the other in x, those of a block row by row.
struct PlantField {
    std::size_t first;         ///< index of the first cell in x
    std::size_t cells;
    std::size_t columns;       ///< in a row; of a rod, all
    int first_number;          ///< of the family of states in the model: T[first_number] is the first cell
    PlantQuantity states;      ///< of one of them: "T"
    bool has_range = false;
};

/// Outputs that contain sums over cells.
struct PlantSums {
    std::size_t count;
    Statements values;                 ///< adds to `sums`
    Statements slopes;                 ///< adds slopes by cells to C
    Statements slopes_by_inputs;       ///< and by inputs to D
    Statements outputs;                ///< y, and what it is differentiated by: C and D at fixed sums, and `by_sums`
    Statements by_state, by_input, by_sum;
};

/// Rods with many cells, around a plant that computes all else: the core. What is said of x is said of all states.
struct PlantFields {
    std::size_t states = 0;
    std::size_t plain_states = 0;
    std::vector<std::size_t> positions;                             ///< of the states of the core in x, rising
    std::vector<std::pair<std::string, std::size_t>> indices;       ///< of states in x, of a rod that of its first cell
    std::vector<PlantField> list;
    std::vector<std::string> equations;                             ///< for the reader
    std::vector<PlantCached> cached;
    Statements update, start_state;
    Statements rates;                                               ///< adds to dxdt
    Statements jacobian, by_input, by_parameter, by_time;           ///< add to J
    Statements energy, power;                                       ///< add to these
    std::optional<PlantSums> sums;
    std::vector<PlantCurve> curves;
    std::set<std::string> helpers;
};

/// What users see of a plant with such rods: all states, and the pattern of df/dx. Functions are those of the core.
Plant whole_plant(const Plant& core, const PlantFields& fields);

/// The number of values of a vector of the interface: "State", "JacobianX", ...
std::size_t size_of(const Plant& plant, const std::string& vector);

}  // namespace dalembert
