// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "report/book_page.hpp"
#include "book/entry_process.hpp"
#include "report/json_output.hpp"
#include "report/printed_report.hpp"
#include "run/shared.hpp"
#include "text/safe_text.hpp"
#include "elements/verdict.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

/// What was found of one file.
struct FileResult {
    nlohmann::ordered_json json;
    BookPart part;
    bool failed = false;
    std::vector<Diagnostic> unreadable = {};  ///< of entries that have no verdict for that
};

nlohmann::ordered_json as_json(const std::string& id, const Diagnostic& d) {
    nlohmann::ordered_json json{{"id", id}, {"error", name_of(d.id)}, {"message", d.message}};
    if (d.span) {
        const Position place = d.span.source->position(d.span.begin);
        json.update({{"file", d.span.source->name()}, {"line", place.line}, {"column", place.column}});
    }
    return json;
}

class Check {
public:
    Check(const Options& options, Streams streams) : options_(options), streams_(streams), model_(loaded(options, streams)) {}

    FileResult run() {
        json_ = json_result("check", model_->model);
        json_["scenes"] = nlohmann::ordered_json::array();
        const std::vector<std::string> scenes =
            options_.choice.scene.empty() ? scene_names(model_->model) : std::vector<std::string>{resolve_scene(model_->model, options_.choice.scene)};
        for (const std::string& scene : scenes) check_scene(scene);
        report_printed();
        return {std::move(json_), {model_->model.title, model_->model.reference, verdicts_.rows(), counts_}, failed_};
    }

private:
    void say(const std::string& text) {
        if (options_.format != "json") streams_.out << text;
    }

    void check_scene(const std::string& name) {
        Machine machine = derive_machine(model_, name, options_.choice.sizes);
        show_warnings(machine, streams_);
        show_doubts(machine, streams_);
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
        std::vector<std::string> names;
        for (const PrintedRow& row : verdicts_.rows()) names.push_back(row.id);
        for (const PrintedRow& row : verdicts_.rows()) {
            const bool is_of_another_scene = !row.found && !options_.choice.scene.empty();  // what was not asked for does not fail
            failed_ = failed_ || (!row.as_expected() && !is_of_another_scene);
            counts_.add(row.verdict());
            json_["printed"].push_back(report_json(row, model_->model.reference));
            say(report_text(row, column_width(names)));
        }
        json_["passed"] = !failed_;
        if (!verdicts_.rows().empty()) say(counts_.line() + (failed_ ? "; not all as expected\n" : "\n"));
    }

    const Options& options_;
    Streams streams_;
    std::shared_ptr<const LoadedModel> model_;
    nlohmann::ordered_json json_;
    PrintedVerdicts verdicts_{!options_.pages.empty()};
    VerdictCounts counts_;
    bool failed_ = false;
};

