// The machine as it moves: bodies at their positions, bars between points; of what has no places, its states as levels.

/// `places`: for each row of the run the coordinates of all points. `measures`, `forces`: of
/// view_rows() and force_rows(). `across`: pixels. Returns { node, show(i) }.
function make_drawing(scene, places, measures, forces, across) {
    const arrow = 60, room = scene.forces.length > 0 ? arrow + 6 : 36;
    const width = Math.max(280, Math.min(640, across));
    let height = Math.round(0.75 * width);
    const svg = element("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `Drawing of ${scene.bodies.join(", ")}`});
    const count = scene.framed, is_planar = scene.plane.length > 0;
    const {view: said} = scene, first = measures[0] || [], given = (key, usual) => said[key] === null ? usual : first[said[key]];
    const look_of = (k) => said.looks[k], is_hidden = (k) => k < scene.bodies.length && Boolean(look_of(k) && look_of(k).hidden);
    const reach_at = (k, i) => k >= scene.bodies.length ?
        0 :
        scene.shapes.filter((one) => one.body === k).reduce((most, one) => {
            const from = one.first + one.sizes, m = measures[i], p = places[i];
            return Math.max(most, Math.hypot(...[0, 1, 2].map((j) => m[from + j] - p[3 * k + j])) + reach_of_solid(one, m));
        }, reach_of(look_of(k), measures[i]));
    let turn = is_planar ? 0 : given("turn", -0.6), tilt = is_planar ? 0 : given("tilt", 0.45), shown = 0;
    // A look along z at the plane, or from aside and above with z upwards.
    const project = (p, k) => {
        const [x, y, z] = [p[3 * k], p[3 * k + 1], p[3 * k + 2]];
        if (is_planar) return [p[3 * k + scene.plane[0]], p[3 * k + scene.plane[1]]];
        const across = x * Math.cos(turn) + y * Math.sin(turn), away = y * Math.cos(turn) - x * Math.sin(turn);
        return [across, z * Math.cos(tilt) + away * Math.sin(tilt)];
    };
    let view;
    // In space the ground is three axes from its origin, as long as the machine is large.
    const far = places.reduce((most, p) => {
        for (let k = 0; k < 3 * count; ++k)
            if (Math.abs(p[k]) > most) most = Math.abs(p[k]);
        return most;
    }, 0);
    const axes = is_planar ? [] : [[0, 0, 0], [far / 2, 0, 0], [0, far / 2, 0], [0, 0, far / 2]];
    const ground_height = given("ground", null), grid = [];
    for (let k = -4; !is_planar && ground_height !== null && k <= 4; ++k)
        for (const [from, to] of [[[k, -4], [k, 4]], [[-4, k], [4, k]]])
            grid.push([from, to].map(([a, b]) => [a * far / 4, b * far / 4, ground_height]));
    // A wall stands behind all that its spring does, by a third of how far bodies move; the length of a spring without load is not known.
    const connectors = scene.connectors;
    const reach = Math.max(far * 0.1, ...[0, 1, 2].map((i) => {
        let low = Infinity, high = -Infinity;
        for (const p of places)
            for (let k = 0; k < scene.bodies.length; ++k) {
                low = Math.min(low, p[3 * k + i]);
                high = Math.max(high, p[3 * k + i]);
            }
        return high - low;
    })) ||
        1;
    const walls = connectors.map(({from, to, has_wall}) => {
        if (!has_wall || places.length === 0) return null;
        const along = (p, i) => p[3 * to + 3 + i] - p[3 * to + i];
        let most = 0;
        for (const p of places)
            most = Math.max(most, [0, 1, 2].reduce((sum, i) => sum + (p[3 * from + i] - p[3 * to + i]) * along(p, i), 0));
        const offset = [0, 1, 2].map((i) => (most + reach / 3) * along(places[0], i));
        return (p) => offset.map((one, i) => p[3 * to + i] + one);  // what the spring hangs on may move
    });
    const frame = () => {
        let [x_low, x_high, y_low, y_high] = [Infinity, -Infinity, Infinity, -Infinity];
        const see = (p, k, reach = 0) => {
            const [x, y] = project(p, k);
            if (!Number.isFinite(x) || !Number.isFinite(y)) return;
            x_low = Math.min(x_low, x - reach);
            x_high = Math.max(x_high, x + reach);
            y_low = Math.min(y_low, y - reach);
            y_high = Math.max(y_high, y + reach);
        };
        for (const axis of axes) see(axis, 0);
        places.forEach((p, i) => {
            for (let k = 0; k < count; ++k)
                if (!is_hidden(k)) see(p, k, reach_at(k, i));
            for (const one of connectors)
                if (!one.has_wall) see(p, one.to);
        });
        if (is_planar && ground_height !== null) [y_low, y_high] = [Math.min(y_low, ground_height), Math.max(y_high, ground_height)];
        for (const wall of walls)
            if (wall !== null) places.forEach((p) => see(wall(p), 0));
        if (!(x_low <= x_high)) [x_low, x_high, y_low, y_high] = [-1, 1, -1, 1];
        if (is_planar) {  // no higher than needed
            const wanted = 2 * room + (y_high - y_low) / (x_high - x_low) * (width - 2 * room);
            height = Math.round(Math.min(0.75 * width, Math.max(0.3 * width, Number.isFinite(wanted) ? wanted : Infinity)));
            svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
        }
        const span = Math.max((x_high - x_low) / (width - 2 * room), (y_high - y_low) / (height - 2 * room)) || 1 / width;
        view = {x: (x_low + x_high) / 2, y: (y_low + y_high) / 2, span};
    };
    const on_paper = (p, k) => {
        const [x, y] = project(p, k);
        return [width / 2 + (x - view.x) / view.span, height / 2 - (y - view.y) / view.span];
    };
    const ground = element("g", {stroke: "currentColor", "stroke-opacity": 0.25});
    const trails = element("g", {fill: "none", "stroke-opacity": 0.45, "stroke-width": 1.5});
    const bars = element("g", {stroke: "currentColor", "stroke-width": 7, "stroke-linecap": "round", "stroke-opacity": 0.55});
    const bodies = element("g");
    const label = element("g");
    svg.append(ground, trails, bars, bodies, label);
    const connector_lines = connectors.map(() => trails.appendChild(element("path", {stroke: "currentColor", "stroke-opacity": 0.8})));
    const wall_lines = walls.map(
        (wall) =>
            wall === null ? null : trails.appendChild(element("line", {stroke: "currentColor", "stroke-opacity": 0.8, "stroke-width": 3})));
    const bar_lines = (scene.bars || []).map(() => bars.appendChild(element('line')));
    const colour = (k) => look_of(k) && view_colours[look_of(k).colour] || plot_colours[k % plot_colours.length];
    const trail_lines = scene.bodies.map((name, k) => trails.appendChild(element('polyline', {style: `stroke: ${colour(k)}`})));
    const shapes =
        scene.bodies.map((name, k) => look_of(k) && look_of(k).shape !== '' && !is_hidden(k) ? make_shape(look_of(k), colour(k)) : null);
    const solids = scene.shapes.map((one) => make_solid(one, colour(one.body)));
    bodies.append(...shapes.flatMap((shape) => shape === null ? [] : [shape.node]), ...solids.map((one) => one.node));
    const has_shape = (k) => shapes[k] !== null || scene.shapes.some((one) => one.body === k);
    const size_of = (k) => is_hidden(k) ? 0 : has_shape(k) ? 3 : count > 60 ? 4 : 9;
    const discs = scene.bodies.map((name, k) => bodies.appendChild(element('circle', {r: size_of(k), style: `fill: ${colour(k)}`})));
    const size_of_force = (values, k) => Math.hypot(values[3 * k], values[3 * k + 1], values[3 * k + 2]);
    const largest = (is_torque) => forces.reduce(
        (most, values) => scene.forces.reduce(
            (m, one, k) => one.is_torque === is_torque ? Math.max(m, size_of_force(values, k) || 0) : m, most),
        0);
    const largest_force = largest(false), largest_torque = largest(true);
    const arrows = scene.forces.map(({is_torque}) => {
        const colour = view_colours[is_torque ? 'purple' : 'red'];
        return bodies.appendChild(element('path', {style: `stroke: ${colour}; fill: ${colour}`, 'stroke-width': 2.5}));
    });
    const joints = [];
    for (let k = scene.bodies.length; k < count; ++k) joints.push(bodies.appendChild(element('circle', {r: 3, fill: 'currentColor'})));
    const names = scene.bodies.length > 12 ? [] : scene.bodies.map((name) => label.appendChild(element('text', {}, name)));
    const draw_ground = () => {
        const [x, y] = [width / 2 - view.x / view.span, height / 2 + view.y / view.span];
        ground.replaceChildren();
        if (!is_planar) {
            const from = on_paper(axes[0], 0);
            axes.slice(1).forEach((axis, k) => {
                const to = on_paper(axis, 0);
                ground.append(
                    element('line', {x1: from[0], y1: from[1], x2: to[0], y2: to[1], 'stroke-opacity': 0.6}),
                    element('text', {x: to[0] + 4, y: to[1] - 4, stroke: 'none'}, 'xyz'[k]));
            });
        }
        for (const [from, to] of grid) {
            const [a, b] = [on_paper(from, 0), on_paper(to, 0)];
            ground.append(element('line', {x1: a[0], y1: a[1], x2: b[0], y2: b[1]}));
        }
        if (is_planar && ground_height !== null)
            ground.append(ground_line(width, height / 2 - (ground_height - view.y) / view.span));
        else if (is_planar && y > 0 && y < height)
            ground.append(element('line', {x1: 0, x2: width, y1: y, y2: y, 'stroke-dasharray': '3 5'}));
        if (is_planar && x > 0 && x < width) ground.append(element('line', {x1: x, x2: x, y1: 0, y2: height, 'stroke-dasharray': '3 5'}));
        const metres =
            [1, 2, 5, 10].map((one) => one * 10 ** Math.floor(Math.log10(view.span * 120))).reverse().find((one) => one / view.span < 160);
        ground.append(
            element(
                "line", {x1: 14, x2: 14 + metres / view.span, y1: height - 12, y2: height - 12, "stroke-width": 3, "stroke-opacity": 0.8}),
            element("text", {x: 14, y: height - 18, stroke: "none"}, `${number_text(metres)} m`));
    };
    const show = (i) => {
        shown = Math.max(0, Math.min(i, places.length - 1));
        const p = places[shown];
        if (!p) return;
        const at = [];
        for (let k = 0; k < count; ++k) at.push(on_paper(p, k));
        bar_lines.forEach((line, b) => {
            const [from, to] = scene.bars[b].map((k) => at[k]);
            for (const [key, value] of [["x1", from[0]], ["y1", from[1]], ["x2", to[0]], ["y2", to[1]]])
                line.setAttribute(key, value.toFixed(2));
        });
        connectors.forEach((one, s) => {
            const ends = [at[one.from], walls[s] === null ? on_paper(p, one.to) : on_paper(walls[s](p), 0)];
            const length = Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]) || 1;
            const across = [(ends[1][1] - ends[0][1]) / length, (ends[0][0] - ends[1][0]) / length];
            const aside = (one.beside - (one.together - 1) / 2) * 20;
            const [a, b] = ends.map((end) => end.map((x, i) => x + aside * across[i]));
            connector_lines[s].setAttribute('d', one.is_damper ? damper_path(a, b, across) : spring_path(a, b, across));
            if (wall_lines[s] !== null)
                for (const [key, value] of [
                         ["x1", b[0] - 14 * across[0]], ["y1", b[1] - 14 * across[1]], ["x2", b[0] + 14 * across[0]],
                         ["y2", b[1] + 14 * across[1]]])
                    wall_lines[s].setAttribute(key, value.toFixed(1));
        });
        [...discs, ...joints].forEach((disc, k) => {
            disc.setAttribute("cx", at[k][0].toFixed(2));
            disc.setAttribute("cy", at[k][1].toFixed(2));
        });
        shapes.forEach((shape, k) => {
            if (shape !== null) shape.show(at[k][0], at[k][1], measures[shown], view.span);
        });
        for (const solid of solids) solid.show(measures[shown], (point) => on_paper(point, 0), view.span);
        arrows.forEach((path, k) => {
            const {at: place, is_torque} = scene.forces[k], most = is_torque ? largest_torque : largest_force, from = at[place];
            if (is_torque && is_planar) {  // about the axis that points at us: z, -y or x
                const normal = 3 - scene.plane[0] - scene.plane[1], share = forces[shown][3 * k + normal] / most || 0;
                return path.setAttribute('d', turning_path(from[0], from[1], normal === 1 ? -share : share));
            }
            const [along, up] = project(forces[shown], k).map((one) => most > 0 ? arrow * one / most : 0);
            path.setAttribute('d', (is_torque ? axis_path : arrow_path)(from[0], from[1], along, -up));
        });
        const taken = [];
        names.forEach((name, k) => {
            // Bodies at one place have one label.
            const together = scene.bodies.filter((one, j) => !is_hidden(j) && Math.hypot(at[j][0] - at[k][0], at[j][1] - at[k][1]) < 4);
            const text = together[0] === scene.bodies[k] && !is_hidden(k) ? together.join(", ") : "";
            const place = text === "" ? null : label_place(taken, at[k], text.length, width);
            name.textContent = place === null ? "" : text;
            if (place === null) return;
            name.setAttribute("x", place.x);
            name.setAttribute("y", place.y);
            name.setAttribute("text-anchor", place.anchor);
        });
        trail_lines.forEach((line, k) => {
            if (!said.has_trails || is_hidden(k)) return;
            let text = "";
            for (let j = Math.max(0, shown - 120); j <= shown; ++j) {
                const [x, y] = on_paper(places[j], k);
                text += `${x.toFixed(1)},${y.toFixed(1)} `;
            }
            line.setAttribute("points", text);
        });
    };
    const redraw = () => {
        frame();
        draw_ground();
        show(shown);
    };
    redraw();
    const arrows_text = (is_torque, most, words, unit) => most > 0 ?
        ` ${words} (${scene.forces.filter((one) => one.is_torque === is_torque).map((one) => one.name).join(', ')}), up to ${
            number_text(most, 3)} ${unit}.` :
        '';
    const caption = element(
        'figcaption', {},
        (is_planar ? 'Bodies at their positions, to scale.' :
                     'Bodies at their positions, to scale; drag, or use the arrow keys, to look from elsewhere.') +
            arrows_text(false, largest_force, 'Arrows are forces', 'N') +
            arrows_text(true, largest_torque, is_planar ? 'Arrows around bodies are torques' : 'Arrows with two heads are torques', 'N m') +
            (walls.some((wall) => wall !== null) ? ' The distances to walls are not to scale.' : ''));
    if (!is_planar) {
        let from = null;
        svg.setAttribute("tabindex", "0");
        const turn_by = (across, up) => {
            turn += across;
            tilt = Math.max(-1.5, Math.min(1.5, tilt + up));
            redraw();
        };
        svg.addEventListener("pointerdown", (e) => {
            from = [e.clientX, e.clientY];
            svg.setPointerCapture(e.pointerId);
        });
        svg.addEventListener("pointermove", (e) => {
            if (from) {
                turn_by((e.clientX - from[0]) / 150, (e.clientY - from[1]) / 150);
                from = [e.clientX, e.clientY];
            }
        });
        svg.addEventListener("pointerup", () => {
            from = null;
        });
        svg.addEventListener("keydown", (e) => {
            const step = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]}[e.key];
            if (step) {
                turn_by(...step);
                e.preventDefault();
            }
        });
    }
    return {node: element("figure", {}, svg, caption), show};
}

