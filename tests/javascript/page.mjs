// SPDX-License-Identifier: GPL-3.0-or-later
// The script of a page, without its page. Returns null where there is none.
import fs from "fs";

export async function script_of(file) {
    const html = fs.readFileSync(file, "utf8");
    const begin = html.indexOf('<script type="module">');
    if (begin < 0) return null;
    const text = html.slice(html.indexOf("\n", begin) + 1, html.indexOf("</script>", begin));
    await import("data:text/javascript;base64," + Buffer.from(text).toString("base64"));
    return globalThis.dalembert_page;
}
