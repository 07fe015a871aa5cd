// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <ostream>

#include "elements/kinds.hpp"
#include "report/json_output.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "emit/equations.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

std::string stage_table(const std::vector<StageReport>& stages) {
    std::string text;
    for (const StageReport& stage : stages) text += fmt::format("  {:<11} {:>8.1f} ms  {}\n", stage.stage, 1000 * stage.seconds, stage.result);
    return text;
}

/// What a stage hands to the next one, for whoever wants to see it.
std::string dumped(const Machine& machine, const std::string& stage, const Header& header) {
    const System& system = *machine.system;
    if (stage == "equations") return equations_as_text(system);
    if (stage == "code") return header.text;
    std::string text;
    if (stage == "atoms") {
        const Atoms& atoms = machine.code->atoms;
        for (Letter letter = 0; letter < atoms.size(); ++letter)
            text += fmt::format("{:>4} {:<7} {} {}\n", letter, name_of(atoms[letter].op), atoms[letter].is_dynamic ? "moves" : "fixed",
                                atoms[letter].variable != nullptr ? atoms[letter].variable->name : atoms[letter].key);
        return text;
    }
    const Scene& scene = system.scene;
    text += fmt::format("scene {}\n", scene.name);
    const auto name = []<class T>(const T& member) {
        if constexpr (requires { member.name(); }) return member.name();
        else if constexpr (requires { member->name; }) return member->name;
        else return member.name;
    };
    for_each_kind(scene, [&]<class Items>(const char* title, const Items& items) {
        if constexpr (std::is_pointer_v<Items>) {  // gravity
            if (items != nullptr) text += fmt::format("{}\n", title);
        } else if constexpr (requires { items.begin()->first; }) {  // sizes
            for (const auto& [size, value] : items) text += fmt::format("{}: {} = {}\n", title, size, value);
        } else if (!items.empty()) {
            text += fmt::format("{}:", title);
            for (const auto& member : items) text += " " + name(member);
            text += "\n";
        }
    });
    return text;
}

}  // namespace

namespace {

nlohmann::ordered_json as_json(const Machine& machine, const Header& header, const std::filesystem::path& path) {
    nlohmann::ordered_json json = json_result("generate", machine.system->scene);
    json["header"] = path.string();
    json["namespace"] = header.name_space;
    json["bytes"] = header.text.size();
    json["all_proven"] = proofs_of(machine).all_proven();
    json["operations"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < function_count; ++i) {
        if (static_cast<Function>(i) == Function::together && !machine.together) continue;
        const OperationCount c = operations(machine, static_cast<Function>(i));
        json["operations"][name_of(static_cast<Function>(i))] = {{"additions", c.additions}, {"multiplications", c.multiplications},
                                                                 {"divisions", c.divisions}, {"trigonometric", c.trigonometric},
                                                                 {"other", c.other},         {"total", c.total()}};
    }
    json["cells"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; machine.fields && i < machine.fields->fields.size(); ++i) {
        const FieldFunctions& f = machine.fields->fields[i];
        json["cells"].push_back({{"rod", f.field->rod->name}, {"count", f.field->geometry.cells()}, {"operations", machine.fields->per_cell(f).total()}});
    }
    json["seconds"] = nlohmann::ordered_json::object();
    for (const StageReport& stage : machine.stages) json["seconds"][stage.stage] = stage.seconds;
    return json;
}

}  // namespace

ExitCode generate_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    const std::vector<std::string> scenes = options.every_scene ? scene_names(model->model) : std::vector<std::string>{options.choice.scene};
    FileContents files;
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    std::string text;
    for (const std::string& scene : scenes) {
        Machine machine = derive_machine(model, scene, options.choice.sizes, parse_fixed(options.fix, model->names));
        show_warnings(machine, streams);
        show_doubts(machine, streams);
        ask_of_code(machine, options);
        const Header header = generate(machine, options.taylor ? SeriesWish::wanted : SeriesWish::none);
        if (!options.dump.empty()) {
            streams.out << dumped(machine, options.dump, header);
            return ExitCode::good;
        }
        const std::filesystem::path path = std::filesystem::path(options.output) / (options.header.empty() ? header.file_name : options.header);
        files.emplace_back(path, header.text);
        all.push_back(as_json(machine, header, path));
        const bool all_proven = proofs_of(machine).all_proven();
        std::string cells;
        for (std::size_t i = 0; machine.fields && i < machine.fields->fields.size(); ++i) {
            const FieldFunctions& f = machine.fields->fields[i];
            cells += fmt::format(" and {} for each of the {} cells of {}", machine.fields->per_cell(f).total(), f.field->geometry.cells(), f.field->rod->name);
        }
        text += fmt::format("{}: {} degrees of freedom, {} operations in the right-hand side{}, {}\n", path.string(), machine.system->symbols.degrees(),
                            operations(machine, Function::rhs).total(), cells, all_proven ? "everything proven" : "some of it numerically equal only");
        if (options.explain) text += stage_table(machine.stages) + rewritten_text(machine);
    }
    write_files(files);
    if (options.format == "json") streams.out << printed(options.every_scene ? all : all.front());
    else streams.out << text;
    return ExitCode::good;
}

}  // namespace dalembert
