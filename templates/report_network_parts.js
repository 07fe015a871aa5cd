// Colours, scales and parts of the picture of fluids, heat, circuits and shafts.

/// From pale to deep blue for pressures and green for potentials, from blue over violet to red for temperatures; `share` from 0 to 1.
const network_colours = {
    pressure: (share) => `hsl(${(190 + 40 * share).toFixed(0)} 70% ${(82 - 50 * share).toFixed(0)}%)`,
    temperature: (share) => `hsl(${(240 + 120 * share).toFixed(0)} 70% ${(62 - 12 * share).toFixed(0)}%)`,
    voltage: (share) => `hsl(${(90 + 60 * share).toFixed(0)} 60% ${(84 - 54 * share).toFixed(0)}%)`
};
const network_legends = {
    pressure: 'Pressures',
    temperature: 'Temperatures',
    voltage: 'Potentials'
};

/// Where values are between the least and the largest of a run: { low, high, share(value) }; nothing where there are none.
function scale_of(rows, places) {
    let low = Infinity, high = -Infinity;
    for (const row of rows)
        for (const place of places) {
            const value = row[place];
            if (!Number.isFinite(value)) continue;
            low = Math.min(low, value);
            high = Math.max(high, value);
        }
    if (!(low <= high)) return null;
    const is_flat = high - low <= 1e-6 * Math.max(Math.abs(low), Math.abs(high));
    return {low, high, share: (value) => is_flat ? 0.5 : Math.min(1, Math.max(0, (value - low) / (high - low)))};
}

/// A strip of colours with its ends in words.
function legend_of(title, scale, unit, colour, x, y, across) {
    const strip = element('g'), count = 24, step = across / count;
    const ends = [...new Set([scale.low, scale.high].map((one) => number_text(in_unit(one, unit), 4)))];
    for (let k = 0; k < count && ends.length > 1; ++k)
        strip.append(element(
            'rect', {x: (x + k * step).toFixed(1), y, width: (step + 0.5).toFixed(1), height: 10, fill: colour((k + 0.5) / count)}));
    strip.append(element('text', {x, y: y - 5}, `${title}: ${ends.join(' ... ')} ${unit_text(unit)}`));
    return strip;
}

/// Text that fits into a width, whole where a pointer rests.
function short_text(text, x, y, across, anchor = 'middle') {
    const most = Math.max(4, Math.floor(across / 6.6));
    const shown = text.length > most ? text.slice(0, most - 1) + '\u2026' : text;
    const node = element('text', {x, y, 'text-anchor': anchor}, shown);
    if (shown !== text) node.append(element('title', {}, text));
    return node;
}

