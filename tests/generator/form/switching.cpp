// SPDX-License-Identifier: GPL-3.0-or-later
// Modes, constraints and events as they are derived: against equations by hand, and with wrong signs that proofs must see.
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "graph/verify.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const Machine& mode(const Machine& machine, const std::string& name) {
    const auto is_it = [&](const Machine& m) { return m.system->scene.modes[*m.system->scene.mode].name == name; };
    if (is_it(machine)) return machine;
    const auto found = std::find_if(machine.other_modes.begin(), machine.other_modes.end(), is_it);
    REQUIRE(found != machine.other_modes.end());
    return *found;
}

const EventEquation& event(const System& system, const std::string& name) {
    const auto found = std::find_if(system.events.begin(), system.events.end(), [&](const EventEquation& e) { return e.name == name; });
    REQUIRE(found != system.events.end());
    return *found;
}

/// What an event sets at a place of x.
std::optional<ex> after(const Reset& reset, std::size_t place) {
    for (const auto& [at, value] : reset.values)
        if (at == place) return value;
    return std::nullopt;
}

const std::string two_discs =
    "[parameters]\nJ = { value = 2, unit = \"kg*m^2\", range = [0.1, 10] }\nK = { value = 1, unit = \"kg*m^2\", range = [0.1, 10] }\nc = { value = 3, unit = \"N*m\", range = [0, 10] }\n"
    "[coordinates]\na = { unit = \"rad\" }\nb = { unit = \"rad\" }\n[inputs]\nu = { unit = \"N*m\" }\n"
    "[bodies.first]\ninertia = \"J\"\nrotation = \"a\"\n[bodies.second]\ninertia = \"K\"\nrotation = \"b\"\n[torques.motor]\non = \"first\"\ntorque = \"u\"\n";

}  // namespace

TEST_CASE("a clutch that sticks: one acceleration for both, and the torque that it bears") {
    Machine machine = machine_from(two_discs + "[frictions.clutch]\nrate = \"dot(a) - dot(b)\"\nnormal_force = \"c\"\ncoefficient = \"1\"\n");
    const System& sticks = *mode(machine, "clutch_sticks").system;
    const ex J = symbol_named(sticks, SymbolKind::parameter, "J"), K = symbol_named(sticks, SymbolKind::parameter, "K"), u = symbol_named(sticks, SymbolKind::input, "u");
    REQUIRE(sticks.motion.free == std::vector<std::size_t>{0});
    CHECK((sticks.motion.matrix(0, 0) - (J + K)).expand().is_zero());
    CHECK((sticks.motion.force[0] - u).expand().is_zero());
    REQUIRE(sticks.motion.accelerations.size() == 1);
    CHECK(sticks.motion.accelerations[0].second.is_equal(symbol_named(sticks, SymbolKind::acceleration, "a")));
    // The clutch pulls the second disc along: K*ddot(b) = -force of the rate dot(a) - dot(b).
    const ex force = sticks.constraints[0].force;
    CHECK((force + K * symbol_named(sticks, SymbolKind::acceleration, "a")).expand().is_zero());
    // It breaks where that is all it has; the rate of the guard asks for the rate of the acceleration.
    CHECK((event(sticks, "clutch_breaks_forwards").guard - (symbol_named(sticks, SymbolKind::parameter, "c") + force)).expand().is_zero());
    CHECK(event(sticks, "clutch_breaks_forwards").rate.has(symbol_named(sticks, SymbolKind::jerk, "a")));
    CHECK(!event(sticks, "clutch_stops_forwards").is_watched);
    const System& slides = *mode(machine, "clutch_slides_forwards").system;
    CHECK(slides.motion.free.size() == 2);
    CHECK((slides.dissipated_power - symbol_named(slides, SymbolKind::parameter, "c") * (symbol_named(slides, SymbolKind::velocity, "a") - symbol_named(slides, SymbolKind::velocity, "b"))).expand().is_zero());
    for (const Machine* each : {&machine, &machine.other_modes[0], &machine.other_modes[1]}) CHECK(all_proven(*each->system));
    generate(machine);
    CHECK(proofs_of(machine).all_proven());
}

