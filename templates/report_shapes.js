// What the view of a model says of the drawing: shapes of bodies, to scale, their colours, and the ground.
const view_colours = {
    blue: 'light-dark(#0b57a4, #7cb8ff)',
    orange: 'light-dark(#b3400a, #ffae70)',
    green: 'light-dark(#1a7a3c, #7ddc9a)',
    purple: 'light-dark(#8a2b8f, #e39be8)',
    yellow: 'light-dark(#8a6d00, #e2d36b)',
    grey: 'light-dark(#5a5f66, #b4bac2)',
    red: 'light-dark(#b01722, #ff8f8f)',
    brown: 'light-dark(#6d4326, #c9a183)'
};

/// For each row of a run the measures of the view.
function view_rows(scene, recording) {
    if (scene.measures === null) return recording.rows.map(() => []);
    const measure = scene.measures(recording.made.parameter_values);
    return recording.rows.map((row) => {
        const values = new Float64Array(scene.view.count);
        measure(row.t, row.x, values);
        return values;
    });
}

/// For each row of a run the components of the forces and torques, in N and N m.
function force_rows(scene, recording) {
    if (scene.force_values === null) return recording.rows.map(() => []);
    const functions = scene.force_values.map((make) => make === null ? null : make(recording.made.parameter_values));
    return recording.rows.map((row) => {
        const values = new Float64Array(3 * scene.forces.length), f = functions[row.mode] || null;
        if (f !== null) f(row.t, row.x, row.u, values);
        return values;
    });
}

/// The path of an arrow.
function arrow_path(x, y, along, up) {
    const length = Math.hypot(along, up);
    if (!(length > 2)) return "";
    const [a, b] = [along / length, up / length], head = Math.min(10, length / 2), side = head * 0.45;
    const back = [x + along - head * a, y + up - head * b];
    return `M${x.toFixed(1)} ${y.toFixed(1)}L${back.map((one) => one.toFixed(1)).join(" ")}` +
        `M${(x + along).toFixed(1)} ${(y + up).toFixed(1)}L${(back[0] - side * b).toFixed(1)} ${(back[1] + side * a).toFixed(1)}` +
        `L${(back[0] + side * b).toFixed(1)} ${(back[1] - side * a).toFixed(1)}z`;
}

/// The path of an arrow along an axis of turning, with two heads.
function axis_path(x, y, along, up) {
    const length = Math.hypot(along, up), short = Math.max(0, 1 - 9 / length);
    return arrow_path(x, y, along, up) + (length > 12 ? arrow_path(x, y, short * along, short * up) : '');
}

/// The path of an arrow around a point, counter-clockwise for a positive `share` of most of a turn.
function turning_path(x, y, share) {
    const r = 22, turn = 1.5 * Math.PI * share;
    if (!(Math.abs(turn) > 0.05)) return '';
    const at = (angle, away = r) => [x + away * Math.cos(angle), y - away * Math.sin(angle)];
    const [from, to] = [at(0), at(turn)], back = turn - Math.sign(turn) * Math.min(0.45, Math.abs(turn) / 2);
    const arc = (a) => `A${r} ${r} 0 ${Math.abs(a) > Math.PI ? 1 : 0} ${a > 0 ? 0 : 1} `;
    const text = (point) => point.map((one) => one.toFixed(1)).join(' ');
    // There and back, so that nothing is within it that would be filled.
    return `M${text(from)}${arc(back)}${text(at(back))}${arc(-back)}${text(from)}` +
        path_through([at(back, r - 5), to, at(back, r + 5)]) + 'z';
}

const path_through = (points) => points.map(([x, y], k) => `${k === 0 ? 'M' : 'L'}${x.toFixed(1)} ${y.toFixed(1)}`).join('');

/// The path of a spring from a to b; `across`: a pixel at right angles.
function spring_path(a, b, across) {
    const turns = 14, points = [];
    for (let k = 0; k <= turns; ++k) {
        const side = k < 2 || k > turns - 2 ? 0 : k % 2 === 0 ? 7 : -7;
        points.push([0, 1].map((i) => a[i] + k / turns * (b[i] - a[i]) + side * across[i]));
    }
    return path_through(points);
}

/// The path of a damper: a piston on a rod from a, in a cylinder at b.
function damper_path(a, b, across) {
    const at = (share, side) => [0, 1].map((i) => a[i] + share * (b[i] - a[i]) + side * across[i]);
    return [
        [at(0, 0), at(0.5, 0)], [at(0.5, -5), at(0.5, 5)], [at(0.35, 8), at(0.65, 8), at(0.65, -8), at(0.35, -8)], [at(0.65, 0), at(1, 0)]
    ].map(path_through).join('');
}

/// How far a shape reaches from the position of its body, in m.
function reach_of(look, measures) {
    if (!look || look.shape === '') return 0;
    return look.shape === 'box' ? Math.hypot(measures[look.width], measures[look.height]) / 2 : measures[look.radius];
}