/// The body of a part around (x, y); `colour(quantity)` gives that of a value of a row. Returns { node, show(row), low }: below `low`
/// stand its values.
function part_body(part, x, y, largest_size, colour) {
    const node = element('g'), wide = 84, high = 46, frame = {stroke: 'currentColor', 'stroke-width': 1.5};
    const box = (more) => element('rect', {x: x - wide / 2, y: y - high / 2, width: wide, height: high, ...more});
    if (part.kind === 'rotor') return rotor_body(part, x, y);
    const fluid_or_heat = part.pressure !== null ? 'pressure' : 'temperature';
    if (part.kind === 'junction') {
        const dot = element('circle', {cx: x, cy: y, r: 7, ...frame});
        node.append(dot);
        return {node, low: y + 10, show: (row) => dot.setAttribute('fill', colour('pressure', row[part.pressure]))};
    }
    if (part.kind === 'pin') {
        const dot = element('circle', {cx: x, cy: y, r: 6, ...frame});
        node.append(dot);
        return {node, low: y + 8, show: (row) => dot.setAttribute('fill', colour('voltage', row[part.voltage]))};
    }
    if (part.kind === 'ground') {
        const d = `M${x} ${y}v10M${x - 12} ${y + 10}h24M${x - 8} ${y + 14}h16M${x - 4} ${y + 18}h8`;
        node.append(element('path', {d, fill: 'none', ...frame}));
        return {node, low: y + 18, show: () => {}};
    }
    if (part.kind === 'fixed') {
        const strokes = [-12, -4, 4, 12].map((aside) => `M${x - 3} ${y + aside}l6 -6`).join('');
        node.append(element('path', {d: `M${x} ${y - 18}v36${strokes}`, fill: 'none', ...frame}));
        return {node, low: y + 18, show: () => {}};
    }
    if (part.kind === 'outside' || part.kind === 'enclosure') {
        const is_outside = part.kind === 'outside';
        const ring = element(
            'circle',
            {cx: x, cy: y, r: is_outside ? 4 : 20, fill: 'var(--back)', ...(is_outside ? {} : {'stroke-dasharray': '3 4'}), ...frame});
        node.append(ring);
        return {node, low: y + high / 2, show: () => {}};
    }
    if (part.kind === 'cells') {
        const count = part.count, columns = part.across, rows = Math.ceil(count / columns);
        const tall = Math.max(rows > 1 ? 56 : 30, 0), cells = [];
        for (let k = 0; k < count; ++k) {
            const [i, j] = [k % columns, Math.floor(k / columns)];
            const cell = element('rect', {
                x: (x - wide / 2 + wide * i / columns).toFixed(2),
                y: (y + tall / 2 - tall * (j + 1) / rows).toFixed(2),
                width: (wide / columns + 0.3).toFixed(2),
                height: (tall / rows + 0.3).toFixed(2)
            });
            cells.push(cell);
            node.append(cell);
        }
        node.append(element('rect', {x: x - wide / 2, y: y - tall / 2, width: wide, height: tall, fill: 'none', ...frame}));
        const show = (row) => cells.forEach((cell, k) => cell.setAttribute('fill', colour('temperature', row[part.cells + k])));
        return {node, low: y + tall / 2, show};
    }
    const fill = box({'fill-opacity': 0.9});
    node.append(box({fill: 'currentColor', 'fill-opacity': 0.07}), fill);
    if (part.kind === 'tank' || part.kind === 'cylinder') {
        const is_tank = part.kind === 'tank';
        const piston = element(
            'rect', {fill: 'currentColor', width: is_tank ? wide : 5, height: is_tank ? 1.5 : high, x: x - wide / 2, y: y - high / 2});
        const walls = is_tank ? `M${x - wide / 2} ${y - high / 2}v${high}h${wide}v${- high}` :
                                `M${x + wide / 2} ${y - high / 2}h${- wide}v${high}h${wide}`;
        node.append(piston, element('path', {d: walls, fill: 'none', ...frame}));
        const show = (row) => {
            const share = Math.min(1, Math.max(0, row[part.size] / largest_size || 0)) * 0.9;
            fill.setAttribute('fill', colour(fluid_or_heat, row[part[fluid_or_heat]]));
            if (is_tank) {
                fill.setAttribute('y', y + high / 2 - share * high);
                fill.setAttribute('height', share * high);
                piston.setAttribute('y', y + high / 2 - share * high - 1);
            } else {
                fill.setAttribute('width', share * wide);
                piston.setAttribute('x', x - wide / 2 + share * wide);
            }
        };
        return {node, low: y + high / 2, show};
    }
    const is_dashed = part.kind === 'reservoir' || part.kind === 'held', is_round = part.kind === 'vessel' || part.kind === 'sought';
    for (const one of node.children) one.setAttribute('rx', is_round ? high / 2 : 4);
    node.append(box({fill: 'none', rx: is_round ? high / 2 : 4, ...(is_dashed ? {'stroke-dasharray': '5 4'} : {}), ...frame}));
    return {node, low: y + high / 2, show: (row) => fill.setAttribute('fill', colour(fluid_or_heat, row[part[fluid_or_heat]]))};
}

/// A wheel with a mark that turns counter-clockwise, where the angle is known.
function rotor_body(part, x, y) {
    const r = 23, node = element('g'), frame = {stroke: 'currentColor', 'stroke-width': 1.5};
    const spokes = element('path', {fill: 'none', ...frame}), mark = element('circle', {r: 3.5, style: `fill: ${plot_colours[0]}`});
    node.append(element('circle', {cx: x, cy: y, r, fill: 'var(--back)', ...frame}), spokes,
        element('circle', {cx: x, cy: y, r: 3, fill: 'currentColor'}));
    if (part.angle !== null) node.append(mark);
    const show = (row) => {
        if (part.angle === null || !Number.isFinite(row[part.angle])) return;
        const at = (turn, away) => [x + away * Math.cos(row[part.angle] + turn), y - away * Math.sin(row[part.angle] + turn)];
        spokes.setAttribute('d', [0, 1, 2].map((k) => path_through([at(2 * k * Math.PI / 3, 3), at(2 * k * Math.PI / 3, r)])).join(''));
        for (const [key, value] of [['cx', at(0, r - 7)[0]], ['cy', at(0, r - 7)[1]]]) mark.setAttribute(key, value.toFixed(2));
    };
    return {node, low: y + 25, show};
}

