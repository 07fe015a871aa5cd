// Shows runs, and what a person changes.
class Player {
    constructor() {
        this.part = (id) => document.getElementById(id);
        for (const scene of scenes) this.part("scene").append(element("option", {value: scene.name}, scene.name));
        for (const speed of [0.1, 0.25, 0.5, 1, 2, 5, 10, 100, 1000])
            this.part("speed").append(element("option", {value: speed}, `${speed} \u00d7`));
        this.part("scene").addEventListener("change", () => this.choose(this.part("scene").selectedIndex));
        this.part("play").addEventListener("click", () => this.play(!this.is_playing));
        this.part("reset").addEventListener("click", () => this.choose(this.part("scene").selectedIndex));
        this.part("time").addEventListener("input", () => {
            this.play(false);
            this.show_time(Number(this.part("time").value));
        });
        this.part("speed").addEventListener("change", () => {
            this.speed = Number(this.part("speed").value);
        });
        this.part("add-plot").addEventListener("change", (e) => {
            if (e.target.value) {
                this.panels.push({x: this.part("over").value, y: [e.target.value]});
                this.draw_plots();
            }
            e.target.value = "";
        });
        this.part("copy-command").addEventListener("click", () => this.copy(command_of(this.scene, this.settings)));
        this.part("copy-link").addEventListener("click", () => this.copy(this.link()));
        const named = this.read_link();
        this.choose(named.scene, named.settings, this.refused);
    }

    /// `refused`: what is said of an address.
    choose(number, settings, refused = "") {
        this.play(false);
        this.part("scene").selectedIndex = number;
        this.scene = scenes[number];
        this.settings = settings || settings_of(this.scene);
        this.panels = this.scene.plots.slice();
        this.plant = this.scene.make();
        if (this.panels.length === 0) this.panels = this.scene.states.slice(0, 3).map((one) => ({x: "", y: [one.name]}));
        this.shown = 0;
        this.refused = refused;
        this.make_fields();
        this.run();
    }

    /// Where the run is at once: the next one, if settings change while it waits, is the same.
    run() {
        if (this.is_waiting) return;
        this.is_waiting = true;
        this.part("status").textContent = "Computing ...";
        setTimeout(() => {
            this.is_waiting = false;
            const begin = performance.now();
            this.recording = run_scene(this.scene, this.settings);
            const duration = performance.now() - begin, rows = this.recording.rows;
            if (rows.length === 0) {  // nothing to show
                this.part("status").textContent = this.refused + this.recording.message;
                for (const [field] of this.following) field.follow(NaN);
                for (const id of ["drawing", "plots", "events"]) this.part(id).replaceChildren();
                this.part("now").textContent = "";
                this.plots = [];
                this.end = 0;
                return;
            }
            for (const [field, value] of this.following) field.follow(value(this.recording));
            this.columns = columns_of(this.scene, this.recording);
            this.end = rows[rows.length - 1].t;
            this.part("time").max = this.end;
            this.part("status").textContent = this.refused + moved_start(this.scene, this.recording) +
                (this.recording.is_good ? "" : this.recording.message + " ") +
                counted(this.recording.steps, "step") +
                (this.recording.implicit_steps > 0 ? `, of which ${this.recording.implicit_steps} implicit` : "") +
                (this.recording.events.length > 0 ? `, ${counted(this.recording.events.length, "event")}` : "") +
                `, computed in ${duration.toFixed(0)} ms.`;
            if (this.speed === undefined || this.speed_of !== this.scene) {
                const wanted = this.end / 10, choices = [...this.part("speed").options].map((one) => Number(one.value));
                this.speed = this.end <= 20 && this.end >= 2 ?
                    1 :
                    choices.reduce((a, b) => Math.abs(Math.log(b / wanted)) < Math.abs(Math.log(a / wanted)) ? b : a);
                this.part("speed").value = this.speed;
                this.speed_of = this.scene;
            }
            this.draw();
            this.show_time(Math.min(this.shown || 0, this.end));
        }, 0);
    }

