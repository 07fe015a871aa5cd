// SPDX-License-Identifier: GPL-3.0-or-later
// What a model says where springs, dampers and constraints stand for a friction, a contact or a stop.
#pragma once

#include <optional>
#include <string>

#include "elements/model.hpp"

namespace dalembert {

struct Maker {
    std::string kind;  ///< "friction", "contact" or "stop"
    std::string name;
};

/// The friction, contact or stop that brings an element; nothing where the model has the element itself.
std::optional<Maker> maker_of(const Item& item, const Model& model);

}  // namespace dalembert
