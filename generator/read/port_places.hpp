// SPDX-License-Identifier: GPL-3.0-or-later
// Where ports of fluids, heat and points stand, and which of two elements can go where they become one.
#pragma once

#include <string>

#include "elements/model.hpp"
#include "elements/parts.hpp"

namespace dalembert {

/// The weaker one goes.
enum class Rank { given, follows, stores };

/// An element where fluids, heat or bodies meet.
struct Place {
    Reference to;
    const char* word = "";  ///< "volume"; empty where there is no such element
    Rank rank = Rank::stores;
    std::string medium = {};
    bool is_of_part = false;

    bool can_go() const { return is_of_part && rank != Rank::stores; }
};

Place place_of(const Model& model, const Reference& to, Port::Kind kind);

/// "volume 'tank', whose state is stored"
std::string said(const Place& place);

}  // namespace dalembert
