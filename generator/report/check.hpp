// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert check`. A check may take long, so texts of its parts are written as they are ready.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline.hpp"
#include "report/book_page.hpp"

namespace dalembert {

/// What was proven of one scene of a model.
struct CheckedScene {
    struct Proof {
        std::string name;
        Verdict verdict;
        std::string reason = {};  ///< why not checkable
    };
    struct Group {
        std::string title;
        std::vector<Proof> proofs;
    };
    std::string sized_name, scene;
    std::vector<Group> groups;  ///< none is empty
    bool failed() const;
};

/// What could not be read, or not be checked.
struct CheckError {
    std::string id;  ///< of the entry; empty for a whole file
    std::string error, message;
    std::string file = {};  ///< empty where there is no place
    std::size_t line = 0, column = 0;
};

struct CheckedFile {
    enum class Kind { model, catalogue, unreadable };
    Kind kind = Kind::model;
    std::string name;                  ///< of the model, or the path of what is unreadable
    BookPart part;                     ///< printed equations; title and edition
    std::vector<CheckedScene> scenes;  ///< of a model
    std::vector<CheckError> errors;
    bool failed = false;               ///< a verdict is not the one that is expected
    std::size_t unread = 0, unchecked = 0, read_in_part = 0;  ///< entries of a catalogue
    std::vector<Diagnostic> unreadable;                       ///< each place once
    bool passed() const;
    /// Of rows that do not say it.
    const std::string& source() const { return kind == Kind::catalogue ? part.title : part.about; }
};

struct CheckResult {
    std::vector<CheckedFile> files;
    std::vector<std::filesystem::path> pages = {};  ///< that were written
    VerdictCounts counts() const;
    bool failed() const;
    /// Every file and entry could be read.
    bool is_whole() const;
};

/// What was proven of a machine. After generate.
CheckedScene checked_scene(const Machine& machine);

CheckError check_error(const std::string& id, const Diagnostic& diagnostic);

std::string as_text(const CheckedScene& scene);
/// The entry of a catalogue that has no verdict; `width` is that of the column of names.
std::string as_text(const BookProblem& problem, std::size_t width);
/// The last lines of a file.
std::string end_of_text(const CheckedFile& file);
/// The last line of several files, and the pages that were written.
std::string as_text(const CheckResult& result);
/// Of several files a list, else the object of the only one.
nlohmann::ordered_json as_json(const CheckResult& result);

}  // namespace dalembert
