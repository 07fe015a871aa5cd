// Where a run starts, and whether its values make a machine.

/// What values must keep to; see ValueCondition of the program. What has no value breaks the first rule alone.
const value_rules = {
    above_zero: ([value]) => value > 0,
    not_below_zero: ([value]) => !(value < 0),
    share: ([value]) => !(value < 0 || value > 1),
    below: ([low, high]) => !(low >= high),
    not_above: ([low, high]) => !(low > high),
    square_of_one: ([square]) => !(Math.abs(Math.sqrt(square) - 1) > 1e-6),
    rising: (values) => values[0] === 0 && values.every((value, i) => i === 0 || value > values[i - 1]) &&
        Math.abs(values[values.length - 1] - 1) < 1e-12,
    inertia: (tensor) => {
        const [small, middle, large] = principal_moments(tensor), rounding = 1e-9 * large;
        return !(small < -rounding || large > small + middle + rounding);
    },
};

/// The eigenvalues of a symmetric tensor of nine entries, from the smallest on, by Jacobi's rotations.
function principal_moments(tensor) {
    const m = [0, 1, 2].map((i) => [0, 1, 2].map((j) => tensor[3 * i + j]));
    for (let sweep = 0; sweep < 50; ++sweep)
        for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
            if (m[p][q] === 0) continue;
            const angle = 0.5 * Math.atan2(2 * m[p][q], m[q][q] - m[p][p]), c = Math.cos(angle), s = Math.sin(angle);
            for (let k = 0; k < 3; ++k) [m[k][p], m[k][q]] = [c * m[k][p] - s * m[k][q], s * m[k][p] + c * m[k][q]];
            for (let k = 0; k < 3; ++k) [m[p][k], m[q][k]] = [c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]];
        }
    return [m[0][0], m[1][1], m[2][2]].sort((a, b) => a - b);
}

const is_as_written = (scene, settings) => settings.parameters.every((value, i) => value === scene.parameters[i]);

/// A sentence about the first condition that the values break; "" if they keep all. What the page did not change was checked before.
function broken_condition(scene, made, start) {
    if (scene.checked_values === null) return "";
    const count = scene.conditions.reduce((sum, one) => sum + one.values, 0);
    const values_at = (parameters, x) => {
        const values = new Float64Array(count);
        scene.checked_values(parameters)(0, x, values);
        return values;
    };
    const usual = scene.make();
    usual.set_parameters(scene.parameters);
    const before = values_at(usual.parameter_values, Float64Array.from(scene.start)), now = values_at(made.parameter_values, start);
    let place = 0;
    for (const {rule, values, text} of scene.conditions) {
        const own = now.slice(place, place + values), same = own.every((value, i) => Object.is(value, before[place + i]));
        place += values;
        if (same || value_rules[rule](own)) continue;
        const shown = rule === "inertia" ? principal_moments(own) : rule === "square_of_one" ? own.map(Math.sqrt) : own;
        let next = 0;
        const next_text = () => {
            const value = shown[next++];
            return Number.isFinite(value) ? number_text(value, 6) : "no number";
        };
        return text.replace(/\{\}/g, next_text) + ".";
    }
    return "";
}

/// The start of a run: { start, refused }, with a sentence where `simulate` would refuse it, too. What a person or the model gives stays,
/// and the constraints determine the rest.
function start_of(scene, settings, made) {
    const start = Float64Array.from(scene.start), given = Object.entries(settings.start);
    if (is_as_written(scene, settings) && given.length === 0) return {start, refused: ""};
    if (!is_as_written(scene, settings) || scene.held !== null) scene.start_values(made.parameter_values)(start);
    for (const [place, value] of given) start[place] = value;
    const wrong = made.states.findIndex((state, i) => !is_in_range(start[i], state, scene.states[i]));
    if (wrong >= 0) {
        const {name, is_root} = scene.states[wrong], value = is_root ? start[wrong] ** 2 : start[wrong];
        return {
            start,
            refused: Number.isFinite(value) ?
                `The start of '${name}' is ${in_words(value, scene.states[wrong])}, which is outside of its declared range.` :
                `The start of '${name}' has no value with these parameters.`
        };
    }
    const apart = scene.held === null ? "" : meet_constraints(scene, settings, made, start);
    const refused = apart || broken_condition(scene, made, start);
    return {start, refused: refused && refused[0].toUpperCase() + refused.slice(1)};
}

/// Newton's method with the least steps of what is free, each halved until it helps; a sentence where a constraint stays open.
function meet_constraints(scene, settings, made, x) {
    const m = scene.constraints.length, n = made.degrees;
    const filled = (f, size) => {
        const values = new Float64Array(size);
        if (f !== null) f(made.parameter_values)(0, x, values);
        return values;
    };
    for (const [kind, what] of [[0, "position"], [1, "rate"]]) {
        const free = scene.free[kind].map((place) => place in settings.start ? -1 : place);
        const rest = () => filled(scene.held[2 * kind], m);
        const size_of = (r) => r.reduce((sum, one) => sum + one * one, 0);
        for (let step = 0, is_better = true; step < 60 && is_better; ++step) {
            const r = rest(), before = size_of(r), at = x.slice();
            if (!(before > 0)) break;
            const A = filled(scene.held[2 * kind + 1], m * n).map((slope, k) => free[k % n] < 0 ? 0 : slope);
            const least = least_step(A, r, m, n);
            is_better = false;
            for (let half = 0, length = 1; half < 20 && !is_better; ++half, length /= 2) {
                free.forEach((place, j) => {
                    if (place >= 0) x[place] = at[place] - length * least[j];
                });
                is_better = size_of(rest()) < before;
            }
            if (!is_better) x.set(at);
        }
        const left = rest(), slopes = filled(scene.held[3], m * n);
        const largest = 1 + x.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
        for (let i = 0; i < m; ++i) {
            const slope = Math.sqrt(size_of(slopes.subarray(n * i, n * i + n)));
            if (Math.abs(left[i]) <= 1e-9 * largest * slope) continue;
            return `the start values do not meet constraint '${scene.constraints[i]}': its ${what} is ${number_text(left[i], 4)} there, ` +
                "not zero. What the model gives and what stands in a field is kept, and the rest cannot meet it.";
        }
    }
    return "";
}

/// The least x with A*x = r, as far as rows of A are independent.
function least_step(A, r, m, n) {
    const rows = [], x = new Float64Array(n);
    for (let i = 0; i < m; ++i) {
        const row = A.slice(n * i, n * i + n), product = (other) => row.reduce((sum, one, j) => sum + one * other[j], 0);
        const before = product(row);
        let value = r[i];
        for (let twice = 0; twice < 2; ++twice)
            for (const known of rows) {
                const factor = product(known.row) / known.square;
                known.row.forEach((one, j) => { row[j] -= factor * one; });
                value -= factor * known.value;
            }
        const square = product(row);
        if (square > 1e-20 * before) rows.push({row, value, square});
    }
    for (const {row, value, square} of rows) row.forEach((one, j) => { x[j] += value / square * one; });
    return x;
}
