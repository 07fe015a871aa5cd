// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/describe_fluids.hpp"
#include "elements/describe_heat.hpp"

namespace dalembert {

namespace {

using T = ValueType;

constexpr KeySpec doc_key{"doc", T::text, false, "what it is, in words; goes into the report and the header"};
constexpr KeySpec for_key{"for", T::family, false, "makes it a family, one for each value of an index: \"k = 1..N\""};
constexpr KeySpec when_key{"when", T::condition, false,
                           "the effects under which it is there: \"drag\", \"not drag\", \"a and (b or c)\"; always, if left out"};
constexpr KeySpec unit_key{"unit", T::unit, true, "its unit: \"kg\", \"N/m\", \"deg\", \"1\""};
constexpr KeySpec range_key{"range", T::range, false,
                            "[low, high] in its unit; inf and -inf are allowed. Positivity in proofs and random test points come from here"};

/// The keys of a description.
class KeyList {
public:
    template <class Member>
    void operator()(const char* name, const Member& member, const Key& key) { keys.push_back({name, type_of(member, key), key.required, key.doc}); }
    void choice(const char* name, const Key& key) { keys.push_back({name, T::choice, key.required, key.doc}); }
    template <class Part>
    void table(const char* name, const std::optional<Part>&, const Key& key);
    void item(const ItemKeys& item) {
        keys.push_back(doc_key);
        if (item.has_family) keys.push_back(for_key);
        keys.push_back(when_key);
    }

