// SPDX-License-Identifier: GPL-3.0-or-later
// Names in programs: the model's own where there are any, and never two things with one name.
#pragma once

#include <set>
#include <string>

#include "form/system.hpp"
#include "symbolic/map_pieces.hpp"

namespace dalembert {

/// "phi", "phi_dot", "m_2" for m[2]: a variable as an identifier.
std::string identifier(const Variable& variable);
std::string identifier(const std::string& base, int index, bool is_member);

/// The member that caches value `number`: k0, k1, ..., unless a definition has such a name.
std::string cached_name(const Symbols& symbols, std::size_t number);

/// The table of a measured characteristic: no other characteristic has one of this name.
std::string table_name(const CurvePieces& curve);
std::string table_name(const MapPieces& map);

/// The names of one function.
class NameScope {
public:
    /// Starts with everything that must not be used for something else.
    explicit NameScope(std::set<std::string> taken) : taken_(std::move(taken)) {}
    /// The wanted name, or the next free one like it.
    std::string unique(const std::string& wanted);

private:
    std::set<std::string> taken_;
};

/// Throws Failure (doubly-defined) when two members of families get the same name in a program, as phi_1 and phi[1].
void check_identifiers(const System& system);

}  // namespace dalembert
