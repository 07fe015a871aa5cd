// SPDX-License-Identifier: BSL-1.0
// The memory of a run, which in C is one block: see dalembert_run_memory.h and dalembert_modes_calls.h.
function numbers(count) { return new Float64Array(count); }

function lay_modes(modes, plant, self) {
    const values = dalembert_event_values(plant);
    const kept = new_dalembert_events_memory();
    const times = Array.from({length: plant.events}, () => new_dalembert_times());
    const departures = numbers(plant.events);
    // What begins anew with what is kept.
    kept.times_behind = times;
    kept.departures_behind = departures;
    Object.assign(modes, {
        plant,
        self,
        kept,
        times,
        departures,
        most_events: 100000,
        last_event: DALEMBERT_NONE,
        limit: Infinity,
        u: numbers(plant.inputs + 1),
        u_half: numbers(plant.inputs + 1),
        u_whole: numbers(plant.inputs + 1),
        g: numbers(values + 1),
        g_half: numbers(values + 1),
        g_whole: numbers(values + 1),
        rates: numbers(plant.events + 1),
        s: numbers(2 * plant.time_switches),
        dxdt: numbers(plant.states),
        before: numbers(plant.states),
        after: numbers(plant.states),
        projection: numbers(plant.is_projected ? dalembert_projection_room(plant) : 0),
        candidates: numbers(plant.most_transitions + 1),
        others: numbers(plant.most_transitions + 1),
        is_over: numbers(plant.events + 1),
        is_ignored: numbers(plant.events + 1),
    });
}

function lay_matrices(inside, plant) {
    const n = plant.states;
    const starts = plant.pattern_x.column_starts, starts_u = plant.pattern_u.column_starts;
    dalembert_find_band(plant, inside.J);
    Object.assign(inside.W, inside.J);
    inside.W.is_factored = 1;
    inside.has_matrix = n > 0 && dalembert_band_height(inside.W) <= (1 << 22) / n;
    if (!inside.has_matrix) return;
    inside.J_values = numbers(starts ? starts[n] : n * n);
    inside.J_u = numbers(starts_u ? starts_u[plant.inputs] : n * plant.inputs);
    inside.J.entries = numbers(n * dalembert_band_height(inside.J));
    inside.W.entries = numbers(n * dalembert_band_height(inside.W));
    inside.W.sizes = numbers(n);
    inside.W.exchanges = numbers(n);
}

function lay_constraints(inside, plant) {
    const n = plant.states, m = plant.constraints, degrees = plant.degrees;
    const fill = (polynomial, count) => {
        for (let i = 0; i < count; ++i) polynomial.slopes[i] = numbers(n);
    };
    inside.weighted = numbers(2 * m * degrees + degrees * degrees);
    inside.gram = numbers(2 * m * m + m);
    for (const one of ["pivots", "pivots_of_chosen", "order", "order_of_chosen", "is_held", "is_done"]) inside[one] = numbers(m);
    fill(inside.guess, 3);
    fill(inside.long_step, 9);
    fill(inside.other_step, 7);
}

/// A run of a plant, as dalembert_run_new() makes one.
function dalembert_run_new(plant, self) {
    const run = new_dalembert_run();
    const inside = new_dalembert_run_inside();
    const n = plant.states, guards = dalembert_event_values(plant);
    const is_measured = plant.modes === 0 && plant.is_projected;
    Object.assign(run, {plant, self, inside, x: numbers(n), scale: numbers(n).fill(1), blamed: DALEMBERT_NONE, last_event: DALEMBERT_NONE});
    Object.assign(run.options, {tolerance: 1e-9, finds_scales: 1, most_steps: 100000000, most_events: 100000});
    lay_modes(inside.modes, plant, self);
    inside.kept = new_dalembert_run_memory();
    for (const one
             of ["dxdt", "radius", "stage", "other", "difference", "from_x", "from_dxdt", "next_x", "start_x", "dfdt", "prepared_x",
                 "reach", "rounding", "coast_x"])
        inside[one] = numbers(n);
    for (const one of ["u", "u_ahead", "u_behind", "prepared_u"]) inside[one] = numbers(plant.inputs + 1);
    for (const one of ["row_sizes", "is_used", "chosen"]) inside[one] = numbers(is_measured ? plant.constraints : 0);
    for (const one
             of ["ends", "is_strict", "begins_at_zero", "side", "at_start", "at_before", "sample", "lowest", "low", "at_end", "found",
                 "near_values", "far_values", "seen"])
        inside[one] = numbers(guards);
    inside.watches = Array.from({length: guards}, () => new_dalembert_watch());
    for (let i = 0; i < 16; ++i) inside.k[i] = numbers(n);
    for (let i = 0; i < 4; ++i) inside.dense[i] = numbers(n);
    for (const one of ["c", "part", "behind"]) Object.assign(inside[one], {y: numbers(n), error: numbers(n), dydt: numbers(n)});
    lay_matrices(inside, plant);
    if (is_measured && plant.constraints > 0) lay_constraints(inside, plant);
    Object.assign(inside.modes, {context: run, on_change: dalembert_on_change, coast: dalembert_coast, is_exact: 1});
    inside.guards = guards;
    inside.spares_stages = plant.modes > 0;
    for (let i = 0; i < guards; ++i) {
        inside.ends[i] = plant.modes > 0 ? i < plant.events : plant.guard_table[i].ends;
        inside.has_kinks = inside.has_kinks || (plant.modes > 0 && !inside.ends[i]);
    }
    for (let i = 0; plant.constraint_rank > 0 && inside.is_held !== null && i < plant.constraints; ++i)
        inside.is_held[i] = !plant.constraint_table[i].can_be_left_out;
    return run;
}
