// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/catalogue_schema.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace dalembert {

namespace {

using Type = ValueType;

const KeySpec about_key{"doc", Type::text, false, "a remark, shown where the verdict is not `proven`"};

const std::array catalogue_keys{
    KeySpec{"format", Type::whole_number, true, "version of the catalogue language: 1"},
    KeySpec{"source", Type::text, true, "the text: author, title"},
    KeySpec{"edition", Type::text, false, "edition, or the place where the text was found"},
    KeySpec{"doc", Type::text, false, "part of the text that this file covers"},
    KeySpec{"functions", Type::effects, false, "of entries in LaTeX: letters that are functions, with their arguments: [\"f(x)\", \"L\"]"},
    KeySpec{"preamble", Type::text, false,
            "of entries in LaTeX: lines of the text that define macros, \\newcommand, \\def and \\DeclareMathOperator; other lines have no "
            "effect"},
    KeySpec{"decimal", Type::choice, false,
            "of entries in LaTeX: \".\" or \",\" stands before decimals, and the other one between thousands: 42,164"},
    KeySpec{"coordinates", Type::effects, false, "of entries in LaTeX: the Cartesian coordinates of \\nabla: [\"x\", \"y\", \"z\"]"},
    KeySpec{"dimensionless", Type::boolean, false, "true: the text has no units, and all letters of entries without a model are numbers"},
};
const std::array letter_keys{
    KeySpec{"unit", Type::unit, true, "its unit: \"kg\", \"N/m\", \"1\""},
    KeySpec{"range", Type::range, false,
            "[low, high] in its unit: random points come from it, and proofs take the sign of the letter from it"},
    KeySpec{"value", Type::constant, false, "the letter stands for this number, in its unit"},
    KeySpec{"of", Type::choice, false, "\"t\": the letter is a function of time, with derivatives dot(NAME) and ddot(NAME)"},
    KeySpec{"for", Type::family, false, "makes it a family: \"k = 1..3\""},
    KeySpec{"doc", Type::text, false, "meaning of the letter"},
};
const std::array notation_keys{
    KeySpec{"value", Type::expression, true, "expression that the letter of the text stands for"},
};
const std::array macro_keys{
    KeySpec{"value", Type::text, true, "LaTeX text that the macro stands for"},
};
const std::array entry_keys{
    KeySpec{"equation", Type::equation, false, "the printed equation in the model language: \"left = right\", also \"a = b = c\""},
    KeySpec{"equations", Type::equations, false, "several equations under one number"},
    KeySpec{"latex", Type::text, false, "instead of `equation`: one or several equations in LaTeX, as printed"},
    KeySpec{"notation", Type::expressions_by_name, false,
            "with latex: meanings of letters that are not in [notation]: { '\\varphi' = \"theta\" }"},
    KeySpec{"functions", Type::effects, false,
            "with latex: letters that are functions: with \"f(x)\", f(a) is the value at a; with \"f\", single letters and times in "
            "brackets are arguments"},
    KeySpec{"model", Type::text, false,
            "model that the equation is checked against, as a path from the catalogue; without one, the equation is an identity of its own "
            "letters"},
    KeySpec{"printed", Type::text, false,
            "instead of an equation: a [printed] entry of the model; the entry of the same number if left out"},
    KeySpec{"scene", Type::text, false, "scene of the model; if left out, the default one or, for a [printed] entry, all that contain it"},
    KeySpec{"mode", Type::text, false, "mode of a model that switches; all modes if left out"},
    KeySpec{"with", Type::expressions_by_name, false, "letters with their meaning, from earlier lines of the text: { p = \"rho*R*T\" }"},
    KeySpec{"letters", Type::named_tables, false,
            "further letters, or other meanings than in [letters]: { x = \"m\" } or { x = { unit = \"m\", of = \"t\" } }"},
    KeySpec{"positive", Type::named_tables, false, "the same for positive letters"},
    KeySpec{"at", Type::expressions_by_name, false,
            "a point: values that are inserted everywhere, in the equation too: { phi = 0, \"dot(phi)\" = 0 }"},
    KeySpec{"solves", Type::equations, false,
            "the entry gives the values of letters, \"x = ...\"; these equations must hold with the values inserted"},
    KeySpec{"unit", Type::unit, false, "unit of a side that is a single number; it must be right to half a unit of its last printed digit"},
    KeySpec{"dimensionless", Type::boolean, false,
            "true, without a model: the letters of the entry are numbers, even if they have units elsewhere"},
    KeySpec{"not_checkable", Type::text, false, "instead of an equation: the reason why there is nothing to check, as \"definition\""},
    KeySpec{"expect", Type::choice, false,
            "verdict of a known misprint: \"wrong\", \"dimensionally wrong\", \"numerically equal\", \"not checkable\""},
    KeySpec{"source", Type::text, false, "place of the equation, if it is not in the source of the catalogue"},
    KeySpec{"for", Type::family, false, "an entry for each value of an index: \"k = 1..3\""},
    about_key,
};

const std::array catalogue_table{
    SectionSpec{"catalogue", false, "A file with this section is a catalogue: the equations of a text, for `check`.",
                "[catalogue]\nformat = 1\nsource = \"A. Author, Mechanics\"\nedition = \"second, 2020\"", catalogue_keys, ""},
    SectionSpec{"letters", true, "Letters of the text that may have any sign, with their units.",
                "[letters]\nx = \"m\"\nq = { unit = \"m\", of = \"t\" }", letter_keys, "unit"},
    SectionSpec{"positive", true, "Letters of the text that are positive.",
                "[positive]\nm = \"kg\"\ng = { unit = \"m/s^2\", value = 9.81 }", letter_keys, "unit"},
    SectionSpec{"notation", true, "Letters of the text, and the expressions of models that they stand for.",
                "[notation]\nT           = \"kinetic_energy\"\n'\\varphi_1' = \"phi_1\"", notation_keys, "value"},
    SectionSpec{"macros", true, "Macros of the text and their meanings; #1, #2, ... are the arguments of a macro.",
                "[macros]\n'\\v'   = '\\mathbf{#1}'\n'\\pdd' = '\\frac{\\partial #1}{\\partial #2}'", macro_keys, "value"},
    SectionSpec{"entries", true, "The equations, by their printed numbers.",
                "[entries.\"2.219\"]\nmodel    = \"../mechanics/spherical_pendulum.toml\"\nequation = \"potential_energy = m*g*l*(1 - "
                "cos(theta))\"",
                entry_keys, ""},
};

}  // namespace

std::span<const SectionSpec> catalogue_sections() { return catalogue_table; }

const SectionSpec& catalogue_section(std::string_view name) {
    const auto found = std::find_if(catalogue_table.begin(), catalogue_table.end(), [&](const SectionSpec& s) { return name == s.name; });
    if (found == catalogue_table.end()) throw std::logic_error("a catalogue has no such section: " + std::string(name));
    return *found;
}

}  // namespace dalembert
