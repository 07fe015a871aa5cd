// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/export.hpp"

#include <fmt/format.h>

#include <map>

#include "report/json_output.hpp"

namespace dalembert {

std::string as_text(const ExportResult& result) {
    std::string text = fmt::format("{}\nfor {}, {}:\n", result.subject.title(), result.target,
                                   result.all_proven ? "everything proven" : "some parts only numerically equal");
    constexpr std::size_t most_listed = 8;
    std::map<std::filesystem::path, std::vector<const ExportResult::File*>> folders;
    for (const ExportResult::File& file : result.files) folders[file.path.parent_path()].push_back(&file);
    for (const auto& [folder, files] : folders) {
        std::size_t bytes = 0;
        for (const ExportResult::File* file : files) {
            bytes += file->bytes;
            if (files.size() <= most_listed) text += fmt::format("  {} ({} bytes)\n", file->path.string(), file->bytes);
        }
        if (files.size() > most_listed) text += fmt::format("  {}/ ({} files, {} bytes)\n", folder.string(), files.size(), bytes);
    }
    for (const std::string& note : result.notes) text += fmt::format("note: {}\n", note);
    return text;
}

nlohmann::ordered_json as_json(const ExportResult& result) {
    nlohmann::ordered_json json = json_result("export", result.subject);
    json["target"] = result.target;
    json["all_proven"] = result.all_proven;
    json["written"] = nlohmann::ordered_json::array();
    for (const ExportResult::File& file : result.files) json["written"].push_back({{"path", file.path.string()}, {"bytes", file.bytes}});
    json["notes"] = result.notes;
    return json;
}

}  // namespace dalembert
