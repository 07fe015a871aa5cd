// SPDX-License-Identifier: GPL-3.0-or-later
// What a page copies as command line makes the run that it shows, with all kinds of settings changed; where the page refuses values in
// words, the command is refused, too: node command.mjs PROGRAM PAGE.html MODEL.toml [CHANGES]. CHANGES are JSON: { scene, parameters,
// start, held, until, refused }, with values by names in SI; without them some of each kind are changed in the first scene.
import {execSync} from "child_process";
import fs from "fs";
import os from "os";
import path from "path";

import {script_of} from "./page.mjs";

const [program, file, model, wished] = process.argv.slice(2);
const page = await script_of(file), changes = wished ? JSON.parse(wished) : null;
const scene = page.scenes[changes !== null && changes.scene ? place_of(page.scenes, changes.scene) : 0];
const settings = page.settings_of(scene), plant = scene.make();

function place_of(list, name) {
    const place = list.findIndex((one) => one.name === name);
    if (place < 0) throw new Error(`the page has no ${name}`);
    return place;
}

if (changes === null) {
    const within = (value, {low, high}) => Math.min(high, Math.max(low, value));
    settings.parameters = settings.parameters.map((value, i) => i < 3 ? within(1.01 * value, plant.parameters[i]) : value);
    const moved = scene.states.findIndex((state) => !state.is_root);  // a page has no field for a root
    if (moved >= 0) settings.start[moved] = within(scene.start[moved] + 0.01, plant.states[moved]);
    settings.held = settings.held.map((value, i) => i === 0 ? within(0.5, plant.inputs[i]) : value);
    settings.until = 0.9 * scene.until;
} else {
    for (const [name, value] of Object.entries(changes.parameters || {})) settings.parameters[place_of(plant.parameters, name)] = value;
    for (const [name, value] of Object.entries(changes.start || {})) settings.start[place_of(scene.states, name)] = value;
    for (const [name, value] of Object.entries(changes.held || {})) settings.held[place_of(plant.inputs, name)] = value;
    if (changes.until) settings.until = changes.until;
}
settings.tolerance = 1e-11;
const run = page.run_scene(scene, settings), command = page.command_of(scene, settings);

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "command"));
process.on("exit", () => fs.rmSync(folder, {recursive: true}));
const shell = command.replace("dalembert", program).replace(path.basename(model), model);
let words = "";
try {
    execSync(`${shell} --no-plot -o ${folder}`, {stdio: ["ignore", "ignore", "pipe"], encoding: "utf8"});
} catch (error) {
    words = error.stderr;
    if (error.status !== 2 && error.status !== 4) throw error;
}
if (changes !== null && changes.refused) {
    const said = [[run.message, run.rows.length > 0], [words, words === ""]];
    for (const [text, is_taken] of said)
        if (is_taken || !text.toLowerCase().includes(changes.refused.toLowerCase()))
            throw new Error(`${command} is not refused with "${changes.refused}", but: "${text}"`);
    console.log(`${command}: refused`);
    process.exit(0);
}
if (run.rows.length === 0) throw new Error(`the page refuses ${command}: ${run.message}; the program says "${words}"`);
// Whole runs, row by row: at both ends a ball may be on the floor whatever it did between them. At an event a row may be that before or
// after it.
const csv = fs.readdirSync(folder).find((name) => name.endsWith(".csv") && !name.endsWith("_events.csv"));
if (csv === undefined) throw new Error(`${command}: ${words}`);
const rows = fs.readFileSync(path.join(folder, csv), "utf8").trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
if (rows.length !== run.rows.length) throw new Error(`${rows.length} rows of ${command}, but ${run.rows.length} in the page`);
const shown = (row, i) => scene.states[i].is_root ? row.x[i] ** 2 : row.x[i];
const sizes = scene.states.map((state, i) => run.rows.reduce((most, row) => Math.max(most, Math.abs(shown(row, i))), 1e-300));
const usual = page.run_scene(scene, page.settings_of(scene)).rows;
let worst = 0, changed = 0;
rows.forEach((numbers, k) => {
    const row = run.rows[k];
    worst = Math.max(worst, Math.abs(numbers[0] - row.t) / run.until);
    if (run.events.some((event) => Math.abs(event.t - row.t) < 1e-9 * run.until)) return;
    scene.states.forEach((state, i) => {
        worst = Math.max(worst, Math.abs(numbers[1 + i] - shown(row, i)) / sizes[i]);
        if (k < usual.length) changed = Math.max(changed, Math.abs(usual[k].x[i] - row.x[i]) / sizes[i]);
    });
});
console.log(`${command}: ${worst.toExponential(1)}`);
if (!(worst < 1e-7)) throw new Error("the command makes another run");
if (!(changed > 1e-5)) throw new Error("the settings change nothing");
