// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks: their cells against a network that is written by hand, and what their sides and the ends of rods take up.
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "elements/verdict.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

/// What [blocks.block] of systems/heat/block.toml stands for at N = 1, node by node and link by link.
const std::string by_hand = R"toml(
[sizes]
M = 2
[parameters]
L_a      = { value = 0.04, unit = "m",       range = [0.001, 1] }
L_b      = { value = 0.08, unit = "m",       range = [0.001, 1] }
L_d      = { value = 0.04, unit = "m",       range = [0.001, 1] }
H_b      = { value = 0.05, unit = "m",       range = [0.001, 1] }
H_c      = { value = 0.05, unit = "m",       range = [0.001, 1] }
B        = { value = 0.1,  unit = "m",       range = [0.001, 1] }
lambda_a = { value = 15,   unit = "W/(m*K)", range = [0.1, 500] }
lambda_b = { value = 50,   unit = "W/(m*K)", range = [0.1, 500] }
lambda_c = { value = 2,    unit = "W/(m*K)", range = [0.1, 500] }
lambda_d = { value = 15,   unit = "W/(m*K)", range = [0.1, 500] }
rho      = { value = 7200, unit = "kg/m^3",  range = [100, 20000] }
c_p      = { value = 500,  unit = "J/(kg*K)", range = [100, 5000] }
C        = { value = 2000, unit = "J/K",     range = [1, 1e6] }
T_0      = { value = 293,  unit = "K",       range = [200, 400] }
[definitions]
s = "rho*c_p"
H = "H_b + H_c"
[inputs]
P = { unit = "W" }
[states]
T_P = { unit = "K", start = "T_0" }
A_b = { for = "i = 1..M", unit = "K", start = "T_0" }
T_b = { for = "i = 1..M", unit = "K", start = "T_0" }
D_b = { for = "i = 1..M", unit = "K", start = "T_0" }
A_c = { for = "i = 1..M", unit = "K", start = "T_0" }
T_c = { for = "i = 1..M", unit = "K", start = "T_0" }
D_c = { for = "i = 1..M", unit = "K", start = "T_0" }
[nodes]
plate = { temperature = "T_P", capacity = "C", heat = "P" }
right = { temperature = "T_0" }
ab    = { for = "i = 1..M", temperature = "A_b[i]", capacity = "s*L_a/M*H_b*B" }
ac    = { for = "i = 1..M", temperature = "A_c[i]", capacity = "s*L_a/M*H_c*B" }
b     = { for = "i = 1..M", temperature = "T_b[i]", capacity = "s*L_b/M*H_b*B" }
c     = { for = "i = 1..M", temperature = "T_c[i]", capacity = "s*L_b/M*H_c*B" }
db    = { for = "i = 1..M", temperature = "D_b[i]", capacity = "s*L_d/M*H_b*B" }
dc    = { for = "i = 1..M", temperature = "D_c[i]", capacity = "s*L_d/M*H_c*B" }
[links]
into_ab = { from = "plate", to = "ab[1]", law = "conduction", conductivity = "lambda_a", area = "H_b*B", length = "L_a/M/2" }
into_ac = { from = "plate", to = "ac[1]", law = "conduction", conductivity = "lambda_a", area = "H_c*B", length = "L_a/M/2" }
along_ab = { for = "i = 1..M-1", from = "ab[i]", to = "ab[i+1]", law = "conduction", conductivity = "lambda_a", area = "H_b*B", length = "L_a/M" }
along_ac = { for = "i = 1..M-1", from = "ac[i]", to = "ac[i+1]", law = "conduction", conductivity = "lambda_a", area = "H_c*B", length = "L_a/M" }
a_to_b = { from = "ab[M]", to = "b[1]", resistance = "L_a/M/2/(lambda_a*H_b*B) + L_b/M/2/(lambda_b*H_b*B)" }
a_to_c = { from = "ac[M]", to = "c[1]", resistance = "L_a/M/2/(lambda_a*H_c*B) + L_b/M/2/(lambda_c*H_c*B)" }
along_b = { for = "i = 1..M-1", from = "b[i]", to = "b[i+1]", law = "conduction", conductivity = "lambda_b", area = "H_b*B", length = "L_b/M" }
along_c = { for = "i = 1..M-1", from = "c[i]", to = "c[i+1]", law = "conduction", conductivity = "lambda_c", area = "H_c*B", length = "L_b/M" }
b_to_d = { from = "b[M]", to = "db[1]", resistance = "L_b/M/2/(lambda_b*H_b*B) + L_d/M/2/(lambda_d*H_b*B)" }
c_to_d = { from = "c[M]", to = "dc[1]", resistance = "L_b/M/2/(lambda_c*H_c*B) + L_d/M/2/(lambda_d*H_c*B)" }
along_db = { for = "i = 1..M-1", from = "db[i]", to = "db[i+1]", law = "conduction", conductivity = "lambda_d", area = "H_b*B", length = "L_d/M" }
along_dc = { for = "i = 1..M-1", from = "dc[i]", to = "dc[i+1]", law = "conduction", conductivity = "lambda_d", area = "H_c*B", length = "L_d/M" }
out_db = { from = "db[M]", to = "right", law = "conduction", conductivity = "lambda_d", area = "H_b*B", length = "L_d/M/2" }
out_dc = { from = "dc[M]", to = "right", law = "conduction", conductivity = "lambda_d", area = "H_c*B", length = "L_d/M/2" }
across_a = { for = "i = 1..M", from = "ab[i]", to = "ac[i]", law = "conduction", conductivity = "lambda_a", area = "L_a/M*B", length = "H/2" }
across_b = { for = "i = 1..M", from = "b[i]", to = "c[i]", resistance = "(H_b/2/lambda_b + H_c/2/lambda_c)/(L_b/M*B)" }
across_d = { for = "i = 1..M", from = "db[i]", to = "dc[i]", law = "conduction", conductivity = "lambda_d", area = "L_d/M*B", length = "H/2" }
[outputs]
Q_left  = { value = "heat[into_ab] + heat[into_ac]", unit = "W" }
Q_right = { value = "heat[out_db] + heat[out_dc]", unit = "W" }
)toml";

