// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of the JSON results, for `dalembert help json`; a test holds them against what the verbs print.
#pragma once

#include <span>

namespace dalembert {

struct JsonField {
    const char* path;  ///< [] stands for the elements of an array, <NAME> for keys that the model decides
    const char* doc;
};

struct JsonSchema {
    const char* verb;
    std::span<const JsonField> fields;  ///< beside those of every result
};

/// schema, version, model
std::span<const JsonField> common_json_fields();
std::span<const JsonSchema> json_schemas();

}  // namespace dalembert
