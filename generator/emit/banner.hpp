// SPDX-License-Identifier: GPL-3.0-or-later
// The comment at the top of a generated header: command, scene, what was proven, what each function costs, licence.
#pragma once

#include "prove/effect_size.hpp"
#include "graph/verify.hpp"

namespace dalembert {

/// What was proven of a system and of its code.
struct Proofs {
    Audit derivation;
    std::vector<AuditEntry> emitted;

    bool all_proven() const;
};

/// `command` is shown as it is: normalised, without paths.
std::string banner(const std::vector<const Code*>& modes, const Proofs& proofs, const std::vector<EffectSize>& effects_out,
                   const std::string& command);

}  // namespace dalembert
