// Plots over the time, or of one quantity over another, as SVG that can be read off and zoomed.
const plot_colours = [
    'light-dark(#0b57a4, #7cb8ff)', 'light-dark(#b3400a, #ffae70)', 'light-dark(#1a7a3c, #7ddc9a)', 'light-dark(#8a2b8f, #e39be8)',
    'light-dark(#7a6a00, #e2d36b)', 'light-dark(#555, #bbb)'
];
const most_curves = 6;  // that a plot shows at first

/// The path through points, in pixels; it ends and begins again at what is no number. Of points that follow one another in one column of
/// pixels, it takes the first, the lowest, the highest and the last: they cover the same pixels, and a browser paints thousands of others
/// at each frame.
function path_of(across, up) {
    let path = '', pen = 'M';
    for (let begin = 0, end; begin < across.length; begin = end) {
        end = begin + 1;
        if (!Number.isFinite(across[begin]) || !Number.isFinite(up[begin])) {
            pen = 'M';
            continue;
        }
        let lowest = begin, highest = begin;
        const column = Math.floor(across[begin]);
        for (; Math.floor(across[end]) === column && Number.isFinite(up[end]); ++end) {
            if (up[end] < up[lowest]) lowest = end;
            if (up[end] > up[highest]) highest = end;
        }
        for (const i of [...new Set([begin, Math.min(lowest, highest), Math.max(lowest, highest), end - 1])]) {
            path += `${pen}${across[i].toFixed(2)} ${up[i].toFixed(2)}`;
            pen = 'L';
        }
    }
    return path;
}

