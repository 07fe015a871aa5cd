// SPDX-License-Identifier: GPL-3.0-or-later
// The derived machine: M(q) qdd + bias(q, qd, z, t) = Q(...), zd = f, outputs, energies and powers. Everything later stages prove,
// emit or print is read from here.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "balance/balance_equation.hpp"
#include "balance/circuit.hpp"
#include "balance/field.hpp"
#include "form/composite_motion.hpp"
#include "mechanics/chain.hpp"
#include "mechanics/dalembert.hpp"
#include "mechanics/euler_lagrange.hpp"
#include "mechanics/forces.hpp"
#include "mechanics/jets.hpp"
#include "mechanics/load.hpp"
#include "mechanics/solid.hpp"
#include "symbolic/affine_rate.hpp"
#include "symbolic/values.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

struct OutputEquation {
    std::string name;
    std::string base;
    int index;
    bool is_member;
    std::string unit;  ///< in SI, empty when the model gives none
    std::string doc;
    GiNaC::ex value;   ///< may contain accelerations and state rates; zero where the output contains sums over cells in loops
    std::optional<GiNaC::ex> with_sums = {};  ///< the value in their letters

    const GiNaC::ex& shown() const { return with_sums ? *with_sums : value; }
};

/// The balances with names for mass flows, densities and specific energies, for people. What is proven and emitted is written out.
struct NamedBalances {
    std::vector<std::pair<GiNaC::ex, GiNaC::ex>> names;     ///< letter and value, each made of those before it
    std::vector<std::pair<GiNaC::ex, GiNaC::ex>> balanced;  ///< letters of temperatures, and the heat that is zero with them
    std::vector<std::pair<GiNaC::ex, GiNaC::ex>> junctions; ///< letters of pressures, and the mass flow that is zero with them
    GiNaC::exmap temperatures;  ///< what those and other sought temperatures are, to be replaced by their letters
    /// With the letters of sought temperatures.
    GiNaC::ex shortened(const GiNaC::ex& e) const {
        return temperatures.empty() ? e : e.subs(temperatures, GiNaC::subs_options::no_pattern);
    }
    std::vector<GiNaC::ex> state_rates;
    GiNaC::ex internal_energy;
    GiNaC::ex exchanged_power;
};

/// A constraint in one mode.
struct ConstraintEquation {
    const Constraint* item;
    bool holds;
    bool has_multiplier;                 ///< its force is an unknown; else a velocity follows from it
    bool is_redundant;  ///< it follows from others wherever they hold. Left out in a mode; else one of the last multipliers
    AffineRate rate;                     ///< zero where it holds
    std::optional<GiNaC::ex> position;   ///< zero with it
    GiNaC::ex force;                     ///< along the rate, on the machine; may contain accelerations, or be a multiplier
    /// The rate, written out.
    GiNaC::ex whole_rate;
    std::string name;                    ///< "loop", or "loop[2]" of a family
    int index = 0;                       ///< of a family
};

/// Constraints whose rates repeat each other in a mode: sum of made_of[i]*rate[i] = 0. What each of them bears is known but for
/// share*made_of[i], with the force of the last of them as the share: made_of is 1 there, and 0 in all other repetitions.
struct Repetition {
    std::size_t last;                   ///< constraint
    std::vector<GiNaC::ex> made_of;     ///< factors of all constraints, numbers or parameters of known sign
    bool is_even = false;               ///< of frictions in a loop, whose factors change with the motion and have any sign
};

/// What is solved for: the accelerations of coordinates that constraints leave free, all of them where nothing is eliminated; and behind
/// them multipliers, the forces of constraints from which no velocity follows: matrix*unknowns = force. With M of the free coordinates and
/// J of those constraints the matrix is [M, -J'; -J, 0]; the rows of constraints say -(J qdd - gamma) = 0.
struct Motion {
    std::vector<std::size_t> free;                                      ///< coordinates
    std::vector<std::size_t> multipliers;                               ///< constraints, by place in the system
    GiNaC::matrix matrix;
    std::vector<GiNaC::ex> force, residual;                             ///< residual = matrix*unknowns - force
    std::size_t unknowns() const { return free.size() + multipliers.size(); }
    std::vector<std::pair<std::size_t, AffineRate>> velocities;         ///< of the other coordinates, by those of the free ones
    std::vector<std::pair<std::size_t, GiNaC::ex>> accelerations;       ///< of the other coordinates
    std::vector<std::pair<std::size_t, GiNaC::ex>> positions;           ///< coordinates that lie on a constraint, by the others
    /// Where a coordinate moves nothing that has inertia, M is singular although the whole matrix is not. Then M + weight*J'J is
    /// factorised, with the constraints J that such coordinates are in: the accelerations that constraints allow are the same. 0 where M
    /// will do.
    GiNaC::numeric weight = 0;
};

