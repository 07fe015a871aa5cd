// SPDX-License-Identifier: GPL-3.0-or-later
#include "book/entry_process.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "book/catalogue_verdicts.hpp"
#include "text/budgets.hpp"
#include "text/guardian.hpp"

namespace dalembert {

namespace {

using Json = nlohmann::json;

Json as_json(const Span& span) {
    if (!span) return nullptr;
    return {{"name", span.source->name()}, {"text", span.source->text()}, {"begin", span.begin}, {"end", span.end}};
}

/// Texts are kept, so that places in the same one are seen to be so.
class Sources {
public:
    explicit Sources(SourcePtr known) { sources_[known->name()] = std::move(known); }

    Span span_of(const Json& json) {
        if (json.is_null()) return {};
        SourcePtr& source = sources_[json["name"]];
        if (!source || source->text() != json["text"].get<std::string>())
            source = std::make_shared<const Source>(json["name"].get<std::string>(), json["text"].get<std::string>());
        return {source, json["begin"].get<std::size_t>(), json["end"].get<std::size_t>()};
    }

private:
    std::map<std::string, SourcePtr> sources_;
};

Json as_json(const Diagnostic& d) {
    Json json{{"id", static_cast<int>(d.id)}, {"span", as_json(d.span)}, {"message", d.message}, {"notes", Json::array()}};
    for (const Note& note : d.notes) json["notes"].push_back({{"span", as_json(note.span)}, {"message", note.message}});
    return json;
}

Diagnostic diagnostic_of(const Json& json, Sources& sources) {
    Diagnostic d{static_cast<Id>(json["id"].get<int>()), sources.span_of(json["span"]), json["message"]};
    for (const Json& note : json["notes"]) d.notes.push_back({sources.span_of(note["span"]), note["message"]});
    return d;
}

Json as_json(const PrintedRow& row) {
    Json json{{"id", row.id},
              {"source", row.source},
              {"doc", row.doc},
              {"scenes", row.scenes},
              {"equation", row.equation},
              {"reason", row.reason},
              {"difference", row.difference},
              {"at", row.at},
              {"given", row.given},
              {"hint", row.hint},
              {"formulas", row.formulas},
              {"meant", row.meant},
              {"derived", row.derived}};
    if (row.expected) json["expected"] = static_cast<int>(*row.expected);
    if (row.found) json["found"] = static_cast<int>(*row.found);
    if (row.counterexample)
        json["counterexample"] = {
            {"values", row.counterexample->values}, {"left", row.counterexample->left}, {"right", row.counterexample->right}};
    if (row.suggestion)
        json["suggestion"] = {{"words", row.suggestion->words},
                              {"equation", row.suggestion->equation},
                              {"printed", row.suggestion->printed},
                              {"begin", row.suggestion->begin},
                              {"end", row.suggestion->end}};
    json["equations"] = row.parts.equations;
    for (const RefusedEquation& one : row.parts.refused) json["refused"].push_back({{"number", one.number}, {"why", as_json(one.why)}});
    return json;
}

PrintedRow row_of(const Json& json, Sources& sources) {
    PrintedRow row{json["id"], json["source"], json["doc"]};
    row.scenes = json["scenes"].get<std::vector<std::string>>();
    row.equation = json["equation"];
    row.reason = json["reason"];
    row.difference = json["difference"];
    row.at = json["at"].get<std::vector<std::string>>();
    row.given = json["given"].get<std::vector<std::string>>();
    row.hint = json["hint"];
    row.formulas = json["formulas"];
    row.meant = json["meant"];
    row.derived = json["derived"].get<std::vector<std::string>>();
    if (json.contains("expected")) row.expected = static_cast<Verdict>(json["expected"].get<int>());
    if (json.contains("found")) row.found = static_cast<Verdict>(json["found"].get<int>());
    row.parts.equations = json["equations"];
    if (json.contains("refused"))
        for (const Json& one : json["refused"]) row.parts.refused.push_back({one["number"], diagnostic_of(one["why"], sources)});
    if (json.contains("counterexample")) {
        const Json& c = json["counterexample"];
        row.counterexample = CounterExample{c["values"].get<std::vector<std::pair<std::string, std::string>>>(), c["left"], c["right"]};
    }
    if (json.contains("suggestion"))
        row.suggestion = Suggestion{json["suggestion"]["words"], json["suggestion"]["equation"], json["suggestion"]["printed"],
                                    json["suggestion"]["begin"], json["suggestion"]["end"]};
    return row;
}

/// Less than its budget where a stage may take less.
double entry_seconds() { return std::min<double>(budget::entry_seconds, stage_limits().seconds); }
double entry_bytes() { return std::min<double>(budget::entry_bytes, stage_limits().bytes); }

/// In this process.
Json checked(CatalogueVerdicts& verdicts, const CatalogueEntry& entry) {
    Json json{{"rows", Json::array()}, {"errors", Json::array()}, {"stopped", ""}};
    try {
        for (const PrintedRow& row : verdicts.check(entry)) json["rows"].push_back(as_json(row));
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics()) json["errors"].push_back(as_json(d));
    } catch (const std::bad_alloc&) {
        json["stopped"] = fmt::format("it needs more memory than the limit of {:.3g} GB", entry_bytes() / 1e9);
    } catch (const std::exception& error) {
        json["stopped"] = fmt::format("the program stopped at this entry, a defect of the program: {}", error.what());
    }
    return json;
}

void write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = write(file, text.data(), text.size());
        if (count <= 0) _exit(1);
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

/// Sanitizers take address space that says nothing.
constexpr bool limits_memory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // gcc
    return false;
#elif defined(__has_feature)
    return !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
    return true;
#endif
}