/// Levels of at most twelve columns between the least and the largest value of the run.
function make_levels(columns, across) {
    const list = columns.slice(0, 12), width = Math.max(280, Math.min(640, across)), height = 20 + 46 * list.length;
    const svg = element(
        "svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `Levels of ${list.map((one) => one.name).join(", ")}`});
    const step = 46, thick = 18;
    const parts = list.map((column, k) => {
        const good = column.values.filter(Number.isFinite);
        const low = good.reduce((a, b) => Math.min(a, b), Infinity), high = good.reduce((a, b) => Math.max(a, b), -Infinity);
        const y = 14 + k * step;
        const text = element("text", {x: 14, y: y + 10});
        const bar = element("rect", {x: 14, y: y + 16, height: thick, rx: 3, style: `fill: ${plot_colours[k % plot_colours.length]}`});
        svg.append(
            text, element("rect", {x: 14, y: y + 16, width: width - 28, height: thick, rx: 3, fill: "currentColor", "fill-opacity": 0.1}),
            bar);
        return {column, low, high, text, bar};
    });
    const show = (i) => {
        for (const {column, low, high, text, bar} of parts) {
            const value = column.values[i], share = high > low ? (value - low) / (high - low) : 0.5;
            text.textContent =
                `${column.name} = ${number_text(value)} ${column.unit}   (${number_text(low, 4)} ... ${number_text(high, 4)})`;
            bar.setAttribute("width", Number.isFinite(share) ? Math.max(0, share) * (width - 28) : 0);
        }
    };
    show(0);
    return {
        node: element(
            "figure", {}, svg,
            element(
                "figcaption", {}, "No body has a place to draw: states and outputs, between their least and largest value of this run.")),
        show
    };
}
