// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/check.hpp"

#include <algorithm>

#include "book/entry_process.hpp"
#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "run/controllers.hpp"
#include "run/shared.hpp"
#include "text/safe_text.hpp"

namespace dalembert {

namespace {

/// Where texts of parts go as they are ready; nothing is written with `--format json`.
class PartsAsText {
public:
    PartsAsText(const Options& options, Streams streams) : out_(is_json(options) ? nullptr : &streams.out) {}
    void operator()(const std::string& text) const {
        if (out_ != nullptr) *out_ << text << std::flush;
    }

private:
    std::ostream* out_;
};

std::size_t column_of(const std::vector<PrintedRow>& rows) {
    std::vector<std::string> names;
    for (const PrintedRow& row : rows) names.push_back(row.id);
    return column_width(names);
}

/// One model, scene by scene.
class ModelCheck {
public:
    ModelCheck(const Options& options, Streams streams)
        : options_(options), streams_(streams), write_(options, streams), model_(loaded(options, streams)) {}

    CheckedFile run() {
        const Model& model = model_->model;
        file_.name = model.name;
        file_.part.title = model.title;
        file_.part.about = model.reference;
        const std::string& wanted = options_.choice.scene;
        for (const std::string& scene : wanted.empty() ? scene_names(model) : std::vector<std::string>{resolve_scene(model, wanted)})
            check_scene(scene);
        judge_printed();
        write_(end_of_text(file_));
        return std::move(file_);
    }

private:
    /// With its controllers. Errors of any of them come before results.
    void check_scene(const std::string& name) {
        Machine machine = derive_machine(model_, name, options_.choice.sizes);
        show_warnings(machine, streams_);
        show_doubts(machine, streams_);
        generate(machine);
        const System& system = *machine.system;
        const std::vector<PreparedController> controllers = prepare_controllers(system, Values(system.scene, system.translate), 0);
        for (const PreparedController& one : controllers) show_warnings(*one.machine, streams_);
        add(machine);
        for (const PreparedController& one : controllers) add(*one.machine);
        verdicts_.add(system);
        for (const Machine& other : machine.other_modes) verdicts_.add(*other.system);
    }

    void add(const Machine& machine) {
        file_.scenes.push_back(checked_scene(machine));
        file_.failed = file_.failed || file_.scenes.back().failed();
        write_(as_text(file_.scenes.back()));
    }

    void judge_printed() {
        file_.part.rows = verdicts_.rows();
        if (!file_.part.rows.empty()) write_("printed equations\n");
        const std::size_t width = column_of(file_.part.rows);
        for (const PrintedRow& row : file_.part.rows) {
            const bool is_of_another_scene = !row.found && !options_.choice.scene.empty();  // what was not asked for does not fail
            file_.failed = file_.failed || (!row.as_expected() && !is_of_another_scene);
            file_.part.counts.add(row.verdict());
            write_(report_text(row, width));
        }
    }

    const Options& options_;
    Streams streams_;
    PartsAsText write_;
    std::shared_ptr<const LoadedModel> model_;
    CheckedFile file_;
    PrintedVerdicts verdicts_{!options_.pages.empty()};
};

/// One catalogue, entry by entry.
class CatalogueCheck {
public:
    CatalogueCheck(const Catalogue& catalogue, const Options& options, Streams streams)
        : catalogue_(catalogue), for_pages_(!options.pages.empty()), write_(options, streams) {
        file_.kind = CheckedFile::Kind::catalogue;
        file_.part.title = catalogue.title;
        file_.part.about = catalogue.edition;
        std::vector<std::string> names;
        for (const CatalogueEntry& entry : catalogue.entries) names.push_back(entry.name);
        width_ = column_width(names);
    }