    draw() {
        const scene = this.scene;
        const add = this.part("add-plot");
        const option = (one) => element("option", {value: one.name}, one.name);
        add.replaceChildren(element("option", {value: ""}, "add ..."), ...this.columns.slice(1).map(option));
        const before = this.part("over").value;
        this.part("over").replaceChildren(...this.columns.map(option));
        if (this.columns.some((one) => one.name === before)) this.part("over").value = before;
        const across = this.part("drawing").clientWidth;
        this.drawings = [];
        if (scene.place !== null && scene.bodies.length > 0) {
            const place = scene.place(this.recording.made.parameter_values);
            this.drawings.push(make_drawing(
                scene, this.recording.rows.map((row) => {
                    const points = new Float64Array(3 * scene.points);
                    place(row.t, row.x, points);
                    return points;
                }),
                view_rows(scene, this.recording), force_rows(scene, this.recording), across));
        }
        if (scene.network) this.drawings.push(make_network(scene.network, network_rows(scene, this.recording), across));
        if (this.drawings.length === 0)
            this.drawings.push(make_levels(this.columns.slice(1, 1 + scene.states.length + scene.outputs.length), across));
        this.part("drawing").replaceChildren(...this.drawings.map((drawing) => drawing.node));
        this.part("events").replaceChildren(...this.event_list());
        this.row = 0;
        this.draw_plots();
    }

    /// The first events, folded.
    event_list() {
        const events = this.recording.events, most = 100;
        if (events.length === 0) return [];
        const head =
            element("tr", {}, ...["t [s]", "event", "mode before", "mode after"].map((title) => element("th", {scope: "col"}, title)));
        const rows = events.slice(0, most).map(
            (event) => element(
                "tr", {},
                ...[number_text(event.t, 8), event.name, this.plant.modes[event.before], this.plant.modes[event.after]].map(
                    (text) => element("td", {}, text))));
        const rest = events.length > most ? element("p", {}, `... and ${events.length - most} more.`) : "";
        return [element(
            "details", {}, element("summary", {}, `Events: ${events.length}`),
            element("div", {class: "wide", tabindex: "0"}, element("table", {}, head, ...rows)), rest)];
    }

    draw_plots() {
        const find = (name) => this.columns.find((one) => one.name === name);
        const all = (name) => find(name) ? [find(name)] : this.columns.filter((one) => one.name.startsWith(name + "["));
        this.plots = [];
        for (const panel of this.panels) {
            const x = find(panel.x || "t"), curves = panel.y.flatMap(all);
            if (x === undefined || curves.length === 0) continue;
            const events = this.recording.events.map((event) => event.t / this.columns[0].factor);
            // Plots over the time show the same of it.
            const plot = make_plot(x, curves, events, this.part("plots").clientWidth, (low, high) => {
                for (const other of this.plots)
                    if (other === plot || (plot.is_over_time && other.is_over_time)) other.zoom(low, high);
            });
            plot.is_over_time = Boolean(x.is_time);
            plot.figure.append(this.remove_button(panel, curves));
            plot.svg.addEventListener("pointermove", (e) => {
                if (!this.is_playing) this.show(plot.at(e));
            });
            plot.svg.addEventListener("keydown", (e) => {
                const step = {ArrowLeft: -1, ArrowRight: 1}[e.key];
                if (step) {
                    this.show(this.row + step);
                    e.preventDefault();
                }
            });
            this.plots.push(plot);
        }
        this.part("plots").replaceChildren(...this.plots.map((plot) => plot.figure));
        this.show(this.row || 0);
    }

    remove_button(panel, curves) {
        const button = element("button", {type: "button", class: "remove"}, "\u00d7");
        button.setAttribute("aria-label", `Remove the plot of ${curves.map((one) => one.name).join(", ")}`);
        button.addEventListener("click", () => {
            this.panels = this.panels.filter((one) => one !== panel);
            this.draw_plots();
        });
        return button;
    }

    show(row, is_quick = false) {
        const rows = this.recording.rows;
        if (rows.length === 0) return;
        this.row = Math.max(0, Math.min(row, rows.length - 1));
        const now = rows[this.row];
        for (const plot of this.plots) plot.show(this.row, is_quick);
        for (const drawing of this.drawings) drawing.show(this.row, is_quick);
        this.shown = now.t;
        this.part("time").value = now.t;
        this.part("now").textContent = `t = ${number_text(now.t / this.columns[0].factor, 4)} ${this.columns[0].unit}` +
            (this.plant.modes.length > 0 ? `, ${this.plant.modes[now.mode]}` : "");
    }

    show_time(t, is_quick = false) {
        const rows = this.recording.rows;
        let low = 0, high = rows.length - 1;
        while (low < high) {
            const middle = (low + high + 1) >> 1;
            if (rows[middle].t <= t)
                low = middle;
            else
                high = middle - 1;
        }
        this.show(low, is_quick);
    }

