// SPDX-License-Identifier: GPL-3.0-or-later
// A visitor of descriptions that gives the elements of a model other names, wherever these stand.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "elements/item.hpp"
#include "elements/kinds.hpp"

namespace dalembert {

struct Renaming {
    std::string prefix;                                        ///< of the names of all elements: "left_"
    std::set<std::string, std::less<>> formulas;               ///< names in expressions that get the prefix
    std::map<std::string, ExpressionPtr, std::less<>> values;  ///< of a name in expressions: what stands instead
    std::map<std::string, Reference, std::less<>> elements;    ///< what another element stands for; of a body as "body NAME"
    std::map<std::string, std::string, std::less<>> effects;
    std::set<std::string, std::less<>> taken = {};             ///< names that an index or a variable of a law cannot have any more

    /// Of a part that has its ground as a port: all its pins. Its ground gets the prefix, too, and potentials count from there.
    std::optional<std::set<std::string, std::less<>>> pins = {};

    static std::string key_of(const std::string& name, bool is_body) { return is_body ? "body " + name : name; }
};

void rename(Model& model, const Renaming& renaming);

ExpressionPtr renamed(const ExpressionPtr& expression, const Renaming& renaming);

/// Whether something but formulas names a coordinate: a generalised force on it, say.
bool is_named_as_coordinate(const Model& model, const std::string& coordinate);

}  // namespace dalembert