FileResult check_catalogue(const SourcePtr& source, const Options& options, Streams streams) {
    Diagnostics diagnostics;
    const Catalogue catalogue = read_catalogue(source, diagnostics);
    const bool as_text = options.format != "json";
    FileResult result{{{"schema", "dalembert/check"}, {"version", json_version}, {"catalogue", catalogue.title}, {"edition", catalogue.edition}, {"printed", nlohmann::ordered_json::array()}}, {catalogue.title, catalogue.edition, {}, {}}};
    if (as_text) streams.out << safe_line(catalogue.title) << std::endl;
    std::vector<std::string> names;
    for (const CatalogueEntry& entry : catalogue.entries) names.push_back(entry.name);
    const std::size_t width = column_width(names);
    std::size_t unread = 0, unchecked = 0, half_read = 0;
    const auto has_no_verdict = [&](const CatalogueEntry& entry, const char* verdict, const std::string& reason) {
        result.part.problems.push_back({entry.name, verdict, reason});
        if (as_text) streams.out << fmt::format("  {:<{}} {}: {}\n", safe_line(entry.name), width, verdict, safe_line(reason)) << std::flush;
    };
    const auto note_error = [&](const CatalogueEntry& entry, const Diagnostic& d) {
        result.json["errors"].push_back(as_json(entry.name, d));
        const auto is_same = [&](const Diagnostic& other) { return other.message == d.message && other.span.source == d.span.source && other.span.begin == d.span.begin; };
        if (std::none_of(result.unreadable.begin(), result.unreadable.end(), is_same)) result.unreadable.push_back(d);
    };
    check_entries(catalogue, !options.pages.empty(), [&](const CatalogueEntry& entry, const EntryOutcome& outcome) {
        for (const Diagnostic& d : outcome.errors) note_error(entry, d);
        if (!outcome.rows.empty()) {
            const std::vector<RefusedEquation>& refused = outcome.rows.front().parts.refused;
            for (const RefusedEquation& one : refused) note_error(entry, one.why);
            half_read += refused.empty() ? 0 : 1;
        }
        if (!outcome.errors.empty()) {
            ++unread;
            has_no_verdict(entry, "not read", outcome.errors.front().message);
        } else if (!outcome.stopped.empty()) {
            ++unchecked;
            result.failed = true;
            result.json["errors"].push_back({{"id", entry.name}, {"error", "stopped"}, {"message", outcome.stopped}});
            has_no_verdict(entry, "not checked", outcome.stopped);
        }
        for (const PrintedRow& row : outcome.rows) {
            result.failed = result.failed || !row.as_expected();
            result.part.counts.add(row.verdict());
            result.json["printed"].push_back(report_json(row, catalogue.title));
            if (as_text) streams.out << report_text(row, width) << std::flush;
            result.part.rows.push_back(row);
        }
    });
    if (as_text)
        streams.out << result.part.counts.line() << (half_read > 0 ? fmt::format("; {} of them could not be read in full", half_read) : "") << (unread > 0 ? fmt::format("; {} more could not be read", unread) : "")
                    << (unchecked > 0 ? fmt::format("; {} more could not be checked", unchecked) : "")
                    << (result.failed ? "; not all as expected\n" : "\n");
    result.json["summary"] = result.part.counts.json();
    result.json["passed"] = !result.failed && unread == 0 && half_read == 0;
    return result;
}

/// What is wrong with one of several files takes nothing from the others.
FileResult check_file(const std::string& path, const Options& options, Streams streams) {
    Options one = options;
    one.choice.model = path;
    try {
        const SourcePtr source = read_text_file(path);
        return is_catalogue(source) ? check_catalogue(source, one, streams) : Check(one, streams).run();
    } catch (const Failure& failure) {
        if (options.models.size() == 1 || failure.exit_code() != ExitCode::bad_input) throw;
        FileResult result{{{"schema", "dalembert/check"}, {"version", json_version}, {"file", path}, {"errors", nlohmann::ordered_json::array()}, {"passed", false}}, {path, "", {}, {}}};
        for (const Diagnostic& d : failure.diagnostics()) {
            if (d.severity != Severity::error) continue;
            result.json["errors"].push_back(as_json("", d));
            result.part.problems.push_back({"the file", "not read", d.message});
            result.unreadable.push_back(d);
        }
        if (options.format != "json") streams.out << fmt::format("{}\n  not read: {}\n", safe_line(path), safe_line(failure.diagnostics().front().message));
        return result;
    }
}

}  // namespace

ExitCode check_command(const Options& options, Streams streams) {
    std::vector<FileResult> results;
    for (const std::string& path : options.models) results.push_back(check_file(path, options, streams));
    VerdictCounts counts;
    bool failed = false;
    std::vector<BookPart> parts;
    std::vector<Diagnostic> unreadable;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (FileResult& result : results) {
        counts.add(result.part.counts);
        failed = failed || result.failed;
        files.push_back(std::move(result.json));
        parts.push_back(std::move(result.part));
        unreadable.insert(unreadable.end(), result.unreadable.begin(), result.unreadable.end());
    }
    const bool is_whole = unreadable.empty();
    if (!options.pages.empty()) write_files(book_pages(parts, options.pages));
    if (options.format != "json") {
        if (results.size() > 1) streams.out << counts.line(fmt::format("printed equations in {} files", results.size()).c_str()) << (is_whole ? "" : "; not all could be read") << (failed ? "; not all as expected\n" : "\n");
    } else if (results.size() == 1) {
        streams.out << printed(files[0]);
    } else {
        streams.out << printed({{"schema", "dalembert/check"}, {"version", json_version}, {"files", files}, {"summary", counts.json()}, {"passed", !failed && is_whole}});
    }
    if (!is_whole) throw Failure(std::move(unreadable));
    return failed ? ExitCode::check_failed : ExitCode::good;
}

}  // namespace dalembert