/// What is solved in place of matrix, force and residual: the same accelerations and multipliers follow.
struct SolvedMotion {
    GiNaC::matrix matrix;
    std::vector<GiNaC::ex> force, residual;
};

/// A load with what its unknowns are in equilibrium.
struct LoadSolution {
    const Load* load;
    std::vector<LoadShare> shares;     ///< of its forces and moments, with the solution inserted
    std::vector<GiNaC::ex> unknowns;   ///< values, in order of declaration
    SpaceVector force() const;         ///< the resultant (2.28)
    SpaceVector moment() const;        ///< about the point of reference (2.38)
};

/// A constraint that is struck: velocities of free coordinates change by mass^-1*direction*impulse, so that the rate becomes -restitution
/// times what it was.
struct Impact {
    std::vector<GiNaC::ex> direction;   ///< of the rate by the free velocities
    GiNaC::ex drift;                    ///< rate = direction*velocities + drift
    GiNaC::ex restitution;
    std::optional<std::size_t> pivot;   ///< where nothing is left of the rate: the free coordinate whose velocity follows from it
    bool takes_roundings = false;       ///< and no more: note [dead centres]
    GiNaC::ex least = 0;                ///< then direction^2 is zero below it
};

/// Note [dead centres]: friction sticks where its rate, a factor times a velocity, falls to zero. At the dead centre of a crank it is the
/// factor that becomes zero: friction cannot hold the crank there, and the velocity stays. A factor is zero below a millionth of its size
/// at any angle. The size of other factors is not known; but where friction sticks, nothing but rounding is left of the velocity. The
/// number is one over the square of the largest rounding, which follows from how exactly the time of a stop is known.
inline constexpr long roundings_squared = 100000000;  // 1/(1e-4 m/s)^2, or of rad/s

/// New values of x, by place, made of the old ones.
struct Reset {
    std::vector<std::pair<std::size_t, GiNaC::ex>> values;
    std::optional<Impact> impact;
};

/// An event in one mode.
struct EventEquation {
    const Event* item;  ///< null where a medium or volume brings it
    std::string name, doc;
    bool ends;
    bool is_watched;
    GiNaC::ex guard;  ///< falls through zero; may contain accelerations
    GiNaC::ex rate;   ///< of the guard; may contain accelerations and their rates
    Reset reset, rest;
    std::vector<const Event*> together = {};  ///< events that happen with it: of constraints that let go together
    /// The modes that it leads to, in order of preference: where all of these events happen, else each of them alone.
    std::vector<Condition> next() const;
};

/// A function of time, and letters that stand for numbers, whose changes of sign are kinks or jumps.
struct SwitchInTime {
    GiNaC::ex function;
    std::vector<GiNaC::ex> rates;  ///< how fast the arguments of its sines and cosines rise, at t = 0
};

/// Lives at one place, because its parts refer to each other.
struct System {
    System(const Names& names, Scene chosen);
    System(const System&) = delete;
    System& operator=(const System&) = delete;

    const Names& names;
    Scene scene;
    Symbols symbols;
    Translator translate;
    Solids solids;
    /// A load of the scene, solved when it is asked for first. Throws Failure (needs-absent, and what solve_load does).
    const LoadSolution& load(const std::string& name, const Span& span) const;

    std::vector<BodyMotion> bodies;
    std::optional<Chain> chain;     ///< of many bodies that are placed on each other and free to move
    std::optional<CompositeMotion> composites;  ///< of a chain in space: what M, coriolis and gravity are then
    std::vector<Potential> potentials;
    std::vector<Resistance> resistances;
    std::vector<Supply> supplies;
    std::vector<Ejection> ejections;
    Fluids fluids;
    HeatNetwork heat;
    Circuit circuit;

