// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <ginac/ginac.h>

#include <chrono>
#include <filesystem>
#include <ostream>
#include <thread>
#include <vector>

#include "command/page_server.hpp"
#include "command/report.hpp"
#include "report/error_page.hpp"
#include "text/files.hpp"
#include "text/guardian.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

namespace fs = std::filesystem;

/// The files that a page was made of: the model, its parts and its data.
using Stamps = std::vector<std::pair<fs::path, FileStamp>>;

Stamps as_they_are_now(Stamps stamps) {
    for (auto& [path, stamp] : stamps) stamp = stamp_of(path);
    return stamps;
}

void wait_for_change(const Stamps& shown) {
    using namespace std::chrono_literals;
    Stamps now = as_they_are_now(shown);
    for (; now == shown; now = as_they_are_now(shown)) std::this_thread::sleep_for(200ms);
    for (Stamps before; before != now; now = as_they_are_now(shown)) {  // an editor may still write
        before = std::move(now);
        std::this_thread::sleep_for(50ms);
    }
}

std::string script_of_version(std::size_t version) {
    return fmt::format("<script>\nconst watched_version = {};\n{}</script>\n", version, embedded_file("report_watch.js"));
}

/// The page of the model as its files say now. Where the model has errors, a page that shows these.
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
    read_text_file(options.choice.model);  // throws where there is none
    PageServer server(options.port);
    std::size_t version = 1;
    server.show(error_page(nullptr, {}, script_of_version(version)));
    streams.out << fmt::format("http://127.0.0.1:{}/ shows {} and follows its changes; Ctrl-C ends\n", server.port(),
                               options.choice.model.string());
    streams.out.flush();
    while (true) {  // until a signal comes, see guardian.hpp
        const FilesRead read;
        server.show(watched_page(options, ++version, streams));
        enter_stage("waiting for changes");
        wait_for_change(read.files());
    }
}

}  // namespace dalembert
