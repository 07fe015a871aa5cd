// Runs scenes with settings, and makes columns of them.

// In s; beyond, doubles have no room for errors and shortest steps.
const shortest_run = 1e-150, longest_run = 1e150;

/// Settings as the model has them: `start` holds only values that were changed, by their place; a held input is a number, and so is an end
/// of the run that does not follow from the model.
function settings_of(scene) {
    return {
        until: null,
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
    const take = (name, value, quantity, unit, set) => {
        if (is_in_range(value, quantity, unit))
            set(value);
        else
            refused.push(name);
    };
    const one = {unit: "1", factor: 1, offset: 0};
    for (const [key, low, high] of [["until", shortest_run, longest_run], ["tolerance", 1e-13, 0.01]])
        if (read[key] !== undefined && !(key === "until" && read[key] === null))
            take(key, read[key], {low, high}, one, (value) => { usual[key] = value; });
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
    return refused.length === 0 ?
        "" :
        `The address gives values that are refused, as they are no numbers in their ranges: ${refused.join(", ")}. `;
}

/// The recording of a scene; see dalembert_record(). Where `simulate` would refuse the values, one without rows and with a sentence.
function run_scene(scene, settings) {
    const made = scene.make();
    made.set_parameters(settings.parameters);
    const refusal = (message) => ({rows: [], events: [], is_good: false, ends: false, t: 0, message, steps: 0, implicit_steps: 0, made});
    const until = end_of(scene, settings, made);
    if (!(until >= shortest_run && until <= longest_run))
        return refusal(
            `The end of the run is ${Number.isFinite(until) ? `${until} s` : "no number"} with these parameters. ` +
            "The field \"until\" can set another one.");
    const {start, refused} = start_of(scene, settings, made);
    if (refused) return refusal(refused);
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
    const first = new Float64Array(made.inputs.length);
    inputs(0, start, first);
    const wrong = made.inputs.findIndex((input, i) => scene.fixed_inputs[i] && !is_in_range(first[i], input, scene.input_units[i]));
    if (wrong >= 0)
        return refusal(
            `The input '${made.inputs[wrong].name}' is ${in_words(first[wrong], scene.input_units[wrong])}, ` +
            "which is outside of its declared range.");
    const recording = dalembert_record(made, {
        until,
        tolerance: settings.tolerance,
        intervals: scene.intervals,
        start,
        stops: kink_times(scene, settings, made, until),
        longest_step: scene.longest_step === null ? Infinity : until / scene.intervals,
        inputs: made.inputs.length > 0 ? inputs : null,
        method: settings.method || "automatic",
    });
    return {...recording, made, until, wished_start: start};
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

/// What is said where constraints of a machine with modes, or of an attitude, move the start.
function moved_start(scene, recording) {
    if (recording.rows.length === 0 || !recording.made.constraints || recording.made.constraints.length === 0) return "";
    const begin = recording.rows[0].x, wished = recording.wished_start;
    const moved = scene.states.flatMap((state, i) => {
        if (!(Math.abs(begin[i] - wished[i]) > 1e-9 * Math.max(Math.abs(wished[i]), 1e-3))) return [];
        return [`${state.name} = ${number_text(in_unit(begin[i], state), 4)} ${unit_text(state)}`.trim()];
    });
    return moved.length === 0 ? "" : `The start was moved onto the constraints: ${moved.join(", ")}. `;
}

/// What reproduces a run at a shell: whatever is not named follows from parameters there as it does here.
function command_of(scene, settings) {
    const plant = scene.make();
    const list = (option, values) => values.length === 0 ? "" : ` ${option} "${values.join(",")}"`;
    const named = (name, value, unit) => `${name}=${Number(in_unit(value, unit).toPrecision(15))}`;
    const parameters = settings.parameters.flatMap(
        (value, i) => value === scene.parameters[i] ? [] : [named(plant.parameters[i].name, value, scene.parameter_units[i])]);
    const start = Object.entries(settings.start).map(([i, value]) => named(scene.states[i].name, value, scene.states[i]));
    const inputs = settings.held.flatMap((value, i) => value === null ? [] : [named(plant.inputs[i].name, value, scene.input_units[i])]);
    return scene.command + list("--parameter", parameters) + list("--state", start) + list("--input", inputs) +
        (settings.until === null ? "" : ` --until ${settings.until}`) +
        (settings.tolerance === scene.tolerance ? "" : ` --tolerance ${settings.tolerance}`);
}
