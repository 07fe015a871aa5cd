// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "check/units.hpp"
#include "elements/every_kind.hpp"
#include "elements/walk.hpp"

namespace dalembert {

namespace {

/// The units of the expressions of one item, by its description.
class ItemUnits {
public:
    explicit ItemUnits(Units& units) : units_(units) {}

    void operator()(const Written& written) const {
        const Key& key = written.key;
        if (written.is_of_sizes || key.unit) return;
        Units::Bound bound;
        for (std::size_t i = 0; i < written.bound.size(); ++i) bound.emplace(written.bound[i], key.variables.at(i));
        std::optional<Dimension> expected = key.dimension;
        if (written.like != nullptr) expected = units_.of(*written.like, {}).dimension;
        if (written.along != nullptr && expected) expected = *expected / units_.of_coordinate(written.along->coordinate);
        if (expected) units_.expect(written.expression, *expected, written.what, bound);
        else if (bound.empty()) measure(written.expression);
        else units_.of(written.expression, bound);
    }

    /// Reports what disagrees in it once, however often it is asked for.
    Measure measure(const Expression& e) const {
        const auto known = measured_.find(&e);
        return known != measured_.end() ? known->second : measured_.emplace(&e, units_.of(e, {})).first->second;
    }

    /// None where every unit fits.
    std::optional<Dimension> dimension_of(const ExpressionPtr& e) const {
        if (!e) return std::nullopt;
        const Measure found = measure(*e);
        return found.fits_all ? std::nullopt : std::optional(found.dimension);
    }
    std::optional<Dimension> dimension_of(const CoordinateEntry& entry) const { return units_.of_coordinate(entry.coordinate); }

private:
    Units& units_;
    mutable std::map<const Expression*, Measure> measured_;
};

/// Values with units are checked when they are converted, printed equations when they are proven.
class UnitCheck {
public:
    UnitCheck(const Model& model, const Names& names, Diagnostics& diagnostics)
        : model_(model), units_(names, diagnostics), diagnostics_(diagnostics) {}

    void run() {
        for_each_kind(model_, [&](const char*, const auto& items) { for_each_item(items, [&](const auto& item) { check(item); }); });
    }

private:
    template <class Described>
    void check(const Described& item) {
        if constexpr (requires { item.is_made; })
            if (item.is_made) return;
        const ItemUnits units(units_);
        walk(item, units);
        if constexpr (requires { agree(item, units); }) agree(item, units);
    }

    // What descriptions do not say: units of several expressions together.

    void agree(const Friction& friction, const ItemUnits& units) {
        const Dimension force = Dimension::power() / units.measure(*friction.rate).dimension;
        const Measure normal = units.measure(*friction.normal_force);
        const Measure sliding = units.measure(*friction.coefficient);
        if (!normal.fits_all && !sliding.fits_all && normal.dimension * sliding.dimension != force)
            diagnostics_.error(
                Id::unit_mismatch, friction.coefficient->span,
                fmt::format("the force of friction '{}' is its coefficient times its normal force; it must be in '{}', but is in '{}'",
                            friction.name, force.usual_unit(), (normal.dimension * sliding.dimension).usual_unit()),
                {{friction.normal_force->span, fmt::format("the normal force is in '{}'", normal.dimension.usual_unit())}});
    }

    void agree(const Profile& profile, const ItemUnits& units) {
        Measure value{Dimension::none(), true};
        for (const Phase& phase : profile.phases) {
            if (value.fits_all) value = units.measure(*phase.value);
            else
                units_.expect(*phase.value, value.dimension,
                              fmt::format("the value in phase '{}', as in the phases before, of profile '{}'", phase.name, profile.name));
        }
    }

    const Model& model_;
    Units units_;
    Diagnostics& diagnostics_;
};

}  // namespace

void check_units(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    UnitCheck(model, names, diagnostics).run();
}

}  // namespace dalembert
