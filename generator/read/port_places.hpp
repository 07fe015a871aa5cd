// SPDX-License-Identifier: GPL-3.0-or-later
// Where ports of fluids, heat and points stand, and which of two elements can go where they become one.
#pragma once

#include <string>

#include "elements/model.hpp"
#include "elements/parts.hpp"

namespace dalembert {

/// The weaker one goes. Of bodies the ground is given.
enum class Rank { given, follows, stores };

/// An element where fluids, heat or bodies meet.
struct Place {
    Reference to;
    const char* word = "";  ///< "volume"; empty where there is no such element
    Rank rank = Rank::stores;
    std::string medium = {};
    bool is_of_part = false;
    bool is_family = false;  ///< the place is one member of it

    bool can_go() const { return is_of_part && !is_family && rank != Rank::stores; }
    bool is(const Place& other) const;
};

/// "tank", "tank[1]"
std::string written(const Reference& to);
/// "volume 'tank[1]'"
std::string named(const Place& place);
Place place_of(const Model& model, const Reference& to, Port::Kind kind);

/// "volume 'tank[1]', whose state is stored"
std::string said(const Place& place);

}  // namespace dalembert