    play(is_playing) {
        this.is_playing = is_playing;
        this.part("play").textContent = is_playing ? "Pause" : "Run";
        if (!is_playing) return;
        let t = Number(this.part("time").value), last = performance.now(), words = 0;
        if (t >= this.end) t = 0;
        const frame = (now) => {
            if (!this.is_playing) return;
            t += (now - last) / 1000 * this.speed;
            last = now;
            const has_words = now - words > 100 || t >= this.end;
            if (has_words) words = now;
            this.show_time(t, !has_words);
            if (t >= this.end)
                this.play(false);
            else
                requestAnimationFrame(frame);
        };
        requestAnimationFrame(frame);
    }

    make_fields() {
        const {scene, settings, plant} = this;
        const changed = () => {
            this.play(false);
            this.run();
        };
        const range = (one, unit) => Number.isFinite(one.low) || Number.isFinite(one.high) ?
            ` (${number_text(in_unit(one.low, unit))} ... ${number_text(in_unit(one.high, unit))})` :
            "";
        const group = (title, fields, is_open) => fields.length === 0 ?
            "" :
            element("details", is_open ? {open: ""} : {}, element("summary", {}, title), element("div", {class: "fields"}, ...fields));
        const seconds = {unit: "s", factor: 1, offset: 0}, one = {unit: "1", factor: 1, offset: 0};
        this.following = [];
        const parameters = plant.parameters.map((p, i) => {
            const set = (value) => { settings.parameters[i] = value; changed(); };
            return make_field(p, scene.parameter_units[i], settings.parameters[i], p.description + range(p, scene.parameter_units[i]), set)
                .node;
        });
        const inputs = plant.inputs.map((input, i) => {
            const doc = `${input.description ? input.description + "; " : ""}empty: ${scene.input_texts[i] || "0"} (in SI), ` +
                "as in the run; else this value is held";
            const set = (value) => { settings.held[i] = value; changed(); };
            return make_field(input, scene.input_units[i], settings.held[i], doc, set, true).node;
        });
        const starts = scene.states.flatMap((state, i) => {
            if (state.is_root) return [];
            const quantity = {...plant.states[i], name: state.name, has_slider: true}, doc = quantity.description + range(quantity, state);
            const set = (value) => {
                if (value === null)
                    delete settings.start[i];
                else
                    settings.start[i] = value;
                changed();
            };
            const field = make_field(quantity, state, settings.start[i] ?? null, doc + "; empty: as the model says", set, true);
            this.following.push([field, (recording) => recording.rows[0].x[i]]);
            return [field.node];
        });
        const until = make_field(
            {name: "until", low: shortest_run, high: longest_run}, seconds, settings.until,
            "length of the run; empty: as the model says", (value) => { settings.until = value; changed(); }, true);
        this.following.push([until, (recording) => recording.until]);
        const tolerance = make_field(
            {name: "tolerance", low: 1e-13, high: 0.01}, one, settings.tolerance, "relative error of a step",
            (value) => { settings.tolerance = value; changed(); });
        this.part("settings").replaceChildren(
            group("Parameters", parameters, parameters.length <= 12), group("Inputs", inputs, true), group("Start values", starts, false),
            group("Run", [until.node, tolerance.node], false));
    }

    link() {
        const {scene, settings} = this;
        return location.href.split("#")[0] + "#" + new URLSearchParams({scene: scene.name, settings: JSON.stringify(settings)});
    }

    /// What the address says, as far as it fits the page.
    read_link() {
        const none = {scene: Math.max(0, scenes.findIndex((scene) => scene.name === first_scene))};
        try {
            const given = new URLSearchParams(location.hash.slice(1));
            const number = scenes.findIndex((scene) => scene.name === given.get("scene"));
            if (number < 0 && given.has("scene")) this.refused = `The page has no scene "${given.get("scene")}" that runs. `;
            if (number < 0) return none;
            const usual = settings_of(scenes[number]), read = JSON.parse(given.get("settings") || "{}");
            this.refused = check_settings(scenes[number], read, usual);
            return {scene: number, settings: usual};
        } catch (e) {
            this.refused = "The settings of the address cannot be read; those of the run are shown. ";
            return none;
        }
    }

    async copy(text) {
        try {
            await navigator.clipboard.writeText(text);
            this.part("status").textContent = "Copied: " + text;
        } catch (e) {
            this.part("status").textContent = text;  // from disk some browsers do not let pages copy
        }
    }
}

globalThis.dalembert_page = {
    scenes,
    settings_of,
    check_settings,
    run_scene,
    network_rows,
    label_place,
    path_of,
    columns_of,
    command_of,
    tick_texts: (values) => {
        const [low, high] = axis_bounds(values);
        return ticks(low, high).map((tick) => number_text(tick, axis_digits(low, high)));
    }
};
if (typeof document !== "undefined") new Player();