    GiNaC::matrix mass;             ///< M, from d'Alembert
    Generalised coriolis;           ///< inertial terms without qdd, from d'Alembert
    Generalised gravity;            ///< generalised forces of gravity
    Generalised elastic;            ///< of springs and other potentials
    Generalised dissipative;        ///< of dampers
    Generalised supplied;           ///< Q: of forces, torques and inputs
    Generalised bias;               ///< coriolis - gravity - elastic - dissipative - (forces of fluids and circuits)
    Generalised residual;           ///< M qdd + bias - Q, zero on every motion

    std::vector<GiNaC::ex> kinetic; ///< kinetic energies: one a body, then one a plain term
    GiNaC::ex kinetic_energy;
    GiNaC::ex potential_energy;
    GiNaC::ex supplied_power;
    GiNaC::ex dissipated_power;
    GiNaC::ex prescribed_power;     ///< contains accelerations where kinematics depend on time
    GiNaC::ex internal_energy;      ///< of fluids, heat elements and circuits
    GiNaC::ex exchanged_power;      ///< of enthalpy flows, heat, shafts and jets over the border
    /// Whether anything stores internal energy; whether anything crosses the border.
    bool has_balances() const { return !fluids.empty() || !heat.empty() || !circuit.empty(); }
    bool has_exchange() const { return has_balances() || !ejections.empty(); }

    std::vector<GiNaC::ex> state_rates;  ///< zd
    /// Parameters that derivatives are made by; those by others are left out as if they were zero. Nothing: by all.
    std::optional<std::set<std::string>> slopes_by;
    /// An expression with the rates of states replaced by what they are.
    GiNaC::ex with_rates(const GiNaC::ex& e) const;

    /// The rate of what parameters and states determine.
    Rate rate() const;

    /// Where the model ends and where its right-hand side has edges: of fluids, and behind them of functions with kinks and jumps in the
    /// equations.
    std::vector<Guard> guards;
    /// Of time, parameters and inputs alone; what stands inside another comes first. The same in all modes.
    std::vector<SwitchInTime> time_switches;

    NamedBalances named;
    std::vector<OutputEquation> outputs;
    std::vector<CellSum> cell_sums;  ///< that outputs contain
    /// Only while outputs are derived: the letter of a sum over cells of a field.
    std::function<GiNaC::ex(const CellField& field, const CellRange& cells, const GiNaC::ex& term, const Expression& place)> sum_over_cells;

    std::vector<ConstraintEquation> constraints;
    std::vector<Repetition> repetitions;
    Motion motion;
    std::vector<Diagnostic> warnings;
    /// Whether runs have to be brought back to constraints: to those with a multiplier, and to eliminated ones whose rate has factors that
    /// move. What others say integration keeps exactly.
    bool needs_projection() const;
    /// With the weight of the constraints of coordinates without inertia; and M with it, of all coordinates, the metric of projections.
    SolvedMotion solved_motion() const;
    GiNaC::matrix metric() const;
    /// The letters of what is solved for, and where each stands in a list of all accelerations, with the multipliers behind them.
    std::vector<GiNaC::ex> unknowns() const;
    std::vector<std::size_t> unknown_places() const;
    std::vector<EventEquation> events;
    /// Velocities and accelerations that constraints determine, by the others.
    GiNaC::exmap held_motion() const;

private:
    mutable std::map<std::string, LoadSolution> loads_;
};

/// Solves the balances of force and moment (2.39) of a load for its unknowns, exactly. Throws Failure (not-affine: unknowns multiply each
/// other; undetermined: statically indeterminate; no-equilibrium: a balance that no unknown can meet).
LoadSolution solve_load(const System& system, const Load& load);

/// Sets the rates of the states that a volume determines. Of a state that is integrated as its root w: dw/dt = d(w^2)/dt/(2w).
void set_rates(std::vector<GiNaC::ex>& state_rates, const ControlVolume& volume, const VolumeBalance& balance, const Symbols& symbols);

/// Derives a scene by d'Alembert's principle; energies and powers on their own. Throws Failure.
std::unique_ptr<System> derive(const Names& names, Scene scene);

}  // namespace dalembert