TEST_CASE("wrong forces of constraints are seen by the power balance, wrong resets by the proof of the code") {
    // A belt that moves with 2 m/s drives the block that sticks to it.
    Machine machine = machine_from(block + "[springs.s]\nelongation = \"x\"\nstiffness = \"c\"\n[definitions]\nV = { value = \"4*l*d/m\", unit = \"m/s\" }\n"
                                           "[constraints.belt]\nrate = \"dot(x) - V\"\nwhen = \"held\"\n[modes]\nhand = [\"held\", \"let_go\"]\n"
                                           "[events.opens]\nguard = \"l - x\"\nwhen = \"held\"\nnext = \"let_go\"\nreset = { \"dot(x)\" = \"-dot(x)/2\" }\n"
                                           "[events.ends]\nguard = \"x + l\"\nwhen = \"let_go\"\nends = true\n");
    System& held = *machine.system;
    REQUIRE(held.motion.free.empty());
    CHECK(!held.prescribed_power.is_zero());
    CHECK(all_proven(held));
    flipped_is_wrong(held, held.prescribed_power, "power of the belt");
    generate(machine);
    CHECK(proofs_of(machine).all_proven());
    const auto is_wrong = [&] {
        const auto entries = verify(*machine.code);
        return std::any_of(entries.begin(), entries.end(), [](const AuditEntry& e) { return e.result.verdict == Verdict::wrong; });
    };
    EventEquation& opens = const_cast<EventEquation&>(event(held, "opens"));
    for (ex* value : {&opens.guard, &opens.rate, &opens.reset.values[0].second}) {
        const ex right = *value;
        *value = -right;
        CHECK(is_wrong());
        *value = right;
    }
    CHECK(!is_wrong());
}

TEST_CASE("an impact on a cart throws its pendulum: the momentum along the free coordinate is kept") {
    Machine machine = machine_from(
        "[parameters]\nM = { value = 3, unit = \"kg\", range = [0.1, 10] }\nm = { value = 1, unit = \"kg\", range = [0.1, 10] }\nl = { value = 1, unit = \"m\", range = [0.1, 10] }\n"
        "e = { value = 0.5, unit = \"1\", range = [0, 1] }\n[coordinates]\ns = { unit = \"m\", start = 0.5 }\nphi = { unit = \"rad\" }\n"
        "[bodies.cart]\nmass = \"M\"\nposition = [\"s\", 0, 0]\n[bodies.bob]\non = \"cart\"\nmass = \"m\"\nposition = [\"l*sin(phi)\", \"-l*cos(phi)\", 0]\n"
        "[stops.wall]\ngap = \"l - s\"\nrestitution = \"e\"\n");
    generate(machine);
    CHECK(proofs_of(machine).all_proven());
    const System& open = *machine.system;
    const EventEquation& hits = event(open, "wall_hits");
    CHECK((*after(hits.reset, 0) - symbol_named(open, SymbolKind::parameter, "l")).is_zero());  // on the wall exactly
    REQUIRE(hits.reset.impact);
    CHECK(hits.reset.impact->direction == std::vector<ex>{-1, 0});
    REQUIRE(hits.rest.impact);
    CHECK(hits.rest.impact->pivot == std::optional<std::size_t>(0));
    const System& closed = *mode(machine, "wall_closed").system;
    CHECK(closed.motion.free == std::vector<std::size_t>{1});
    CHECK(closed.motion.positions.size() == 1);
}

TEST_CASE("a ball alone is struck without a solve, and modes whose constraints contradict each other are not there") {
    Machine machine = machine_from(block + "[stops.left]\ngap = \"x + l\"\n[stops.right]\ngap = \"l - x\"\nrestitution = \"1/2\"\n");
    const Scene& scene = machine.system->scene;
    std::vector<std::string> names;
    for (const SceneMode& m : scene.modes) names.push_back(m.name);
    CHECK(names == std::vector<std::string>{"left_open_and_right_open", "left_open_and_right_closed", "left_closed_and_right_open"});
    const EventEquation& right = event(*machine.system, "right_hits");
    CHECK(!right.reset.impact);
    CHECK((*after(right.reset, 1) + symbol_named(*machine.system, SymbolKind::velocity, "x") / 2).is_zero());
    CHECK(after(event(*machine.system, "left_hits").reset, 1)->is_zero());
    CHECK(scene.modes_after(right.item->next, 0) == std::vector<std::size_t>{1, 0});
    CHECK(scene.modes_after(right.item->next, 2) == std::vector<std::size_t>{1, 2});  // closed on both sides is no mode
}

