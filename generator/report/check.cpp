// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/verdict.hpp"
#include "report/json_output.hpp"
#include "text/safe_text.hpp"

namespace dalembert {

namespace {

/// "12 proven, 1 numerically equal"
std::string counted(const std::vector<CheckedScene::Proof>& proofs) {
    std::map<Verdict, int> counts;
    for (const CheckedScene::Proof& proof : proofs) ++counts[proof.verdict];
    std::string text;
    for (const auto& [verdict, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, to_string(verdict));
    return text;
}

nlohmann::ordered_json as_json(const CheckError& error) {
    nlohmann::ordered_json json{{"id", error.id}, {"error", error.error}, {"message", error.message}};
    if (!error.file.empty()) json.update({{"file", error.file}, {"line", error.line}, {"column", error.column}});
    return json;
}

nlohmann::ordered_json as_json(const CheckedScene& scene) {
    nlohmann::ordered_json json{{"scene", scene.scene}, {"proofs", nlohmann::ordered_json::array()}};
    for (const CheckedScene::Group& group : scene.groups)
        for (const CheckedScene::Proof& proof : group.proofs)
            json["proofs"].push_back({{"name", proof.name}, {"verdict", to_string(proof.verdict)}});
    return json;
}

nlohmann::ordered_json as_json(const CheckedFile& file) {
    using Kind = CheckedFile::Kind;
    nlohmann::ordered_json json = json_result("check");
    if (file.kind == Kind::unreadable) json["file"] = file.name;
    if (file.kind == Kind::unreadable) json["errors"] = nlohmann::ordered_json::array();
    if (file.kind == Kind::model) {
        json["model"] = file.name;
        json["scenes"] = nlohmann::ordered_json::array();
        for (const CheckedScene& scene : file.scenes) json["scenes"].push_back(as_json(scene));
    }
    if (file.kind == Kind::catalogue) {
        json["catalogue"] = file.part.title;
        json["edition"] = file.part.about;
    }
    if (file.kind != Kind::unreadable) json["printed"] = nlohmann::ordered_json::array();
    for (const PrintedRow& row : file.part.rows) json["printed"].push_back(report_json(row, file.source()));
    for (const CheckError& error : file.errors) json["errors"].push_back(as_json(error));
    if (file.kind == Kind::catalogue) json["summary"] = file.part.counts.json();
    json["passed"] = file.passed();
    return json;
}

}  // namespace

bool CheckedScene::failed() const {
    const auto is_wrong = [](const Proof& proof) { return proof.verdict == Verdict::wrong; };
    return std::any_of(groups.begin(), groups.end(),
                       [&](const Group& group) { return std::any_of(group.proofs.begin(), group.proofs.end(), is_wrong); });
}

bool CheckedFile::passed() const { return kind != Kind::unreadable && !failed && unread == 0 && read_in_part == 0; }

VerdictCounts CheckResult::counts() const {
    VerdictCounts counts;
    for (const CheckedFile& file : files) counts.add(file.part.counts);
    return counts;
}

bool CheckResult::failed() const {
    return std::any_of(files.begin(), files.end(), [](const CheckedFile& file) { return file.failed; });
}

bool CheckResult::is_whole() const {
    return std::all_of(files.begin(), files.end(), [](const CheckedFile& file) { return file.unreadable.empty(); });
}

CheckedScene checked_scene(const Machine& machine) {
    CheckedScene scene{machine.system->scene.sized_name(), machine.system->scene.name, {}};
    const auto add = [&](const std::string& title, const std::vector<AuditEntry>& entries) {
        if (entries.empty()) return;
        scene.groups.push_back({title, {}});
        for (const AuditEntry& entry : entries) {
            const bool is_told = entry.result.verdict == Verdict::not_checkable;
            scene.groups.back().proofs.push_back({entry.name, entry.result.verdict, is_told ? entry.result.reason : ""});
        }
    };
    const Proofs proofs = proofs_of(machine);
    add("d'Alembert = Euler-Lagrange", proofs.derivation.derivations);
    add("force = -d(energy)/dq", proofs.derivation.potentials);
    add("media: (3.11), (3.21), (3.31), (3.41), (3.43)", proofs.derivation.media);
    add("balances of mass and energy", proofs.derivation.balances);
    add("forces of constraints do no virtual work", proofs.derivation.constraints);
    add("curves of dampers: dissipated power not negative", proofs.derivation.dissipation);
    add("solids: integrals, and Steiner's theorem", proofs.derivation.solids);
    add("loads: equilibrium with the solution inserted", proofs.derivation.loads);
    if (machine.system->scene.sampling == nullptr) add(Audit::power_balance_name(*machine.system), {proofs.derivation.power_balance});
    add("passive network: eigenvalues real, not positive", proofs.derivation.eigenvalues);
    add("emitted code = derivation", proofs.emitted);
    return scene;
}

CheckError check_error(const std::string& id, const Diagnostic& d) {
    CheckError error{id, name_of(d.id), d.message};
    if (!d.span) return error;
    const Position place = d.span.source->position(d.span.begin);
    error.file = d.span.source->name();
    error.line = place.line;
    error.column = place.column;
    return error;
}

std::string as_text(const CheckedScene& scene) {
    std::string text = fmt::format("{}, scene {}\n", scene.sized_name, scene.scene);
    for (const CheckedScene::Group& group : scene.groups) {
        text += fmt::format("  {:<52} {}\n", group.title, counted(group.proofs));
        for (const CheckedScene::Proof& proof : group.proofs)
            if (proof.verdict != Verdict::proven)
                text += fmt::format("    {}: {}{}{}\n", proof.name, to_string(proof.verdict), proof.reason.empty() ? "" : ", since ",
                                    proof.reason);
    }
    return text;
}

std::string as_text(const BookProblem& problem, std::size_t width) {
    return fmt::format("  {:<{}} {}: {}\n", safe_line(problem.id), width, problem.verdict, safe_line(problem.reason));
}

std::string end_of_text(const CheckedFile& file) {
    if (file.kind == CheckedFile::Kind::unreadable)
        return fmt::format("{}\n  not read: {}\n", safe_line(file.name), file.errors.empty() ? "" : safe_line(file.errors.front().message));
    if (file.kind == CheckedFile::Kind::model && file.part.rows.empty()) return "";
    std::string text = file.part.counts.line();
    if (file.read_in_part > 0) text += fmt::format("; {} of them could not be read in full", file.read_in_part);
    if (file.unread > 0) text += fmt::format("; {} more could not be read", file.unread);
    if (file.unchecked > 0) text += fmt::format("; {} more could not be checked", file.unchecked);
    return text + (file.failed ? "; not all as expected\n" : "\n");
}

std::string as_text(const CheckResult& result) {
    std::string pages;
    for (const std::filesystem::path& page : result.pages) pages += fmt::format("{}\n", page.string());
    if (result.files.size() == 1) return pages;
    return result.counts().line(fmt::format("printed equations in {} files", result.files.size()).c_str()) +
           (result.is_whole() ? "" : "; not all could be read") + (result.failed() ? "; not all as expected\n" : "\n") + pages;
}

nlohmann::ordered_json as_json(const CheckResult& result) {
    std::vector<std::string> pages;
    for (const std::filesystem::path& page : result.pages) pages.push_back(page.string());
    if (result.files.size() == 1) {
        nlohmann::ordered_json json = as_json(result.files[0]);
        if (!pages.empty()) json["pages"] = pages;
        return json;
    }
    nlohmann::ordered_json json = json_result("check");
    json["files"] = nlohmann::ordered_json::array();
    for (const CheckedFile& file : result.files) json["files"].push_back(as_json(file));
    json["summary"] = result.counts().json();
    json["passed"] = !result.failed() && result.is_whole();
    if (!pages.empty()) json["pages"] = pages;
    return json;
}

}  // namespace dalembert
