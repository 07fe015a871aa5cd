// SPDX-License-Identifier: GPL-3.0-or-later
// What is fed with any bytes. Whatever they are, a target comes back: what cannot be read is a Failure inside, and everything else that goes
// wrong ends the program.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fuzz {

struct Target {
    const char* name;
    void (*run)(const std::string& bytes);
};

/// Those of the layers text and model.
std::span<const Target> readers();
/// `check`: everything from the file to the proofs.
Target whole();

/// Null where there is none of that name.
const Target* find(std::span<const Target> targets, std::string_view name);

}  // namespace fuzz
