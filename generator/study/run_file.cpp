// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/run_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "text/diagnostic.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_file(const std::string& sentence) { throw Failure(Diagnostic{Id::bad_option, {}, sentence}); }

[[noreturn]] void cannot(const fs::path& file, const char* what) {
    throw Failure(Diagnostic{Id::tool_failed, {}, fmt::format("'{}' cannot be {}: {}", file.string(), what, std::strerror(errno))},
                  ExitCode::tool_missing);
}

std::string number(double value) { return std::isnan(value) ? "nan" : detail::number_text(value); }

/// Fields of a line; titles may be quoted.
std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            is_quoted = !is_quoted;
        else if (c == ',' && !is_quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

bool read_number(const std::string& text, double& value) {
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

Column column_of(const std::string& title) {
    const std::size_t open = title.rfind(" [");
    if (open == std::string::npos || title.back() != ']') return {title, ""};
    return {title.substr(0, open), title.substr(open + 2, title.size() - open - 3)};
}

bool read_row(std::string_view line, std::size_t varied, std::size_t observed, RowOfRun& row) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != 3 + varied + observed) return false;
    const auto end = std::from_chars(fields[0].data(), fields[0].data() + fields[0].size(), row.run);
    if (end.ec != std::errc() || end.ptr != fields[0].data() + fields[0].size() || !read_number(fields[2], row.t)) return false;
    row.status = fields[1];
    row.varied.resize(varied);
    row.observed.resize(observed);
    for (std::size_t i = 0; i < varied + observed; ++i)
        if (!read_number(fields[3 + i], i < varied ? row.varied[i] : row.observed[i - varied])) return false;
    return true;
}

/// The text, and how much of it are complete rows of runs that follow each other.
RunTable parsed(const fs::path& file, const std::string& text, std::size_t& complete) {
    const auto bad = [&]() { refuse_file(fmt::format("'{}' is not the result of a study", file.string())); };
    const std::size_t first = text.find('\n'), second = first == std::string::npos ? first : text.find('\n', first + 1);
    if (second == std::string::npos || !text.starts_with("# ")) bad();
    RunTable result;
    std::size_t varied = 0;
    try {
        result.study = nlohmann::ordered_json::parse(text.substr(2, first - 2));
        if (result.study.contains("shard")) {
            result.shard = {result.study["shard"].at("part").get<std::size_t>(), result.study["shard"].at("of").get<std::size_t>()};
            result.study.erase("shard");
        }
        varied = result.study.at("vary").size();
        (void)result.study.at("runs").get<std::size_t>();
    } catch (const nlohmann::json::exception&) {
        bad();
    }
    const std::vector<std::string> titles = fields_of(std::string_view(text).substr(first + 1, second - first - 1));
    if (titles.size() < 3 + varied) bad();
    for (std::size_t i = 3; i < titles.size(); ++i) (i < 3 + varied ? result.varied : result.observed).push_back(column_of(titles[i]));
    complete = second + 1;
    std::size_t expected = result.shard.first(result.study["runs"].get<std::size_t>());
    while (complete < text.size()) {
        const std::size_t end = text.find('\n', complete);
        RowOfRun row{};
        if (end == std::string::npos ||
            !read_row(std::string_view(text).substr(complete, end - complete), varied, result.observed.size(), row) || row.run != expected)
            break;
        result.rows.push_back(std::move(row));
        ++expected;
        complete = end + 1;
    }
    return result;
}

}  // namespace

std::string line_of(const RowOfRun& row) {
    std::string line = fmt::format("{},{},{}", row.run, row.status, number(row.t));
    for (const double value : row.varied) line += "," + number(value);
    for (const double value : row.observed) line += "," + number(value);
    return line + "\n";
}

std::string head_of(const RunTable& table) {
    nlohmann::ordered_json study = table.study;
    if (!table.shard.is_whole()) study["shard"] = {{"part", table.shard.part}, {"of", table.shard.of}};
    std::string head = "# " + study.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\nrun,status,t [s]";
    for (const auto* columns : {&table.varied, &table.observed})
        for (const Column& column : *columns) head += "," + detail::csv_field(column.title());
    return head + "\n";
}

