// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/switching_validity.hpp"

#include <fmt/format.h>

#include "elements/model.hpp"
#include "form/random_points.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

void check_switching_values(const System& system, const Values& values, ValueConditions* conditions) {
    const GiNaC::exmap at = values.substitution();
    const auto value = [&](const ExpressionPtr& e) -> std::optional<cln::cl_R> {
        if ((dependence(*e, system.names) & ~on_parameters) != 0) return std::nullopt;
        return value_at(system.symbols.without_definitions(system.translate(e, {})).subs(at, GiNaC::subs_options::no_pattern), {}, 40);
    };
    // Of what depends on parameters alone.
    using Rule = ValueCondition::Rule;
    const auto note = [&](Rule rule, std::initializer_list<ExpressionPtr> of, std::string text) {
        if (conditions == nullptr) return;
        ValueCondition condition{rule, {}, std::move(text)};
        for (const ExpressionPtr& e : of) {
            if (!e || (dependence(*e, system.names) & ~on_parameters) != 0) return;
            condition.values.push_back(system.translate(e, {}));
        }
        conditions->push_back(std::move(condition));
    };
    const auto in_range = [&](const ExpressionPtr& e, const Item& item, const char* what, bool has_end) {
        note(has_end ? Rule::share : Rule::not_below_zero, {e},
             fmt::format("the {} of '{}' is {{}}; {}", what, item.name,
                         has_end ? "it must lie between 0 and 1" : "it must not be negative"));
        const auto number = e ? value(e) : std::nullopt;
        if (!number || (!cln::minusp(*number) && (!has_end || *number <= cln::cl_R(1)))) return;
        throw Failure(Diagnostic{Id::value_out_of_range, e->span,
                                 fmt::format("the {} of '{}' is {}; {}", what, item.name, cln::double_approx(*number),
                                             has_end ? "it must lie between 0 and 1" : "it must not be negative")});
    };
    for (const Contact& contact : system.scene.model->contacts) {
        if (!contact.play || !system.scene.holds(contact.when)) continue;
        note(Rule::above_zero, {contact.play}, fmt::format("the play of contact '{}' is {{}}, but must be positive", contact.name));
        const auto play = value(contact.play);
        if (play && !cln::plusp(*play))
            throw Failure(
                Diagnostic{Id::value_out_of_range, contact.play->span,
                           fmt::format("the play of contact '{}' is {}, but must be positive; without play, a spring acts on both sides",
                                       contact.name, cln::double_approx(*play))});
    }
    for (const Saturation& saturation : system.scene.model->saturations) {
        if (!system.scene.holds(saturation.when)) continue;
        note(Rule::below, {saturation.low, saturation.high},
             fmt::format("the lower limit of saturation '{}' is {{}}; it must be below the upper one, which is {{}}", saturation.name));
        const auto low = value(saturation.low), high = value(saturation.high);
        if (low && high && *low >= *high)
            throw Failure(Diagnostic{Id::value_out_of_range,
                                     saturation.low->span,
                                     fmt::format("the lower limit of saturation '{}' is {}; it must be below the upper one, which is {}",
                                                 saturation.name, cln::double_approx(*low), cln::double_approx(*high)),
                                     {{saturation.high->span, "the upper limit"}}});
    }
    for (const Event& event : system.scene.model->events)
        if (system.scene.holds(event.when)) in_range(event.restitution, event, "restitution", true);
    for (const Friction& friction : system.scene.model->frictions) {
        if (!system.scene.holds(friction.when)) continue;
        in_range(friction.coefficient, friction, "coefficient", false);
        if (!friction.static_coefficient) continue;
        note(Rule::not_above, {friction.coefficient, friction.static_coefficient},
             fmt::format("friction '{0}' has the sliding coefficient {{}}, above its static coefficient {{}}", friction.name));
        const auto sliding = value(friction.coefficient), holding = value(friction.static_coefficient);
        if (!sliding || !holding || *sliding <= *holding) continue;
        throw Failure(Diagnostic{Id::wrong_modes,
                                 friction.static_coefficient->span,
                                 fmt::format("friction '{}' has the static coefficient {}, less than the sliding coefficient {}: after a "
                                             "stop it could neither stick nor slide",
                                             friction.name, cln::double_approx(*holding), cln::double_approx(*sliding)),
                                 {{friction.coefficient->span, "of sliding"}}});
    }
}

}  // namespace dalembert
