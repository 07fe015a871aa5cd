// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/runtime.hpp"

#include <fmt/format.h>

#include "js/from_c.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// The interface of a plant, without what binds it to C.
std::string_view plant_interface() {
    const std::string_view text = embedded_file("plant.h"), end = "} dalembert_plant;";
    const std::size_t begin = text.find("/* Name in the model");
    return text.substr(begin, text.find(end) + end.size() - begin);
}

/// In the order in which one needs the other.
constexpr const char* parts[]{"projection", "accumulation", "modes",       "modes_logic",  "modes_calls", "jumps",       "run",
                              "control",    "dop853",       "jacobian",    "rodas5p",      "choice",      "guards",
                              "bracket",    "events",       "collocation", "independence", "singular",    "steps",
                              "passing",    "run_memory",   "run_calls",   "scales"};

}  // namespace

std::string javascript_runtime() {
    CUnit unit;
    parse_c(plant_interface(), unit);
    for (const char* part : parts) parse_c(embedded_file(fmt::format("dalembert_{}.h", part)), unit);
    // Memory is an affair of each language, and no state is saved.
    const FromC options{
        .left_out = {"dalembert_take",          "dalembert_numbers",          "dalembert_modes_lay_kept", "dalembert_modes_lay_work",
                     "dalembert_modes_set",     "dalembert_modes_new",        "dalembert_modes_free",     "dalembert_modes_note",
                     "dalembert_modes_recall",  "dalembert_modes_saved_size", "dalembert_modes_save",     "dalembert_modes_load",
                     "dalembert_lay_candidate", "dalembert_lay_polynomial",   "dalembert_lay_run",        "dalembert_run_new",
                     "dalembert_run_free",      "dalembert_run_message",      "dalembert_run_saved_size", "dalembert_run_save",
                     "dalembert_run_load"}};
    std::string text = std::string(embedded_file("mathematics.js")) + javascript_from(unit, options);
    for (const char* file : {"memory.js", "plant.js", "record.js"}) text += embedded_file(file);
    return text;
}

}  // namespace dalembert
