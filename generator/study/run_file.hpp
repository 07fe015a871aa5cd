// SPDX-License-Identifier: GPL-3.0-or-later
// The CSV file of a study: a comment that says which study it belongs to, titles, and a row each run, in order of their numbers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <dalembert/recording.hpp>

namespace dalembert {

/// Which runs a file has: all, or those of the i-th of n parts.
struct Shard {
    std::size_t part = 1, of = 1;
    std::size_t first(std::size_t runs) const { return begin(part - 1, runs); }
    std::size_t last(std::size_t runs) const { return begin(part, runs); }  ///< behind it
    bool is_whole() const { return of == 1; }

private:
    std::size_t begin(std::size_t k, std::size_t runs) const { return runs / of * k + std::min(k, runs % of); }
};

struct RowOfRun {
    std::size_t run;
    std::string status;
    double t;  ///< s, where it ended
    std::vector<double> varied, observed;
    /// Whether the run came to its end, or to that of an event of the model.
    bool is_good() const { return status == "success" || status.starts_with("ended by "); }
};

struct RunTable {
    nlohmann::ordered_json study;  ///< what the comment says
    Shard shard;
    std::vector<Column> varied, observed;
    std::vector<RowOfRun> rows;
};

/// A line of the file with its end. Numbers read back as they were.
std::string line_of(const RowOfRun& row);
/// The comment and the titles.
std::string head_of(const RunTable& table);

/// Reads complete rows. Throws Failure (unreadable-file, bad-option: no file of a study).
RunTable read_runs(const std::filesystem::path& file);

/// Adds rows to a file, which it begins or goes on with. Nobody else may at the same time.
class RunFile {
public:
    /// A torn last line is cut off. Throws Failure (bad-option: the file belongs to another study; unreadable-file, tool-failed).
    RunFile(const std::filesystem::path& file, const RunTable& head);

    /// How many of its runs were there.
    std::size_t found() const { return found_; }
    /// Whole lines. Throws Failure (tool-failed).
    void add(const std::string& lines);

private:
    /// Closes its file, also where a constructor throws: with it goes the lock.
    struct Descriptor {
        int number = -1;
        Descriptor() = default;
        Descriptor(const Descriptor&) = delete;
        Descriptor& operator=(const Descriptor&) = delete;
        ~Descriptor();
    };

    std::filesystem::path file_;
    Descriptor descriptor_;
    std::size_t found_ = 0;
};

/// The whole of several shards, in any order. Throws Failure (bad-option: they do not fit, or one is missing or not complete).
RunTable merged(const std::vector<std::filesystem::path>& files);

}  // namespace dalembert
