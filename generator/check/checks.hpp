// SPDX-License-Identifier: GPL-3.0-or-later
// The checks that a model passes after it was read and before anything is chosen from it. Each reports all that it finds.
#pragma once

#include <optional>
#include <set>

#include "elements/names.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Validity and uniqueness of names; definitions that need themselves. The other checks rely on this one.
void check_names(const Model& model, Diagnostics& diagnostics);

struct NameProblem {
    Id id;
    std::string sentence;
};

/// Of a name that a model cannot have: it is that of files and of a C++ namespace.
std::optional<NameProblem> problem_of_model_name(const std::string& name);

/// Every word of every expression: defined, with the right index and arguments, and nothing that its place must not depend on.
void check_expressions(const Model& model, Diagnostics& diagnostics);

/// "a body", "an enclosure"
std::string with_article(const std::string& words);

/// The same of one printed equation.
void check_expressions(const PrintedEquation& printed, const Names& names, Diagnostics& diagnostics);

/// Behind "'r_bold_S' is not defined": how to say what is printed as "\mathbf r_S", or which known name may be meant.
std::string hint_for_unknown(const Expression& name, const Names& names);

/// That no expression is too large when the definitions in it are written out. For what has passed the other checks.
void check_written_sizes(const Model& model, Diagnostics& diagnostics);
void check_written_sizes(const PrintedEquation& printed, const Names& names, Diagnostics& diagnostics);

/// Of letters that are in no header, so that only words of the model language are taken.
void check_letter_names(const Model& letters, Diagnostics& diagnostics);

/// States that volumes, pipes, nodes, rods, blocks and branches determine.
class Claims {
public:
    Claims(const Names& names, Diagnostics& diagnostics) : names_(names), diagnostics_(diagnostics) {}

    /// The state that a key of an item names, which nothing else may determine. `what` is "volume 'tank'". Null, with an error, if it names
    /// none.
    const State* claim(const std::string& name, const Span& span, const char* key, const std::string& what);
    const State* claim(const Expression& named, const char* key, const std::string& what);
    /// Reports states that nothing determines.
    void check_all(const Model& model) const;

private:
    const Names& names_;
    Diagnostics& diagnostics_;
    std::set<std::string> claimed_;
};

/// What balances are about: whether laws fit media, and that each state is determined.
void check_balances(const Model& model, Diagnostics& diagnostics);
/// Media, volumes, reservoirs and flows.
void check_fluids(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics);
/// Nodes, links, rods, blocks and enclosures.
void check_heat(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics);
/// Capacitors and inductors.
void check_circuits(const Model& model, Claims& claims, Diagnostics& diagnostics);
/// Warns of volumes that can reach zero within the declared ranges of coordinates and states, at the default parameters.
void warn_of_vanishing(const Model& model, Diagnostics& diagnostics);
/// What items refer to by name: other elements, as their descriptions say, effects, scenes and what is plotted. The other checks say
/// nothing of names that this one does not find.
void check_references(const Model& model, Diagnostics& diagnostics);

/// Modes, constraints and events: what they refer to, what a mode must not change, guards that never move.
void check_switching(const Model& model, Diagnostics& diagnostics);

/// Of a controller that samples: what it may have, and that it does not know the time. Of other models: that no state has a next value.
void check_sampling(const Model& model, Diagnostics& diagnostics);
/// That parameters of controllers depend on parameters alone. For what has passed check_expressions().
void check_controller_parameters(const Model& model, Diagnostics& diagnostics);

/// Units of every expression, and that both sides of everything agree.
void check_units(const Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
