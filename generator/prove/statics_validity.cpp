// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/statics_validity.hpp"

#include <fmt/format.h>

namespace dalembert {

namespace {

class SolidCheck {
public:
    SolidCheck(const System& system, const Values& values) : system_(system), at_(values.substitution()) {}

    void check(const Solid& solid) const {
        static constexpr const char* axes[]{"length along x", "length along y", "length along z"};
        for (std::size_t i = 0; solid.size && i < 3; ++i) positive(solid, (*solid.size)[i], axes[i]);
        positive(solid, solid.radius, "radius");
        positive(solid, solid.height, "height");
        not_negative(solid, solid.inner_radius, "inner radius");
        not_negative(solid, solid.top_radius, "radius at the top");
        if (const auto inner = number(solid.inner_radius), outer = number(solid.radius); inner && outer && *inner >= *outer)
            throw Failure(Diagnostic{
                Id::value_out_of_range,
                solid.inner_radius->span,
                fmt::format("the inner radius of solid '{}' is {:.6g} m, not below its radius of {:.6g} m", solid.name, *inner, *outer),
                {{solid.radius->span, "the radius stands here"}}});
        if (const auto mass = number(system_.solids.of(solid.name).mass); mass && *mass <= 0)
            throw Failure(
                Diagnostic{Id::value_out_of_range, solid.span,
                           fmt::format("solid '{}' has the mass {:.6g} kg; {}", solid.name, *mass,
                                       solid.without.empty() ? "a mass is positive"
                                                             : "what is taken away weighs as much as what it is taken from, or more")});
    }

private:
    std::optional<double> number(const GiNaC::ex& e) const {
        const auto value = value_at(system_.symbols.without_definitions(e), at_, 20);
        return value ? std::optional(cln::double_approx(*value)) : std::nullopt;
    }
    std::optional<double> number(const ExpressionPtr& e) const { return e ? number(system_.translate(e, {})) : std::nullopt; }

    void not_negative(const Solid& solid, const ExpressionPtr& length, const char* what) const {
        if (const auto value = number(length); value && *value < 0)
            throw Failure(Diagnostic{Id::value_out_of_range, length->span,
                                     fmt::format("the {} of solid '{}' is {:.6g} m; it cannot be negative", what, solid.name, *value)});
    }

    void positive(const Solid& solid, const ExpressionPtr& length, const char* what) const {
        if (const auto value = number(length); value && *value <= 0)
            throw Failure(Diagnostic{Id::value_out_of_range, length->span,
                                     fmt::format("the {} of solid '{}' is {:.6g} m, but must be positive", what, solid.name, *value)});
        if (!length || length->kind != Expression::Kind::name) return;
        const Named* named = system_.names.find(length->name);
        if (named == nullptr || named->kind != Named::Kind::parameter || !named->quantity().range || !named->quantity().range->low) return;
        const Range& range = *named->quantity().range;
        if (const auto low = number(range.low); low && *low <= 0)
            throw Failure(Diagnostic{Id::value_out_of_range,
                                     length->span,
                                     fmt::format("the {} of solid '{}' must be positive, but the range of '{}' begins at {:.6g} m", what,
                                                 solid.name, length->name, *low),
                                     {{range.span, "the range is declared here"}}});
    }

    const System& system_;
    GiNaC::exmap at_;
};

}  // namespace

void check_solid_values(const System& system, const Values& values) {
    const SolidCheck check(system, values);
    for (const Solid* solid : system.scene.solids) check.check(*solid);
}

}  // namespace dalembert