/// Returns { node, show(x, y, measures, span) }: `span`: m a pixel.
function make_shape(look, colour) {
    const angle = (measures) => look.rotation === null ? 0 : measures[look.rotation];
    const path =
        element('path', {style: `fill: ${colour}; stroke: ${colour}`, 'fill-opacity': 0.45, 'stroke-width': 2, 'stroke-linejoin': 'round'});
    const at = (x, y, turn, along, across) => `${(x + along * Math.cos(turn) - across * Math.sin(turn)).toFixed(2)} ${
        (y - along * Math.sin(turn) - across * Math.cos(turn)).toFixed(2)}`;
    const show = (x, y, measures, span) => {
        const turn = angle(measures);
        if (look.shape === 'box') {
            const [w, h] = [measures[look.width] / span / 2, measures[look.height] / span / 2];
            path.setAttribute('d', `M${[[-w, -h], [w, -h], [w, h], [-w, h]].map(([a, b]) => at(x, y, turn, a, b)).join('L')}z`);
            return;
        }
        const r = measures[look.radius] / span;
        let d = `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${- 2 * r} 0z`;
        if (look.shape === 'wheel')
            for (let k = 0; k < 4; ++k) d += `M${at(x, y, turn + k * Math.PI / 2, 0.15 * r, 0)}L${at(x, y, turn + k * Math.PI / 2, r, 0)}`;
        path.setAttribute('d', d);
    };
    return {node: path, show};
}

/// Points of a solid in its own axes that its outline is made of, ring by ring.
function solid_rings(kind, sizes) {
    const ring = (radius, z) => Array.from({length: 25}, (one, k) => [Math.cos(k * Math.PI / 12), Math.sin(k * Math.PI / 12)])
                                    .map(([x, y]) => [radius * x, radius * y, z]);
    const [a, b, c] = sizes;
    switch (kind) {
        case 'box': {
            const square = (z) => [[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]].map(([x, y]) => [x * a / 2, y * b / 2, z]);
            const sides = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => [-1, 1].map((z) => [x * a / 2, y * b / 2, z * c / 2]));
            return c > 0 ? [square(-c / 2), square(c / 2), ...sides] : [square(0)];
        }
        case 'cylinder': return [ring(a, -b / 2), ring(a, b / 2)];
        case 'cone': return [ring(a, 0), c > 0 ? ring(c, b) : [[0, 0, b]]];
        case 'hemisphere': return [0, 0.25, 0.5, 0.75, 1].map((k) => ring(a * Math.cos(k * Math.PI / 2), a * Math.sin(k * Math.PI / 2)));
        case 'wheel': return [ring(a, 0), ...[0, 1, 2, 3].map((k) => [0.15, 1].map(
            (way) => [way * a * Math.cos(k * Math.PI / 2), way * a * Math.sin(k * Math.PI / 2), 0]))];
        default: return [ring(a, 0)];  // a disc
    }
}

/// The corners of the smallest convex outline, by their x and then by their y.
function outline_of(points) {
    const sorted = [...points].sort((p, q) => p[0] - q[0] || p[1] - q[1]);
    const half = (list) => list.reduce((chain, p) => {
        const turns = ([a, b]) => (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= 0;
        while (chain.length > 1 && turns(chain.slice(-2))) chain.pop();
        return [...chain, p];
    }, []);
    return [...half(sorted).slice(0, -1), ...half(sorted.reverse()).slice(0, -1)];
}

/// How far a solid reaches from its middle, in m.
function reach_of_solid(solid, measures) {
    return Math.hypot(...measures.slice(solid.first, solid.first + solid.sizes));
}

/// A solid with its sizes, origin and axes among the measures. Returns { node, show(measures, project, span) }: `project(point)` gives
/// pixels, `span`: m a pixel.
function make_solid(solid, colour) {
    const path = element('path', {
        style: `fill: ${colour}; stroke: ${colour}`,
        'fill-opacity': 0.35,
        'stroke-width': 1.5,
        'stroke-opacity': 0.8,
        'stroke-linejoin': 'round'
    });
    const show = (measures, project, span) => {
        const sizes = measures.slice(solid.first, solid.first + solid.sizes), from = solid.first + solid.sizes;
        const in_ground = (p) => [0, 1, 2].map(
            (i) => measures[from + i] + [0, 1, 2].reduce((sum, k) => sum + p[k] * measures[from + 3 + 3 * k + i], 0));
        if (solid.kind === 'sphere') {
            const [x, y] = project(in_ground([0, 0, 0])), r = sizes[0] / span;
            path.setAttribute('d', `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${- 2 * r} 0z`);
            return;
        }
        const rings = solid_rings(solid.kind, sizes).map((ring) => ring.map((p) => project(in_ground(p))));
        path.setAttribute('d', path_through(outline_of(rings.flat())) + 'z' + rings.map(path_through).join(''));
    };
    return {node: path, show};
}

/// A line with strokes below it, across a picture.
function ground_line(width, y) {
    const group = element('g', {stroke: 'currentColor', 'stroke-opacity': 0.55});
    group.append(element('line', {x1: 0, x2: width, y1: y, y2: y, 'stroke-width': 2}));
    for (let x = 6; x < width; x += 14) group.append(element('line', {x1: x, x2: x - 6, y1: y, y2: y + 7}));
    return group;
}

/// Where so many letters beside a point stand without lying on those of `taken`, which they join: { x, y, anchor }; null where all places
/// are taken.
function label_place(taken, [x, y], letters, width) {
    const across = 7 * letters, up = 13;  // at most, at 12 px
    const places = [[1, -10], [-1, -10], [1, 20], [-1, 20]].map(([side, below]) => ({
        x: x + 14 * side, y: y + below, anchor: side > 0 ? 'start' : 'end', left: side > 0 ? x + 14 : x - 14 - across
    }));
    const inside = places.filter((one) => one.left >= 0 && one.left + across <= width);
    const place = (inside.length > 0 ? inside : places).find((one) => !taken.some(
        (other) => one.left < other.left + other.across && other.left < one.left + across && Math.abs(one.y - other.y) < up));
    if (place === undefined) return null;
    taken.push({...place, across});
    return place;
}
