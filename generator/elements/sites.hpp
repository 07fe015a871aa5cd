// SPDX-License-Identifier: GPL-3.0-or-later
// Every expression of a model with what it is for and what it may depend on. Checks and the choice of a scene walk over these,
// so that no expression is forgotten by one of them.
#pragma once

#include <functional>

#include "elements/dependence.hpp"
#include "elements/item.hpp"
#include "elements/kinds.hpp"

namespace dalembert {

struct Site {
    const Expression* expression;
    unsigned allowed;
    std::string what;  ///< "the mass of body 'rod'"
    /// Names that mean something here only: family index, variable of a law, letters of a printed equation.
    std::vector<std::string> bound;
    /// sizes only: bounds of a family
    bool sizes_only = false;
    /// the state named here may be left out of a scene
    bool may_be_absent = false;
    /// the bound names may be names of the model too: p and T of a medium's law
    bool may_shadow = false;
};

using SiteVisitor = std::function<void(const Site&)>;

/// The sites of one item of any kind; those of its family come first.
template <class Described>
void visit(const Described& item, const SiteVisitor& visitor);

/// All sites of a model, in the order of its sections; of elements that switch those that were written, and not what they stand for.
void visit(const Model& model, const SiteVisitor& visitor);

}  // namespace dalembert
