// SPDX-License-Identifier: GPL-3.0-or-later
// The documented fields are those that the verbs print: none is missing in the documentation, none is documented only.
#include "report/json_fields.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "command/command_line.hpp"
#include "text/process.hpp"

using namespace dalembert;
using Json = nlohmann::ordered_json;

namespace {

/// Keys below these are names of the model, of functions or of stages.
const std::map<std::string, std::string> free_keys{{"sizes", "<NAME>"},
                                                   {"definitions", "<NAME>"},
                                                   {"state_rates", "<NAME>"},
                                                   {"outputs", "<NAME>"},
                                                   {"parameter", "<NAME>"},
                                                   {"state", "<NAME>"},
                                                   {"input", "<NAME>"},
                                                   {"output", "<NAME>"},
                                                   {"values", "<NAME>"},
                                                   {"state_derivative", "<NAME>"},
                                                   {"unknown", "<NAME>"},
                                                   {"summary", "<VERDICT>"},
                                                   {"proofs", "<VERDICT>"},
                                                   {"printed", "<VERDICT>"},
                                                   {"sticking", "<NAME>"},
                                                   {"operations", "<FUNCTION>"},
                                                   {"definiteness", "<MATRIX>"},
                                                   {"seconds", "<STAGE>"},
                                                   {"errors", "<ARITHMETIC>"},
                                                   {"points", "<ARITHMETIC>"},
                                                   {"at", "<NAME>"}};

void collect(const Json& value, const std::string& path, const std::string& key, std::set<std::string>& paths) {
    if (value.is_object()) {
        const auto general = free_keys.find(key);
        for (const auto& [name, member] : value.items()) {
            const std::string step = general == free_keys.end() ? name : general->second;
            collect(member, path.empty() ? step : path + "." + step, step, paths);
        }
    } else if (key == "files") {  // of check, each is a result by itself
        paths.insert(path + "[]");
    } else if (value.is_array()) {
        for (const Json& element : value) collect(element, path + "[]", "", paths);
        if (value.empty()) paths.insert(path + "[]");
    } else {
        paths.insert(path);
    }
}

std::set<std::string> printed_paths(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--format", "json"});
    std::ostringstream out, err;
    const int code = run_program(arguments, {out, err});
    INFO(err.str());
    REQUIRE(code <= 1);
    std::set<std::string> paths;
    collect(Json::parse(out.str()), "", "", paths);
    return paths;
}

}  // namespace

