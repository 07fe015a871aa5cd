// SPDX-License-Identifier: GPL-3.0-or-later
// Plays with a page as a person would, and returns what it finds. browser.mjs evaluates it in the page.
(async () => {
    const found = {errors: [], scenes: 0, frames: 0};
    window.addEventListener("error", (event) => found.errors.push(event.message));
    const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    const part = (id) => document.getElementById(id);
    const is_ready = async () => {
        for (let i = 0; i < 400 && !/steps?,/.test(part("status").textContent); ++i) await wait(50);
        if (!/steps?,/.test(part("status").textContent)) found.errors.push("no run: " + part("status").textContent);
    };
    try {
        await wait(200);
        for (let i = 0; i < part("scene").options.length; ++i) {
            part("status").textContent = "";
            part("scene").selectedIndex = i;
            part("scene").dispatchEvent(new Event("change"));
            await is_ready();
            if (part("plots").querySelectorAll("path").length === 0) found.errors.push("no plot in scene " + i);
            if (part("drawing").querySelector("svg") === null) found.errors.push("no drawing in scene " + i);
            if (/NaN|undefined|Infinity/.test(part("player").textContent))
                found.errors.push(
                    "what is no number: " +
                    /.{30}(NaN|undefined|Infinity)/.exec(part("player").textContent));
            ++found.scenes;
        }
        const before = part("time").value;
        part("play").click();
        const count = () => {
            if (++found.frames < 1000) requestAnimationFrame(count);
        };
        requestAnimationFrame(count);
        await wait(1000);
        part("play").click();
        found.frames_per_second = found.frames;
        if (!(Number(part("time").value) > Number(before))) found.errors.push("it does not move");
        const field = part("settings").querySelector("input"), note = field.parentElement.querySelector("small");
        const usual = field.value;
        const type = async (text) => {
            field.value = text;
            field.dispatchEvent(new Event("change"));
            await wait(100);
        };
        await type("not a number");
        if (note.className !== "bad") found.errors.push("takes what is no number");
        part("status").textContent = "";
        await type(usual.replace(".", ","));
        if (note.className === "bad") found.errors.push("does not take a comma: " + note.textContent);
        await is_ready();
        const slider = part("settings").querySelector("input[type=range]");
        if (slider !== null) {
            const text = slider.parentElement.querySelector("input"), now = text.value;
            slider.value = Number(slider.value) > 0.5 ? Number(slider.value) - 0.05 : Number(slider.value) + 0.05;
            part("status").textContent = "";
            slider.dispatchEvent(new Event("input"));
            await is_ready();
            if (text.value === now) found.errors.push("a slider changes nothing");
            found.slider = `${now} to ${text.value}`;
        }
        // A field of a start value shows what the run starts from, until somebody fills it, and again when it is emptied.
        const field_of = (name) => part("settings").querySelector(`input[type=text][aria-label="${name}"]`);
        if (field_of("h_0") !== null && field_of("h") !== null) {
            const starts_at = async (name, text) => {
                part("status").textContent = "";
                field_of(name).value = text;
                field_of(name).dispatchEvent(new Event("change"));
                await is_ready();
                return [field_of("h").placeholder, /h = ([^ ]*) m/.exec(part("plots").textContent)[1]].join(" ");
            };
            for (const [name, text, shown] of [["h_0", "5", "5 5"], ["h", "3", "3 3"], ["h", "", "5 5"]])
                if (await starts_at(name, text) !== shown) found.errors.push(`${name} = "${text}" does not start at ${shown}`);
            part("status").textContent = "";
            const usual_e = field_of("e").value;
            field_of("e").value = "1";
            field_of("e").dispatchEvent(new Event("change"));
            for (let i = 0; i < 100 && !/end of the run/.test(part("status").textContent); ++i) await wait(20);
            if (!/end of the run/.test(part("status").textContent)) found.errors.push("no refusal: " + part("status").textContent);
            part("status").textContent = "";
            field_of("e").value = usual_e;
            field_of("e").dispatchEvent(new Event("change"));
            await is_ready();
        }
        for (const svg of document.querySelectorAll('#plots svg'))
            svg.dispatchEvent(new PointerEvent('pointermove', {clientX: 200, clientY: 100}));
        // A drag zooms, with all plots over the time; a double click and keys show all again.
        const plot = part('plots').querySelector('svg'),
              texts = () => [...plot.querySelectorAll('text')].map((one) => one.textContent).join();
        const whole = texts(), box = plot.getBoundingClientRect();
        const point = (kind, share) => plot.dispatchEvent(
            new PointerEvent(kind, {clientX: box.left + share * box.width, clientY: box.top + 0.5 * box.height, bubbles: true, button: 0}));
        for (const [zoom, back] of [
                 [() => ["pointerdown", "pointermove", "pointerup"].forEach((kind, i) => point(kind, 0.4 + 0.1 * i)),
                  () => plot.dispatchEvent(new MouseEvent("dblclick"))],
                 [() => plot.dispatchEvent(new KeyboardEvent("keydown", {key: "+"})),
                  () => plot.dispatchEvent(new KeyboardEvent("keydown", {key: "0"}))]]) {
            zoom();
            if (texts() === whole) found.errors.push("a plot does not zoom");
            back();
            if (texts() !== whole) found.errors.push("a plot does not show all again");
        }
        const count_of = () => part("plots").querySelectorAll("figure").length, before_adding = count_of();
        part("over").selectedIndex = 1;
        part("add-plot").selectedIndex = Math.min(2, part("add-plot").options.length - 1);
        part("add-plot").dispatchEvent(new Event("change"));
        if (count_of() !== before_adding + 1) found.errors.push("no phase plot");
        part("plots").querySelector("figure:last-child .remove").click();
        if (count_of() !== before_adding) found.errors.push("a plot is not removed");
        for (const details of document.querySelectorAll("details")) details.open = true;
        await wait(50);
        const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
        if (wide > 0) found.errors.push(`${wide} px are outside of the window`);
        found.requests = performance.getEntriesByType("resource").length;
        if (found.requests > 0) found.errors.push("the page loads something");
    } catch (error) {
        found.errors.push(String(error));
    }
    window.scrollTo(0, 0);
    return found;
})();
