// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/json_fields.hpp"

#include <array>

namespace dalembert {

namespace {

constexpr auto of_common = std::to_array<JsonField>({
    {"schema", "dalembert/VERB"},
    {"version", "of the schema; fields may join without a new version, none is renamed or removed"},
    {"model", "name of the model; in a survey each system has its own"},
});

constexpr auto of_derive = std::to_array<JsonField>({
    {"scene", "the scene"},
    {"sizes.<NAME>", "sizes of families"},
    {"definitions.<NAME>", "expressions of the definitions"},
    {"coordinates[]", "names, in the order of rows and columns"},
    {"equations[].coordinate", "whose equation of motion it is"},
    {"equations[].left", "M*ddot(q) + bias"},
    {"equations[].right", "generalised force of forces, torques and inputs"},
    {"constraints[].name", "a constraint that holds; of machines that switch, in the first mode"},
    {"constraints[].position", "which is zero, empty where the rate alone is held"},
    {"constraints[].rate", "which is zero"},
    {"constraints[].force", "along the rate, on the machine; an unknown of its own where it is called constraint_force[NAME]"},
    {"mass_matrix[][]", "M, row by row"},
    {"coriolis[]", "part of the bias: Coriolis and centrifugal forces"},
    {"gravity[]", "generalised forces of gravity, in the bias with a minus sign, as the next two"},
    {"elastic[]", "generalised forces of springs and potentials"},
    {"dissipative[]", "generalised forces of dampers"},
    {"fluid[]", "part of the bias: pressures and the shafts of pumps"},
    {"bias[]", "coriolis - gravity - elastic - dissipative - fluid"},
    {"generalised_force[]", "Q in M*ddot(q) + bias = Q"},
    {"state_rates.<NAME>", "rates of the states"},
    {"rods[].name", "a rod whose cells are computed in loops; what state_rates says of its cells is added"},
    {"rods[].cells", "how many there are"},
    {"rods[].heat_to_next", "from a cell to the next"},
    {"rods[].source", "heat into a cell from outside"},
    {"rods[].capacity", "of a cell"},
    {"rods[].energy", "of a cell"},
    {"kinetic_energy", "T"},
    {"potential_energy", "V"},
    {"supplied_power", "of forces, torques and inputs"},
    {"dissipated_power", "of dampers"},
    {"prescribed_power", "of what moves the machine in a prescribed way"},
    {"internal_energy", "what fluids store"},
    {"exchanged_power", "enthalpy flows, heat and shafts over the border"},
    {"guards[].name", "what the guard belongs to"},
    {"guards[].doc", "what happens where it is zero"},
    {"guards[].ends", "whether a run ends there; else the right-hand side has an edge"},
    {"guards[].value", "the guard"},
    {"outputs.<NAME>", "expressions of the outputs"},
    {"modes[].mode", "of a machine that switches: name of the mode; what stands above is of the first"},
    {"modes[].equations[].left", "equations of motion as constraints leave them, and accelerations that these determine"},
    {"modes[].equations[].right", ""},
    {"modes[].state_rates.<NAME>", "rates of the states"},
    {"modes[].constraints[].name", "a constraint that holds"},
    {"modes[].constraints[].position", "which is zero, empty where the rate alone is held"},
    {"modes[].constraints[].rate", "which is zero"},
    {"modes[].constraints[].force", "along the rate, on the machine"},
    {"modes[].events[].name", "an event that is watched"},
    {"modes[].events[].guard", "it happens where this falls through zero"},
    {"modes[].events[].ends", "whether a run ends there"},
    {"modes[].events[].next[]", "modes afterwards, in order of preference"},
});

constexpr auto of_generate = std::to_array<JsonField>({
    {"scene", "the scene; with --every-scene the result is an array of such objects"},
    {"sizes.<NAME>", "sizes of families"},
    {"header", "path of the header"},
    {"namespace", "in which the header defines System and Parameters"},
    {"bytes", "size of the header"},
    {"all_proven", "every identity was proven, none only compared by numbers"},
    {"operations.<FUNCTION>.additions", "operations of each function of the header: additions and subtractions"},
    {"operations.<FUNCTION>.multiplications", ""},
    {"operations.<FUNCTION>.divisions", ""},
    {"operations.<FUNCTION>.trigonometric", "calls of sin and cos"},
    {"operations.<FUNCTION>.other", "calls of other functions"},
    {"operations.<FUNCTION>.total", "sum of the above"},
    {"cells[].rod", "a rod whose cells are computed in loops; their operations are not among those above"},
    {"cells[].count", "how many there are"},
    {"cells[].operations", "of the right-hand side, for each"},
    {"seconds.<STAGE>", "time of each stage"},
});

constexpr auto of_check = std::to_array<JsonField>({
    {"scenes[].scene", "a scene that was derived"},
    {"scenes[].proofs[].name", "what was proven of the derivation and of the emitted code"},
    {"scenes[].proofs[].verdict", "proven, proven under assumption, numerically equal or wrong"},
    {"printed[].id", "number of the printed equation"},
    {"printed[].source", "where it is printed"},
    {"printed[].verdict", "as above, and dimensionally wrong, not checkable"},
    {"printed[].expected", "verdict that the model expects, for known misprints; else empty"},
    {"printed[].as_expected", "the verdict is the expected one; without one, it is not wrong"},
    {"printed[].scenes[]", "in which it was checked"},
    {"printed[].equation", "the equation that decided the verdict"},
    {"printed[].reason", "why it could not be checked"},
    {"printed[].assumptions[]", "under which it is proven"},
    {"printed[].difference", "printed minus derived"},
    {"printed[].suggestion", "a form that would be right; empty so far"},
    {"printed[].counterexample", "null, or numbers for which both sides differ"},
    {"printed[].counterexample.values.<NAME>", "of parameters, states and inputs"},
    {"printed[].counterexample.left", "value of the left side"},
    {"printed[].counterexample.right", "value of the right side"},
    {"passed", "everything is as expected; exit code 0"},
});

constexpr auto of_evaluate = std::to_array<JsonField>({
    {"scene", "the scene"},
    {"sizes.<NAME>", "sizes of families"},
    {"mode", "of a machine that switches"},
    {"digits", "significant digits; above 17 all numbers are texts"},
    {"parameter.<NAME>", "in SI, as everything below"},
    {"state.<NAME>", ""},
    {"input.<NAME>", ""},
    {"state_derivative.<NAME>", "dot(q), ddot(q) and the rates of plain states"},
    {"output.<NAME>", ""},
    {"unknown.<NAME>", "of loads; where there are any, as the next ones"},
    {"sticking.<NAME>.sticks", "whether friction at rest can hold"},
    {"sticking.<NAME>.margin", "N; the force that is missing to slip, negative where it slips"},
    {"sticking.<NAME>.needed_coefficient", "the coefficient that would just do"},
    {"kinetic_energy", "J"},
    {"potential_energy", "J"},
    {"supplied_power", "W"},
    {"dissipated_power", "W"},
    {"prescribed_power", "W"},
    {"internal_energy", "J; where there are fluids"},
    {"exchanged_power", "W; likewise"},
});

constexpr auto of_simulate = std::to_array<JsonField>({
    {"scene", "the scene"},
    {"sizes.<NAME>", "sizes of families"},
    {"status", "success, or why the run stopped; exit code 4 then"},
    {"t", "time that was reached, s"},
    {"state", "the state that stopped the run, else empty"},
    {"constraint", "the constraint that could not be held any more, else empty"},
    {"guard", "what the run was about to pass when it ended, else empty"},
    {"events", "guards that changed their sign and were passed"},
    {"steps", "steps of the integrator"},
    {"rejected", "steps that were tried and thrown away"},
    {"rhs_calls", "evaluations of the right-hand side"},
    {"energy_error", "max |E - E0 - work| / max(T + |V|)"},
    {"euler_step", "s, largest step for which the explicit Euler method is stable at the start; of models with heat"},
    {"lost", "J, energy lost at events, as by impacts; of what switches, as the next one"},
    {"mode", "in which the run ended"},
    {"files[]", "what was written"},
});

constexpr auto of_equilibrium = std::to_array<JsonField>({
    {"scene", "the scene"},
    {"sizes.<NAME>", "sizes of families"},
    {"mode", "of a machine that switches"},
    {"status", "success, or why the search stopped"},
    {"kind", "isolated, family or none"},
    {"dimension", "of the family"},
    {"residual", "what is left of dx/dt, scaled"},
    {"iterations", "steps of Newton's method"},
    {"state.<NAME>", "the equilibrium"},
    {"input.<NAME>", "the inputs that hold it"},
    {"A[][]", "df/dx there, row by row"},
    {"B[][]", "df/du"},
    {"C[][]", "dy/dx"},
    {"D[][]", "dy/du"},
    {"eigenvalues[].real", "of A, 1/s"},
    {"eigenvalues[].imaginary", ""},
});

constexpr auto of_survey = std::to_array<JsonField>({
    {"systems[].model", "name of the model"},
    {"systems[].scene", "the scene that was run"},
    {"systems[].degrees_of_freedom", ""},
    {"systems[].operations", "of the right-hand side"},
    {"systems[].generation_seconds", "all stages"},
    {"systems[].all_proven", "every identity was proven"},
    {"systems[].equations", "printed equations that were checked"},
    {"systems[].as_expected", "how many of them are as the model expects"},
    {"systems[].misprints", "how many of them are wrong"},
    {"systems[].status", "of the run, as in simulate"},
    {"systems[].steps", "steps of the integrator"},
    {"systems[].energy_error", "as in simulate"},
});

constexpr auto of_effects = std::to_array<JsonField>({
    {"against", "the scene that the others are compared with"},
    {"scenes[].scene", "name of the scene; NAME-EFFECT and NAME+EFFECT are scenes with one effect left out or added"},
    {"scenes[].named", "whether it is a scene of the model"},
    {"scenes[].same_as", "a scene with the same effects; what is known stands there"},
    {"scenes[].refused", "why there is no such scene or run; nothing else is known of it then"},
    {"scenes[].states", "length of x"},
    {"scenes[].parameters", "how many"},
    {"scenes[].operations", "of the right-hand side"},
    {"scenes[].nanoseconds.median", "of a call of the right-hand side at the start of the run"},
    {"scenes[].nanoseconds.lowest", "of all rounds"},
    {"scenes[].nanoseconds.highest", "of all rounds"},
    {"scenes[].bytes", "of the code of the right-hand side"},
    {"scenes[].status", "of the run, as in simulate"},
    {"scenes[].t", "time that was reached, s"},
    {"scenes[].deviations[].output", "an output that both scenes have, with its unit; a state where the model has no outputs"},
    {"scenes[].deviations[].largest", "its largest difference over the run"},
    {"scenes[].deviations[].relative", "to its largest magnitude in the scene compared with; missing where that is zero"},
    {"files[]", "what was written"},
});

constexpr auto of_scenes = std::to_array<JsonField>({
    {"default", "the default scene; empty without one"},
    {"scenes[].scene", "name of the scene"},
    {"scenes[].doc", "description"},
    {"scenes[].effects_in[]", "effects that it has"},
    {"scenes[].effects_out[]", "effects that it leaves out"},
    {"scenes[].coordinates", "how many"},
    {"scenes[].states", "length of x: coordinates, velocities and plain states"},
    {"scenes[].inputs", "how many"},
    {"scenes[].outputs", "how many"},
    {"scenes[].parameters", "how many"},
    {"scenes[].header", "file name of its header"},
});

constexpr auto schemas = std::to_array<JsonSchema>({
    {"derive", of_derive},           {"generate", of_generate}, {"check", of_check},   {"evaluate", of_evaluate}, {"simulate", of_simulate},
    {"equilibrium", of_equilibrium}, {"survey", of_survey},     {"effects", of_effects},   {"scenes", of_scenes},
});

}  // namespace

std::span<const JsonField> common_json_fields() { return of_common; }
std::span<const JsonSchema> json_schemas() { return schemas; }

}  // namespace dalembert