TEST_CASE("the JSON fields are the documented ones") {
    const std::string systems = SOURCE_DIR "/systems/mechanics/";
    const std::string book = SOURCE_DIR "/systems/book/2_5_euler_lagrange.toml";
    const ScratchFolder scratch;
    const std::filesystem::path folder = scratch.path();
    // With a family and an input, so that every field occurs.
    const std::string model = folder / "driven.toml";
    std::ofstream(model)
        << "[model]\nformat = 1\nname = \"driven\"\n[sizes]\nN = { value = 1 }\n[parameters]\nm = { value = 1, unit = \"kg\" }\n"
           "c = { value = 2, unit = \"N/m\" }\n[coordinates]\nq = { for = \"k = 1..N\", unit = \"m\" }\n[inputs]\nf = { unit = \"N\" }\n"
           "[bodies.b]\nfor = \"k = 1..N\"\nmass = \"m\"\nposition = [\"q[k]\", 0, 0]\n[springs.s]\nstiffness = \"c\"\nelongation = "
           "\"q[1]\"\n"
           "[forces.f]\non = \"b[1]\"\nforce = [\"f\", 0, 0]\n[outputs]\ny = { value = \"q[1]\", unit = \"m\" }\n";
    // Of two effects one needs the other, so that a scene is refused.
    const std::string braked = folder / "braked.toml";
    std::ofstream(braked)
        << "[model]\nformat = 1\nname = \"braked\"\n[parameters]\nm = { value = 1, unit = \"kg\" }\nd = { value = 2, unit = \"N*s/m\" }\n"
           "[coordinates]\nq = { unit = \"m\", start_rate = 1 }\n[bodies.b]\nmass = \"m\"\nposition = [\"q\", 0, 0]\n"
           "[dampers.weak]\nrate = \"dot(q)\"\ncoefficient = \"d\"\nwhen = \"weak\"\n[dampers.strong]\nrate = \"dot(q)\"\ncoefficient = "
           "\"2*d\"\nwhen = \"strong\"\n"
           "[effects]\nweak = { doc = \"a brake\" }\nstrong = { doc = \"another\", implies = [\"weak\"] }\n[runs.reference]\nuntil = 1\n";
    // A machine that switches, with a state, so that every field of modes occurs.
    const std::string sliding = folder / "sliding.toml";
    std::ofstream(sliding)
        << "[model]\nformat = 1\nname = \"sliding\"\n[parameters]\nm = { value = 1, unit = \"kg\" }\nf = { value = 2, unit = \"N\" }\n"
           "[coordinates]\nq = { unit = \"m\", start_rate = 1 }\n[bodies.b]\nmass = \"m\"\nposition = [\"q\", 0, 0]\n"
           "[states]\nway = { unit = \"m\", derivative = \"abs(dot(q))\" }\n"
           "[frictions.floor]\nrate = \"dot(q)\"\nnormal_force = \"f\"\ncoefficient = \"1/2\"\n";
    // With more than one local optimum.
    const std::string waves = folder / "waves.toml";
    std::ofstream(waves)
        << "[model]\nformat = 1\nname = \"waves\"\n[parameters]\nm = { value = 1, unit = \"kg\" }\nw = { value = 1, unit = \"1/s\" }\n"
           "[coordinates]\nq = { unit = \"m\", start_rate = 1 }\n[bodies.b]\nmass = \"m\"\nposition = [\"q\", 0, 0]\n"
           "[outputs]\ny = { value = \"q*sin(w*t)\", unit = \"m\" }\n[runs.reference]\nuntil = 1\n";
    const std::string data = folder / "run.csv";
    std::ofstream(data) << "t,q[1]\n0,1\n0.1,0.99\n0.2,0.96\n0.3,0.91\n0.4,0.84\n0.5,0.76\n";
    const std::map<std::string, std::vector<std::vector<std::string>>> calls{
        {"new", {{"crane", "-o", folder}}},
        {"derive",
         {{systems + "spring_mass_damper.toml"},
          {systems + "cart_pendulum.toml"},
          {systems + "n_pendulum.toml", "--size", "N=2"},
          {SOURCE_DIR "/tests/golden/capacitor.toml"},
          {SOURCE_DIR "/systems/hydraulics/torricelli.toml"},
          {SOURCE_DIR "/systems/heat/fin.toml", "--size", "N=50"},
          {SOURCE_DIR "/tests/physics/heat/plate.toml", "--scene", "looped"},
          {SOURCE_DIR "/systems/drives/motor_start.toml"},
          {sliding}}},
        {"generate",
         {{SOURCE_DIR "/systems/heat/fin.toml", "--size", "N=50", "-o", folder},
          {systems + "cart_pendulum.toml", "-o", folder},
          {systems + "n_pendulum.toml", "--size", "N=2", "-o", folder}}},
        {"compile", {{systems + "n_pendulum.toml", "--size", "N=2", "-o", folder}}},
        {"export", {{systems + "n_pendulum.toml", "--size", "N=2", "--to", "c", "-o", folder}}},
        {"effects", {{systems + "projectile.toml", "-o", folder, "--no-plot"}, {braked, "-o", folder, "--no-plot"}}},
        {"check",
         {{systems + "coupled_springs.toml", "-o", folder}, {systems + "cart_pendulum.toml"}, {book}, {book, systems + "pulley.toml"}}},
        {"report", {{systems + "cart_pendulum.toml", "-o", folder}, {SOURCE_DIR "/systems/heat/convection.toml", "-o", folder},
                    {systems + "pendulum.toml", SOURCE_DIR "/systems/heat/convection.toml", "-o", folder}}},
        {"evaluate",
         {{systems + "cart_pendulum.toml"},
          {systems + "friction_limits.toml"},
          {systems + "n_pendulum.toml", "--size", "N=2"},
          {SOURCE_DIR "/systems/hydraulics/torricelli.toml"},
          {sliding, "--mode", "floor_sticks"}}},
        {"simulate",
         {{sliding, "--until", "1", "--no-plot", "-o", folder},
          {systems + "n_pendulum.toml", "--size", "N=2", "--until", "0.01", "--method", "dop853", "--sensitivities", "g",
           "--second-order", "--no-plot", "-o", folder},
          {SOURCE_DIR "/systems/heat/voltage_regulator.toml", "--until", "1", "--no-plot", "-o", folder}}},
        {"equilibrium", {{model}, {sliding, "--mode", "floor_sticks"}}},
        {"modal",
         {{systems + "drive_train.toml"}, {systems + "chaplygin_sleigh.toml"}, {model}, {sliding, "--mode", "floor_slides_forwards"}}},
        {"optimise",
         {{waves, "--maximise", "y", "--over", "w=1:15"},
          {model, "--until", "1", "--minimise", "y", "--over", "c=1:2", "--state", "q[1]=1"}}},
        {"cost",
         {{waves, "--methods", "rk4,dopri5", "--arithmetics", "double", "--limit", "2", "--no-plot", "-o", folder},
          {waves, "--budget", "1 ms step, 1 s", "--methods", "rk4", "--arithmetics", "double", "--limit", "2"}}},
        {"accuracy", {{model, "--points", "20"}, {waves, "--points", "20"}}},
        {"identify",
         {{systems + "cart_pendulum.toml", "--data", SOURCE_DIR "/systems/data/cart_pendulum_1.csv", "--fit", "d_R,rho_S,h_S",
           "--no-plot", "-o", folder},
          {model, "--data", data, "--fit", "m", "--state", "q[1]=1", "--no-plot", "-o", folder}}},
        {"study",
         {{model, "--vary", "m=uniform(1, 2)", "--runs", "9", "--indices", "--until", "0.1", "--state", "q[1]=1",
           "--no-plot", "-o", folder},
          {model, "--vary", "m=uniform(1, 2)", "--runs", "9", "--indices", "--until", "0.1", "--only", "3", "-o", folder}}},
        {"survey", {{systems + "pulley.toml", "--no-plot", "-o", folder}}},
        {"scenes", {{systems + "cart_pendulum.toml"}}},
    };
    CHECK(calls.size() == json_schemas().size());
    // Those that compile take minutes together.
    const bool is_full = std::getenv("DALEMBERT_FULL") != nullptr;
    const std::set<std::string> long_ones{"effects", "optimise", "cost", "accuracy", "survey"};
    for (const JsonSchema& schema : json_schemas()) {
        if (!is_full && long_ones.contains(schema.verb)) continue;
        CAPTURE(schema.verb);
        std::set<std::string> documented;
        for (const JsonField& field : common_json_fields()) documented.insert(field.path);
        for (const JsonField& field : schema.fields) documented.insert(field.path);
        if (schema.verb == std::string("survey")) documented.erase("model");
        std::set<std::string> printed;
        for (std::vector<std::string> arguments : calls.at(schema.verb)) {
            arguments.insert(arguments.begin(), schema.verb);
            printed.merge(printed_paths(arguments));
        }
        for (const std::string& path : printed) {
            // Of an empty array one cannot see what its elements are.
            const bool known = std::any_of(documented.begin(), documented.end(), [&](const std::string& d) {
                return d == path || (path.ends_with("[]") && d.starts_with(path));
            });
            CHECK_MESSAGE(known, path, " is printed but not documented");
        }
        for (const std::string& path : documented) CHECK_MESSAGE(printed.contains(path), path, " is documented but was not printed");
    }
}
