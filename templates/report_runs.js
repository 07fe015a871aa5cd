// Runs scenes with settings, and makes columns of them.

/// Settings as the model has them: `start` holds only values that were changed, by their place; a held input is a number.
function settings_of(scene) {
    return {
        until: scene.until,
        tolerance: scene.tolerance,
        parameters: scene.parameters.slice(),
        start: {},
        held: scene.input_texts.map(() => null)
    };
}

/// Takes into `usual` what `read`, from an address, says and fields would take; returns a sentence about what is refused.
function check_settings(scene, read, usual) {
    const plant = scene.make(), refused = [];
    const is_object = (one) => one !== null && typeof one === "object" && !Array.isArray(one);
    if (!is_object(read)) return "The settings of the address are no settings; those of the run are shown. ";
    const fits = (value, quantity, unit) => {
        const in_field = in_unit(value, unit), slack = 1e-12 * Math.abs(in_field);
        return Number.isFinite(value) && in_field + slack >= in_unit(quantity.low, unit) && in_field - slack <= in_unit(quantity.high, unit);
    };
    const take = (name, value, quantity, unit, set) => {
        if (fits(value, quantity, unit))
            set(value);
        else
            refused.push(name);
    };
    const one = {unit: "1", factor: 1, offset: 0};
    for (const [key, low, high] of [["until", Number.MIN_VALUE, Infinity], ["tolerance", 1e-13, 0.01]])
        if (read[key] !== undefined) take(key, read[key], {low, high}, one, (value) => { usual[key] = value; });
    for (const [key, list, units] of [["parameters", plant.parameters, scene.parameter_units], ["held", plant.inputs, scene.input_units]]) {
        if (read[key] === undefined) continue;
        if (!Array.isArray(read[key]) || read[key].length !== list.length) {
            refused.push(`${key} (a list of ${list.length} numbers is expected)`);
            continue;
        }
        read[key].forEach((value, i) => {
            if (key === "held" && value === null) return;
            if (value !== usual[key][i]) take(list[i].name, value, list[i], units[i], (good) => { usual[key][i] = good; });
        });
    }
    if (read.start !== undefined && !is_object(read.start)) refused.push("start");
    for (const [place, value] of is_object(read.start) ? Object.entries(read.start) : []) {
        const state = scene.states[place];
        if (!/^\d+$/.test(place) || state === undefined || state.is_root)
            refused.push(`start ${place}`);
        else
            take(`start of ${state.name}`, value, plant.states[place], state, (good) => { usual.start[place] = good; });
    }
    return refused.length === 0 ? "" : `The address gives values that are refused, as they are no numbers in their ranges: ${refused.join(", ")}. `;
}

/// Whether a start value is of the run, not of the model: more than roundings of the same formula lie between them.
function is_of_run(value, usual) { return Math.abs(value - usual) > 1e-12 * Math.abs(usual); }

/// The recording of a scene; see dalembert_record().
function run_scene(scene, settings) {
    const made = scene.make();
    const n = made.states.length;
    const usual = new Float64Array(n), start = new Float64Array(n);
    made.start_state(usual);
    made.set_parameters(settings.parameters);
    const is_as_written = settings.parameters.every((value, i) => value === scene.parameters[i]);
    if (is_as_written)
        start.set(scene.start);
    else {
        made.start_state(start);  // parameters may move it; what the run says of it stays
        scene.start.forEach((value, i) => {
            if (is_of_run(value, usual[i])) start[i] = value;
        });
    }
    for (const [place, value] of Object.entries(settings.start)) start[place] = value;
    const written = scene.inputs === null ? null : scene.inputs(made.parameter_values);
    const inputs = (t, x, u) => {
        if (written)
            written(t, x, u);
        else
            u.fill(0);
        settings.held.forEach((value, i) => {
            if (value !== null) u[i] = value;
        });
    };
    const recording = dalembert_record(made, {
        until: settings.until,
        tolerance: settings.tolerance,
        intervals: scene.intervals,
        start,
        stops: scene.stops,
        longest_step: scene.longest_step === null ? Infinity : settings.until / scene.intervals,
        inputs: made.inputs.length > 0 ? inputs : null,
        method: settings.method || "automatic",
    });
    return {...recording, made, wished_start: start};
}