TEST_CASE("what repeats each other in a mode is left when nothing can hold any more, and friction does not slide where its rate is held") {
    const std::string parameters = "[inputs]\nF = { unit = \"N\" }\n[definitions]\nC = { value = \"c*l/5\", unit = \"N\" }\nH = { value = \"c*l/3\", unit = \"N\" }\n"
                                   "[forces.f]\nforce = [\"F\", 0, 0]\non = \"block\"\n";
    Machine machine = machine_from(block + parameters + "[frictions.floor]\nrate = \"dot(x)\"\nnormal_force = \"C\"\ncoefficient = 1\nstatic_coefficient = \"H/C\"\n[stops.wall]\ngap = \"x\"\n");
    std::vector<std::string> names;
    for (const SceneMode& m : machine.system->scene.modes) names.push_back(m.name);
    CHECK(names == std::vector<std::string>{"floor_sticks_and_wall_open", "floor_sticks_and_wall_closed", "floor_slides_forwards_and_wall_open", "floor_slides_backwards_and_wall_open"});
    const System& held = *mode(machine, "floor_sticks_and_wall_closed").system;
    const ex F = symbol_named(held, SymbolKind::input, "F"), H = held.symbols.without_definitions(symbol_named(held, SymbolKind::definition, "H"));
    const EventEquation& breaks = event(held, "floor_breaks_forwards");
    // The stop bears what presses on it, friction all it can against what pulls off.
    CHECK((held.symbols.without_definitions(breaks.guard) - (H - F)).expand().is_zero());
    CHECK(held.scene.modes_after(breaks.next(), 1).front() == 2);
    CHECK(!event(held, "floor_breaks_backwards").is_watched);
    CHECK(!event(held, "wall_opens").is_watched);
    const auto force = [&](std::size_t constraint, int pull) { return held.constraints[constraint].force.subs(F == pull, GiNaC::subs_options::no_pattern).evalf(); };
    CHECK((force(0, 3) + 3).is_zero());
    CHECK(force(1, 3).is_zero());
    CHECK(force(0, -3).is_zero());
    CHECK((force(1, -3) - 3).is_zero());
    // Where the sum of the velocities before the impact is turned round, friction is, too; what rests sticks.
    const System& back = *mode(machine, "floor_slides_backwards_and_wall_open").system;
    CHECK(back.scene.modes_after(event(back, "wall_hits").next(), 3) == std::vector<std::size_t>{1, 3});
    for (Machine* each : {&machine, &machine.other_modes[0], &machine.other_modes[1], &machine.other_modes[2]}) CHECK(all_proven(*each->system));
    generate(machine);
    CHECK(proofs_of(machine).all_proven());

    const auto refused = [](const std::string& text) {
        try {
            machine_from(text);
        } catch (const Failure& failure) {
            return failure.diagnostics().front().message;
        }
        return std::string();
    };
    CHECK(refused(block + parameters + "[constraints.rail]\nrate = \"dot(x)\"\n[frictions.floor]\nrate = \"2*dot(x)\"\nnormal_force = \"C\"\ncoefficient = 1\n") ==
          "friction 'floor' does not slide in mode 'floor_slides_forwards': its rate is held at zero");
}

TEST_CASE("a mode's name is 1 there and 0 elsewhere, and a saturation follows its value within limits") {
    Machine machine = machine_from(block + "[inputs]\nu = { unit = \"N\" }\n[saturations.drive]\nvalue = \"2*u\"\nlow = \"-V\"\nhigh = \"3*V\"\n"
                                           "[definitions]\nV = { value = \"c*l/5\", unit = \"N\" }\n[forces.f]\nforce = [\"drive\", 0, 0]\non = \"block\"\n");
    const System& within = *mode(machine, "drive_within").system;
    CHECK((within.supplied[0] - 2 * symbol_named(within, SymbolKind::input, "u")).is_zero());
    const System& above = *mode(machine, "drive_above").system;
    CHECK((above.supplied[0] - 3 * symbol_named(above, SymbolKind::definition, "V")).is_zero());
    CHECK(event(within, "drive_leaves_above").is_watched);
    CHECK(!event(within, "drive_returns_from_above").is_watched);
}
