// SPDX-License-Identifier: GPL-3.0-or-later
// Media, volumes, reservoirs and flows as they were written.
#pragma once

#include "elements/item.hpp"

namespace dalembert {

struct Medium : Item {
    enum class Law { ideal_gas, liquid, incompressible, given };
    Law law = Law::liquid;
    ExpressionPtr gas_constant;
    std::optional<Property> density;
    ExpressionPtr bulk_modulus;
    ExpressionPtr expansion;
    std::optional<Property> isochoric_heat;
    std::optional<Property> energy;
    std::optional<Property> pressure;  ///< (rho, T) -> p
    ExpressionPtr reference_pressure;
    ExpressionPtr reference_temperature;
};

/// A medium at a state that nothing in the model changes: ambient, supply, tank.
struct Reservoir : Item {
    Reference medium;
    ExpressionPtr pressure;
    ExpressionPtr temperature;
    ExpressionPtr potential;
};

/// A place where flows meet and nothing is stored: they sum up to zero, from which its pressure follows.
struct Junction : Item {
    Reference medium;
    ExpressionPtr potential;
};

/// A control volume with one medium in one state.
struct Volume : Item {
    Reference medium;
    ExpressionPtr volume;
    ExpressionPtr pressure;     ///< a state; with `filling` any expression
    ExpressionPtr density;      ///< a state
    ExpressionPtr mass;         ///< a state
    ExpressionPtr filling;      ///< a state that the volume follows
    ExpressionPtr temperature;  ///< a state, which a scene may leave out
    ExpressionPtr isothermal;
    struct Polytropic {
        ExpressionPtr exponent, pressure, temperature;
        Span span;
    };
    std::optional<Polytropic> polytropic;
    ExpressionPtr head;
    ExpressionPtr gravity;
    ExpressionPtr potential;
    ExpressionPtr heat;
    ExpressionPtr shaft_power;
    ExpressionPtr smallest;
    bool empties = false;  ///< being filled or empty is a mode
};

/// What goes from one volume, reservoir or junction to another.
struct Flow : Item {
    enum class Law { given_mass, given_volume, hydraulic_orifice, pneumatic_orifice, laminar, check_valve, pump, pipe };
    Law law = Law::given_mass;
    Reference from;
    Reference to;
    ExpressionPtr mass_flow;
    ExpressionPtr volume_flow;
    ExpressionPtr area;
    ExpressionPtr coefficient;
    ExpressionPtr width;
    ExpressionPtr conductance;
    ExpressionPtr cracking_pressure;
    bool switches = false;   ///< of a check valve being open or shut, of a pneumatic orifice being choked and the direction, are modes
    ExpressionPtr displacement;
    ExpressionPtr speed;
    ExpressionPtr velocity;  ///< a state
    ExpressionPtr length;
    std::optional<::dalembert::Law> loss;
};

}  // namespace dalembert
