// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert scenes`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace dalembert {

struct ScenesResult {
    struct Row {
        std::string name, doc;
        std::vector<std::string> effects_in, effects_out;
        std::size_t coordinates, plain_states, inputs, outputs, parameters;
        std::string header;  ///< file name
        /// Length of x.
        std::size_t states() const { return 2 * coordinates + plain_states; }
    };
    std::string model;
    std::string default_scene;  ///< empty without one
    std::vector<Row> scenes;
};

std::string as_text(const ScenesResult& result);
nlohmann::ordered_json as_json(const ScenesResult& result);

}  // namespace dalembert
