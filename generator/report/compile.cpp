// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/compile.hpp"

#include <dalembert/plant.h>
#include <fmt/format.h>

#include "report/json_output.hpp"

namespace dalembert {

std::string as_text(const CompileResult& result) {
    return fmt::format("{}\n{}: {} bytes, exports {} (version {})\n{}\n", result.subject.title(), result.plant.string(), result.bytes,
                       DALEMBERT_PLANT_FUNCTION, DALEMBERT_PLANT_VERSION, result.header.string());
}

nlohmann::ordered_json as_json(const CompileResult& result) {
    nlohmann::ordered_json json = json_result("compile", result.subject);
    json["plant"] = result.plant.string();
    json["header"] = result.header.string();
    json["function"] = DALEMBERT_PLANT_FUNCTION;
    json["table_version"] = DALEMBERT_PLANT_VERSION;
    json["bytes"] = result.bytes;
    return json;
}

}  // namespace dalembert
