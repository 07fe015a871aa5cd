// Plots over the time, or of one quantity over another, as SVG that can be read off.
const plot_colours = [
    "light-dark(#0b57a4, #7cb8ff)", "light-dark(#b3400a, #ffae70)", "light-dark(#1a7a3c, #7ddc9a)", "light-dark(#8a2b8f, #e39be8)",
    "light-dark(#7a6a00, #e2d36b)", "light-dark(#555, #bbb)"
];

/// `x`: { name, unit, values }; `curves`: the same. `events`: times, where x is the time. `room`: pixels across. Returns { figure, show(i)
/// }.
function make_plot(x, curves, events, room) {
    const width = Math.max(280, Math.min(640, room)), height = 240, left = 60, right = 12, top = 12, bottom = 38;
    const step = width < 450 ? 2 : 1;  // of numbers below the axis
    const all = curves.flatMap((curve) => curve.values).filter(Number.isFinite);
    const [x_low, x_high] =
        x.is_time ? [x.values[0], Math.max(x.values[x.values.length - 1], x.values[0] + 1e-300)] : axis_bounds(x.values);
    const [y_low, y_high] = axis_bounds(all);
    const across = (value) => left + (width - left - right) * (value - x_low) / (x_high - x_low || 1);
    const up = (value) => height - bottom - (height - top - bottom) * (value - y_low) / (y_high - y_low);
    const names = curves.map((curve) => curve.name).join(", ");
    const svg =
        element("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `Plot of ${names} over ${x.name}`, tabindex: "0"});
    const digits = axis_digits(y_low, y_high);
    for (const tick of ticks(y_low, y_high)) {
        svg.append(
            element("line", {x1: left, x2: width - right, y1: up(tick), y2: up(tick), stroke: "currentColor", "stroke-opacity": 0.15}));
        svg.append(element("text", {x: left - 6, y: up(tick) + 4, "text-anchor": "end"}, number_text(tick, digits)));
    }
    const below = ticks(x_low, x_high), tick_step = below.length > 1 ? below[1] - below[0] : 1;
    for (const tick of below) {
        svg.append(element(
            "line", {x1: across(tick), x2: across(tick), y1: top, y2: height - bottom, stroke: "currentColor", "stroke-opacity": 0.15}));
        if (Math.round(tick / tick_step) % step === 0)
            svg.append(element("text", {x: across(tick), y: height - bottom + 16, "text-anchor": "middle"}, number_text(tick, 4)));
    }
    svg.append(element("text", {x: width - right, y: height - 6, "text-anchor": "end"}, `${x.name} ${x.unit ? `[${x.unit}]` : ""}`));
    for (const t of x.is_time ? events.slice(0, 200) : [])
        svg.append(element("line", {
            x1: across(t),
            x2: across(t),
            y1: top,
            y2: height - bottom,
            stroke: "currentColor",
            "stroke-opacity": 0.4,
            "stroke-dasharray": "2 4"
        }));
    curves.forEach((curve, c) => {
        let path = "", pen = "M";
        curve.values.forEach((value, i) => {
            if (!Number.isFinite(value) || !Number.isFinite(x.values[i])) {
                pen = "M";
                return;
            }
            path += `${pen}${across(x.values[i]).toFixed(2)} ${up(value).toFixed(2)}`;
            pen = "L";
        });
        svg.append(element("path", {
            d: path,
            fill: "none",
            style: `stroke: ${plot_colours[c % plot_colours.length]}`,
            "stroke-width": 1.8,
            "stroke-linejoin": "round"
        }));
    });
    const cursor = element("line", {y1: top, y2: height - bottom, stroke: "currentColor", "stroke-opacity": 0.7});
    const dots = curves.map((curve, c) => element("circle", {r: 4, style: `fill: ${plot_colours[c % plot_colours.length]}`}));
    svg.append(cursor, ...dots);
    const caption = element("figcaption");
    const figure = element("figure", {}, svg, caption);
    /// `is_quick`: without the words below, which cost most of the time of a frame.
    const show = (i, is_quick) => {
        if (i < 0 || i >= x.values.length) return;
        cursor.setAttribute("x1", across(x.values[i]));
        cursor.setAttribute("x2", across(x.values[i]));
        if (!is_quick) caption.replaceChildren(`${x.name} = ${number_text(x.values[i])} ${x.unit}`);
        curves.forEach((curve, c) => {
            const good = Number.isFinite(curve.values[i]);
            dots[c].setAttribute("cx", good ? across(x.values[i]) : -10);
            dots[c].setAttribute("cy", good ? up(curve.values[i]) : -10);
            if (!is_quick)
                caption.append(
                    "; ", element("span", {style: `color: ${plot_colours[c % plot_colours.length]}`}, "\u25cf "),
                    `${curve.name} = ${number_text(curve.values[i])} ${curve.unit}`);
        });
    };
    /// The row nearest to a place across the picture.
    const at = (event) => {
        const box = svg.getBoundingClientRect();
        const place = (event.clientX - box.left) / box.width * width;
        let best = 0;
        for (let i = 1; i < x.values.length; ++i)
            if (Math.abs(across(x.values[i]) - place) < Math.abs(across(x.values[best]) - place)) best = i;
        return best;
    };
    return {figure, svg, show, at};
}
