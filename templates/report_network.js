// Fluids, heat, circuits and shafts as they are: volumes that fill, pressures, temperatures and potentials as colours, rotors that turn,
// flows and torques as arrows whose size follows them.

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
            rows, [...parts.filter((one) => one.pressure === null && one.temperature !== null).map((one) => one.temperature), ...cells]),
        voltage: scale_of(rows, places('voltage'))
    };
    const colour = (quantity, value) =>
        Number.isFinite(value) && scales[quantity] !== null ? network_colours[quantity](scales[quantity].share(value)) : 'none';
    const carried = {
        mass: {words: 'mass', colour: 'var(--accent)'},
        heat: {words: 'heat', colour: 'light-dark(#b3400a, #ffae70)'},
        current: {words: 'charge', colour: 'light-dark(#1a7a3c, #7ddc9a)'},
        torque: {words: 'torque', colour: view_colours.red}
    };
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
        lines.append(element('path', {d, ...(links[k].carries === 'heat' ? {'stroke-dasharray': '6 4'} : {})}));
    });
    const paper = {fill: 'var(--back)'};
    const text_of = (value, unit) => `${number_text(in_unit(value, unit), 4)} ${unit_text(unit)}`.trim();
    const shown_parts = parts.map((part, k) => {
        const [x, y] = at(layout.parts[k]);
        const size = part.size === null ? 0 : largest(rows.map((row) => row[part.size]));
        const has_box = !['outside', 'pin', 'ground', 'fixed'].includes(part.kind);
        bodies.append(element('rect', {x: x - 42, y: y - 24, width: has_box ? 84 : 0, height: 48, rx: 20, ...paper}));
        const body = part_body(part, x, y, size, colour);
        const words = [
            element('text', {x, y: body.low + 13, 'text-anchor': 'middle'}), element('text', {x, y: body.low + 26, 'text-anchor': 'middle'})
        ];
        bodies.append(body.node, short_text(part.name, x, y - (['junction', 'pin'].includes(part.kind) ? 14 : 29), step - 6), ...words);
        return {part, body, words};
    });
    const flows = links.map((link, k) => {
        const [x, line] = at(layout.stations[k]), heading = layout.headings[k];
        const has_symbol = link.carries === 'current' || (link.carries === 'torque' && link.kind !== 'torque');
        const most = link.flow === null ? 0 : largest(rows.map((row) => row[link.flow])), y = has_symbol ? line + 17 : line;
        const arrow = element('path', {style: `fill: ${carried[link.carries].colour}`});
        const words = element('text', {x, y: line + (has_symbol ? 38 : 28), 'text-anchor': 'middle'});
        const symbol = link.carries === 'current' ? branch_symbol(link.kind, x, line, heading) :
            link.carries === 'torque'             ? coupling_symbol(link.kind, x, line) :
                                                    {nodes: link_symbol(link.kind, x, line), show: () => {}};
        bodies.append(...symbol.nodes, arrow, short_text(link.name, x, line - 21, step - 6), words);
        return {link, x, y, most, arrow, words, heading, symbol};
    });
    for (const [kind, one] of Object.entries(carried))
        one.most = largest(flows.filter((flow) => flow.link.carries === kind).map((flow) => flow.most)) || 1;
    legends.forEach(
        ([name, scale], k) => svg.append(legend_of(
            network_legends[name], scale, units[name], network_colours[name], 8,
            layout.rows * tall + 40 * k + 22, Math.min(240, width - 16))));
    const show = (i, is_quick) => {
        const row = rows[Math.max(0, Math.min(i, rows.length - 1))];
        if (!row) return;
        for (const {part, body, words} of shown_parts) {
            body.show(row);
            if (is_quick) continue;
            const lines_of_words = [];
            if (part.pressure !== null) lines_of_words.push(text_of(row[part.pressure], units.pressure));
            if (part.voltage !== null) lines_of_words.push(text_of(row[part.voltage], units.voltage));
            if (part.speed !== null) lines_of_words.push(text_of(row[part.speed], units.speed));
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
        for (const {link, x, y, arrow, words, heading, symbol} of flows) {
            const value = link.flow === null ? NaN : row[link.flow], share = Math.sqrt(Math.abs(value) / carried[link.carries].most);
            const side = Number.isFinite(value) ? Math.sign(value) * heading : 0, thick = 1 + 5 * Math.min(1, share),
                  head = 5 + 4 * Math.min(1, share);
            const tip = x + side * 20;
            const holds = link.kind === 'clutch' && row[link.conducts] > 0, is_rigid = link.kind === 'shaft' || link.kind === 'gear';
            arrow.setAttribute(
                'd',
                is_rigid || holds          ? '' :
                side === 0 || share < 1e-3 ? `M${x - 6} ${y - 1}h12v2h-12z` :
                                             `M${x - side * 20} ${y - thick / 2}H${tip - side * 10}V${y - head}L${tip} ${y}L${
                                                 tip - side * 10} ${y + head}V${y + thick / 2}H${x - side * 20}z`);
            symbol.show(link.conducts === null || row[link.conducts] > 0);
            if (is_quick) continue;
            words.textContent = link.kind === 'gear' ? `${number_text(row[link.ratio], 4)} : 1` :
                link.kind === 'shaft'                ? '' :
                holds                                ? 'holds' :
                link.flow === null                   ? 'not known here' :
                                                       text_of(value, units[link.carries]);
        }
    };
    show(0);
    const found = Object.keys(carried).filter((kind) => kind !== 'torque' && links.some((link) => link.carries === kind));
    const broken = found.length > 1 ? ' (along broken lines)' : '';
    const kinds = found.map((kind) => carried[kind].words + (kind === 'heat' ? broken : '')).join(', ');
    const caption = (found.length > 0 ? `Arrows show flows of ${kinds}; the larger, the more flows. ` : '') +
        (links.some((link) => link.carries === 'torque' && link.flow !== null) ?
             'Arrows of torques point at what they turn counter-clockwise. ' :
             '') +
        (parts.some((part) => ['reservoir', 'held'].includes(part.kind)) ? 'Dashed parts have given values. ' : '') +
        'Places are not to scale.';
    return {node: element('figure', {}, svg, element('figcaption', {}, caption)), show};
}
