// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/new.hpp"

#include <fmt/format.h>

#include "report/json_output.hpp"

namespace dalembert {

std::string as_text(const NewResult& result) {
    std::string text = fmt::format("{}, a project of the kind {}: {}\n", result.project, result.kind, result.doc);
    for (const std::filesystem::path& file : result.files) text += "  " + file.string() + "\n";
    return text + fmt::format("Next: go there with `cd {}`, and try the three commands of its README.md.\n", result.folder.string());
}

nlohmann::ordered_json as_json(const NewResult& result) {
    nlohmann::ordered_json json = json_result("new", result.project);
    json["kind"] = result.kind;
    json["doc"] = result.doc;
    json["folder"] = result.folder.string();
    json["files"] = json_list(result.files);
    return json;
}

}  // namespace dalembert
