// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ostream>

#include "command/json_output.hpp"
#include "command/printed_verdicts.hpp"
#include "command/shared.hpp"
#include "emit/safe_text.hpp"
#include "model/verdict.hpp"

namespace dalembert {

namespace {

class Check {
public:
    Check(const Options& options, Streams streams) : options_(options), streams_(streams), model_(loaded(options, streams)) {}

    ExitCode run() {
        json_ = json_result("check", model_->model);
        json_["scenes"] = nlohmann::ordered_json::array();
        const std::vector<std::string> scenes =
            options_.choice.scene.empty() ? scene_names(model_->model) : std::vector<std::string>{resolve_scene(model_->model, options_.choice.scene)};
        for (const std::string& scene : scenes) check_scene(scene);
        report_printed();
        if (options_.format == "json") streams_.out << printed(json_);
        return failed_ ? ExitCode::check_failed : ExitCode::good;
    }

private:
    void say(const std::string& text) {
        if (options_.format != "json") streams_.out << text;
    }

    void check_scene(const std::string& name) {
        Machine machine = derive_machine(model_, name, options_.choice.sizes);
        show_warnings(machine, streams_);
        generate(machine);
        const System& system = *machine.system;
        const Proofs proofs = proofs_of(machine);
        nlohmann::ordered_json scene{{"scene", name}, {"proofs", nlohmann::ordered_json::array()}};
        say(fmt::format("{}, scene {}\n", system.scene.sized_name(), name));
        const auto group = [&](const char* title, const std::vector<const AuditEntry*>& entries) {
            if (entries.empty()) return;
            say(fmt::format("  {:<52} {}\n", title, summary(entries)));
            for (const AuditEntry* entry : entries) {
                scene["proofs"].push_back({{"name", entry->name}, {"verdict", to_string(entry->result.verdict)}});
                if (entry->result.verdict != Verdict::proven) say(fmt::format("    {}: {}\n", entry->name, to_string(entry->result.verdict)));
                failed_ = failed_ || entry->result.verdict == Verdict::wrong;
            }
        };
        group("d'Alembert = Euler-Lagrange", pointers(proofs.derivation.derivations));
        group("force = -d(energy)/dq", pointers(proofs.derivation.potentials));
        group("media: (3.11), (3.21), (3.31), (3.41), (3.43)", pointers(proofs.derivation.media));
        group("balances of mass and energy", pointers(proofs.derivation.balances));
        group("forces of constraints do no virtual work", pointers(proofs.derivation.constraints));
        group("solids: integrals, and Steiner's theorem", pointers(proofs.derivation.solids));
        group("loads: equilibrium with the solution inserted", pointers(proofs.derivation.loads));
        group(Audit::power_balance_name(system), {&proofs.derivation.power_balance});
        group("passive network: eigenvalues real, not positive", pointers(proofs.derivation.eigenvalues));
        group("emitted code = derivation", pointers(proofs.emitted));
        json_["scenes"].push_back(std::move(scene));
        verdicts_.add(system);
        for (const Machine& other : machine.other_modes) verdicts_.add(*other.system);
    }

    void report_printed() {
        json_["printed"] = nlohmann::ordered_json::array();
        if (!verdicts_.rows().empty()) say("printed equations\n");
        std::map<std::string, int> counts;
        for (const PrintedRow& row : verdicts_.rows()) {
            const Verdict verdict = row.verdict();
            const std::string reason = row.found ? row.reason : "no scene that was checked contains it";
            ++counts[to_string(verdict)];
            const bool is_of_another_scene = !row.found && !options_.choice.scene.empty();  // what was not asked for does not fail
            failed_ = failed_ || (!row.as_expected() && !is_of_another_scene);
            const std::string source = row.entry->source.empty() ? model_->model.reference : row.entry->source;
            nlohmann::ordered_json assumptions = nlohmann::ordered_json::array();
            if (verdict == Verdict::proven_under_assumption) assumptions.push_back(row.reason);
            nlohmann::ordered_json json{{"id", row.id},           {"source", source},
                                        {"verdict", to_string(verdict)}, {"expected", row.entry->expected ? to_string(*row.entry->expected) : ""},
                                        {"as_expected", row.as_expected()}, {"scenes", row.scenes},
                                        {"equation", row.equation}, {"reason", reason},
                                        {"assumptions", assumptions}, {"difference", row.difference},
                                        {"suggestion", ""},       {"counterexample", nullptr}};
            std::string text = fmt::format("  {:<16} {}{}\n", safe_line(row.id), to_string(verdict),
                                           row.entry->expected ? (row.as_expected() ? ", as expected" : fmt::format(", but '{}' was expected", to_string(*row.entry->expected))) : "");
            const bool is_notable = verdict != Verdict::proven;
            if (is_notable && !row.entry->doc.empty()) text += fmt::format("      {}\n", safe_line(row.entry->doc));
            if (is_notable && !row.equation.empty()) text += fmt::format("      printed:    {}\n", safe_line(row.equation));
            if (is_notable && !reason.empty()) text += fmt::format("      {} {}\n", verdict == Verdict::proven_under_assumption ? "assuming:  " : "reason:    ", safe_line(reason));
            if (!row.difference.empty()) text += fmt::format("      difference: {}\n", row.difference);
            if (row.counterexample) {
                const CounterExample& c = *row.counterexample;
                json["counterexample"] = {{"values", nlohmann::ordered_json::object()}, {"left", c.left}, {"right", c.right}};
                std::vector<std::string> values;
                for (const auto& [name, value] : c.values) {
                    json["counterexample"]["values"][name] = value;
                    values.push_back(fmt::format("{} = {}", name, value));
                }
                text += fmt::format("      example:    left {}, right {}{}{}\n", c.left, c.right, values.empty() ? "" : " at ", fmt::join(values, ", "));
            }
            json_["printed"].push_back(std::move(json));
            say(text);
        }
        json_["passed"] = !failed_;
        if (verdicts_.rows().empty()) return;
        std::string line = fmt::format("{} printed equations:", verdicts_.rows().size());
        for (const auto& [verdict, count] : counts) line += fmt::format(" {} {},", count, verdict);
        line.pop_back();
        say(line + (failed_ ? "; not all as expected\n" : "\n"));
    }

    const Options& options_;
    Streams streams_;
    std::shared_ptr<const LoadedModel> model_;
    nlohmann::ordered_json json_;
    PrintedVerdicts verdicts_;
    bool failed_ = false;
};

}  // namespace

ExitCode check_command(const Options& options, Streams streams) { return Check(options, streams).run(); }

}  // namespace dalembert
