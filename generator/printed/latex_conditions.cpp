// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/names.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

/// Nothing is said of the ends: equations are checked inside.
struct KnownRange {
    std::optional<Rational> low, high;
};

std::optional<Rational> plain_number(const ExpressionPtr& e) {
    if (!e) return std::nullopt;
    if (e->kind == Expression::Kind::number) return e->value;
    if (e->kind != Expression::Kind::negate) return std::nullopt;
    const auto inside = plain_number(e->children[0]);
    return inside ? std::optional<Rational>(-*inside) : std::nullopt;
}

class DeclaredRanges {
public:
    DeclaredRanges(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model)
        : catalogue_(catalogue), entry_(entry), model_(model) {}

    /// Whether a condition holds for all that letters may be.
    bool holds(const Expression& condition) const {
        const auto part = [&](std::size_t i) { return holds(*condition.children[i]); };
        if (condition.name == "both") return part(0) && part(1);
        if (condition.name == "either") return part(0) || part(1);
        if (condition.name == "not_equal")
            return plain_number(condition.children[1]).has_value();  // all but one point, at which nothing is checked anyway
        if (condition.name == "equal")
            return std::any_of(entry_.at.begin(), entry_.at.end(), [&](const AtPoint& point) { return is_point(condition, point); });
        const bool is_less = condition.name.starts_with("less"), is_greater = condition.name.starts_with("greater");
        if (!is_less && !is_greater) return false;
        const KnownRange a = range_of(condition.children[is_less ? 0 : 1]), b = range_of(condition.children[is_less ? 1 : 0]);
        return a.high && b.low && *a.high <= *b.low;
    }

private:
    /// x = 2 where the entry is checked at x = 2.
    static bool is_point(const Expression& condition, const AtPoint& point) {
        const auto number = plain_number(condition.children[1]), value = plain_number(point.value);
        return condition.children[0]->kind == Expression::Kind::name && point.variable->name == condition.children[0]->name && number &&
               value && *number == *value;
    }

    KnownRange range_of(const ExpressionPtr& e) const {
        if (const auto number = plain_number(e)) return {number, number};
        if (e->kind != Expression::Kind::name || !e->children.empty()) return {};
        const auto of = [](const Quantity& quantity) {
            return quantity.range ? KnownRange{plain_number(quantity.range->low), plain_number(quantity.range->high)} : KnownRange{};
        };
        if (std::any_of(entry_.letters.begin(), entry_.letters.end(), [&](const PrintedLetter& letter) { return letter.name == e->name; }))
            return {};
        if (model_ != nullptr) {
            const Names names(*model_);
            if (const Named* named = names.find(e->name)) {
                const bool is_quantity = named->kind == Named::Kind::parameter || named->kind == Named::Kind::coordinate ||
                                         named->kind == Named::Kind::input || named->kind == Named::Kind::state;
                return is_quantity ? of(named->quantity()) : KnownRange{};
            }
        }
        for (const auto* letters : {&entry_.own, &catalogue_.letters})
            for (const CatalogueLetter& letter : *letters) {
                if (letter.name != e->name) continue;
                if (const auto value = plain_number(letter.value)) return {value, value};
                KnownRange range = of(letter);
                if (letter.is_positive && !range.low) range.low = Rational(0);
                return range;
            }
        return {};
    }

    const Catalogue& catalogue_;
    const CatalogueEntry& entry_;
    const Model* model_;
};

[[noreturn]] void refuse_condition(const Span& span) {
    fail(Id::not_allowed_here, span,
         fmt::format("the condition '{}' does not follow from the declarations of its letters; put them under 'positive', give them a "
                     "range, or a point with 'at'",
                     span.text()));
}

ExpressionPtr relation_between(Relation relation, const ExpressionPtr& a, const ExpressionPtr& b) {
    const char* name = relation == Relation::less            ? "less"
                       : relation == Relation::less_equal    ? "less_equal"
                       : relation == Relation::greater       ? "greater"
                       : relation == Relation::greater_equal ? "greater_equal"
                       : relation == Relation::not_equal     ? "not_equal"
                                                             : "unknown";
    return std::make_shared<Expression>(Expression{Expression::Kind::call, a->span, 0, name, {a, b}});
}

}  // namespace

bool is_condition(const LatexEquation& read) {
    return !read.relations.empty() && std::none_of(read.relations.begin(), read.relations.end(),
                                                   [](Relation r) { return r == Relation::equal || r == Relation::approximately; });
}

void check_conditions(const LatexEquation& read, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    const DeclaredRanges ranges(catalogue, entry, model);
    for (const ExpressionPtr& condition : read.conditions)
        if (!ranges.holds(*condition)) refuse_condition(condition->span);
    if (!is_condition(read)) return;
    for (std::size_t i = 0; i < read.relations.size(); ++i)
        if (!ranges.holds(*relation_between(read.relations[i], read.equation.sides[i], read.equation.sides[i + 1])))
            refuse_condition(read.equation.span);
}

}  // namespace dalembert
