// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <ginac/ginac.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <ostream>
#include <thread>

#include "command/page_server.hpp"
#include "command/report.hpp"
#include "report/error_page.hpp"
#include "text/files.hpp"
#include "text/guardian.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

namespace fs = std::filesystem;

/// When the files were written last that a model may be made of: models and data of its folder.
using Stamps = std::map<fs::path, std::pair<fs::file_time_type, std::uintmax_t>>;

Stamps stamps_beside(const fs::path& model) {
    Stamps stamps;
    std::error_code error;
    const fs::path folder = model.parent_path().empty() ? "." : model.parent_path();
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const std::string ending = at->path().extension().string();
        if (ending != ".toml" && ending != ".csv" && at->path() != model) continue;
        std::error_code gone;
        const fs::file_time_type time = at->last_write_time(gone);
        const std::uintmax_t size = gone ? 0 : at->file_size(gone);
        if (!gone) stamps[at->path()] = {time, size};
    }
    return stamps;
}

std::string script_of_version(std::size_t version) {
    return fmt::format("<script>\nconst watched_version = {};\n{}</script>\n", version, embedded_file("report_watch.js"));
}

/// The page of the model as it is now, or of what is wrong with it.
std::string watched_page(const Options& options, std::size_t version, Streams streams) {
    const auto wrong = [&](const std::vector<Diagnostic>& diagnostics) {
        SourcePtr text;
        try {
            text = read_text_file(options.choice.model);
        } catch (const Failure&) {  // the diagnostics say why
        }
        return error_page(text, diagnostics, script_of_version(version));
    };
    try {
        MadePage made = make_page(options, streams, false, script_of_version(version));
        streams.err << fmt::format("  {}: {} kB\n", made.told.model, (made.html.size() + 500) / 1000);
        return std::move(made.html);
    } catch (const Failure& failure) {
        streams.err << failure.what();
        return wrong(failure.diagnostics());
    } catch (const GiNaC::pole_error&) {
        return wrong({Diagnostic{Id::division_by_zero, {}, "a value makes an expression divide by zero"}});
    } catch (const std::bad_alloc&) {
        return wrong({Diagnostic{Id::too_large, {}, "there is not enough memory; use a smaller model, fewer cells or modes"}});
    }
}

}  // namespace

ExitCode watch_command(const Options& options, Streams streams) {
    using namespace std::chrono_literals;
    read_text_file(options.choice.model);  // throws where there is none
    PageServer server(options.port);
    std::size_t version = 1;
    server.show(error_page(nullptr, {}, script_of_version(version)));
    streams.out << fmt::format("http://127.0.0.1:{}/ shows {} and follows its changes; Ctrl-C ends\n", server.port(),
                               options.choice.model.string());
    streams.out.flush();
    Stamps shown;
    for (bool is_first = true;; is_first = false) {  // until a signal comes, see guardian.hpp
        enter_stage("waiting for changes");
        Stamps now = stamps_beside(options.choice.model);
        while (!is_first && now == shown) {
            std::this_thread::sleep_for(200ms);
            now = stamps_beside(options.choice.model);
        }
        for (Stamps before; before != now; now = stamps_beside(options.choice.model)) {  // an editor may still write
            before = std::move(now);
            std::this_thread::sleep_for(50ms);
        }
        shown = std::move(now);
        server.show(watched_page(options, ++version, streams));
    }
}

}  // namespace dalembert
