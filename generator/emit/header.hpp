// SPDX-License-Identifier: GPL-3.0-or-later
// The generated header: tables, functions, banner.
#pragma once

#include "graph/verify.hpp"

namespace dalembert {

inline constexpr const char* program_version = "0.1.0";
inline constexpr int header_api_version = 1;

/// What was proven of a system and of its code.
struct Proofs {
    Audit derivation;
    std::vector<AuditEntry> emitted;

    bool all_proven() const;
};

struct Header {
    std::string file_name;   ///< NAME_SCENE.hpp
    std::string name_space;  ///< NAME::SCENE
    std::string text;
};

/// The name of the header of a scene, without making it.
std::string header_name(const Scene& scene);
std::string header_namespace(const Scene& scene);

/// `command` is what the banner shows: normalised, without paths.
Header make_header(const Code& code, const Proofs& proofs, const std::string& command);

}  // namespace dalembert