/// Columns of a recording in declared units: { name, unit, values }.
function columns_of(scene, recording) {
    const column = (name, unit, of) => ({name, unit: unit_text(unit), values: recording.rows.map((row) => in_unit(of(row), unit))});
    const time = time_unit(recording.t), joule = {unit: "J", factor: 1, offset: 0};
    return [
        {name: "t", unit: time.unit, is_time: true, factor: time.factor, values: recording.rows.map((row) => row.t / time.factor)},
        ...scene.states.map((one, i) => column(one.name, one, (row) => one.is_root ? row.x[i] ** 2 : row.x[i])),
        ...scene.outputs.map((one, i) => column(one.name, one, (row) => row.y[i])),
        ...recording.made.inputs.map((one, i) => column(one.name, scene.input_units[i], (row) => row.u[i])),
        column("kinetic_energy", joule, (row) => row.kinetic),
        column("potential_energy", joule, (row) => row.potential),
        column("internal_energy", joule, (row) => row.internal),
        ...(recording.made.modes.length > 0 ? [{name: "mode", unit: "", values: recording.rows.map((row) => row.mode)}] : []),
    ];
}

/// What is said where constraints move values of the start that a person gave, or those behind changed parameters.
function moved_start(scene, settings, recording) {
    if (recording.rows.length === 0 || !recording.made.constraints || recording.made.constraints.length === 0) return "";
    const begin = recording.rows[0].x, wished = recording.wished_start;
    const moved = scene.states.flatMap((state, i) => {
        if (!(Math.abs(begin[i] - wished[i]) > 1e-9 * Math.max(Math.abs(wished[i]), 1e-3))) return [];
        return [`${state.name} = ${number_text(in_unit(begin[i], state), 4)} ${unit_text(state)}`.trim()];
    });
    return moved.length === 0 ? "" : `The start was moved onto the constraints: ${moved.join(", ")}. `;
}

/// What reproduces a run at a shell. Lengths and starts that the run makes of parameters would follow these there, so they are named.
function command_of(scene, settings) {
    const plant = scene.make();
    const list = (option, values) => values.length === 0 ? "" : ` ${option} "${values.join(",")}"`;
    const number = (value, unit) => String(Number(in_unit(value, unit).toPrecision(15)));
    const changed = (values, of) => values.flatMap((value, i) => value === of[i] ? [] : [i]);
    const is_moved = settings.parameters.some((value, i) => value !== scene.parameters[i]);
    const is_held = plant.constraints !== null && plant.constraints.length > 0;
    const start = {...settings.start};
    if (is_held && (is_moved || Object.keys(start).length > 0)) {
        const rows = run_scene(scene, settings).rows;  // where the constraints let it begin
        if (rows.length > 0) rows[0].x.forEach((value, i) => { start[i] = value; });
    } else if (is_moved && !is_held) {
        const usual = new Float64Array(scene.start.length);
        plant.start_state(usual);
        scene.start.forEach((value, i) => {
            if (is_of_run(value, usual[i]) && !(i in start)) start[i] = value;
        });
    }
    const shown = (i) => scene.states[i].is_root ? start[i] ** 2 : start[i];
    return scene.command +
        list("--parameter",
             changed(settings.parameters, scene.parameters)
                 .map((i) => `${plant.parameters[i].name}=${number(settings.parameters[i], scene.parameter_units[i])}`)) +
        list("--state", Object.keys(start).map((i) => `${scene.states[i].name}=${number(shown(i), scene.states[i])}`)) +
        list("--input",
             settings.held.flatMap(
                 (value, i) => value === null ? [] : [`${plant.inputs[i].name}=${number(value, scene.input_units[i])}`])) +
        ` --until ${settings.until}` +
        (settings.tolerance === scene.tolerance ? "" : ` --tolerance ${settings.tolerance}`);
}