const std::string plate =
    "[parameters]\n"
    "L = { value = 0.3, unit = \"m\", range = [0.01, 1] }\n"
    "k = { value = 20, unit = \"W/(m*K)\", range = [0.1, 500] }\n"
    "rho = { value = 7000, unit = \"kg/m^3\", range = [100, 20000] }\n"
    "c_p = { value = 500, unit = \"J/(kg*K)\", range = [100, 5000] }\n"
    "alpha = { value = 30, unit = \"W/(m^2*K)\", range = [1, 1000] }\n"
    "T_0 = { value = 293, unit = \"K\", range = [200, 400] }\n"
    "[states]\nT = { for = \"n = 3..14\", unit = \"K\", start = 300, range = [200, 1000] }\n"
    "[blocks.plate]\ntemperature = \"T\"\ncolumns = [[\"L\", 4]]\nrows = [[\"L/2\", 2], [\"L\", 1]]\ndepth = \"L\"\nconductivity = \"k\"\ndensity = \"rho\"\nheat_capacity = \"c_p\"\n";

}  // namespace

TEST_CASE("the block of four materials is the network that was written by hand") {
    const Machine machine = machine_of("heat/block", "block");
    const Machine hand = machine_from(by_hand);
    const System& system = *machine.system;
    // States of both stand row by row.
    REQUIRE(system.state_rates.size() == hand.system->state_rates.size());
    GiNaC::exmap renamed;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::input})
        for (const Variable& variable : hand.system->symbols.all(kind)) renamed[variable.symbol] = system.symbols.find(kind, variable.name, variable.index)->symbol;
    for (std::size_t k = 0; k < system.state_rates.size(); ++k) renamed[hand.system->symbols.get(SymbolKind::state, k)] = system.symbols.get(SymbolKind::state, k);
    const auto equal = [&](const ex& a, const ex& of_hand) {
        return Prover(system).proven_equal(a, hand.system->symbols.without_definitions(of_hand).subs(renamed, GiNaC::subs_options::no_pattern));
    };
    for (std::size_t k = 0; k < system.state_rates.size(); ++k) {
        CAPTURE(k);
        CHECK(equal(system.state_rates[k], hand.system->state_rates[k]));
    }
    CHECK(equal(system.internal_energy, hand.system->internal_energy));
    for (std::size_t k = 0; k < 2; ++k) CHECK(equal(system.outputs[k].value, hand.system->outputs[k].value));
}