RunTable read_runs(const fs::path& file) {
    std::size_t complete = 0;
    return parsed(file, read_file(file), complete);
}

RunFile::RunFile(const fs::path& file, const RunTable& head) : file_(file) {
    if (file.has_parent_path()) {
        std::error_code ignored;
        fs::create_directories(file.parent_path(), ignored);
    }
    descriptor_.number = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_.number < 0) cannot(file, "opened");
    if (::flock(descriptor_.number, LOCK_EX | LOCK_NB) != 0)
        refuse_file(fmt::format("another study is writing '{}'; wait for it, or give another folder with -o", file.string()));
    const std::string text = read_file(file), wanted = head_of(head);
    std::size_t complete = 0;
    // A file without its head was killed before it had one.
    if (text.size() >= wanted.size() || !wanted.starts_with(text)) {
        if (!text.starts_with(wanted)) {
            const RunTable other = parsed(file, text, complete);
            std::string difference;
            for (const auto& [key, value] : head.study.items())
                if (difference.empty() && (!other.study.contains(key) || other.study[key] != value))
                    difference =
                        fmt::format(": its '{}' is {}, not {}", key, other.study.value(key, nlohmann::ordered_json()).dump(), value.dump());
            refuse_file(
                fmt::format("'{}' belongs to another study{}; move it away, or give another folder with -o", file.string(), difference));
        }
        found_ = parsed(file, text, complete).rows.size();
    }
    if (::ftruncate(descriptor_.number, static_cast<off_t>(complete)) != 0 || ::lseek(descriptor_.number, 0, SEEK_END) < 0)
        cannot(file, "cut");
    if (complete == 0) add(wanted);
}

RunFile::Descriptor::~Descriptor() {
    if (number >= 0) ::close(number);
}

void RunFile::add(const std::string& lines) {
    for (std::size_t done = 0; done < lines.size();) {
        const ssize_t written = ::write(descriptor_.number, lines.data() + done, lines.size() - done);
        if (written < 0 && errno != EINTR) cannot(file_, "written");
        if (written > 0) done += static_cast<std::size_t>(written);
    }
}

RunTable merged(const std::vector<fs::path>& files) {
    std::vector<RunTable> tables;
    for (const fs::path& file : files) tables.push_back(read_runs(file));
    const std::size_t of = tables.front().shard.of, runs = tables.front().study["runs"].get<std::size_t>();
    if (of == 1) refuse_file(fmt::format("'{}' is a whole study, and no shard of one", files.front().string()));
    std::vector<const RunTable*> parts(of, nullptr);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const RunTable& table = tables[i];
        if (table.study != tables.front().study || table.shard.of != of)
            refuse_file(fmt::format("'{}' and '{}' are not shards of the same study", files.front().string(), files[i].string()));
        if (table.shard.part < 1 || table.shard.part > of || parts[table.shard.part - 1] != nullptr)
            refuse_file(fmt::format("shard {} of {} is given twice, in '{}', too", table.shard.part, of, files[i].string()));
        parts[table.shard.part - 1] = &table;
        const std::size_t expected = table.shard.last(runs) - table.shard.first(runs);
        if (table.rows.size() != expected)
            refuse_file(fmt::format("'{}' has {} of its {} runs; start this shard again to go on with it", files[i].string(),
                                    table.rows.size(), expected));
    }
    RunTable whole = tables.front();
    whole.shard = {};
    whole.rows.clear();
    for (std::size_t part = 0; part < of; ++part) {
        if (parts[part] == nullptr) refuse_file(fmt::format("shard {} of {} is missing", part + 1, of));
        whole.rows.insert(whole.rows.end(), parts[part]->rows.begin(), parts[part]->rows.end());
    }
    return whole;
}

}  // namespace dalembert
