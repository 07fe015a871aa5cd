// SPDX-License-Identifier: BSL-1.0
// A run from its start to its end, recorded at equal intervals.

/// One sentence about how a run ended, with names.
function dalembert_ending(run, status) {
    const plant = run.plant;
    let about = "";
    if ((status === dalembert_not_finite || status === dalembert_step_too_small) && run.blamed < plant.states)
        about = `: state ${plant.state_table[run.blamed].name}`;
    else if ((status === dalembert_constraint_broken || status === dalembert_singular_position) && run.blamed < plant.constraints)
        about = `: constraint ${plant.constraint_table[run.blamed].name}`;
    else if (plant.modes > 0 && run.last_event < plant.events && status !== dalembert_good)
        about = `: event ${plant.event_names[run.last_event]}`;
    else if (plant.modes === 0 && run.last_event < plant.guards && status !== dalembert_good)
        about = `: ${plant.guard_table[run.last_event].doc}`;
    return `At t = ${Number(run.t.toPrecision(6))} s: ${dalembert_status_text(status)}${about}.`;
}

/// `made`: a generated module, with its parameters set. `wishes`: { until, tolerance, intervals, longest_step, stops, start, inputs, method
/// }: inputs writes u of (t, x, u), start holds a value for each state, method is "dop853", "rodas5p" or "automatic". Rows are { t, x, y,
/// u, mode, kinetic, potential, internal }.
function dalembert_record(made, wishes) {
    const plant = dalembert_plant_of(made);
    const run = dalembert_run_new(plant, made);
    run.options.tolerance = wishes.tolerance;
    run.options.method = wishes.method === "dop853" ? dalembert_explicit :
        wishes.method === "rodas5p"                 ? dalembert_rosenbrock :
                                                      dalembert_automatic;
    run.options.longest_step = wishes.longest_step;
    run.options.stops = wishes.stops;
    run.options.stop_count = wishes.stops.length;
    run.options.most_steps = wishes.most_steps || 1000000;
    if (wishes.inputs) run.inputs.function = (context, t, x, u) => wishes.inputs(t, x, u);
    const events = [], rows = [];
    run.on_event = (context, of, t, event, before, after) => {
        if (event < plant.events) events.push({t, name: plant.event_names[event], before, after});
    };
    const energy = (f) => f === null ? 0 : f(made, run.mode, run.x, run.t);
    const record = () => {
        const u = new Float64Array(plant.inputs), y = new Float64Array(plant.outputs);
        if (wishes.inputs) wishes.inputs(run.t, run.x, u);
        if (plant.output !== null) plant.output(made, run.mode, run.x, u, run.t, y);
        rows.push({
            t: run.t,
            x: run.x.slice(),
            y,
            u,
            mode: run.mode,
            kinetic: energy(plant.kinetic_energy),
            potential: energy(plant.potential_energy),
            internal: energy(plant.internal_energy)
        });
    };
    let status = dalembert_run_start(run, 0, wishes.until, Float64Array.from(wishes.start));
    if (status === dalembert_good) record();
    for (let i = 1; status === dalembert_good && i <= wishes.intervals; ++i) {
        status = dalembert_run_to(run, i === wishes.intervals ? wishes.until : wishes.until * i / wishes.intervals);
        if (status === dalembert_good || rows[rows.length - 1].t < run.t) record();
    }
    return {
        rows,
        events,
        is_good: status === dalembert_good,
        ends: status === dalembert_range_left,
        t: run.t,
        message: dalembert_ending(run, status),
        steps: run.steps,
        rejected: run.rejected,
        rhs_calls: run.rhs_calls,
        implicit_steps: run.implicit_steps
    };
}