/// The symbol of a coupling. Returns { nodes, show(holds) }.
function coupling_symbol(kind, x, y) {
    const line = (d, more = {}) => element('path', {d, fill: 'none', stroke: 'currentColor', 'stroke-width': 1.5, ...more});
    const paper = (half, high) => element('rect', {x: x - half, y: y - high, width: 2 * half, height: 2 * high, fill: 'var(--back)'});
    const still = (...nodes) => ({nodes, show: () => {}});
    switch (kind) {
        case 'torsion spring': return still(paper(20, 6), line(spring_path([x - 20, y], [x + 20, y], [0, 1])));
        case 'torsion damper': return still(paper(16, 6), line(damper_path([x - 20, y], [x + 20, y], [0, 1])));
        case 'gear':
            return still(...[-8, 8].map((aside) => element(
                'circle',
                {cx: x + aside, cy: y, r: 7, fill: 'var(--back)', stroke: 'currentColor', 'stroke-width': 3, 'stroke-dasharray': '2.2 2.2'})));
        case 'clutch': {
            const plates = line('');
            const show = (holds) => plates.setAttribute('d', [-1, 1].map((k) => `M${x + k * (holds ? 2 : 5)} ${y - 12}v24`).join(''));
            return {nodes: [paper(5, 12), plates], show};
        }
        default: return still();
    }
}

/// What stands on a line, of its kind: an orifice, a valve, a pump, or nothing but the arrow.
function link_symbol(kind, x, y) {
    const line = (d) => element('path', {d, fill: 'none', stroke: 'currentColor', 'stroke-width': 1.5});
    if (kind.endsWith('orifice')) return [line(`M${x - 9} ${y - 15}q9 7 18 0M${x - 9} ${y + 15}q9 -7 18 0`)];
    if (kind.endsWith('valve')) return [line(`M${x - 12} ${y - 14}h24v28h-24z`)];
    if (kind === 'pump') return [element('circle', {cx: x, cy: y, r: 15, fill: 'none', stroke: 'currentColor', 'stroke-width': 1.5})];
    if (kind === 'laminar') return [line(`M${x - 14} ${y - 9}h28M${x - 14} ${y + 9}h28`)];
    if (kind === 'pipe') return [line(`M${x - 18} ${y - 11}h36M${x - 18} ${y + 11}h36`)];
    if (kind === 'radiation') return [line(`M${x - 16} ${y - 13}q4 -5 8 0t8 0t8 0t8 0`)];
    return [];
}

/// The symbol of a branch of a circuit on a line that leads to the right (`heading` 1) or left (-1). Returns { nodes, show(conducts) }.
function branch_symbol(kind, x, y, heading) {
    const line = (d, more = {}) =>
        element('path', {d, fill: 'none', stroke: 'currentColor', 'stroke-width': 1.5, 'stroke-linejoin': 'round', ...more});
    const paper = (half) => element('rect', {x: x - half, y: y - 4, width: 2 * half, height: 8, fill: 'var(--back)'});
    const circle = (at, r) => element('circle', {cx: at, cy: y, r, fill: 'var(--back)', stroke: 'currentColor', 'stroke-width': 1.5});
    const still = (...nodes) => ({nodes, show: () => {}});
    const h = heading < 0 ? -1 : 1;
    switch (kind) {
        case 'resistor': return still(line(`M${x - 15} ${y - 6}h30v12h-30z`, {fill: 'var(--back)'}));
        case 'inductor': return still(paper(16), line(`M${x - 16} ${y}a4 4 0 0 1 8 0a4 4 0 0 1 8 0a4 4 0 0 1 8 0a4 4 0 0 1 8 0`));
        case 'capacitor': return still(paper(3), line(`M${x - 3} ${y - 11}v22M${x + 3} ${y - 11}v22`));
        case 'voltage_source':
            return still(circle(x, 12), line(`M${x - 12} ${y}h24M${x + h * 17} ${y - 8}v6M${x + h * 17 - 3} ${y - 5}h6`));
        case 'current_source': return still(circle(x, 12), line(`M${x} ${y - 12}v24`));
        case 'motor': return still(circle(x, 12), element('text', {x, y: y + 4, 'text-anchor': 'middle'}, 'M'));
        case 'transformer':
            return still(circle(x - 6, 10), line(`M${x - 4} ${y}a10 10 0 1 0 20 0a10 10 0 1 0 -20 0z`));
        case 'diode': {
            const body = line(`M${x - h * 8} ${y - 9}L${x + h * 8} ${y}L${x - h * 8} ${y + 9}zM${x + h * 8} ${y - 9}v18`);
            return {nodes: [body], show: (conducts) => body.setAttribute('fill', conducts ? 'currentColor' : 'var(--back)')};
        }
        case 'switch': {
            const lever = line('');
            const show = (conducts) => lever.setAttribute('d', `M${x - h * 13} ${y}L${x + h * 13} ${y - (conducts ? 0 : 12)}`);
            return {nodes: [paper(13), circle(x - 13, 2), circle(x + 13, 2), lever], show};
        }
        default: return still();
    }
}