/// `x`: { name, unit, values }; `curves`: the same, with an axis for each unit. `events`: times, where x is the time. `room`: pixels
/// across. Returns { figure, svg, show(row, is_quick), at(event), zoom(low, high) }; on_zoom(low, high) is called where a person zooms
/// along x, with nothing for all.
function make_plot(x, curves, events, room, on_zoom) {
    const axes = [...new Set(curves.map((curve) => curve.unit))], axis_of = curves.map((curve) => axes.indexOf(curve.unit));
    const width = Math.max(280, Math.min(640, room)), height = 240, left = 60, top = 20, bottom = 38;
    // Curves of further units have their values below alone.
    const apart = 54, narrowest = 120, axes_shown = Math.min(axes.length, 1 + Math.floor((width - left - 12 - narrowest) / apart));
    const right = 12 + apart * (axes_shown - 1);
    const names = curves.map((curve) => curve.name).join(', '), colour = (c) => plot_colours[c % plot_colours.length];
    const svg = element('svg', {
        viewBox: `0 0 ${width} ${height}`,
        role: 'img',
        'aria-label': `Plot of ${names} over ${x.name}; arrow keys move along it, + and - zoom, 0 shows all`,
        tabindex: '0'
    });
    const caption = element('figcaption'), figure = element('figure', {}, svg, caption);
    const is_shown = curves.map((curve, c) => c < most_curves);
    const all_of_x = x.is_time ? [x.values[0], Math.max(x.values[x.values.length - 1], x.values[0] + 1e-300)] : axis_bounds(x.values);
    let bounds = {x: all_of_x, y: null}, scale, cursor, dots, selection = null, row = 0;

    /// Of the curves of an axis that are shown, where x is in its bounds.
    const bounds_of_axis = (axis) => {
        const values = curves.flatMap((curve, c) => is_shown[c] && axis_of[c] === axis ? curve.values : []);
        return axis_bounds(values.filter((value, i) => {
            const at = x.values[i % x.values.length];
            return Number.isFinite(value) && at >= bounds.x[0] && at <= bounds.x[1];
        }));
    };
    /// The first axis at the left, with lines across; others at the right, in the colour of their curve if it is one.
    const draw_axis_up = (axis, line) => {
        const {low, high, up} = scale.axes[axis], digits = axis_digits(low, high);
        const own = axis_of.flatMap((one, c) => one === axis ? [c] : []);
        const is_first = axis === 0, at = is_first ? left - 6 : width - right + 6 + apart * (axis - 1);
        const look = {x: at, 'text-anchor': is_first ? 'end' : 'start'};
        if (axes.length > 1 && own.length === 1) look.style = `fill: ${colour(own[0])}`;
        for (const tick of ticks(low, high)) {
            if (is_first) svg.append(element('line', {x1: left, x2: width - right, y1: up(tick), y2: up(tick), ...line}));
            svg.append(element('text', {...look, y: up(tick) + 4}, number_text(tick, digits)));
        }
        if (axes[axis]) svg.append(element('text', {...look, y: 11}, `[${axes[axis]}]`));
    };
    const draw_axes = () => {
        const {across, x_low, x_high} = scale, line = {stroke: 'currentColor', 'stroke-opacity': 0.15};
        const step = width < 450 ? 2 : 1;  // of numbers below the axis
        for (let axis = 0; axis < axes_shown; ++axis) draw_axis_up(axis, line);
        const below = ticks(x_low, x_high), distance = below.length > 1 ? below[1] - below[0] : 1,
              digits_below = axis_digits(x_low, x_high);
        for (const tick of below) {
            svg.append(element('line', {x1: across(tick), x2: across(tick), y1: top, y2: height - bottom, ...line}));
            if (Math.round(tick / distance) % step === 0)
                svg.append(
                    element('text', {x: across(tick), y: height - bottom + 16, 'text-anchor': 'middle'}, number_text(tick, digits_below)));
        }
        svg.append(element('text', {x: width - right, y: height - 6, 'text-anchor': 'end'}, `${x.name} ${x.unit ? `[${x.unit}]` : ''}`));
    };
    const draw_curves = (inside) => {
        const {across} = scale;
        // More would hide the curves; a zoom shows those that are left.
        const times = x.is_time ? events.filter((time) => time >= scale.x_low && time <= scale.x_high) : [];
        for (const t of times.length <= 200 ? times : [])
            inside.append(element('line', {
                x1: across(t),
                x2: across(t),
                y1: top,
                y2: height - bottom,
                stroke: 'currentColor',
                'stroke-opacity': 0.4,
                'stroke-dasharray': '2 4'
            }));
        const places = x.values.map(across);
        curves.forEach((curve, c) => {
            if (!is_shown[c]) return;
            const path = path_of(places, curve.values.map(scale.axes[axis_of[c]].up));
            inside.append(
                element('path', {d: path, fill: 'none', style: `stroke: ${colour(c)}`, 'stroke-width': 1.8, 'stroke-linejoin': 'round'}));
        });
    };
    const draw = () => {
        const [x_low, x_high] = bounds.x;
        scale = {
            x_low,
            x_high,
            across: (value) => left + (width - left - right) * (value - x_low) / (x_high - x_low || 1),
            axes: axes.map((unit, axis) => {
                const [low, high] = bounds.y ? bounds.y[axis] : bounds_of_axis(axis);
                return {low, high, up: (value) => height - bottom - (height - top - bottom) * (value - low) / (high - low)};
            })
        };
        svg.replaceChildren();
        draw_axes();
        const box = {x: left, y: top, width: width - left - right, height: height - top - bottom};
        const inside = element('svg', {...box, viewBox: Object.values(box).join(' ')});  // cuts off what is outside of it
        draw_curves(inside);
        cursor = element('line', {y1: top, y2: height - bottom, stroke: 'currentColor', 'stroke-opacity': 0.7});
        dots = curves.map((curve, c) => element('circle', {r: 4, style: `fill: ${colour(c)}`}));
        // In a layer of its own, so that a browser need not paint the curves again where it moves.
        svg.append(inside, element('g', {style: 'will-change: transform'}, cursor, ...dots));
    };
    /// `is_quick`: without the words below, which cost most of the time of a frame.
    const show = (i, is_quick) => {
        if (i < 0 || i >= x.values.length) return;
        row = i;
        const {across} = scale, place = across(x.values[i]), is_inside = place >= left - 1e-6 && place <= width - right + 1e-6;
        cursor.setAttribute('x1', place);
        cursor.setAttribute('x2', place);
        if (!is_quick) caption.replaceChildren(`${x.name} = ${number_text(x.values[i])} ${x.unit}`);
        curves.forEach((curve, c) => {
            const y = scale.axes[axis_of[c]].up(curve.values[i]), is_between = y >= top - 1e-6 && y <= height - bottom + 1e-6;
            const good = is_shown[c] && is_inside && is_between;
            dots[c].setAttribute('cx', good ? place : -10);
            dots[c].setAttribute('cy', good ? y : -10);
            if (!is_quick && is_shown[c])
                caption.append(
                    '; ', element('span', {style: `color: ${colour(c)}`}, '\u25cf '),
                    `${curve.name} = ${number_text(curve.values[i])} ${curve.unit}`);
        });
    };
    const redraw = () => {
        draw();
        show(row, false);
    };
    const zoom = (low, high) => {
        bounds = low === undefined || !(high > low) ? {x: all_of_x, y: null} :
                                                      {x: [Math.max(low, all_of_x[0]), Math.min(high, all_of_x[1])], y: null};
        redraw();
    };
    /// Where an event of a pointer is, in pixels of the picture.
    const place_of = (event) => {
        const box = svg.getBoundingClientRect();
        return [(event.clientX - box.left) / box.width * width, (event.clientY - box.top) / box.height * height];
    };
    /// The row nearest to a place across the picture.
    const at = (event) => {
        const [place] = place_of(event);
        let best = 0;
        for (let i = 1; i < x.values.length; ++i)
            if (Math.abs(scale.across(x.values[i]) - place) < Math.abs(scale.across(x.values[best]) - place)) best = i;
        return best;
    };
    const value_across = (place) => scale.x_low + (place - left) / (width - left - right) * (scale.x_high - scale.x_low);
    const value_up = ({low, high}, place) => low + (height - bottom - place) / (height - top - bottom) * (high - low);
    const end_selection = () => {
        if (selection !== null) selection.box.remove();
        selection = null;
    };
    svg.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        const box = element('rect', {fill: 'var(--accent)', 'fill-opacity': 0.15, style: 'stroke: var(--accent)'});
        selection = {from: place_of(event), to: place_of(event), box};
        svg.append(box);
        if (event.isTrusted) svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener('pointermove', (event) => {
        if (selection === null) return;
        selection.to = place_of(event);
        const [[a, b], [c, d]] = [selection.from, selection.to], is_high = Math.abs(d - b) > 30;
        for (const [key, value] of [
                 ['x', Math.min(a, c)], ['width', Math.abs(c - a)], ['y', is_high ? Math.min(b, d) : top],
                 ['height', is_high ? Math.abs(d - b) : height - top - bottom]])
            selection.box.setAttribute(key, value);
    });
    svg.addEventListener('pointercancel', end_selection);
    svg.addEventListener('pointerup', () => {
        if (selection === null) return;
        const [[a, b], [c, d]] = [selection.from, selection.to];
        end_selection();
        if (Math.abs(c - a) < 6) return;
        const [low, high] = [value_across(Math.min(a, c)), value_across(Math.max(a, c))];
        const y = Math.abs(d - b) > 30 ? scale.axes.map((axis) => [Math.max(b, d), Math.min(b, d)].map((place) => value_up(axis, place))) :
                                         null;
        on_zoom(low, high);
        if (y !== null) {
            bounds.y = y;
            redraw();
        }
    });
    svg.addEventListener('dblclick', () => on_zoom());
    svg.addEventListener('keydown', (event) => {
        const half = (scale.x_high - scale.x_low) / 2, middle = Math.min(Math.max(x.values[row], scale.x_low), scale.x_high);
        if (event.key === '+')
            on_zoom(middle - half / 2, middle + half / 2);
        else if (event.key === '-')
            on_zoom(middle - 2 * half, middle + 2 * half);
        else if (event.key === '0')
            on_zoom();
        else
            return;
        event.preventDefault();
    });
    if (curves.length > most_curves) figure.append(choice_of_curves(curves, is_shown, redraw));
    draw();
    return {figure, svg, show, at, zoom};
}

/// A folded list of boxes, one a curve.
function choice_of_curves(curves, is_shown, redraw) {
    const list = element('div', {class: 'choice'});
    curves.forEach((curve, c) => {
        const box = element('input', {type: 'checkbox'});
        box.checked = is_shown[c];
        box.addEventListener('change', () => {
            is_shown[c] = box.checked;
            redraw();
        });
        list.append(element('label', {}, box, ` ${curve.name}`));
    });
    return element('details', {}, element('summary', {}, `Curves: ${curves.length}`), list);
}
