// When a run ends, and where it is known before that it has kinks and jumps.

/// How long the run is, in s: as a person says, or as the model does with these parameters.
function end_of(scene, settings, made) {
    if (settings.until !== null) return settings.until;
    if (scene.end_of_run === null || is_as_written(scene, settings)) return scene.until;
    const end = new Float64Array(1);
    scene.end_of_run(made.parameter_values)(end);
    return end[0];
}

/// Times in s between 0 and `until`, as the program finds them: see input_kinks() there.
function kink_times(scene, settings, made, until) {
    const found = new Set(scene.stops.filter((t) => t < until));
    if (is_as_written(scene, settings) && until <= scene.until) return [...found];
    for (const t of scene.known_times)
        if (t < until) found.add(t);
    for (const {waves, functions, rates} of scene.switches) {
        const all = functions(made.parameter_values), values = new Float64Array(waves.length);
        const fast = new Float64Array(waves.reduce((sum, count) => sum + count, 0));
        if (rates !== null) rates(made.parameter_values)(fast);
        let first = 0;
        waves.forEach((count, i) => {
            const fastest = fast.subarray(first, first + count).reduce((most, rate) => Math.max(most, Math.abs(rate) || 0), 0);
            first += count;
            const sign_at = (t) => {
                all(t, values);
                return Math.sign(values[i]);
            };
            add_changes_of_sign(found, sign_at, until, Math.min(100000, Math.max(1000, Math.trunc(4 * fastest * until / Math.PI))));
        });
    }
    const rising = [...found].sort((a, b) => a - b), result = [];
    for (const t of rising)  // a zero that is a number has one just before it and one on it
        if (t > 0 && (result.length === 0 || t - result[result.length - 1] > 4 * Number.EPSILON * t)) result.push(t);
    return result;
}

/// What is known already divides the run: what stands inside others has its own kinks.
function add_changes_of_sign(found, sign_at, until, parts) {
    const times = [], divide = (from, to) => { for (let k = 1; k < 4; ++k) times.push(from + (to - from) * k / 4); };
    for (let i = 0; i <= parts; ++i) times.push(until * i / parts);
    let last = 0;
    for (const t of [...found].sort((a, b) => a - b)) {
        divide(last, t);
        last = t + Math.max(t, until) * Number.EPSILON;
        times.push(t, last);
    }
    divide(last, until);
    times.sort((a, b) => a - b);
    let before = sign_at(0);
    for (let i = 1; i < times.length; ++i) {
        if (times[i] === times[i - 1]) continue;
        const sign = sign_at(times[i]);
        if (!Number.isNaN(sign) && !Number.isNaN(before) && sign !== before) {
            let from = times[i - 1], to = times[i];
            for (let middle = from + (to - from) / 2; middle > from && middle < to; middle = from + (to - from) / 2)
                if (sign_at(middle) === before)
                    from = middle;
                else
                    to = middle;
            found.add(from);
        }
        before = sign;
    }
}
