// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/plant_texts.hpp"

#include <fmt/format.h>

#include "emit/equations.hpp"

namespace dalembert {

std::string table_text(const char* title, const std::vector<PlantQuantity>& quantities) {
    std::string text = quantities.empty() ? "" : fmt::format("\n{}\n", title);
    for (const PlantQuantity& q : quantities) text += fmt::format("  {} [{}]  {}\n", q.name, q.unit, q.doc);
    return text;
}

std::string equations_text(const Machine& machine) {
    constexpr std::size_t most = 200000;  // characters
    std::string text = equations_as_text(*machine.system);
    for (const Machine& other : machine.other_modes) text += "\n" + equations_as_text(*other.system);
    return text.size() < most ? text : "The equations are too long to be printed here; `dalembert derive` shows them.\n";
}

}  // namespace dalembert
