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
    KeySpec{"edition", Type::text, false, "which edition, or where it was found"},
    KeySpec{"doc", Type::text, false, "which part of the text this file is about"},
    KeySpec{"functions", Type::effects, false, "of entries in LaTeX: letters that are functions, with what they are functions of: [\"f(x)\", \"L\"]"},
    KeySpec{"preamble", Type::text, false, "of entries in LaTeX: lines of the text that define macros, \\newcommand, \\def and \\DeclareMathOperator; what else stands there is passed over"},
    KeySpec{"decimal", Type::choice, false, "of entries in LaTeX: \".\" or \",\" stands before decimals, and the other one between thousands: 42,164"},
    KeySpec{"coordinates", Type::effects, false, "of entries in LaTeX: the Cartesian coordinates that \\nabla differentiates by: [\"x\", \"y\", \"z\"]"},
    KeySpec{"dimensionless", Type::boolean, false, "true: the text counts without units, and all letters of entries without a model are numbers"},
};
const std::array letter_keys{
    KeySpec{"unit", Type::unit, true, "its unit: \"kg\", \"N/m\", \"1\""},
    KeySpec{"range", Type::range, false, "[low, high] in its unit: where random points are taken from, and what makes it positive"},
    KeySpec{"value", Type::constant, false, "a number, in its unit: the letter stands for it"},
    KeySpec{"of", Type::choice, false, "\"t\": it is a function of time, with derivatives dot(NAME) and ddot(NAME)"},
    KeySpec{"for", Type::family, false, "makes it a family: \"k = 1..3\""},
    KeySpec{"doc", Type::text, false, "what it is"},
};
const std::array notation_keys{
    KeySpec{"value", Type::expression, true, "what the letter of the text stands for"},
};
const std::array macro_keys{
    KeySpec{"value", Type::text, true, "what it stands for, in LaTeX"},
};
const std::array entry_keys{
    KeySpec{"equation", Type::equation, false, "the printed equation in the model language: \"left = right\", also \"a = b = c\""},
    KeySpec{"equations", Type::equations, false, "several equations under one number"},
    KeySpec{"latex", Type::text, false, "instead: the equation, or several, in LaTeX, as it is printed"},
    KeySpec{"notation", Type::expressions_by_name, false, "with latex: what its letters stand for, where that is not in [notation]: { '\\varphi' = \"theta\" }"},
    KeySpec{"functions", Type::effects, false, "with latex: letters that are functions: \"f(x)\", so that f(a) is its value at a, or \"f\" for letters alone in brackets, and times"},
    KeySpec{"model", Type::text, false, "the model that it is checked against, relative to the catalogue; none: an identity on its own letters"},
    KeySpec{"printed", Type::text, false, "instead of an equation: the [printed] entry of the model that says it; the one of the same number, if left out"},
    KeySpec{"scene", Type::text, false, "the scene of the model; if left out its default, of a [printed] entry all that contain it"},
    KeySpec{"mode", Type::text, false, "the mode of a model that switches; all of them, if left out"},
    KeySpec{"with", Type::expressions_by_name, false, "letters with what they stand for, from lines before: { p = \"rho*R*T\" }"},
    KeySpec{"letters", Type::named_tables, false, "further letters, or others than in the file: { x = \"m\" } or { x = { unit = \"m\", of = \"t\" } }"},
    KeySpec{"positive", Type::named_tables, false, "the same for what is positive"},
    KeySpec{"at", Type::expressions_by_name, false, "a point at which it holds: { phi = 0, \"dot(phi)\" = 0 }"},
    KeySpec{"solves", Type::equations, false, "the entry says what letters are, \"x = ...\"; these are the equations that they solve: what has to hold when they are inserted"},
    KeySpec{"unit", Type::unit, false, "a side that is a number alone is a value in this unit, right to half a unit of its last printed digit"},
    KeySpec{"dimensionless", Type::boolean, false, "true: the letters of the entry are numbers, whatever their units are elsewhere; without a model"},
    KeySpec{"not_checkable", Type::text, false, "instead of an equation: why there is nothing to check, as \"definition\""},
    KeySpec{"expect", Type::choice, false, "the verdict of a known misprint: \"wrong\", \"dimensionally wrong\", \"numerically equal\", \"not checkable\""},
    KeySpec{"source", Type::text, false, "where it is printed, if not in the catalogue's source"},
    KeySpec{"for", Type::family, false, "an entry for each value of an index: \"k = 1..3\""},
    about_key,
};

const std::array catalogue_table{
    SectionSpec{"catalogue", false, "A file with this section is a catalogue: the equations of a text, for `check`.",
                "[catalogue]\nformat = 1\nsource = \"A. Author, Mechanics\"\nedition = \"second, 2020\"", catalogue_keys, ""},
    SectionSpec{"letters", true, "Letters of the text that may have any sign, with their units.", "[letters]\nx = \"m\"\nq = { unit = \"m\", of = \"t\" }", letter_keys, "unit"},
    SectionSpec{"positive", true, "Letters of the text that are positive.", "[positive]\nm = \"kg\"\ng = { unit = \"m/s^2\", value = 9.81 }", letter_keys, "unit"},
    SectionSpec{"notation", true, "What letters of the text stand for in models.", "[notation]\nT           = \"kinetic_energy\"\n'\\varphi_1' = \"phi_1\"", notation_keys, "value"},
    SectionSpec{"macros", true, "Macros of the text, and what they stand for; a macro has as many arguments as #1, #2, ... occur.", "[macros]\n'\\v'   = '\\mathbf{#1}'\n'\\pdd' = '\\frac{\\partial #1}{\\partial #2}'", macro_keys, "value"},
    SectionSpec{"entries", true, "The equations, by their printed numbers.",
                "[entries.\"2.219\"]\nmodel    = \"../mechanics/spherical_pendulum.toml\"\nequation = \"potential_energy = m*g*l*(1 - cos(theta))\"", entry_keys, ""},
};

}  // namespace

std::span<const SectionSpec> catalogue_sections() { return catalogue_table; }

const SectionSpec& catalogue_section(std::string_view name) {
    const auto found = std::find_if(catalogue_table.begin(), catalogue_table.end(), [&](const SectionSpec& s) { return name == s.name; });
    if (found == catalogue_table.end()) throw std::logic_error("a catalogue has no such section: " + std::string(name));
    return *found;
}

}  // namespace dalembert
