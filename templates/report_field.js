// A field for a number in a unit, with a slider where its range has two ends.

/// `set` gets the number in SI, or null where the field may be empty and is. Returns { node, follow(value) }: what follow() gets stands for
/// an empty field; NaN for nothing.
function make_field(quantity, unit, value, doc, set, may_be_empty = false) {
    const input = element("input", {
        type: "text",
        inputmode: "decimal",
        value: value === null ? "" : number_text(in_unit(value, unit), 12),
        "aria-label": quantity.name
    });
    const note = element("small", {}, doc);
    const [low, high] = [quantity.low, quantity.high].map((bound) => in_unit(bound, unit));
    const has_slider = Number.isFinite(low) && Number.isFinite(high) && high > low && (!may_be_empty || quantity.has_slider);
    const slider = has_slider ? make_slider(quantity.name, low, high) : null;
    const say = (bad) => {
        input.setAttribute("aria-invalid", bad !== "");
        note.className = bad ? "bad" : "";
        note.textContent = bad || doc;
    };
    input.addEventListener("change", () => {
        const given = read_number(input.value);
        if (may_be_empty && input.value.trim() === "") {
            say("");
            set(null);
        } else if (Number.isNaN(given)) {
            say(`"${input.value}" is not a number, such as 0.5 or 0,5.`);
        } else if (!Number.isFinite(given)) {
            say(`"${input.value}" is too large for a number.`);
        } else if (given < low || given > high) {
            const to = Number.isFinite(high) ? ` to ${number_text(high)}` : " upwards";
            const from = Number.isFinite(low) ? `from ${number_text(low)}${to}` : `up to ${number_text(high)}`;
            const range = `${from} ${unit_text(unit)}`.trim();
            say(`${number_text(given, 12)} is outside of the declared range ${range}.`);
        } else {
            say("");
            if (slider) slider.show(given);
            set(in_si(given, unit));
        }
    });
    if (slider) {
        if (value !== null) slider.show(in_unit(value, unit));
        slider.node.addEventListener("input", () => {
            const given = Number(slider.value().toPrecision(4));
            input.value = number_text(given, 12);
            say("");
            set(in_si(Math.min(high, Math.max(low, given)), unit));
        });
    }
    const parts = [element("span", {}, quantity.name), input, element("span", {}, unit_text(unit))];
    const follow = (usual) => {
        input.placeholder = Number.isFinite(usual) ? number_text(in_unit(usual, unit), 8) : "";
        if (slider && Number.isFinite(usual) && input.value.trim() === "") slider.show(in_unit(usual, unit));
    };
    return {node: element("div", {class: "field"}, ...parts, ...(slider ? [slider.node] : []), note), follow};
}

/// By powers where the range spans several of ten.
function make_slider(name, low, high) {
    const is_by_powers = low > 0 && high / low > 50;
    const place = (value) => is_by_powers ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    const node = element("input", {type: "range", min: 0, max: 1, step: "any", value: 0.5, "aria-label": `${name}, slider`});
    return {
        node,
        show: (value) => { node.value = place(value); },
        value: () => is_by_powers ? low * (high / low) ** Number(node.value) : low + (high - low) * Number(node.value),
    };
}
