// SPDX-License-Identifier: GPL-3.0-or-later
// Opens pages in chromium and plays with them: node browser.mjs PAGE.html ... With SHOTS a folder gets pictures. With AXE, the file
// axe.min.js of axe-core, it finds what is hard to use without eyes or a pointer.
import {spawn} from "child_process";
import fs from "fs";
import os from "os";
import path from "path";

const profile = fs.mkdtempSync(path.join(os.tmpdir(), "browser"));
const browser = spawn(
    "chromium", ["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe", `--user-data-dir=${profile}`],
    {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
const waiting = new Map(), events = [];
let last = 0, rest = "";
browser.stdio[4].on("data", (data) => {
    rest += data;
    const messages = rest.split("\0");
    rest = messages.pop();
    for (const message of messages.map((text) => JSON.parse(text))) {
        if (message.id === undefined) {
            events.push(message);
            continue;
        }
        waiting.get(message.id)(message);
        waiting.delete(message.id);
    }
});
function call(method, params = {}, sessionId = undefined) {
    browser.stdio[3].write(JSON.stringify({id: ++last, method, params, sessionId}) + "\0");
    return new Promise(
        (resolve, reject) =>
            waiting.set(last, (answer) => answer.error ? reject(new Error(`${method}: ${answer.error.message}`)) : resolve(answer.result)));
}

const play = fs.readFileSync(new URL("browser.js", import.meta.url), "utf8");
const axe = process.env.AXE ? fs.readFileSync(process.env.AXE, "utf8") : "";
const ask_axe = `(async () => {
    document.querySelectorAll("details").forEach((one) => { one.open = true; });
    const {violations} = await axe.run(document, {resultTypes: ["violations"]});
    const places = (one) => one.nodes.map((node) => node.html.slice(0, 200)).join(", ");
    return violations.map((one) => \`axe: \${one.impact} \${one.id}: \${one.help}: \${places(one)}\`);
})()`;
let failures = 0;
async function look_at(file, width, scheme) {
    const {targetId} = await call("Target.createTarget", {url: "about:blank"});
    const {sessionId} = await call("Target.attachToTarget", {targetId, flatten: true});
    const page = (method, params) => call(method, params, sessionId);
    events.length = 0;
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await page(`${domain}.enable`);
    await page("Emulation.setDeviceMetricsOverride", {width, height: 1200, deviceScaleFactor: 1, mobile: width < 500});
    await page("Emulation.setEmulatedMedia", {features: [{name: "prefers-color-scheme", value: scheme}]});
    await page("Page.navigate", {url: "file://" + path.resolve(file)});
    while (!events.some((event) => event.method === "Page.loadEventFired")) await new Promise((resolve) => setTimeout(resolve, 20));
    const {result, exceptionDetails} = await page("Runtime.evaluate", {expression: play, awaitPromise: true, returnByValue: true});
    const found = exceptionDetails ? {errors: [exceptionDetails.exception.description]} : result.value;
    if (axe !== "") {
        await page("Runtime.evaluate", {expression: axe});
        const answer = await page("Runtime.evaluate", {expression: ask_axe, awaitPromise: true, returnByValue: true});
        found.errors.push(...(answer.exceptionDetails ? [answer.exceptionDetails.exception.description] : answer.result.value));
    }
    for (const event of events) {
        if (event.method === "Log.entryAdded") found.errors.push("console: " + event.params.entry.text);
        if (event.method === "Runtime.consoleAPICalled") found.errors.push("console: " + JSON.stringify(event.params.args));
        if (event.method === "Runtime.exceptionThrown")
            found.errors.push("exception: " + event.params.exceptionDetails.exception.description);
        if (event.method === "Network.requestWillBeSent" && event.params.type !== "Document")
            found.errors.push("loads " + event.params.request.url);
    }
    if (process.env.SHOTS) {
        const {data} = await page("Page.captureScreenshot", {format: "png"});
        fs.writeFileSync(
            path.join(process.env.SHOTS, `${path.basename(file, ".html")}_${width}_${scheme}.png`), Buffer.from(data, "base64"));
    }
    await call("Target.closeTarget", {targetId});
    if (found.errors.length > 0) ++failures;
    console.log(`${found.errors.length > 0 ? "FAILED: " : ""}${path.basename(file)}, ${width} px, ${scheme}: ${JSON.stringify(found)}`);
}

try {
    for (const file of process.argv.slice(2))
        for (const width of [1280, 390])
            for (const scheme of ["light", "dark"]) await look_at(file, width, scheme);
} finally {
    await call("Browser.close").catch(() => {});
    browser.once("exit", () => fs.rmSync(profile, {recursive: true, force: true, maxRetries: 5}));
}
process.exitCode = failures > 0 ? 1 : 0;
