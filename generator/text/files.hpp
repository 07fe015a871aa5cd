// SPDX-License-Identifier: GPL-3.0-or-later
// Reading model files with limits, and writing results whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "text/source.hpp"

namespace dalembert {

/// Reads a UTF-8 text of at most 1 MB. Throws Failure (unreadable-file, file-too-large, not-text).
SourcePtr read_text_file(const std::filesystem::path& path);

/// A text of at most 1 MB as such a file is. Throws Failure (file-too-large, not-text).
SourcePtr source_of(const std::string& name, std::string text);

/// When a file was written last, and its size; none where there is no file.
struct FileStamp {
    std::optional<std::filesystem::file_time_type> time;
    std::uintmax_t size = 0;

    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
FileStamp stamp_of(const std::filesystem::path& path);

/// The files of models and data that this thread reads while the object lives, also those that are missing.
class FilesRead {
public:
    FilesRead();
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;
    ~FilesRead();

    /// Each file once, in the order of reading, as it was before it was read.
    const std::vector<std::pair<std::filesystem::path, FileStamp>>& files() const { return files_; }
    static void note(const std::filesystem::path& path);

private:
    std::vector<std::pair<std::filesystem::path, FileStamp>> files_;
    FilesRead* outer_;
};

/// Reads any file. Throws Failure (unreadable-file).
std::string read_file(const std::filesystem::path& path);

using FileContents = std::vector<std::pair<std::filesystem::path, std::string>>;

/// Writes all files or none: each is written beside its place first and renamed when all are complete.
/// Makes missing folders. A file that has the same content already keeps its time stamp.
/// Throws Failure (unreadable-file) with exit code 3 and leaves nothing behind.
void write_files(const FileContents& files);

}  // namespace dalembert
