// SPDX-License-Identifier: GPL-3.0-or-later
// What tests ask of the proofs of a system.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>

#include "elements/verdict.hpp"
#include "prove/audit.hpp"
#include "prove/normal_form.hpp"

namespace dalembert {

inline bool is_zero_for_all(const GiNaC::ex& e) { return NormalForm().is_zero(e); }

inline bool all_proven(const System& system) {
    const Audit result = audit(system);
    for (const AuditEntry* entry : result.all())
        if (entry->result.verdict != Verdict::proven) MESSAGE(entry->name, ": ", to_string(entry->result.verdict), " ", entry->result.reason);
    return result.all_proven();
}

inline bool any_wrong(const System& system) {
    const Audit result = audit(system);
    const auto entries = result.all();
    return std::any_of(entries.begin(), entries.end(), [](const AuditEntry* entry) { return entry->result.verdict == Verdict::wrong; });
}

/// Negates a value, sees the proofs fail, and puts it back. What is zero on every motion has no sign.
inline void flipped_is_wrong(System& system, GiNaC::ex& value, const std::string& what) {
    if (Prover(system).equal(value, 0).verdict != Verdict::wrong) return;
    CAPTURE(what);
    const GiNaC::ex right = value;
    value = -value;
    CHECK(any_wrong(system));
    value = right;
}

}  // namespace dalembert