void set_processor_time(double seconds) {
    const auto whole = static_cast<time_t>(seconds);
    const itimerval timer{{0, 0}, {whole, static_cast<suseconds_t>((seconds - static_cast<double>(whole)) * 1e6)}};
    setitimer(ITIMER_PROF, &timer, nullptr);
}

/// One line for each entry from the given one on. Does not come back.
[[noreturn]] void run_child(const Catalogue& catalogue, bool for_pages, std::size_t first, int file) {
    signal(SIGPROF, SIG_DFL);
    // What ends the program ends this process as well: it leads a group that the program's guardian knows.
    setpgid(0, 0);
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
    if (limits_memory()) {
        const auto bytes = static_cast<rlim_t>(entry_bytes());
        const rlimit limit{bytes, bytes};
        setrlimit(RLIMIT_DATA, &limit);
    }
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    {
        CatalogueVerdicts verdicts(catalogue, for_pages);
        for (std::size_t i = first; i < catalogue.entries.size(); ++i) {
            set_processor_time(entry_seconds());
            const std::string line = checked(verdicts, catalogue.entries[i]).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
            set_processor_time(0);
            write_all(file, line);
        }
    }
    _exit(0);
}

std::string why_it_ended(int status) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
        return fmt::format("it needs more than {:g} s of processor time", entry_seconds());
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) return "the system ended it, for example for lack of memory";
    if (WIFSIGNALED(status)) return fmt::format("the program crashed at this entry (signal {}), a defect of the program", WTERMSIG(status));
    return "the program ended at this entry, a defect of the program";
}

EntryOutcome outcome_of(const Json& json, Sources& sources) {
    EntryOutcome outcome;
    for (const Json& row : json["rows"]) outcome.rows.push_back(row_of(row, sources));
    for (const Json& error : json["errors"]) outcome.errors.push_back(diagnostic_of(error, sources));
    outcome.stopped = json["stopped"];
    return outcome;
}

}  // namespace

void check_entries(const Catalogue& catalogue, bool for_pages,
                   const std::function<void(const CatalogueEntry&, const EntryOutcome&)>& done) {
    Sources sources(catalogue.source);
    for (std::size_t next = 0; next < catalogue.entries.size();) {
        std::array<int, 2> pipe_ends{};
        const bool has_pipe = pipe(pipe_ends.data()) == 0;
        const pid_t child = has_pipe ? fork() : -1;
        if (child == 0) {
            close(pipe_ends[0]);
            run_child(catalogue, for_pages, next, pipe_ends[1]);
        }
        if (child > 0) {
            setpgid(child, child);  // here as well: whichever comes first
            Leftovers::all().add_child(child);
        }
        if (child < 0) fail(Id::tool_failed, {}, "the process that checks the entries cannot be started");
        close(pipe_ends[1]);
        std::string waiting;
        std::array<char, 65536> buffer;
        for (ssize_t count; (count = read(pipe_ends[0], buffer.data(), buffer.size())) > 0;) {
            waiting.append(buffer.data(), static_cast<std::size_t>(count));
            for (std::size_t end; (end = waiting.find('\n')) != std::string::npos; waiting.erase(0, end + 1)) {
                const CatalogueEntry& entry = catalogue.entries[next++];
                done(entry, outcome_of(Json::parse(waiting.substr(0, end)), sources));
            }
        }
        close(pipe_ends[0]);
        int status = 0;
        waitpid(child, &status, 0);
        Leftovers::all().remove_child(child);
        if (next < catalogue.entries.size()) {
            const CatalogueEntry& entry = catalogue.entries[next++];
            done(entry, {{}, {}, why_it_ended(status)});
        }
    }
}

}  // namespace dalembert
