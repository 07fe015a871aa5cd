// SPDX-License-Identifier: GPL-3.0-or-later
// What a page copies as command line makes the run that it shows, with all kinds of settings changed:
// node command.mjs PROGRAM PAGE.html MODEL.toml.
import {execSync} from "child_process";
import fs from "fs";
import os from "os";
import path from "path";

import {script_of} from "./page.mjs";

const [program, file, model] = process.argv.slice(2);
const page = await script_of(file), scene = page.scenes[0], settings = page.settings_of(scene);
settings.parameters = settings.parameters.map((value, i) => i < 3 ? 1.01 * value : value);
settings.start[0] = scene.start[0] + 0.01;
settings.held = settings.held.map((value, i) => i === 0 ? 0.5 : value);
settings.until = 0.9 * scene.until;
settings.tolerance = 1e-11;
const run = page.run_scene(scene, settings);

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "command"));
try {
    const command = page.command_of(scene, settings).replace("dalembert", program).replace(path.basename(model), model);
    execSync(`${command} --no-plot -o ${folder}`, {stdio: "ignore"});
    const csv = fs.readdirSync(folder).find((name) => name.endsWith(".csv"));
    const numbers = fs.readFileSync(path.join(folder, csv), "utf8").trim().split("\n").pop().split(",").map(Number);
    const row = run.rows[run.rows.length - 1];
    let worst = Math.abs(numbers[0] - row.t) / scene.until;
    scene.states.forEach((state, i) => {
        worst = Math.max(worst, Math.abs(numbers[1 + i] - row.x[i]) / Math.max(1, Math.abs(row.x[i])));
    });
    console.log(`${page.command_of(scene, settings)}: ${worst.toExponential(1)}`);
    const as_it_was = page.run_scene(scene, page.settings_of(scene)).rows.pop().x[0];
    if (!(worst < 1e-8) || Math.abs(as_it_was - row.x[0]) < 1e-6) throw new Error("the command makes another run, or the settings change nothing");
} finally {
    fs.rmSync(folder, {recursive: true});
}
