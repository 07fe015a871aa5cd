// SPDX-License-Identifier: BSL-1.0
// A generated module behind the table of functions that the integrators work with: see dalembert_plant in plant.h.
function dalembert_plant_of(made) {
    const switches = made.modes.length > 0;
    // Functions of modules take a mode where the machine has some.
    const adapted = (f) => f === undefined ? null :
        switches                           ? (self, mode, ...rest) => f(mode, ...rest) :
                                             (self, mode, ...rest) => f(...rest);
    const whole = {column_starts: null, row_indices: null};
    const kinds = ["next", "beside", "rest"];
    const constraints = made.constraints === null ? [] : made.constraints;
    const n = made.states.length;
    return {
        states: n,
        inputs: made.inputs.length,
        outputs: made.outputs.length,
        parameters: made.parameters.length,
        degrees: made.degrees,
        velocity_place: n - made.plain_states - made.degrees,
        guards: switches ? 0 : made.guard_table.length,
        kinks: switches ? made.guard_table.length : 0,
        constraints: constraints.length,
        modes: made.modes.length,
        events: made.events.length,
        state_table: made.states,
        guard_table: made.guard_table,
        constraint_table: constraints,
        mode_names: made.modes,
        event_names: made.events.map((one) => one.name),
        is_projected: made.constraints !== null,
        constraint_rank: made.constraint_rank,
        most_transitions: Math.max(1, ...made.transitions.flat().flatMap((to) => kinds.map((kind) => to[kind].length))),
        pattern_x: made.pattern_x || whole,
        pattern_u: made.pattern_u || whole,
        start_state: (self, x) => made.start_state(x),
        rhs: switches ? (self, mode, x, u, t, dxdt) => made.rhs(mode, x, u, t, dxdt) :
                        (self, mode, x, u, t, dxdt) => made.rhs(x, u, t, dxdt),
        rhs_and_jacobian: adapted(made.rhs_and_jacobian),
        jacobian_u: adapted(made.jacobian_u),
        jacobian_t: adapted(made.jacobian_t),
        output: adapted(made.output),
        mass_matrix: adapted(made.mass_matrix),
        kinetic_energy: adapted(made.kinetic_energy),
        potential_energy: adapted(made.potential_energy),
        internal_energy: adapted(made.internal_energy),
        guard_values: adapted(made.guard_table.length > 0 || switches ? made.guards : undefined),
        guard_rates: adapted(made.guard_rates),
        kink_values: adapted(made.kinks),
        time_switches: made.time_switch_count || 0,
        time_switch_values: adapted(made.time_switches),
        holds: adapted(made.holds),
        is_watched: (mode, event) => made.transitions[event][mode].is_watched,
        happens_at_once: (event) => made.events[event].at_once,
        happens_at_start: (event) => made.events[event].at_start,
        reset: (self, event, mode, x, u, t) => made.reset(event, mode, x, u, t),
        settle: made.settle === undefined ? null : (self, event, mode, x, u, t) => made.settle(event, mode, x, u, t),
        transitions: (event, mode, kind, modes) => {
            const list = made.transitions[event][mode][kinds[kind]];
            modes.set(list);
            return list.length;
        },
        constraint_positions: adapted(made.constraint_positions),
        constraint_rates: adapted(made.constraint_rates),
        constraint_jacobian: adapted(made.constraint_jacobian),
        correction: adapted(made.correction),
        move_back: (self, x, step) => made.move_back(x, step),
        solve_for: (self, chosen) => made.solve_for(chosen),
    };
}
