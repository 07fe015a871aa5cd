// Fluids and heat as they are: volumes that fill, pressures and temperatures as colours, flows as arrows whose size follows the flow.

/// For each row of a run the values of the network.
function network_rows(scene, recording) {
    const functions = scene.network_values.map((make) => make === null ? null : make(recording.made.parameter_values));
    return recording.rows.map((row) => {
        const values = new Float64Array(scene.network.count), f = functions[row.mode] || null;
        if (f !== null) f(row.t, row.x, row.u, values);
        return values;
    });
}

/// `rows`: of network_rows(). `across`: pixels. Returns { node, show(i, is_quick) }.
function make_network(network, rows, across) {
    const step = 104, tall = 104, margin = 14, room = 300;
    const fitting = network.layouts.filter((one) => one.columns * step + 2 * margin <= across);
    const layout = fitting.length > 0 ? fitting.reduce((a, b) => b.columns > a.columns ? b : a) : network.layouts[0];
    const {parts, links, units} = network, at = ([column, row]) => [margin + (column + 0.5) * step, (row + 0.5) * tall];
    const places = (key) => parts.flatMap((part) => part[key] === null ? [] : [part[key]]);
    const cells = parts.flatMap((part) => part.cells === null ? [] : Array.from({length: part.count}, (one, k) => part.cells + k));
    const scales = {
        pressure: scale_of(rows, places('pressure')),
        temperature: scale_of(
            rows, [...parts.filter((one) => one.pressure === null && one.temperature !== null).map((one) => one.temperature), ...cells])
    };
    const colour = (quantity, value) =>
        Number.isFinite(value) && scales[quantity] !== null ? network_colours[quantity](scales[quantity].share(value)) : 'none';
    const largest = (list) => list.reduce((most, one) => Math.max(most, Math.abs(one) || 0), 0);
    const legends = Object.entries(scales).filter(([name, scale]) => scale !== null);
    const width = Math.max(layout.columns * step + 2 * margin, Math.min(across, room)),
          height = layout.rows * tall + 40 * legends.length + 4;
    const names = parts.map((part) => part.name).filter((name) => name !== '').join(', ');
    const svg = element('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': `Network of ${names}`});
    svg.style.maxWidth = `${width * 1.25}px`;
    const lines =
        element('g', {fill: 'none', stroke: 'currentColor', 'stroke-opacity': 0.45, 'stroke-width': 2, 'stroke-linejoin': 'round'});
    const bodies = element('g');
    svg.append(lines, bodies);
    layout.paths.forEach((path, k) => {
        const d = path.map(at).map(([x, y], i) => `${i === 0 ? 'M' : 'L'}${x.toFixed(1)} ${y.toFixed(1)}`).join('');
        lines.append(element('path', {d, ...(links[k].is_heat ? {'stroke-dasharray': '6 4'} : {})}));
    });
    const paper = {fill: 'var(--back)'};
    const text_of = (value, unit) => `${number_text(in_unit(value, unit), 4)} ${unit_text(unit)}`.trim();
    const shown_parts = parts.map((part, k) => {
        const [x, y] = at(layout.parts[k]);
        const size = part.size === null ? 0 : largest(rows.map((row) => row[part.size]));
        bodies.append(element('rect', {x: x - 42, y: y - 24, width: part.kind === 'outside' ? 0 : 84, height: 48, rx: 20, ...paper}));
        const body = part_body(part, x, y, size, colour);
        const words = [
            element('text', {x, y: body.low + 13, 'text-anchor': 'middle'}), element('text', {x, y: body.low + 26, 'text-anchor': 'middle'})
        ];
        bodies.append(body.node, short_text(part.name, x, y - (part.kind === 'junction' ? 14 : 29), step - 6), ...words);
        return {part, body, words};
    });
    const flows = links.map((link, k) => {
        const [x, y] = at(layout.stations[k]);
        const most = link.flow === null ? 0 : largest(rows.map((row) => row[link.flow]));
        const arrow = element('path', {style: `fill: ${link.is_heat ? 'light-dark(#b3400a, #ffae70)' : 'var(--accent)'}`});
        const words = element('text', {x, y: y + 28, 'text-anchor': 'middle'});
        bodies.append(...link_symbol(link.kind, x, y), arrow, short_text(link.name, x, y - 21, step - 6), words);
        return {link, x, y, most, arrow, words, heading: layout.headings[k]};
    });
    const most_of = (is_heat) => largest(flows.filter((flow) => flow.link.is_heat === is_heat).map((flow) => flow.most)) || 1;
    const most_heat = most_of(true), most_mass = most_of(false);
    legends.forEach(
        ([name, scale], k) => svg.append(legend_of(
            name === 'pressure' ? 'Pressures' : 'Temperatures', scale, units[name], network_colours[name], 8,
            layout.rows * tall + 40 * k + 22, Math.min(240, width - 16))));
    const show = (i, is_quick) => {
        const row = rows[Math.max(0, Math.min(i, rows.length - 1))];
        if (!row) return;
        for (const {part, body, words} of shown_parts) {
            body.show(row);
            if (is_quick) continue;
            const lines_of_words = [];
            if (part.pressure !== null) lines_of_words.push(text_of(row[part.pressure], units.pressure));
            if (part.temperature !== null) lines_of_words.push(text_of(row[part.temperature], units.temperature));
            if (part.cells !== null) {
                const ends =
                    [row[part.cells], row[part.cells + part.count - 1]].map((one) => number_text(in_unit(one, units.temperature), 4));
                lines_of_words.push(`${ends.join(' ... ')} ${unit_text(units.temperature)}`);
            }
            words.forEach((node, k) => {
                node.textContent = lines_of_words[k] || '';
            });
        }
        for (const {link, x, y, arrow, words, heading} of flows) {
            const value = link.flow === null ? NaN : row[link.flow],
                  share = Math.sqrt(Math.abs(value) / (link.is_heat ? most_heat : most_mass));
            const side = Number.isFinite(value) ? Math.sign(value) * heading : 0, thick = 1 + 5 * Math.min(1, share),
                  head = 5 + 4 * Math.min(1, share);
            const tip = x + side * 20;
            arrow.setAttribute(
                'd',
                side === 0 || share < 1e-3 ? `M${x - 6} ${y - 1}h12v2h-12z` :
                                             `M${x - side * 20} ${y - thick / 2}H${tip - side * 10}V${y - head}L${tip} ${y}L${
                                                 tip - side * 10} ${y + head}V${y + thick / 2}H${x - side * 20}z`);
            if (!is_quick)
                words.textContent = link.flow === null ? 'not known here' : text_of(value, link.is_heat ? units.heat : units.mass_flow);
        }
    };
    show(0);
    const has = (is_heat) => links.some((link) => link.is_heat === is_heat);
    const kinds = has(false) && has(true) ? 'of mass (along lines) and heat (along broken lines)' : has(true) ? 'of heat' : 'of mass';
    const caption = (links.length > 0 ? `Arrows show flows ${kinds}; the larger, the more flows. ` : '') +
        'Dashed parts have given values. Places are not to scale.';
    return {node: element('figure', {}, svg, element('figcaption', {}, caption)), show};
}
