// SPDX-License-Identifier: GPL-3.0-or-later
// What a page makes of settings in its address, of values that make no machine, and of curves that hardly move: node settings.mjs
// FORMULAS.html FOUR_BAR.html.
import {script_of} from "./page.mjs";

const [formulas, four_bar] = process.argv.slice(2);
let failures = 0;
function check(is_good, words) {
    if (is_good) return;
    ++failures;
    console.log("FAILED: " + words);
}

let page = await script_of(formulas), scene = page.scenes[0];
const plant = scene.make(), place = (name) => plant.parameters.findIndex((one) => one.name === name);
/// What an address says of `read`, and the settings that are left.
function read_of(read) {
    const settings = page.settings_of(scene);
    return {words: page.check_settings(scene, read, settings), settings};
}
const as_model = JSON.stringify(page.settings_of(scene));

for (const read of [{}, page.settings_of(scene), {until: null}])
    check(read_of(read).words === "" && JSON.stringify(read_of(read).settings) === as_model,
          "not as the model says: " + JSON.stringify(read));
for (const [read, word] of [
         [null, "no settings"], [[1], "no settings"], ["text", "no settings"], [{until: -1}, "until"], [{until: "9"}, "until"],
         [{tolerance: 1}, "tolerance"], [{parameters: [1]}, "a list of 8 numbers"], [{parameters: {m_0: 1}}, "a list of 8 numbers"],
         [{held: [0]}, "a list of 2 numbers"], [{held: [null, 2]}, "w"], [{start: [1]}, "start"], [{start: {9: 1}}, "start 9"],
         [{start: {0: 21}}, "start of x"], [{start: {0: "1"}}, "start of x"]]) {
    const {words, settings} = read_of(read);
    check(words.includes(word), `an address with ${JSON.stringify(read)} is answered with "${words}"`);
    check(JSON.stringify(settings) === as_model, `an address with ${JSON.stringify(read)} changes settings`);
}
const good = {until: 2, tolerance: 1e-6, parameters: scene.parameters.map((value) => 2 * value), start: {0: 3}, held: [1, null]};
check(read_of(good).words === "" && JSON.stringify(read_of(good).settings) === JSON.stringify(good),
      "good settings of an address are not taken");

/// A run with some parameters and start values.
function run_with(parameters, start = {}) {
    const settings = page.settings_of(scene);
    for (const [name, value] of Object.entries(parameters)) settings.parameters[place(name)] = value;
    return page.run_scene(scene, {...settings, start});
}
const usual = run_with({}), longer = run_with({T: 2, l: 0.3});
check(usual.is_good && Math.abs(usual.until - 5) < 1e-12, "the usual run");
check(longer.is_good && Math.abs(longer.until - 10) < 1e-12, "the end of the run does not follow T");
check(Math.abs(longer.rows[0].x[0] - 0.6) < 1e-12 && Math.abs(longer.rows[0].x[1] - 0.15) < 1e-12, "the start does not follow l and T");
for (const [parameters, words] of [
         [{m_1: 4}, "The mass of body 'block' is -1 kg at the start, but must not be below zero."], [{T: 0}, "The end of the run is 0 s"],
         [{T: -1}, "The end of the run is -5 s"], [{l: 11}, "start of 'x' is 22 m"], [{F: 100}, "input 'w' is -1.5 N"]]) {
    const run = run_with(parameters);
    check(run.rows.length === 0 && !run.is_good && run.message.includes(words),
          `${JSON.stringify(parameters)} is answered with "${run.message}"`);
}
// A kick of 0.02 s gives the momentum F*d wherever it is, however long steps are.
const settings = page.settings_of(scene);
settings.parameters[place("T")] = 1.37;
settings.parameters[place("c")] = settings.parameters[place("mu")] = settings.parameters[place("l")] = 0;
settings.held[1] = 0;
settings.tolerance = 1e-3;
const kicked = page.run_scene(scene, settings).rows.pop().x[1];
check(Math.abs(kicked - 0.4) < 1e-9, `a kick whose time moved gives ${kicked} m/s, not 0.4 m/s`);

page = await script_of(four_bar);
scene = page.scenes[0];
const given = page.run_scene(scene, {...page.settings_of(scene), start: {0: 1.4}}).rows[0].x;
check(given[0] === 1.4 && given[3] === 15, `given starts are moved: ${given}`);
check(Math.abs(given[1] - scene.start[1]) > 1e-3, "constraints do not determine the other starts");
const apart = page.run_scene(scene, {...page.settings_of(scene), start: {0: 1.4, 1: 0.4, 2: 1.5}});
check(apart.rows.length === 0 && apart.message.startsWith("The start values do not meet constraint 'loop_"), "says: " + apart.message);

for (const values of [[403, 403 + 1e-4], [403, 403 + 1e-9], [1e6, 1e6 + 3], [5, 5], [-2e-5, -2e-5 - 1e-11], [0, 0]]) {
    const texts = page.tick_texts(values);
    check(texts.length >= 2 && new Set(texts).size === texts.length, `ticks of ${values}: ${texts}`);
}
// Labels of four points that lie close together surround them, a fifth one has no room; near the edge they stand on the other side.
const taken = [], of_points = [0, 1, 2, 3, 4].map((i) => page.label_place(taken, [200 + i, 100], 8, 400));
const anchors = of_points.map((one) => one === null ? "none" : `${one.anchor} ${one.y}`);
check(anchors.join(", ") === "start 90, end 90, start 120, end 120, none", "labels: " + anchors.join(", "));
check(page.label_place([], [390, 100], 8, 400).anchor === "end", "a label near the edge");
// A curve of many points is drawn by few of them, which cover in each column of pixels what all cover; what is no number parts it.
const many = Array.from({length: 50000}, (_, i) => i), across = many.map((i) => i / 100);
const up = many.map((i) => i === 30007 ? NaN : 100 + 90 * Math.sin(0.7 * i) * Math.cos(i / 9000));
const pieces = page.path_of(across, up).split("M").slice(1).map((text) => text.split("L").map((point) => point.split(" ").map(Number)));
check(pieces.length === 2 && pieces.flat().length <= 4 * 501, `${pieces.length} pieces of ${pieces.flat().length} points`);
const covered = (points, column) => {
    const here = points.filter(([at]) => Math.floor(at) === column).map((point) => point[1]);
    return `${Math.min(...here).toFixed(2)} to ${Math.max(...here).toFixed(2)}`;
};
const all = many.filter((i) => i !== 30007).map((i) => [across[i], Number(up[i].toFixed(2))]);
for (let column = 0; column < 500; ++column)
    check(covered(pieces.flat(), column) === covered(all, column), `a curve covers other pixels in column ${column}`);
check(page.path_of([0, 5, 5.5, 2], [1, 2, 3, 4]) === "M0.00 1.00L5.00 2.00L5.50 3.00L2.00 4.00", "the path of four points");
if (failures === 0) console.log("settings, starts and refusals of pages are right");
process.exit(failures > 0 ? 1 : 0);