    CheckedFile run() {
        write_(safe_line(catalogue_.title) + "\n");
        check_entries(catalogue_, for_pages_, [&](const CatalogueEntry& entry, const EntryOutcome& outcome) { add(entry.name, outcome); });
        write_(end_of_text(file_));
        return std::move(file_);
    }

private:
    void add(const std::string& name, const EntryOutcome& outcome) {
        for (const Diagnostic& d : outcome.errors) note(name, d);
        if (!outcome.rows.empty()) {
            const std::vector<RefusedEquation>& refused = outcome.rows.front().parts.refused;
            for (const RefusedEquation& one : refused) note(name, one.why);
            file_.read_in_part += refused.empty() ? 0 : 1;
        }
        if (!outcome.errors.empty()) {
            ++file_.unread;
            has_no_verdict({name, "not read", outcome.errors.front().message});
        } else if (!outcome.stopped.empty()) {
            ++file_.unchecked;
            file_.failed = true;
            file_.errors.push_back({name, "stopped", outcome.stopped});
            has_no_verdict({name, "not checked", outcome.stopped});
        }
        for (const PrintedRow& row : outcome.rows) {
            file_.failed = file_.failed || !row.as_expected();
            file_.part.counts.add(row.verdict());
            file_.part.rows.push_back(row);
            write_(report_text(row, width_));
        }
    }

    void note(const std::string& name, const Diagnostic& d) {
        file_.errors.push_back(check_error(name, d));
        const auto is_same = [&](const Diagnostic& other) {
            return other.message == d.message && other.span.source == d.span.source && other.span.begin == d.span.begin;
        };
        if (std::none_of(file_.unreadable.begin(), file_.unreadable.end(), is_same)) file_.unreadable.push_back(d);
    }

    void has_no_verdict(BookProblem problem) {
        problem.rows_before = file_.part.rows.size();
        file_.part.problems.push_back(problem);
        write_(as_text(problem, width_));
    }

    const Catalogue& catalogue_;
    bool for_pages_;
    PartsAsText write_;
    std::size_t width_ = 0;
    CheckedFile file_;
};

CheckedFile check_catalogue(const SourcePtr& source, const Options& options, Streams streams) {
    Diagnostics diagnostics;
    const Catalogue catalogue = read_catalogue(source, diagnostics);
    return CatalogueCheck(catalogue, options, streams).run();
}

CheckedFile unreadable_file(const std::string& path, const std::vector<Diagnostic>& diagnostics) {
    CheckedFile file;
    file.kind = CheckedFile::Kind::unreadable;
    file.name = path;
    file.part.title = path;
    for (const Diagnostic& d : diagnostics) {
        if (d.severity != Severity::error) continue;
        file.errors.push_back(check_error("", d));
        file.part.problems.push_back({"the file", "not read", d.message});
        file.unreadable.push_back(d);
    }
    return file;
}

}  // namespace

/// What is wrong with one of several files takes nothing from the others.
CheckedFile check_file(const std::string& path, const Options& options, Streams streams) {
    Options one = options;
    one.choice.model = path;
    try {
        const SourcePtr source = read_text_file(path);
        return is_catalogue(source) ? check_catalogue(source, one, streams) : ModelCheck(one, streams).run();
    } catch (const Failure& failure) {
        if (options.models.size() == 1 || failure.exit_code() != ExitCode::bad_input) throw;
        CheckedFile file = unreadable_file(path, failure.diagnostics());
        PartsAsText(options, streams)(end_of_text(file));
        return file;
    }
}

ExitCode check_command(const Options& options, Streams streams) {
    CheckResult result;
    for (const std::string& path : options.models) result.files.push_back(check_file(path, options, streams));
    if (!options.pages.empty()) {
        std::vector<BookPart> parts;
        for (const CheckedFile& file : result.files) parts.push_back(file.part);
        const FileContents pages = book_pages(parts, options.pages);
        write_files(pages);
        result.pages = paths_of(pages);
    }
    write_result(result, options, streams);
    std::vector<Diagnostic> unreadable;
    for (const CheckedFile& file : result.files) unreadable.insert(unreadable.end(), file.unreadable.begin(), file.unreadable.end());
    if (!unreadable.empty()) throw Failure(std::move(unreadable));
    return result.failed() ? ExitCode::check_failed : ExitCode::good;
}

}  // namespace dalembert