TEST_CASE("a block with every kind of side is proven, and each watt that enters is counted") {
    const std::string sides =
        "left = { temperature = \"T_0\" }\nright = { flux = \"alpha*T_0\", coefficient = \"alpha\", ambient = \"T_0\" }\ntop = { coefficient = \"alpha\", emissivity = 0.8, ambient = \"T_0\" }\n"
        "bottom = { node = \"floor[2]\" }\nsource = \"(x, y) -> alpha*T_0*x*y/L^3\"\n[nodes]\nfloor = { for = \"i = 1..2\", temperature = \"i*T_0\" }\n"
        "lid = { temperature = \"T_0\" }\n[links]\nscrew = { from = \"plate[14]\", to = \"lid\", conductance = \"k*L\" }\n";
    const Machine machine = machine_from(plate + sides);
    const System& system = *machine.system;
    CHECK(all_proven(system));
    CHECK(system.heat.find_node("plate[3]") != nullptr);
    CHECK(system.heat.find_node("plate[14]") != nullptr);
    CHECK(system.heat.find_node("plate.top[4]") != nullptr);
    ex entered = 0;
    for (const BorderState& border : system.heat.borders) entered += border.heat;
    ex given = 0;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i) {
            const auto parameter = [&](const char* name) { return ex(system.symbols.find(SymbolKind::parameter, name, 0)->symbol); };
            const ex L = parameter("L");
            const ex x = L * GiNaC::numeric(2 * i + 1, 8), y = j < 2 ? ex(L * GiNaC::numeric(2 * j + 1, 8)) : ex(L), height = j < 2 ? ex(L / 4) : ex(L);
            given += parameter("alpha") * parameter("T_0") * x * y / pow(L, 3) * L / 4 * height * L;
        }
    CHECK(Prover(system).proven_equal(entered + given - system.heat.find_link("screw")->heat, system.exchanged_power));
}

TEST_CASE("a block that convects is a passive network") {
    CHECK_FALSE(machine_from(plate + "left = { coefficient = \"alpha\", ambient = \"T_0\" }\n").audit.eigenvalues.empty());
    CHECK_FALSE(machine_from(plate + "left = { temperature = \"T_0\" }\n").audit.eigenvalues.empty());
    CHECK_FALSE(machine_of("heat/block", "block").audit.eigenvalues.empty());
}

TEST_CASE("what convects or radiates has a level of its temperatures, what is insulated has none") {
    const auto floats = [](const std::string& text) { return !machine_from(text).system->heat.floating_parts().empty(); };
    CHECK(floats(plate));
    CHECK_FALSE(floats(plate + "top = { emissivity = 0.8, ambient = \"T_0\" }\n"));
    CHECK_FALSE(floats(plate + "top = { coefficient = \"alpha\", ambient = \"T_0\" }\n"));
    CHECK(floats(plate + "top = { flux = \"alpha*T_0\" }\n"));
    const std::string rod = plate.substr(0, plate.find("[blocks.plate]")) + "[rods.bar]\nscheme = \"cells\"\ntemperature = \"T\"\nlength = \"L\"\narea = \"L^2\"\nconductivity = \"k\"\ndensity = \"rho\"\nheat_capacity = \"c_p\"\n";
    CHECK(floats(rod));
    CHECK_FALSE(floats(rod + "last = { coefficient = \"alpha\", ambient = \"T_0\" }\n"));
}

TEST_CASE("a block of one material knows no pieces") {
    const Machine whole = machine_from(plate + "left = { temperature = \"T_0\" }\n");
    std::string text = plate;
    text.replace(text.find("[[\"L\", 4]]"), 10, "[[\"L/4\", 1], [\"3/4*L\", 3]]");
    text.replace(text.find("conductivity = \"k\""), 18, "conductivity = [[\"k\", \"k\"], [\"k\", \"k\"]]");
    const Machine pieced = machine_from(text + "left = { temperature = \"T_0\" }\n");
    GiNaC::exmap renamed;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::state})
        for (const Variable& variable : pieced.system->symbols.all(kind)) renamed[variable.symbol] = whole.system->symbols.get(kind, variable.position);
    for (std::size_t k = 0; k < 12; ++k)
        CHECK(Prover(*whole.system).proven_equal(whole.system->state_rates[k], pieced.system->state_rates[k].subs(renamed, GiNaC::subs_options::no_pattern)));
}
