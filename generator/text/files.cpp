// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "text/budgets.hpp"
#include "text/diagnostic.hpp"
#include "text/guardian.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(Id id, std::string message, ExitCode exit_code = ExitCode::bad_input) {
    throw Failure(Diagnostic{id, {}, std::move(message)}, exit_code);
}

/// The offset of the first byte that is no UTF-8 text: a malformed sequence or a control character.
std::optional<std::size_t> first_bad_byte(const std::string& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char c = byte(i);
        if (c < 0x80) {
            if ((c < 0x20 && c != '\n' && c != '\r' && c != '\t') || c == 0x7F) return i;
            ++i;
            continue;
        }
        const std::size_t more = c >= 0xF0 && c < 0xF5 ? 3 : c >= 0xE0 && c < 0xF0 ? 2 : c >= 0xC2 && c < 0xE0 ? 1 : 0;
        if (more == 0 || i + more >= text.size()) return i;
        for (std::size_t k = 1; k <= more; ++k)
            if ((byte(i + k) & 0xC0U) != 0x80U) return i;
        i += more + 1;
    }
    return std::nullopt;
}

/// Of what is no regular file the size is not known: -1.
void check_size(const std::string& name, std::uintmax_t size) {
    if (size != static_cast<std::uintmax_t>(-1) && size > budget::file_bytes)
        fail(Id::file_too_large, fmt::format("the file '{}' has {} bytes; a model has at most {}", name, size, budget::file_bytes));
}

}  // namespace

std::string read_file(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) fail(Id::unreadable_file, fmt::format("there is no file '{}'", path.string()));
    if (fs::is_directory(path, error)) fail(Id::unreadable_file, fmt::format("'{}' is a folder, not a file", path.string()));
    std::ifstream in(path, std::ios::binary);
    if (!in) fail(Id::unreadable_file, fmt::format("the file '{}' cannot be read", path.string()));
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

FileStamp stamp_of(const fs::path& path) {
    std::error_code error;
    FileStamp stamp{fs::last_write_time(path, error)};
    if (error) return {};
    stamp.size = fs::file_size(path, error);
    return error ? FileStamp{} : stamp;
}

namespace {

thread_local FilesRead* files_read = nullptr;

}  // namespace

FilesRead::FilesRead() : outer_(std::exchange(files_read, this)) {}
FilesRead::~FilesRead() { files_read = outer_; }

void FilesRead::note(const fs::path& path) {
    for (FilesRead* to = files_read; to != nullptr; to = to->outer_)
        if (std::none_of(to->files_.begin(), to->files_.end(), [&](const auto& file) { return file.first == path; }))
            to->files_.emplace_back(path, stamp_of(path));
}

SourcePtr read_text_file(const fs::path& path) {
    FilesRead::note(path);
    std::error_code error;
    check_size(path.string(), fs::file_size(path, error));
    return source_of(path.string(), read_file(path));
}

SourcePtr source_of(const std::string& name, std::string text) {
    check_size(name, text.size());
    auto source = std::make_shared<const Source>(name, std::move(text));
    if (const auto bad = first_bad_byte(source->text()))
        throw Failure(Diagnostic{Id::not_text,
                                 Span{source, *bad, *bad + 1},
                                 fmt::format("byte {} is 0x{:02X}, but a model file is UTF-8 text without control characters", *bad + 1,
                                             static_cast<unsigned char>(source->text()[*bad]))});
    return source;
}

void write_files(const FileContents& files) {
    const auto not_ending = Leftovers::all().hold();
    std::vector<fs::path> made_folders;
    std::vector<std::pair<fs::path, fs::path>> pending;  // temporary, final
    std::error_code error;
    const auto undo = [&] {
        std::error_code ignored;
        for (const auto& [temporary, final_path] : pending) fs::remove(temporary, ignored);
        for (auto folder = made_folders.rbegin(); folder != made_folders.rend(); ++folder) fs::remove(*folder, ignored);
    };
    const auto stop = [&](const fs::path& path, const std::string& why) {
        undo();
        fail(Id::unreadable_file, fmt::format("'{}' cannot be written: {}", path.string(), why), ExitCode::tool_missing);
    };

    for (const auto& [path, content] : files) {
        const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
        std::vector<fs::path> missing;
        for (fs::path p = folder; !p.empty() && !fs::exists(p, error); p = p.parent_path()) missing.push_back(p);
        for (auto p = missing.rbegin(); p != missing.rend(); ++p) {
            if (!fs::create_directory(*p, error) && error) stop(*p, error.message());
            made_folders.push_back(*p);
        }
        const fs::path temporary = path.string() + ".part";
        errno = 0;
        std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
        pending.emplace_back(temporary, path);
        out << content;
        out.close();
        if (!out) stop(path, errno != 0 ? std::generic_category().message(errno) : "the disk is full");
    }
    for (const auto& [temporary, path] : pending) {
        const bool unchanged = fs::is_regular_file(path, error) && read_file(path) == read_file(temporary);
        if (unchanged) {
            fs::remove(temporary, error);
        } else {
            fs::rename(temporary, path, error);
            if (error) stop(path, error.message());
        }
    }
}

}  // namespace dalembert
