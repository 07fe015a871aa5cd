// SPDX-License-Identifier: GPL-3.0-or-later
// `dalembert watch` shows the page of a model at an address of this computer alone, a new one when the model changes, and errors at their
// places: node watch.mjs PROGRAM MODEL.toml
import {spawn, spawnSync} from 'child_process';
import fs from 'fs';
import http from 'http';
import net from 'net';
import os from 'os';
import path from 'path';

const [program, model] = process.argv.slice(2);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'watch')), file = path.join(folder, path.basename(model));
fs.copyFileSync(model, file);
const good = fs.readFileSync(file, 'utf8');
let failures = 0;
const check = (is_good, words) => {
    if (is_good) return;
    ++failures;
    console.log('FAILED: ' + words);
};
const watch = spawn(program, ['watch', file, '--port', '0']);
const ended = new Promise((resolve) => watch.once('exit', (code) => resolve(code)));
const port = await new Promise((resolve, reject) => {
    let text = '';
    watch.stdout.on('data', (data) => {
        text += data;
        const found = /^http:\/\/127\.0\.0\.1:(\d+)\/ shows /.exec(text);
        if (found) resolve(Number(found[1]));
    });
    ended.then(() => reject(new Error('it ended: ' + text)));
});
const ask = (place, {method = 'GET', headers = {}} = {}) => new Promise((resolve, reject) => {
    const request = http.request({host: '127.0.0.1', port, path: place, method, headers, agent: false}, (answer) => {
        let text = '';
        answer.on('data', (data) => {
            text += data;
        });
        answer.on('end', () => resolve({status: answer.statusCode, text, version: Number(answer.headers['x-version'])}));
    });
    request.on('error', reject);
    request.end();
});
/// The page behind version `known`.
async function next(known) {
    check((await ask(`/next?${known}`)).status === 200, 'no answer about the next version');
    const page = await ask('/');
    check(page.version > known && page.text.includes(`watched_version = ${page.version};`), 'the page does not know its version');
    return page;
}
try {
    let page = await next(1);
    check(/<section id="player"/.test(page.text) && page.text.includes('connect-src \'self\''), 'no page of the model');
    check((await ask('/')).text === page.text, 'another page without a change');
    for (const [place, options, status] of [
             ['/', {method: 'POST'}, 405], ['/', {headers: {Host: 'example.com'}}, 403],
             ['/', {headers: {Host: `127.0.0.1:${port + 1}`}}, 403], ['/../etc/passwd', {}, 404], ['/index.html', {}, 404],
             ['/', {headers: {Filler: 'x'.repeat(20000)}}, 431]])
        check((await ask(place, options)).status === status, `${JSON.stringify([place, options])} does not get ${status}`);
    const changed = good.replace(/^title .*$/m, 'title = "Another <b>title</b>"');
    fs.writeFileSync(file, changed);
    page = await next(page.version);
    check(page.text.includes('<h1>Another &lt;b&gt;title&lt;/b&gt;</h1>'), 'the change is not shown');
    const line = changed.split('\n').findIndex((one) => one.startsWith('title')) + 1;
    fs.writeFileSync(file, changed.replace(/^title .*$/m, 'tittle = "<script>alert(1)</script>"'));
    page = await next(page.version);
    check(
        new RegExp(`<div id="line-${line}" class="marked">.*tittle.*</div>\n<p class="bad">.*unknown-key: .*title`).test(page.text),
        'the error is not at its place');
    check(!page.text.includes('<script>alert'), 'text of a model became a script');
    const again = spawnSync(program, ['watch', file, '--port', String(port)], {encoding: 'utf8'});
    check(
        again.status === 3 && again.stderr.includes(`port ${port} of this computer cannot be listened to: another program uses it already`),
        'a port that is taken: ' + again.stderr);
    fs.writeFileSync(file, good);
    page = await next(page.version);
    check(/<section id="player"/.test(page.text), 'the page does not come back');
    // It follows a part in another folder, and the points of its curve.
    const part = path.join(folder, 'parts', 'carriage.toml'), points = path.join(folder, 'data', 'force.csv');
    for (const one of [part, points]) fs.mkdirSync(path.dirname(one));
    const head = (name) => `[model]\nformat = 1\nname = "${name}"\n`;
    const carriage = (start) => head('carriage') + `[curves.F]\nof = "s [m]"\nunit = "N"\nfile = "../data/force.csv"\n` +
        `outside = "held"\n[coordinates]\nx = { unit = "m", start = ${start} }\n[bodies.b]\nmass = "1 kg"\n` +
        `position = ["x", 0, 0]\n[springs.s]\nelongation = "x"\nforce = "e -> F(e)"\n`;
    fs.writeFileSync(points, 's [m],F [N]\n-1,-2\n0,0\n1,3\n');
    fs.writeFileSync(part, carriage(0.5));
    fs.writeFileSync(file, head('rail') + '[use.left]\nfile = "parts/carriage.toml"\n[runs.r]\nuntil = 1\n');
    page = await next(page.version);
    check(/<section id="player"/.test(page.text), 'no page of a model with a part: ' + page.text.slice(-2000));
    fs.writeFileSync(points, 's [m],F [N]\n-1,-2\n0,0\nx,3\n');
    page = await next(page.version);
    check(page.text.includes('force.csv'), 'the points of a curve are not followed');
    fs.writeFileSync(points, 's [m],F [N]\n-1,-2\n0,0\n1,4\n');
    page = await next(page.version);
    check(/<section id="player"/.test(page.text), 'the page does not come back after better points');
    fs.rmSync(part);
    page = await next(page.version);
    check(page.text.includes('there is no file'), 'a part that is gone is not told');
    fs.writeFileSync(part, carriage(0.25));
    page = await next(page.version);
    check(/<section id="player"/.test(page.text) && page.text.includes('0.25'), 'a part that comes back is not followed');
    // Somebody who asks half and waits keeps nobody off, and other addresses of this computer have no such port.
    const slow = net.connect(port, '127.0.0.1');
    slow.write('GET / HT');
    check((await ask('/')).status === 200, 'a slow caller keeps others off');
    slow.destroy();
    for (const one of Object.values(os.networkInterfaces()).flat().filter((address) => !address.internal && address.family === 'IPv4')) {
        const is_open = await new Promise((resolve) => {
            const other = net.connect({port, host: one.address, timeout: 2000});
            other.on('connect', () => resolve(true)).on('error', () => resolve(false)).on('timeout', () => resolve(false));
        });
        check(!is_open, `${one.address} is open`);
    }
    check(spawnSync(program, ['watch', path.join(folder, 'none.toml'), '--port', '0']).status === 2, 'a model that is not there');
} finally {
    watch.kill('SIGINT');
}
check(await ended === 130, 'it does not end with Ctrl-C');
fs.rmSync(folder, {recursive: true});
console.log(failures === 0 ? 'the watched page follows its model' : `${failures} failures`);
process.exit(failures > 0 ? 1 : 0);
