// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/study.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>

#include "command/write_result.hpp"
#include "report/study.hpp"
#include "report/study_plot.hpp"
#include "run/shared.hpp"
#include "study/ranks.hpp"
#include "text/guardian.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

/// How far a study is, on a terminal.
class Progress {
public:
    Progress(std::size_t runs, std::ostream& err) : runs_(runs), err_(err), is_shown_(isatty(STDERR_FILENO) != 0), start_(Clock::now()) {}
    ~Progress() {
        if (is_shown_ && told_ > start_) err_ << "\r\033[K" << std::flush;
    }

    void add(std::size_t made) {
        made_ += made;
        const auto now = Clock::now();
        if (!is_shown_ || now - told_ < std::chrono::milliseconds(500)) return;
        told_ = now;
        const double taken = std::chrono::duration<double>(now - start_).count();
        const double left = taken * static_cast<double>(runs_ - made_) / static_cast<double>(made_);
        err_ << fmt::format("\r\033[K{} of {} runs, {:.0f} s left", made_, runs_, left) << std::flush;
    }

private:
    using Clock = std::chrono::steady_clock;
    std::size_t runs_, made_ = 0;
    std::ostream& err_;
    bool is_shown_;
    Clock::time_point start_, told_ = start_;
};

/// Of a table, whatever model it is of.
Subject subject_of_table(const RunTable& table) {
    Subject subject{table.study.value("model", ""), table.study.value("model", ""), table.study.value("scene", ""), "", {}};
    for (const auto& [name, value] : table.study.at("sizes").items()) {
        subject.sizes[name] = value.get<int>();
        subject.sized_name += fmt::format("_{}{}", name, value.get<int>());
    }
    return subject;
}

/// Statistics and plots of the runs in a file.
ExitCode finish(const RunTable& table, const fs::path& file, std::size_t found, const Options& options, Streams streams) {
    StudyResult result{.subject = subject_of_table(table), .found = found, .files = {file}};
    enter_stage("the statistics of a study");
    fill(result, table, static_cast<std::size_t>(options.worst));
    FileContents pictures;
    if (!options.no_plot)
        for (const auto& [ending, content] : study_plot(table, result.subject.title()))
            pictures.emplace_back(fs::path(file).replace_extension(ending), content);
    write_files(pictures);
    for (const auto& [path, content] : pictures) result.files.push_back(path);
    write_result(result, options, streams);
    if (result.left_out_count == table.rows.size()) {
        streams.err << "dalembert: no run came to its end\n";
        return ExitCode::run_stopped;
    }
    if (!options.no_plot && pictures.empty()) {
        streams.err
            << "dalembert: no plot: gnuplot is missing or failed (on Debian: apt-get install gnuplot-nox); --no-plot leaves it out\n";
        return ExitCode::tool_missing;
    }
    return ExitCode::good;
}

ExitCode merge(const Options& options, Streams streams) {
    if (!options.choice.model.empty())
        throw Failure(Diagnostic{Id::bad_option, {}, "--merge takes the files of shards and no model; write the files behind it"});
    const RunTable whole = merged({options.merge.begin(), options.merge.end()});
    std::string text = head_of(whole);
    for (const RowOfRun& row : whole.rows) text += line_of(row);
    const Subject subject = subject_of_table(whole);
    const fs::path file = fs::path(options.output) / fmt::format("{}_{}_study.csv", subject.sized_name, subject.scene);
    write_files({{file, text}});
    return finish(whole, file, whole.rows.size(), options, streams);
}

ExitCode make_again(const Study& study, const Options& options, Streams streams) {
    std::size_t run = 0;
    const std::string& text = options.only;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), run);
    if (end.ec != std::errc() || end.ptr != text.data() + text.size() || run >= study.design().runs)
        throw Failure(Diagnostic{
            Id::bad_option, {}, fmt::format("'--only {}' is no run of this study; its runs are 0 to {}", text, study.design().runs - 1)});
    const System& system = *study.runs().machine().system;
    RepeatedOfStudy result{subject_of(system.scene), study.head().varied, study.head().observed, study.row(run), {}};
    const PlantRunResult made = study.simulated(run);
    const fs::path file = fs::path(options.output) / fmt::format("{}_{}_run_{}.csv", system.scene.sized_name(), system.scene.name, run);
    write_files({{file, csv_text(made.recording)}});
    result.files.push_back(file);
    write_result(result, options, streams);
    return result.row.is_good() ? ExitCode::good : ExitCode::run_stopped;
}

/// Those that the file does not have yet; the result is how many it had.
std::size_t make_runs(Study& study, const fs::path& path, const MakeRuns& make, Streams streams) {
    const Shard& shard = study.head().shard;
    RunFile file(path, study.head());
    const std::size_t first = shard.first(study.design().runs) + file.found(), last = shard.last(study.design().runs);
    if (first == last) return file.found();
    study.compile();
    Progress progress(last - first, streams.err);
    make(study, first, last, [&](const std::string& lines) {
        file.add(lines);
        progress.add(static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')));
    });
    return file.found();
}

}  // namespace

ExitCode study_command(const Options& options, Streams streams) {
    if (!options.merge.empty()) return merge(options, streams);
    if (options.choice.model.empty())
        throw Failure(Diagnostic{Id::bad_option, {}, "MODEL is required; give a model file, or --merge with the files of shards"});
    const std::unique_ptr<Ranks> ranks = Ranks::if_any();
    if (ranks && !ranks->is_writer()) {
        try {
            Study study(loaded(options, streams), options);
            if (options.only.empty()) ranks->work(study);
        } catch (const Failure& failure) {  // the writer tells it
            return failure.exit_code();
        }
        return ExitCode::good;
    }
    Study study(loaded(options, streams), options);
    show_warnings(study.runs().machine(), streams);
    if (!options.only.empty()) {
        study.compile();
        return make_again(study, options, streams);
    }
    const fs::path path = fs::path(options.output) / study.file_name();
    const std::size_t found = make_runs(study, path, ranks ? ranks->maker() : by_threads(static_cast<std::size_t>(options.jobs)), streams);
    return finish(read_runs(path), path, found, options, streams);
}

}  // namespace dalembert
