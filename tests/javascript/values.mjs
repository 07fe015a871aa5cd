// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of a module beside those of a compiled plant: node values.mjs MODULE.js VALUES, where VALUES are lines of values.c.
import fs from "fs";

const [module_file, value_file] = process.argv.slice(2);
const text = fs.readFileSync(module_file);
const [make] = Object.values(await import("data:text/javascript;base64," + text.toString("base64")));
const made = make(), n = made.states.length, switches = made.modes.length > 0;
// What is beside the largest entry, and the entry itself: terms that cancel may be larger than all that is left of them.
const beside_largest = 1e-13, beside_itself = 1e-8;
let count = 0, worst = 0, failures = 0;

function compare(name, mine, theirs, point) {
    const largest = theirs.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    theirs.forEach((value, i) => {
        ++count;
        const is_number = Number.isFinite(mine[i]);
        if (value === null ? !is_number : is_number && mine[i] === value) return;
        const error = Math.abs(mine[i] - value);
        worst = Math.max(worst, error / (largest || 1));
        if (value !== null && error <= beside_largest * largest && (error <= beside_itself * Math.abs(value) || error <= 1e-16 * largest))
            return;
        if (++failures <= 5)
            console.log(`${made.model}, ${made.scene}: ${name}[${i}] is ${mine[i]}, in C++ ${value}, of ${largest} at point ${point}`);
    });
}

const lines = fs.readFileSync(value_file, "utf8").trim().split("\n");
lines.forEach((line, point) => {
    const given = JSON.parse(line), {t, mode} = given;
    const x = Float64Array.from(given.x), u = Float64Array.from(given.u), before = switches ? [mode] : [];
    const of_input = ["rhs", "output", "jacobian_t", "output_jacobian_x", "guards", "guard_rates", "kinks"];
    const of_state = ["mass_matrix", "constraint_positions", "constraint_rates", "constraint_jacobian"];
    for (const name of [...of_input, ...of_state]) {
        if (given[name] === undefined || given[name].length === 0) continue;
        const result = new Float64Array(given[name].length);
        made[name](...before, x, ...(of_input.includes(name) ? [u] : []), t, result);
        compare(name, result, given[name], point);
    }
    for (const name of ["kinetic_energy", "potential_energy", "internal_energy"])
        if (given[name] !== undefined) compare(name, [made[name](...before, x, t)], given[name], point);
    for (const name of ["supplied_power", "dissipated_power", "exchanged_power"])
        if (given[name] !== undefined) compare(name, [made[name](...before, x, u, t)], given[name], point);
    // The plant leaves out what is zero for every motion.
    const J = new Float64Array(made.pattern_x ? made.pattern_x.row_indices.length : n * n), dxdt = new Float64Array(n);
    made.rhs_and_jacobian(...before, x, u, t, dxdt, J);
    const stored = [];
    for (let c = 0; given.column_starts.length > 0 && c < n; ++c)
        for (let i = given.column_starts[c]; i < given.column_starts[c + 1]; ++i)
            stored.push(made.pattern_x ? J[i] : J[n * c + given.row_indices[i]]);
    compare("jacobian_x", given.column_starts.length > 0 ? stored : J, given.jacobian_x, point);
    if (given.start === undefined) return;
    const start = new Float64Array(n);
    made.start_state(start);
    compare("start_state", start, given.start, point);
});
console.log(`${made.model}, ${made.scene}: ${count} values, largest difference ${worst.toExponential(1)} of the largest value`);
process.exit(failures > 0 || count === 0 ? 1 : 0);