    std::vector<KeySpec> keys;

private:
    static ValueType type_of(const ExpressionPtr&, const Key&) { return T::expression; }
    static ValueType type_of(const Reference&, const Key&) { return T::part; }
    static ValueType type_of(bool, const Key&) { return T::boolean; }
    static ValueType type_of(const std::optional<bool>&, const Key&) { return T::boolean; }
    static ValueType type_of(const std::optional<Law>&, const Key&) { return T::law; }
    static ValueType type_of(const std::optional<Property>&, const Key& key) { return key.variables.size() == 1 ? T::dependent : T::property; }
};

template <class Described>
std::span<const KeySpec> keys_of() {
    static const std::vector<KeySpec> keys = [] {
        KeyList list;
        Described item;
        describe(list, item);
        return std::move(list.keys);
    }();
    return keys;
}

template <class Part>
void KeyList::table(const char* name, const std::optional<Part>&, const Key& key) {
    keys.push_back({name, T::expressions_by_name, key.required, key.doc, keys_of<Part>});
}

template <class Described>
SectionSpec section_of() {
    constexpr const KindSpec& kind = kind_of<Described>;
    return {kind.section, true, kind.doc, kind.example, keys_of<Described>(), ""};
}

template <const auto& keys>
std::span<const KeySpec> parts_of() {
    return keys;
}

/// Of a side of a block.
std::span<const KeySpec> side_keys() {
    static const std::vector<KeySpec> keys = [] {
        std::vector<KeySpec> side{{"node", T::part, false, "in perfect contact with it; then nothing else is said"}};
        side.insert(side.end(), keys_of<Boundary>().begin(), keys_of<Boundary>().end());
        return side;
    }();
    return keys;
}

constexpr std::array model_keys{
    KeySpec{"format", T::whole_number, true, "version of the model language: 1"},
    KeySpec{"name", T::text, true, "name of files and namespaces"},
    KeySpec{"title", T::text, false, "one line for reports and plots"},
    KeySpec{"source", T::text, false, "the text the model comes from, with equation numbers"},
};
constexpr std::array size_keys{
    KeySpec{"value", T::constant, true, "the size when --size does not set it; a whole number"},
    range_key,
    doc_key,
};
constexpr std::array parameter_keys{
    KeySpec{"value", T::constants, true, "the default, in its unit; for a family one for all, or a list with one for each"},
    unit_key, range_key, doc_key, for_key,
};
constexpr std::array definition_keys{
    KeySpec{"value", T::expression, true, "what the name stands for"},
    KeySpec{"unit", T::unit, false, "checked against the expression"},
    doc_key, for_key, when_key,
};
constexpr std::array coordinate_keys{
    unit_key,
    KeySpec{"start", T::constant, false, "value at the start, in its unit; if left out 0, or what constraints make of that"},
    KeySpec{"guess", T::constant, false, "instead: near which value constraints find it at the start"},
    KeySpec{"start_rate", T::constant, false, "velocity at the start, in its unit per second; if left out 0, or what constraints make of that"},
    range_key, doc_key, for_key, when_key,
};
constexpr std::array input_keys{unit_key, range_key, doc_key, for_key, when_key};
constexpr std::array state_keys{
    unit_key,
    KeySpec{"start", T::constant, false, "value at the start, in its unit; 0 if left out"},
    KeySpec{"derivative", T::expression, false, "its time derivative; left out for a state that a volume, pipe, node, rod or block determines"},
    KeySpec{"root", T::boolean, false,
            "true: it is integrated as its square root, so that an outflow that goes like the root of it ends exactly; for what is not negative"},
    range_key, doc_key, for_key, when_key,
};
constexpr std::array output_keys{
    KeySpec{"value", T::expression, true,
            "what is put out; may use ddot(q), kinetic_energy, potential_energy, generalised_force[q]"},
    KeySpec{"unit", T::unit, false, "checked against the expression"},
    doc_key, for_key, when_key,
};
constexpr std::array gravity_keys{
    KeySpec{"acceleration", T::vector, true, "the acceleration of free fall, as a vector"},
    KeySpec{"reference", T::vector, false, "the point where the potential energy of gravity is zero; the origin if left out"},
    when_key,
};
constexpr std::array body_keys{
    KeySpec{"mass", T::expression, false, "its mass; needs a position"},
    KeySpec{"position", T::vector, false, "position of its centre of mass"},
    KeySpec{"rotation", T::expression, false, "its angle about the z axis, from x towards y"},
    KeySpec{"angular_velocity", T::expression, false, "instead of rotation: its angular velocity, linear in the velocities"},
    KeySpec{"inertia", T::tensor, false, "moment of inertia about the axis through its centre of mass; of a body in space the tensor in its own axes: [Jx, Jy, Jz], or three rows with products of inertia, as they stand in the matrix"},
    KeySpec{"turns", T::turns, false, "of a body in space: turns about its own axes one after the other, as [[\"z\", \"psi\"], [\"x\", \"theta\"]]"},
    KeySpec{"attitude", T::part, false, "instead of turns: an attitude, whose quaternion orients the body"},
    KeySpec{"solid", T::part, false, "instead of mass, inertia and centre: a solid, in its axes, that they are taken from. Of a planar body its moment about z counts, and the position is that of its centre of mass"},
    KeySpec{"origin", T::vector, false, "instead of position: where its axes begin; [0, 0, 0] if left out"},
    KeySpec{"centre", T::vector, false, "with origin: its centre of mass, in its own axes; [0, 0, 0] if left out"},
    KeySpec{"on", T::body, false,
            "another body: position or origin, and turns, are then measured in its frame. Within a family, NAME[k-1] of the first is the ground"},
    doc_key, for_key, when_key,
};
constexpr std::array attitude_keys{
    KeySpec{"start", T::expressions, false, "the quaternion at the start, a unit one: [cos(a/2), sin(a/2)*axis]; [1, 0, 0, 0] if left out"},
    KeySpec{"start_rate", T::expressions, false, "the angular velocity at the start, about the axes of the body, in rad/s; [0, 0, 0] if left out"},
    doc_key, when_key,
};
constexpr std::array spring_keys{
    KeySpec{"elongation", T::expression, true, "how far it is stretched from rest; a length or an angle"},
    KeySpec{"stiffness", T::expression, false, "of a linear spring: force = stiffness*elongation"},
    KeySpec{"force", T::law, false, "of any other: the force over the elongation, as in \"e -> c*e + c3*e^3\""},
    KeySpec{"energy", T::law, false, "the integral of the force, where the program cannot find it; proven by differentiation"},
    doc_key, for_key, when_key,
};
constexpr std::array damper_keys{
    KeySpec{"rate", T::expression, false, "the velocity that it resists, linear in the velocities"},
    KeySpec{"on", T::body, false, "instead of a rate: a body whose speed through a medium at rest is resisted"},
    KeySpec{"coefficient", T::expression, false, "of a linear damper: force = coefficient*rate"},
    KeySpec{"force", T::law, false, "of any other: the force over the rate (with on: over the speed), as in \"w -> d*w*abs(w)\""},
    doc_key, for_key, when_key,
};
constexpr std::array force_keys{
    KeySpec{"force", T::vector, true, "the force as a vector; its power counts as supplied"},
    KeySpec{"in_axes", T::boolean, false, "true, with on: the vector is given in the axes of the body, else in those of the ground"},
    KeySpec{"on", T::body, false, "the body at whose position it acts"},
    KeySpec{"at", T::vector, false, "instead of a body: the point at which it acts"},
    doc_key, for_key, when_key,
};
constexpr std::array torque_keys{
    KeySpec{"torque", T::torque, true, "the torque about the z axis, or on a body in space as a vector; its power counts as supplied"},
    KeySpec{"in_axes", T::boolean, false, "true: the vector is given in the axes of the body, else in those of the ground"},
    KeySpec{"on", T::body, false, "the body that it turns"},
    KeySpec{"against", T::body, false, "the body that carries the reaction; the ground if left out"},
    KeySpec{"rate", T::expression, false, "instead of bodies: the angular velocity with which the torque works"},
    doc_key, for_key, when_key,
};
constexpr std::array jet_keys{
    KeySpec{"from", T::body, true, "the body that loses mass; its mass contains a state whose rate is minus the mass flows"},
    KeySpec{"mass_flow", T::expression, true, "what leaves, in kg/s; negative for mass that arrives"},
    KeySpec{"velocity", T::vector, true, "of what leaves, or of what arrives, relative to the body: the thrust is minus mass flow times velocity (2.149)"},
    KeySpec{"in_axes", T::boolean, false, "true: the velocity is given in the axes of the body, else in those of the ground"},
    doc_key, for_key, when_key,
};
constexpr std::array cut_keys{
    KeySpec{"bodies", T::parts, true, "those that are cut free together"},
    KeySpec{"direction", T::vector, true, "of length 1, in the axes of the ground: the force that everything else exerts on the bodies is put out along it"},
    KeySpec{"about", T::vector, false, "a point: then the moment about the axis through it in the direction is put out"},
    doc_key, for_key, when_key,
};
constexpr std::array solid_keys{
    KeySpec{"shape", T::choice, false, "\"box\", \"cylinder\", \"cone\", \"sphere\", \"hemisphere\" or \"point\"; instead of `of`. The origin of its axes lies in the middle of a box, cylinder or sphere, and in the middle of the base of a cone or hemisphere; what is round is so about z, and stands towards +z"},
    KeySpec{"size", T::vector, false, "of a box: its lengths along x, y and z"},
    KeySpec{"radius", T::expression, false, "of what is round; of a cone that of its base"},
    KeySpec{"inner_radius", T::expression, false, "of a hollow cylinder or sphere"},
    KeySpec{"height", T::expression, false, "of a cylinder or cone, along z"},
    KeySpec{"top_radius", T::expression, false, "of a frustum of a cone; 0 if left out: the cone ends in a point"},
    KeySpec{"density", T::expression, false, "mass by volume; may depend on the place, as a polynomial in x, y and z along its own axes"},
    KeySpec{"mass", T::expression, false, "instead: its mass, spread evenly"},
    KeySpec{"of", T::parts, false, "instead of a shape: solids that are put together, placed in its axes"},
    KeySpec{"without", T::parts, false, "with of: solids that are taken away, such as bores, with the density of what they are cut out of"},
    KeySpec{"at", T::vector, false, "where the origin of its axes lies; [0, 0, 0] if left out"},
    KeySpec{"turns", T::turns, false, "turns of its axes about themselves one after the other, as of bodies"},
    doc_key,
};
constexpr std::array load_part_keys{
    KeySpec{"at", T::vector, false, "the point where it acts; [0, 0, 0] if left out"},
    KeySpec{"force", T::vector, false, "the force"},
    KeySpec{"moment", T::vector, false, "instead: a moment, the same about every point"},
};
constexpr SectionSpec load_part_spec{"forces", true, "", "", load_part_keys, ""};
constexpr std::array unknown_keys{unit_key, doc_key};
constexpr SectionSpec unknown_spec{"unknowns", true, "", "", unknown_keys, "unit"};
constexpr std::array load_keys{
    KeySpec{"forces", T::named_tables, true, "{ NAME = { at = [x, y, z], force = [x, y, z] } }, or { moment = [x, y, z] } for a pure couple; a force without `at` acts at the origin", parts_of<load_part_keys>},
    KeySpec{"about", T::vector, false, "the point that moments are taken about; the origin if left out"},
    KeySpec{"unknowns", T::named_tables, false, "{ NAME = \"N\" }: names with their units, that follow from the equilibrium. The forces may use them, and everything else; where a force acts, too, as long as the balances are linear in them", parts_of<unknown_keys>},
    doc_key, when_key,
};
constexpr std::array sticking_keys{
    KeySpec{"normal", T::expression, false, "the force that presses the surfaces together"},
    KeySpec{"tangential", T::one_or_two, false, "with normal: the force along the surface that friction has to bear, or its two components at right angles"},
    KeySpec{"tensions", T::expressions, false, "instead: of a rope around a cylinder that stands, the forces at its two ends"},
    KeySpec{"angle", T::expression, false, "with tensions: how far the rope goes around"},
    KeySpec{"coefficient", T::expression, true, "of friction at rest"},
    doc_key, when_key,
};
constexpr std::array kinetic_keys{
    KeySpec{"energy", T::expression, true, "a kinetic energy, quadratic in the velocities"},
    doc_key, for_key, when_key,
};
constexpr std::array potential_keys{
    KeySpec{"energy", T::expression, false, "a potential energy; where velocities enter, linearly, a generalised potential (2.216), as of charges in magnetic fields"},
    KeySpec{"forces", T::expressions_by_name, false,
            "instead of the energy: the generalised force on each coordinate; must satisfy the integrability condition (2.81)"},
    KeySpec{"reference", T::expressions_by_name, false, "with forces: the point where the energy is zero; 0 for what is left out"},
    doc_key, for_key, when_key,
};
constexpr std::array generalised_force_keys{
    KeySpec{"coordinate", T::coordinate, true, "the coordinate on which it acts"},
    KeySpec{"force", T::expression, true, "the generalised force; force times velocity is a power"},
    KeySpec{"power", T::choice, false, "\"supplied\" (default) or \"dissipated\": where its power is counted"},
    doc_key, for_key, when_key,
};
constexpr std::array block_keys{
    KeySpec{"temperature", T::part, true, "the family of states that are its temperatures, a cell each: along the bottom row from left to right, then the next row"},
    KeySpec{"columns", T::pieces, true, "what it is pieced together of from left to right, along x: [[\"L_a\", \"M\"], [\"L_b\", 3]] is a length L_a cut into M cells, and L_b cut into 3"},
    KeySpec{"rows", T::pieces, true, "likewise from bottom to top, along y"},
    KeySpec{"depth", T::expression, true, "across x and y"},
    KeySpec{"conductivity", T::table, true, "of all, or a list for each column of what stands there in each row: [[\"a\", \"a\"], [\"b\", \"c\"]]"},
    KeySpec{"density", T::table, true, "mass by volume, likewise"},
    KeySpec{"heat_capacity", T::table, true, "specific heat capacity, likewise"},
    KeySpec{"source", T::field, false, "heat by volume and time (4.4); \"(x, y) -> ...\" where it varies, from the left bottom corner"},
    KeySpec{"left", T::expressions_by_name, false,
            "what holds at the left side: { temperature }, { node } in perfect contact with it, or some of flux (into the block), coefficient and emissivity with ambient; insulated without (4.9)", side_keys},
    KeySpec{"right", T::expressions_by_name, false, "likewise at the right side", side_keys},
    KeySpec{"bottom", T::expressions_by_name, false, "likewise at the bottom", side_keys},
    KeySpec{"top", T::expressions_by_name, false, "likewise at the top", side_keys},
    doc_key, when_key,
};
constexpr std::array enclosure_keys{
    KeySpec{"surfaces", T::parts, true, "the nodes or cells of rods and blocks that radiate, up to 32; a flat body of one temperature may stand there twice"},
    KeySpec{"emissivities", T::expressions, true, "of each surface, from 0 (reflects everything) to 1 (black); where one depends on states or inputs, up to 3 surfaces"},
    KeySpec{"areas", T::expressions, false, "of each surface; with view_factors"},
    KeySpec{"view_factors", T::matrix, false,
            "row i, column j: the share of what leaves surface i that arrives at j (4.44). \"?\" for what follows from reciprocity (4.45) and the "
            "sum 1 of each row (4.47). An opening is a black surface too, held at the temperature of what is outside"},
    KeySpec{"polygon", T::points, false,
            "instead: the corners of the cross section of a prism without ends, in order, convex or not; surface i goes from corner i to corner i + 1. The view "
            "factors follow from crossed strings; which corners the strings touch is decided at the default parameters, and holds for others while no "
            "string takes another course"},
    KeySpec{"height", T::expression, false, "with polygon: the length of the prism along its axis"},
    doc_key, when_key,
};
constexpr std::array friction_keys{
    KeySpec{"rate", T::expression, true, "the velocity that slides, linear in the velocities"},
    KeySpec{"normal_force", T::expression, true, "what presses the surfaces together; may depend on states and inputs"},
    KeySpec{"coefficient", T::expression, true, "of sliding friction: the force is coefficient*normal_force"},
    KeySpec{"static_coefficient", T::expression, false, "of what holds at rest, not below the other; the same, if left out"},
    doc_key, when_key,
};
constexpr std::array stop_keys{
    KeySpec{"gap", T::expression, true, "the distance, positive where the stop is not touched"},
    KeySpec{"restitution", T::expression, false, "the part of its speed with which the gap opens again after an impact; 0, if left out"},
    doc_key, when_key,
};
constexpr std::array contact_keys{
    KeySpec{"elongation", T::expression, true, "how far it is stretched or pressed; negative where it is slack"},
    KeySpec{"stiffness", T::expression, true, "force = stiffness*elongation where that is positive"},
    KeySpec{"damping", T::expression, false, "of a damper beside the spring; the two together never pull back"},
    KeySpec{"play", T::expression, false, "it acts on both sides, beyond play/2 and below -play/2: a backlash. Brings also NAME_taut_back, with damping NAME_released_back"},
    doc_key, when_key,
};
constexpr std::array saturation_keys{
    KeySpec{"value", T::expression, true, "what is limited"},
    KeySpec{"low", T::expression, true, "the lower limit"},
    KeySpec{"high", T::expression, true, "the upper limit"},
    doc_key, when_key,
};
constexpr std::array phase_keys{
    KeySpec{"name", T::text, true, "of the phase; the mode is NAME_PHASE"},
    KeySpec{"value", T::expression, true, "of the profile in this phase"},
    KeySpec{"until", T::expression, false, "the time at which it ends; the last one has none"},
    KeySpec{"reset", T::expressions_by_name, false, "new values of states, coordinates and velocities at its end"},
};
constexpr SectionSpec phase_spec{"phases", false, "", "", phase_keys, ""};
constexpr std::array profile_keys{
    KeySpec{"phases", T::tables, true, "one after the other: { name, value, until }; until is the time at which the next one begins, which the last one has not. With reset = { \"dot(x)\" = 0 }: new values at its end", parts_of<phase_keys>},
    doc_key, when_key,
};
constexpr std::array mode_keys{
    KeySpec{"modes", T::effects, true, "their names; conditions may name them, and in expressions each is 1 where it holds, else 0"},
    KeySpec{"final", T::effects, false, "those of them that nothing has to leave"},
    doc_key, when_key,
};
constexpr std::array constraint_keys{
    KeySpec{"rate", T::expression, false, "the rate that is held at zero, linear in the velocities"},
    KeySpec{"position", T::expression, false, "instead: the position that is held at zero, and its rate with it"},
    KeySpec{"eliminates", T::coordinate, false, "the coordinate whose velocity follows from the rate; its factor there must not move. If left out: the last one that can, else the force is an unknown of its own"},
    KeySpec{"multiplier", T::boolean, false, "true: no velocity is eliminated; the force is an unknown of its own also where one could be"},
    doc_key, for_key, when_key,
};
constexpr std::array event_keys{
    KeySpec{"guard", T::expression, true, "happens where this goes through zero; may use ddot(q) and constraint_force[NAME]"},
    KeySpec{"direction", T::choice, false, "\"falling\" (default) or \"rising\""},
    KeySpec{"next", T::modes, false, "the mode afterwards: the first in the list that can go on from there; as before, if left out, where it resets something"},
    KeySpec{"reset", T::expressions_by_name, false, "new values of states, coordinates and velocities, made of those before: { \"dot(h)\" = \"-e*dot(h)\" }"},
    KeySpec{"meets", T::part, false, "a constraint whose rate is struck: velocities change by the smallest impulse that reverses it"},
    KeySpec{"restitution", T::expression, false, "with meets: the part of the rate that is left, reversed; 0, if left out: then the constraint holds exactly"},
    KeySpec{"rest", T::modes, false, "the mode after it has happened infinitely often at shrinking intervals; else a run stops there"},
    KeySpec{"rest_reset", T::expressions_by_name, false, "with rest: new values there"},
    KeySpec{"ends", T::boolean, false, "true: the run ends there"},
    doc_key, when_key,
};
constexpr std::array effect_keys{
    KeySpec{"doc", T::text, true, "what the effect is"},
    KeySpec{"excludes", T::effects, false, "effects that cannot be in the same scene"},
    KeySpec{"implies", T::effects, false, "effects that come with it"},
    KeySpec{"level_of", T::text, false, "a common name: of the effects that share it a scene has at most one"},
};
constexpr std::array scene_keys{
    KeySpec{"effects", T::effects, true, "the effects that the scene calls for"},
    KeySpec{"doc", T::text, false, "what the scene is for"},
};
constexpr std::array printed_keys{
    KeySpec{"equation", T::equation, false, "the printed equation in the model language: \"left = right\", also \"a = b = c\""},
    KeySpec{"equations", T::equations, false, "several equations under one number"},
    KeySpec{"with", T::expressions_by_name, false, "letters of the book that the model does not have, with what they stand for"},
    KeySpec{"at", T::expressions_by_name, false, "a point at which it holds: { phi = 0, \"dot(phi)\" = 0 }"},
    KeySpec{"expect", T::choice, false,
            "the verdict of a known misprint: \"wrong\", \"dimensionally wrong\", \"numerically equal\", \"not checkable\""},
    KeySpec{"source", T::text, false, "where it is printed, if not in the model's source"},
    doc_key, for_key, when_key,
};
constexpr std::array run_keys{
    KeySpec{"until", T::constant, true, "end of the run in seconds, or with a unit, \"2 min\"; an expression of parameters is allowed"},
    KeySpec{"scene", T::text, false, "the scene it belongs to; every scene, if left out"},
    KeySpec{"period", T::constant, false, "time of one period in seconds, where there is one; used by the energy test"},
    KeySpec{"start", T::expressions_by_name, false, "start values that differ: { s = 0.2, \"dot(s)\" = 0 }, without a unit in the declared one"},
    KeySpec{"inputs", T::expressions_by_name, false, "inputs as expressions of t and the states, without a unit in the declared one; 0 for what is left out, but temperatures and pressures have to be given"},
    KeySpec{"parameters", T::expressions_by_name, false, "parameters that differ, without a unit in the declared one"},
    KeySpec{"exact", T::expressions_by_name, false, "closed forms of outputs and states, of t and parameters, where there are some: references of `cost`"},
    KeySpec{"tolerance", T::number, false, "relative tolerance of a step; 1e-9 if left out"},
    KeySpec{"method", T::choice, false, "\"automatic\" (default): \"dopri5\" or at 1e-6 and less \"dop853\", \"rodas5p\" as long as the problem is stiff; also \"taylor\" for smooth motion at tight tolerances, \"fehlberg78\", \"bulirsch_stoer\", or with a fixed step \"euler\", \"rk4\" or, for separable machines, \"symplectic\""},
    KeySpec{"step", T::constant, false, "fixed step of euler and rk4 in seconds"},
    KeySpec{"samples", T::whole_number, false, "number of equal intervals at which results are written; 500 if left out"},
    KeySpec{"plots", T::plots, false, "lists of names over time: [[\"s\"], [\"phi\"]], or { x = \"x\", y = [\"z\"] }"},
    doc_key,
};

const std::vector<SectionSpec>& table() {
    static const std::vector<SectionSpec> rows{
        SectionSpec{"model", false, "What the file is about.",
                    "[model]\nformat = 1\nname   = \"cart_pendulum\"\ntitle  = \"Cart with a pendulum rod\"", model_keys, ""},
        SectionSpec{"sizes", true, "Whole numbers that count the members of families; set with --size N=5.",
                    "[sizes]\nN = { value = 3, range = [1, 64], doc = \"number of links\" }", size_keys, "value"},
        SectionSpec{"parameters", true, "Constants of the machine, set in the header's parameter struct.",
                    "[parameters]\nm_W = { value = 1.0, unit = \"kg\", range = [0.1, 10], doc = \"mass of the cart\" }", parameter_keys, ""},
        SectionSpec{"definitions", true, "Names for expressions.", "[definitions]\nm_S = \"rho_S*l_S*b_S*h_S\"", definition_keys, "value"},
        SectionSpec{"coordinates", true, "Generalised coordinates; their velocities are dot(NAME), their accelerations ddot(NAME).",
                    "[coordinates]\nphi = { unit = \"rad\", start = \"pi/6\", doc = \"rod angle, 0 hanging\" }", coordinate_keys, ""},
        SectionSpec{"inputs", true, "What drives the machine from outside.", "[inputs]\nf_e = { unit = \"N\", doc = \"driving force\" }",
                    input_keys, ""},
        SectionSpec{"states", true, "First-order states beside the mechanics: plain ones with their derivative, or those that volumes and pipes determine.",
                    "[states.u_C]\nunit = \"V\"\nderivative = \"i_C/C\"", state_keys, ""},
        SectionSpec{"outputs", true, "What is measured or reported.", "[outputs]\nheight = \"-l*cos(phi)\"", output_keys, "value"},
        SectionSpec{"gravity", false, "Free fall acting on every mass.", "[gravity]\nacceleration = [0, \"-g\", 0]", gravity_keys, ""},
        SectionSpec{"bodies", true, "Point masses, planar rigid bodies, bodies that only turn.",
                    "[bodies.rod]\nmass     = \"m_S\"\nposition = [\"s + l_S/2*sin(phi)\", \"-l_S/2*cos(phi)\", 0]\n"
                    "rotation = \"phi\"\ninertia  = \"m_S*(l_S^2 + b_S^2)/12\"",
                    body_keys, ""},
        SectionSpec{"solids", true,
                    "Shapes of which mass, centre of mass (2.51)-(2.58) and tensor of inertia (2.167)-(2.173) are found by integration: solid_mass[NAME], centre_of_mass[NAME, i], inertia_about_centre[NAME, i, j], inertia_about_origin[NAME, i, j], in the axes that the solid is placed in.",
                    "[solids.rod]\nshape   = \"box\"\nsize    = [\"b_S\", \"l_S\", \"h_S\"]\nat      = [0, \"-l_S/2\", 0]\ndensity = \"rho_S\"", solid_keys, ""},
        SectionSpec{"attitudes", true, "Orientations by unit quaternions. NAME brings the states NAME_0, NAME_1, NAME_2, NAME_3, and the velocities dot(NAME_x), dot(NAME_y), dot(NAME_z): the angular velocity about the axes of what turns. NAME_x, NAME_y and NAME_z have no values themselves.",
                    "[attitudes.e]\nstart_rate = [0.01, 2, 0]", attitude_keys, ""},
        SectionSpec{"springs", true, "Elastic forces with a potential energy.",
                    "[springs.wall]\nelongation = \"s - s_W0\"\nstiffness  = \"c_W\"", spring_keys, ""},
        SectionSpec{"dampers", true, "Resistances, whose power is dissipated.",
                    "[dampers.friction]\nrate        = \"dot(s)\"\ncoefficient = \"d_R\"\nwhen        = \"viscous_friction\"", damper_keys, ""},
        SectionSpec{"forces", true, "Forces at points.", "[forces.drive]\non    = \"cart\"\nforce = [\"f_e\", 0, 0]", force_keys, ""},
        SectionSpec{"torques", true, "Torques on bodies that turn.", "[torques.motor]\non     = \"rotor\"\ntorque = \"tau_m\"", torque_keys, ""},
        SectionSpec{"jets", true, "Mass that leaves a body, or arrives at it. Apart from its velocity relative to the body it takes along the momentum and the spin that it has as a part of the body. The power of ejecting it counts as supplied, what it takes over the border as exchanged.",
                    "[jets.engine]\nfrom      = \"rocket\"\nmass_flow = \"mu\"\nvelocity  = [0, 0, \"-w\"]", jet_keys, ""},
        SectionSpec{"cuts", true, "Forces of rods, ropes, bearings and surfaces without a constraint of their own. cut_force[NAME] is what is left of mass times acceleration of the bodies, when gravity and the [forces] and [torques] on them are taken off: what everything else exerts on them, springs and dampers included.",
                    "[cuts.rod]\nbodies    = [\"bob\"]\ndirection = [\"-sin(phi)\", \"cos(phi)\"]", cut_keys, ""},
        SectionSpec{"loads", true,
                    "Forces on a rigid body. resultant_force[NAME, i] and resultant_moment[NAME, i] are what they come to at a point (2.28)-(2.42). With unknowns the body is in equilibrium (2.39): the balances of force and moment are solved "
                    "for them, and the names of the unknowns stand for what follows.",
                    "[loads.cylinder]\nunknowns = { f_S = \"N\", f_N = \"N\" }\n"
                    "forces.rope   = { force = [\"-f_S*sin(alpha)\", 0, \"f_S*cos(alpha)\"] }\n"
                    "forces.wall   = { force = [\"f_N\", 0, 0] }\n"
                    "forces.weight = { force = [0, 0, \"-m*g\"] }", load_keys, ""},
        SectionSpec{"sticking", true,
                    "Whether friction at rest can hold, by Coulomb's law (2.96), (2.107). sticks[NAME] is 1 or 0, sticking_margin[NAME] the force that is missing to slip, needed_coefficient[NAME] the coefficient that would just do (2.100).",
                    "[sticking.foot]\nnormal      = \"f_N\"\ntangential  = \"f_R\"\ncoefficient = \"mu_H\"", sticking_keys, ""},
        SectionSpec{"kinetic", true, "Kinetic energy for which there is no component.",
                    "[kinetic.gear]\nenergy = \"i_g^2*theta_m*dot(phi)^2/2\"", kinetic_keys, ""},
        SectionSpec{"potentials", true, "Potential energy for which there is no component, or generalised forces that have one.",
                    "[potentials.leaf]\nforces = { z_1 = \"-c*(z_1 - z_2)\", z_2 = \"-c*(z_2 - z_1)\" }", potential_keys, ""},
        SectionSpec{"generalised_forces", true, "Forces on coordinates for which there is no component.",
                    "[generalised_forces.load]\ncoordinate = \"phi_2\"\nforce = \"-tau_l\"", generalised_force_keys, ""},
        section_of<Medium>(),
        section_of<Reservoir>(),
        section_of<Junction>(),
        section_of<Volume>(),
        section_of<Flow>(),
        section_of<HeatNode>(),
        section_of<Link>(),
        section_of<Rod>(),
        SectionSpec{"blocks", true,
                    "Rectangles of one or several materials in which heat flows in two directions (4.4), cut into cells: finite volumes, in which the halves of two cells "
                    "that touch stand in series. heat[NAME.left], right, bottom and top are the heat into it through its sides.",
                    "[blocks.wall]\ntemperature   = \"T\"\ncolumns       = [[\"L\", 8]]\nrows          = [[\"H_1\", 4], [\"H_2\", 4]]\ndepth         = \"B\"\n"
                    "conductivity  = [[\"lambda_1\", \"lambda_2\"]]\ndensity       = \"rho\"\nheat_capacity = \"c_p\"\n"
                    "left          = { node = \"plate\" }\nright         = { coefficient = \"alpha\", ambient = \"T_inf\" }",
                    block_keys, ""},
        SectionSpec{"enclosures", true,
                    "Radiation between grey diffuse surfaces that see each other, all reflections counted (4.42)-(4.51). Surface i gives the heat "
                    "exchange_factor[NAME, i, j]*stefan_boltzmann*(T_i^4 - T_j^4) to surface j; a node with neither capacity nor temperature re-radiates what it takes up.",
                    "[enclosures.furnace]\nsurfaces     = [\"floor\", \"wall\", \"roof\"]\nareas        = [\"A\", \"A\", \"A\"]\n"
                    "emissivities = [\"eps\", 0.8, 1]\nview_factors = [[0, \"?\", \"?\"], [\"?\", 0, \"?\"], [\"?\", \"?\", 0]]",
                    enclosure_keys, ""},
        SectionSpec{"frictions", true,
                    "Dry friction with stiction (2.95)-(2.99). NAME brings the modes NAME_sticks, NAME_slides_forwards, NAME_slides_backwards; constraint_force[NAME] is its force along the rate. "
                    "With more than 128 combinations of modes in the file, and none of these named, a state instead, NAME_direction: 0 where it sticks, 1 and -1 where it slides.",
                    "[frictions.floor]\nrate               = \"dot(x)\"\nnormal_force       = \"m*g\"\ncoefficient        = \"mu\"\nstatic_coefficient = \"mu_0\"", friction_keys, ""},
        SectionSpec{"stops", true, "End stops that are struck, and hold where the machine leans on them. NAME brings the modes NAME_open and NAME_closed; constraint_force[NAME] is the force that opens the gap.",
                    "[stops.floor]\ngap         = \"h\"\nrestitution = \"e\"", stop_keys, ""},
        SectionSpec{"contacts", true, "Springs that act on one side only: ropes, contacts, the flanks of a backlash. NAME brings the modes NAME_slack and NAME_taut, with damping also NAME_released: stretched, but without force.",
                    "[contacts.rope]\nelongation = \"x - l\"\nstiffness  = \"c\"", contact_keys, ""},
        SectionSpec{"saturations", true, "Values within limits. NAME is what is left of the value, and brings the modes NAME_within, NAME_below, NAME_above; with more than 64 combinations of modes in the file, and none of these named, edges instead.",
                    "[saturations.drive]\nvalue = \"k*(x_d - x)\"\nlow   = \"-f_max\"\nhigh  = \"f_max\"", saturation_keys, ""},
        SectionSpec{"profiles", true, "Values that go through phases of time. NAME is the value, and each phase is a mode NAME_PHASE.",
                    "[profiles.drive]\nphases = [{ name = \"runs\", value = \"a\", until = \"t_1\" }, { name = \"stands\", value = 0 }]", profile_keys, ""},
        SectionSpec{"modes", true, "Ways in which a part of the machine can be, one at any time. The first that fits the start values is the start.",
                    "[modes]\npump = [\"pump_on\", \"pump_off\"]", mode_keys, "modes"},
        SectionSpec{"constraints", true, "Rates or positions that are held at zero, in some mode. constraint_force[NAME] is what holds them: the force along the rate, on the machine.",
                    "[constraints.clutch]\nrate = \"dot(phi_1) - dot(phi_2)\"\nwhen = \"engaged\"", constraint_keys, ""},
        SectionSpec{"events", true, "What happens where a guard goes through zero, in the modes that `when` names.",
                    "[events.full]\nguard = \"h_max - h\"\nwhen  = \"pump_on\"\nnext  = \"pump_off\"", event_keys, ""},
        SectionSpec{"effects", true, "Effects that a scene may call for or leave out.",
                    "[effects]\nviscous_friction = { doc = \"friction of the cart, proportional to its speed\" }", effect_keys, ""},
        SectionSpec{"scenes", true,
                    "Lists of effects. What a scene does not name is gone before anything is derived. `default` names the scene that is "
                    "meant when none is chosen. Without [scenes] there is one, `full`, with all effects.",
                    "[scenes]\nlab     = [\"viscous_friction\"]\nideal   = []\ndefault = \"lab\"", scene_keys, "effects"},
        SectionSpec{"printed", true, "Equations as a text prints them, to be checked against the derivation.",
                    "[printed.\"2.160\"]\nequation = \"m*l^2*ddot(phi) = -m*g*l*sin(phi)\"", printed_keys, ""},
        SectionSpec{"runs", true, "Simulations: `simulate` takes the run `reference`, or the one named with --run.",
                    "[runs.reference]\nuntil = 10\nplots = [[\"s\"], [\"phi\"]]", run_keys, ""},
    };
    return rows;
}

std::string key_line(const KeySpec& key, const std::string& indent) {
    return fmt::format("{}{:<{}} {:<23} {} {}\n", indent, key.name, 19 - indent.size(), describe(key.type), key.required ? "required." : "optional.", key.doc);
}

/// A key with those of the table that stands for its value.
std::string key_reference(const KeySpec& key) {
    std::string text = key_line(key, "  ");
    if (key.parts == nullptr) return text;
    for (const KeySpec& part : key.parts()) text += key_line(part, "      ");
    return text;
}

}  // namespace

std::string section_reference(const SectionSpec& section) {
    std::string example;
    for (const char* c = section.example; *c != '\0'; ++c) example += *c == '\n' ? std::string("\n    ") : std::string(1, *c);
    std::string text = fmt::format("[{}{}]  {}\n\n    {}\n\n", section.name, section.is_collection ? ".NAME" : "", section.doc, example);
    for (std::size_t i = 0; i < section.keys.size(); ++i) {
        const bool is_like_last = i > 0 && section.keys[i].parts == section.keys[i - 1].parts;  // "likewise at the last end"
        text += is_like_last ? key_line(section.keys[i], "  ") : key_reference(section.keys[i]);
    }
    if (*section.short_form != '\0')
        text += fmt::format("  A bare value stands for `{}`.\n", section.short_form);
    return text;
}

std::span<const SectionSpec> sections() { return table(); }
const SectionSpec& phase_section() { return phase_spec; }
const SectionSpec& load_part_section() { return load_part_spec; }
const SectionSpec& unknown_section() { return unknown_spec; }

const SectionSpec* find_section(std::string_view name) {
    const auto found = std::find_if(table().begin(), table().end(), [&](const SectionSpec& s) { return name == s.name; });
    return found == table().end() ? nullptr : &*found;
}

const KeySpec* find_key(const SectionSpec& section, std::string_view name) {
    const auto found = std::find_if(section.keys.begin(), section.keys.end(), [&](const KeySpec& k) { return name == k.name; });
    return found == section.keys.end() ? nullptr : &*found;
}

const char* describe(ValueType type) {
    switch (type) {
        case T::text: return "text";
        case T::whole_number: return "whole number";
        case T::number: return "number";
        case T::constant: return "number or expression";
        case T::constants: return "number(s) or expression";
        case T::unit: return "unit";
        case T::range: return "[low, high]";
        case T::expression: return "expression";
        case T::vector: return "[x, y] or [x, y, z]";
        case T::law: return "law \"e -> ...\"";
        case T::property: return "expression or \"(p, T) -> ...\"";
        case T::dependent: return "expression or \"T -> ...\"";
        case T::field: return "expression or \"(x, y) -> ...\"";
        case T::equation: return "equation";
        case T::equations: return "list of equations";
        case T::family: return "\"k = 1..N\"";
        case T::condition: return "condition";
        case T::effects: return "list of names";
        case T::modes: return "mode or list of modes";
        case T::body: return "body";
        case T::part: return "name";
        case T::parts: return "list of names";
        case T::expressions: return "list of expressions";
        case T::matrix: return "list of rows";
        case T::points: return "list of [x, y]";
        case T::turns: return "list of [\"x\", \"y\" or \"z\", angle]";
        case T::tensor: return "expression, [Jx, Jy, Jz] or three rows";
        case T::torque: return "expression or [x, y, z]";
        case T::pieces: return "list of [length, cells]";
        case T::table: return "expression or list of lists";
        case T::coordinate: return "coordinate";
        case T::expressions_by_name: return "{ NAME = expression }";
        case T::choice: return "one of";
        case T::plots: return "list of plots";
        case T::tables: return "list of { KEY = ... }";
        case T::named_tables: return "{ NAME = { KEY = ... } }";
        case T::one_or_two: return "expression or list of two";
        case T::boolean: break;
    }
    return "true or false";
}

std::string language_reference(std::string_view word) {
    std::string text;
    if (word.empty()) {
        for (const SectionSpec& section : table()) text += section_reference(section) + "\n";
        return text;
    }
    if (const SectionSpec* section = find_section(word)) return section_reference(*section);
    const std::size_t point = word.find('.');
    const std::string_view key_name = point == std::string_view::npos ? word : word.substr(point + 1);
    for (const SectionSpec& section : table()) {
        if (point != std::string_view::npos && word.substr(0, point) != section.name) continue;
        const std::string place = fmt::format("[{}{}]", section.name, section.is_collection ? ".NAME" : "");
        if (const KeySpec* key = find_key(section, key_name)) text += place + "\n" + key_reference(*key);
        for (const KeySpec& key : section.keys)
            for (const KeySpec& part : key.parts == nullptr ? std::span<const KeySpec>() : key.parts())
                if (part.name == key_name) text += fmt::format("{} in {}\n{}", place, key.name, key_line(part, "  "));
    }
    return text;
}

std::vector<std::string> language_words() {
    std::vector<std::string> words;
    for (const SectionSpec& section : table()) {
        words.emplace_back(section.name);
        for (const KeySpec& key : section.keys) {
            words.emplace_back(key.name);
            for (const KeySpec& part : key.parts == nullptr ? std::span<const KeySpec>() : key.parts()) words.emplace_back(part.name);
        }
    }
    return words;
}

}  // namespace dalembert
