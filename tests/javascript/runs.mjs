// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a page beside those of `dalembert simulate`, by the same method at the same tolerance: node runs.mjs PROGRAM PAGE.html
// MODEL.toml. Prints a row for each scene and method, with the largest difference of a column beside its largest value.
import {spawnSync} from "child_process";
import fs from "fs";
import os from "os";
import path from "path";

import {script_of} from "./page.mjs";

const [program, file, model] = process.argv.slice(2);
const tolerance = 1e-10;
// Both make the same steps with one method. Where roundings decide how long steps are, as at the limit of stability of explicit ones, what
// they may differ by is what the tolerance leaves: how far the run of the program is from its run at a tenth of the tolerance, or by the
// other method.
const limit = 1e-9;
const page = await script_of(file);
if (page === null) {
    console.log(`${path.basename(model)}: no scene runs`);
    process.exit(0);
}

/// The columns of a CSV file by their names without units.
function read_csv(name) {
    const [head, ...lines] = fs.readFileSync(name, "utf8").trim().split("\n");
    const rows = lines.map((line) => line.split(",").map(Number));
    return new Map(head.split(",").map((title, i) => [title.replace(/ \[[^[]*\]$/, ""), rows.map((row) => row[i])]));
}

function simulated(scene, method, tolerance) {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), "runs"));
    try {
        const options = [
            "--scene", scene.name, ...(scene.run ? ["--run", scene.run] : []), "--tolerance", tolerance, "--method", method, "--no-plot",
            "-o", folder
        ];
        const done = spawnSync(program, ["simulate", model, ...options], {encoding: "utf8"});
        const csv = fs.readdirSync(folder).find((name) => name.endsWith(".csv") && !name.endsWith("_events.csv"));
        return {code: done.status, words: done.stderr, columns: csv ? read_csv(path.join(folder, csv)) : null};
    } finally {
        fs.rmSync(folder, {recursive: true});
    }
}

/// In SI, as files have them.
function recorded(scene, run) {
    const columns = new Map();
    scene.states.forEach((one, i) => columns.set(one.name, run.rows.map((row) => one.is_root ? row.x[i] ** 2 : row.x[i])));
    scene.outputs.forEach((one, i) => columns.set(one.name, run.rows.map((row) => row.y[i])));
    run.made.inputs.forEach((one, i) => columns.set(one.name, run.rows.map((row) => row.u[i])));
    for (const [name, key] of [
             ["kinetic_energy", "kinetic"], ["potential_energy", "potential"], ["internal_energy", "internal"], ["mode", "mode"]])
        columns.set(name, run.rows.map((row) => row[key]));
    return columns;
}

/// The largest difference of a column beside its largest value; rows that `left_out` tells are not compared.
function largest_difference(theirs, mine, left_out) {
    let worst = 0, where = "";
    const t = theirs.get("t");
    for (const [name, values] of theirs) {
        if (!mine.has(name) || name === "t") continue;
        const largest = values.reduce((most, value) => Math.max(most, Math.abs(value)), 0) || 1;
        for (let i = 0; i < Math.min(values.length, mine.get(name).length); ++i) {
            if (left_out[i]) continue;
            const numbers = mine.get(name), from = (k) => Math.abs(values[i] - numbers[k]) / largest;
            // An output may jump where the row stands; roundings then choose the value of before or of behind.
            const difference = from(i) > limit && (from(i - 1) <= limit || from(i + 1) <= limit) ? 0 : from(i);
            if (!(difference <= worst)) [worst, where] = [difference, `${name} at ${t[i]} s`];
        }
    }
    return {worst, where};
}

let failures = 0;
for (const scene of page.scenes)
    for (const method of ["dop853", "rodas5p"]) {
        const name = `${path.basename(model, ".toml")} ${scene.name} ${method}`;
        const program_run = simulated(scene, method, tolerance);
        const run = page.run_scene(scene, {...page.settings_of(scene), tolerance, method});
        if (program_run.columns === null) {
            console.log(`${name}: simulate refuses: ${program_run.words.split("\n")[0]}`);
            continue;
        }
        const rows = program_run.columns.get("t").length;
        if (scene.network && !page.network_rows(scene, run).every((values) => values.every(Number.isFinite)))
            throw new Error(`${name}: the network has values that are not finite`);
        // A row at the time of an event may be that before or behind it.
        const is_event = run.rows.map((row) => run.events.some((event) => Math.abs(event.t - row.t) < 1e-9 * scene.until));
        const {worst, where} = largest_difference(program_run.columns, recorded(scene, run), is_event);
        const own_error = (...other) => largest_difference(program_run.columns, simulated(scene, ...other).columns, is_event).worst;
        const other_method = method === "dop853" ? "rodas5p" : "dop853";
        const left = worst <= limit ? 0 : Math.max(own_error(method, tolerance / 10), own_error(other_method, tolerance));
        // The last row of a run that ends early is that of its last step.
        const stops_alike =
            (program_run.code === 4) === (!run.is_good && !run.ends) && Math.abs(rows - run.rows.length) <= (run.is_good ? 0 : 1);
        const is_good = worst <= Math.max(limit, 3 * left) && stops_alike && rows > 1;
        if (!is_good) ++failures;
        console.log(
            `${is_good ? "" : "FAILED: "}${name}: ${worst.toExponential(1)} ${where}; ${run.rows.length} rows, ${run.steps} steps, ` +
            `${run.events.length} events${left > 0 ? `; the tolerance leaves ${left.toExponential(1)}` : ""}${
                run.is_good ? "" : `; ${run.message}`}` +
            `${stops_alike ? "" : `; ${rows} rows, code ${program_run.code} of the program`}`);
    }
process.exit(failures > 0 ? 1 : 0);
