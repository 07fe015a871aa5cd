// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/signs.hpp"

#include <fmt/format.h>

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

bool is_in_scene(const Expression& name, const System& system) {
    const Named* named = system.names.find(name.name);
    return named == nullptr || system.scene.holds(named->item->when);
}

void check_range(const Written& written, const System& system, const StartValues& value) {
    const Expression& e = written.expression;
    const Named* named = e.kind == Expression::Kind::name ? system.names.find(e.name) : nullptr;
    if (named == nullptr || named->kind != Named::Kind::parameter || !named->quantity().range || !named->quantity().range->low) return;
    const Range& range = *named->quantity().range;
    const auto low = value(system.translate(range.low, {}));
    const SignRule& rule = *written.key.sign;
    if (!low || broken(rule, low->csgn(), (*low - 1).csgn()) == nullptr) return;
    throw Failure(Diagnostic{Id::value_out_of_range,
                             e.span,
                             fmt::format("{} must {}, but the range of '{}' begins at {:.6g}{}", written.what,
                                         rule.is_above_zero ? "be positive" : "not be negative", e.name, low->to_double(),
                                         with_space(rule.unit)),
                             {{range.span, "the range is declared here"}}});
}

void check_law(const Written& written, const Indices& indices, const System& system, const StartValues& value,
               const Bounds& of_temperature) {
    const Key& key = written.key;
    if (system.scene.model->curves.empty() || !key.letters.empty()) return;
    Letters letters;
    BoundsOfLetters bounds;
    for (std::size_t i = 0; i < written.bound.size(); ++i) {
        const GiNaC::ex letter = GiNaC::realsymbol(written.bound[i]);
        letters.emplace(written.bound[i], letter);
        const bool is_temperature = key.variables.at(i) == Dimension::temperature();
        const bool is_absolute = is_temperature || key.variables[i] == Dimension::pressure();
        if (is_absolute) bounds.emplace(letter, common(is_temperature ? of_temperature : Bounds{}, {Rational(0), std::nullopt}));
    }
    value.check_curves(*key.sign, system.translate(written.expression, indices, letters), written.expression.span, written.what, bounds);
}

}  // namespace dalembert
