// SPDX-License-Identifier: GPL-3.0-or-later
// What the picture of fluids, heat, circuits and shafts shows is what outputs of the model say, in every row and mode:
// node network.mjs NETWORK.html
import {script_of} from './page.mjs';

const page = await script_of(process.argv[2]), scene = page.scenes[0];
const run = page.run_scene(scene, page.settings_of(scene)), rows = page.network_rows(scene, run);
let failures = 0, compared = 0;
const check = (is_good, words) => {
    if (is_good) return;
    ++failures;
    console.log('FAILED: ' + words);
};
const {parts, links} = scene.network, part = (name) => parts.find((one) => one.name === name);
const of_key = {
    p: 'pressure',
    v: 'size',
    t: 'temperature',
    u: 'voltage',
    w: 'speed',
    a: 'angle'
};
scene.outputs.forEach((output, k) => {
    const [kind, name] = [output.name.slice(0, 1), output.name.slice(2)];
    const place = of_key[kind] ? part(name)[of_key[kind]] : links.find((one) => one.name === name).flow;
    const largest = run.rows.reduce((most, row) => Math.max(most, Math.abs(row.y[k])), 0);
    run.rows.forEach((row, i) => {
        ++compared;
        check(Math.abs(row.y[k] - rows[i][place]) <= 1e-12 * largest, `${output.name} at ${row.t} s: ${row.y[k]} and ${rows[i][place]}`);
    });
});
check(run.is_good && new Set(run.rows.map((row) => row.mode)).size === 2, 'the valve does not open and shut');
const chain = part('chain'), bar = part('bar');
check(chain.kind === 'cells' && chain.count === 8, 'a long family is not drawn as one part');
check(
    rows.every((row, i) => row[chain.cells + 7] === run.rows[i].x[scene.states.findIndex((one) => one.name === 'c[8]')]),
    'the cells of the family');
check(bar.count === 5 && rows[0][bar.cells] === 350 && rows[0][bar.cells + 1] === 300, 'the cells of the bar, from its held end');
check(rows.every((row) => row[links.find((one) => one.kind === 'gear').ratio] === 5), 'the ratio of the gear');
console.log(`${compared} values of the network`);
process.exit(failures > 0 ? 1 : 0);
