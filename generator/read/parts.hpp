// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a model: their elements get the name of the part before their own, values that are set, and are joined at ports. What
// comes out is the model that would be written by hand.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "elements/model.hpp"
#include "elements/parts.hpp"
#include "read/document.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// A part as its file says, with its own parts in it.
struct Part {
    std::string name;
    Model model;
    std::set<std::string, std::less<>> formulas;  ///< names that expressions of the part may use
};

/// The parts become elements of the model. Throws Failure, or collects problems.
void join_parts(Model& model, std::vector<Part> parts, Diagnostics& diagnostics);

/// Writes "left.p_1" as "left_p_1" wherever one of these names stands before a point, and { left.p_1 = ... } likewise.
void join_names(DocumentNode& root, const std::vector<std::string>& parts);

/// The text of a file that a model uses as a part. Throws Failure, also where the part would contain itself.
/// `word` is what it is in sentences.
SourcePtr source_of_part(const DocumentNode::Member& use, const DocumentNode& file, const char* word = "part");

}  // namespace dalembert
