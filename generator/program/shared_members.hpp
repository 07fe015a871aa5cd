// SPDX-License-Identifier: GPL-3.0-or-later
// What the modes of one machine share in its header.
#pragma once

#include <set>

#include "program/jacobian_layout.hpp"

namespace dalembert {

/// Members for what depends on parameters alone, and patterns of Jacobians.
class SharedMembers {
public:
    explicit SharedMembers(std::vector<const Code*> modes);

    const JacobianLayout& layout(By by) const { return layouts_[static_cast<std::size_t>(by)]; }
    /// Whether a definition is a member of the header: those of the model, and the steps that some function but update() uses.
    bool is_kept(std::size_t definition) const { return !only_in_update_.contains(definition); }
    const std::set<std::size_t>& only_in_update() const { return only_in_update_; }
    /// The number of a cached value of a mode, or nothing where no function uses it. Equal values have one number.
    const std::map<std::uint32_t, std::size_t>& cached(const Code& mode) const { return cached_.at(&mode); }
    /// Whether the header has a function.
    bool has(const HeaderFunction& function) const;
    /// Whether runs are brought back to constraints: nothing has to be where integration keeps exactly what they hold.
    bool has_projection() const;
    bool has_modes() const { return modes_.size() > 1 || !modes_.front()->system.scene.modes.empty(); }

private:
    std::vector<const Code*> modes_;
    std::vector<JacobianLayout> layouts_;
    std::set<std::size_t> only_in_update_;
    std::map<const Code*, std::map<std::uint32_t, std::size_t>> cached_;
};

}  // namespace dalembert
