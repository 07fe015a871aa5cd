// SPDX-License-Identifier: GPL-3.0-or-later
// A page of hostile.toml, or a list of pages, has no element or attribute that comes of the model, and its script does nothing that the
// model says.
import fs from "fs";

import {script_of} from "./page.mjs";

const html = fs.readFileSync(process.argv[2], "utf8");
const failed = (words) => {
    console.log("FAILED: " + words);
    process.exit(1);
};
const known = new Set([
    "html",    "head",    "meta",     "title",  "style", "body",   "header", "h1",    "h2",     "h3",   "p",       "nav",    "a",
    "main",    "section", "noscript", "div",    "label", "select", "button", "input", "output", "ul",   "li",      "strong", "details",
    "summary", "span",    "math",     "mrow",   "mi",    "mo",     "mn",     "mfrac", "msub",   "msup", "msubsup", "mover",  "msqrt",
    "mtext",   "mstyle",  "mspace",   "mtable", "mtr",   "mtd",    "table",  "tr",    "th",     "td",   "footer",  "script", "code",
    "article", "svg",     "path",     "g",      "text",  "tspan"
]);
const outside = html.replace(/(<script(?: type="module")?>\n)[\s\S]*?(<\/script>)/g, "$1$2").replace(/<style>[\s\S]*?<\/style>/, "");
for (const [tag, name] of outside.matchAll(/<([a-zA-Z!?][^\s>/]*)[^>]*>/g)) {
    if (name === "!DOCTYPE") continue;
    if (!known.has(name)) failed("an element " + tag);
    if (/\son\w+\s*=/i.test(tag) || /javascript:/i.test(tag)) failed("an attribute in " + tag);
}
if (!/<script type="module"/.test(html)) {  // a list of pages
    if (/<script/.test(html)) failed("a script");
    console.log("text of models stays text in their list");
    process.exit(0);
}
if (outside.match(/<script/g).length !== 2 || html.match(/<\/script>/g).length !== 2) failed("another script");  // the player, and printing
const page = await script_of(process.argv[2]);
const run = page.run_scene(page.scenes[0], page.settings_of(page.scenes[0]));
if (globalThis.hostile !== undefined) failed("the script did what the model says");
if (!run.is_good || run.rows.length < 2) failed("the model did not run: " + run.message);
if (page.columns_of(page.scenes[0], run).every((column) => column.name !== "arguments")) failed("no column of the model");
console.log("text of a model stays text");
