// Numbers as people read and write them.

/// At most `digits` significant digits, without zeros behind them.
function number_text(value, digits = 5) {
    if (!Number.isFinite(value)) return String(value);
    const rounded = Number(value.toPrecision(digits)), size = Math.abs(rounded);
    return size >= 1e6 || (size > 0 && size < 1e-3) ? rounded.toExponential().replace("e+", "e") : String(rounded);
}

/// "1 step", "2 steps"
function counted(count, word) { return `${count} ${word}${count === 1 ? "" : "s"}`; }

/// "0.5" and "0,5"; NaN for what is no number.
function read_number(text) {
    const plain = text.trim().replace(/\u2212/g, "-").replace(",", ".");
    return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}

const in_unit = (value, unit) => value / unit.factor - unit.offset;
const in_si = (value, unit) => (value + unit.offset) * unit.factor;
/// `value`, in SI, is a number within the bounds of a quantity but for roundings.
function is_in_range(value, quantity, unit) {
    const in_field = in_unit(value, unit), slack = 1e-12 * Math.abs(in_field);
    return Number.isFinite(value) && in_field + slack >= in_unit(quantity.low, unit) && in_field - slack <= in_unit(quantity.high, unit);
}
const in_words = (value, unit) => `${number_text(in_unit(value, unit), 6)} ${unit_text(unit)}`.trim();
const unit_text = (unit) => unit.unit === "1" ? "" : unit.unit;

/// In which a time this long is read.
function time_unit(seconds) {
    for (const [unit, factor] of [["d", 86400], ["h", 3600], ["min", 60]])
        if (seconds >= 3 * factor) return {unit, factor};
    return {unit: "s", factor: 1};
}

/// Between three and seven round numbers from low to high.
function ticks(low, high) {
    const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find((one) => one * power >= rough) * power;
    const result = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) result.push(k * step);
    return result;
}

/// From where to where an axis shows values, with room at both ends.
function axis_bounds(values) {
    let low = Infinity, high = -Infinity;
    for (const value of values)
        if (Number.isFinite(value)) {
            low = Math.min(low, value);
            high = Math.max(high, value);
        }
    if (!(low <= high)) return [0, 1];
    const least = 1e-6 * Math.max(Math.abs(low), Math.abs(high));  // less is rounding
    if (high > low && high - low < least) [low, high] = [(low + high - least) / 2, (low + high + least) / 2];
    const room = high > low ? (high - low) * 0.04 : Math.abs(high) * 0.05 || 1;
    return [low - room, high + room];
}

/// So many that its ticks differ.
function axis_digits(low, high) {
    return Math.min(12, Math.max(4, 2 + Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high)) / (high - low)))));
}

function element(name, attributes = {}, ...children) {
    const is_svg = ["svg", "g", "path", "line", "circle", "rect", "text", "polyline", "title"].includes(name);
    const made = is_svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
}
