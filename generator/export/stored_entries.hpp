// SPDX-License-Identifier: GPL-3.0-or-later
// Which entries of an array statements set to something else than a constant.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/statement.hpp"

namespace dalembert {

/// By entry: whether it may be something else than zero. Nothing where the array is filled in ways that tell no single entries.
std::optional<std::vector<bool>> stored_entries(const Statements& statements, const std::string& array, std::size_t size);

/// Marks the entries of an array that are set to something else than a number.
void mark_computed(const Statements& statements, const std::string& array, std::vector<bool>& computed);

}  // namespace dalembert
