// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/statics_validity.hpp"

#include <fmt/format.h>

#include "elements/statics.hpp"
#include "form/signs.hpp"

namespace dalembert {

namespace {

class SolidCheck {
public:
    SolidCheck(const System& system, const Values& values, ValueConditions* conditions)
        : system_(system), value_(system, values, conditions) {}

    void check(const Solid& solid) const {
        check_signs(solid, solid.name, {}, system_, value_);
        using Rule = ValueCondition::Rule;
        if (solid.inner_radius && solid.radius)
            value_.note({Rule::below,
                         {system_.translate(solid.inner_radius, {}), system_.translate(solid.radius, {})},
                         fmt::format("the inner radius of solid '{}' is {{}} m, not below its radius of {{}} m", solid.name)});
        value_.note({Rule::above_zero,
                     {system_.solids.of(solid.name).mass},
                     fmt::format("solid '{}' has the mass {{}} kg, but must have one above zero", solid.name)});
        if (const auto inner = number(solid.inner_radius), outer = number(solid.radius); inner && outer && *inner >= *outer)
            throw Failure(Diagnostic{
                Id::value_out_of_range,
                solid.inner_radius->span,
                fmt::format("the inner radius of solid '{}' is {:.6g} m, not below its radius of {:.6g} m", solid.name, *inner, *outer),
                {{solid.radius->span, "the radius stands here"}}});
        if (const auto mass = number(system_.solids.of(solid.name).mass); mass && *mass <= 0)
            throw Failure(Diagnostic{
                Id::value_out_of_range, solid.span,
                fmt::format("solid '{}' has the mass {:.6g} kg; {}", solid.name, *mass,
                            solid.without.empty() ? "a mass is positive"
                                                  : "the solids taken away weigh as much as the solid that contains them, or more")});
    }

private:
    std::optional<double> number(const GiNaC::ex& e) const {
        const auto value = value_(e);
        return value ? std::optional(value->to_double()) : std::nullopt;
    }
    std::optional<double> number(const ExpressionPtr& e) const { return e ? number(system_.translate(e, {})) : std::nullopt; }

    const System& system_;
    StartValues value_;
};

}  // namespace

void check_solid_values(const System& system, const Values& values, ValueConditions* conditions) {
    const SolidCheck check(system, values, conditions);
    for (const Solid* solid : system.scene.solids) check.check(*solid);
}

}  // namespace dalembert
