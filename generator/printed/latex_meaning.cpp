// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_meaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "elements/names.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

ExpressionPtr node(Kind kind, const Span& span, std::vector<ExpressionPtr> children, std::string name = {}) {
    return std::make_shared<Expression>(Expression{kind, span, 0, std::move(name), std::move(children)});
}
ExpressionPtr call(const char* name, const Span& span, std::vector<ExpressionPtr> children) {
    return node(Kind::call, span, std::move(children), name);
}

bool is_call_named(const Expression& e, std::string_view name) { return e.kind == Kind::call && e.name == name; }
bool is_open_integral(const Expression& e) { return is_call_named(e, "integral") && e.children.size() == 2; }
bool is_constant(const Expression& e) { return e.kind == Kind::name && e.name == "constant"; }

bool has_open_integral(const Expression& e) {
    bool has = false;
    for_each(e, [&](const Expression& part) { has = has || is_open_integral(part); });
    return has;
}

/// What an expression is made of, also by way of the letters that the entry explains.
class Reach {
public:
    Reach(const Catalogue& catalogue, const CatalogueEntry& entry, const Expression& e) : catalogue_(catalogue), entry_(entry) { visit(e); }

    bool has(const std::string& name) const { return names_.contains(name); }
    const std::set<std::string>& names() const { return names_; }

private:
    void visit(const Expression& e) {
        for_each(e, [&](const Expression& part) {
            if (part.kind != Kind::name || !names_.insert(part.name).second) return;
            for (const PrintedLetter& letter : entry_.letters)
                if (letter.name == part.name) visit(*letter.value);
            for (const LatexMeaning& meaning : catalogue_.notation)
                if (meaning.letter.text == part.name) visit(*meaning.value);
        });
    }

    const Catalogue& catalogue_;
    const CatalogueEntry& entry_;
    std::set<std::string> names_;
};

class Meanings {
public:
    Meanings(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model)
        : catalogue_(catalogue), entry_(entry), model_(model) {}

    ExpressionPtr operator()(const ExpressionPtr& e) const {
        auto copy = std::make_shared<Expression>(*e);
        for (ExpressionPtr& child : copy->children) child = (*this)(child);
        if (copy->kind != Kind::call) return copy;
        if (copy->name == "sum_over") return sum(*copy);
        if (copy->name == "gradient" || copy->name == "laplacian" || copy->name == "divergence") return nabla(*copy);
        return copy;
    }

private:
    /// The bounds of the families with this index, where all that occur have the same ones.
    ExpressionPtr sum(const Expression& e) const {
        if (e.children.size() != 2) {
            const char* const remedy = e.children.size() < 2 ? "write its index and limits, as in '\\sum_{i=1}^{N}'"
                                                             : "write out the members, or a sum with limits";
            fail(Id::not_allowed_here, e.span, fmt::format("the members of the sum '{}' are not known; {}", e.span.text(), remedy));
        }
        const std::string& index = e.children[1]->name;
        const Family* known = nullptr;
        for_each(*e.children[0], [&](const Expression& part) {
            const bool is_member =
                part.kind == Kind::name && std::any_of(part.children.begin(), part.children.end(),
                                                       [&](const ExpressionPtr& i) { return i->kind == Kind::name && i->name == index; });
            const Family* const family = is_member ? family_of(part.name) : nullptr;
            if (family == nullptr) return;
            if (known != nullptr && !(is_same(*known->from, *family->from) && is_same(*known->to, *family->to)))
                fail(Id::not_allowed_here, e.span,
                     fmt::format("the sum '{}' is over families of different sizes; write its limits", e.span.text()));
            known = family;
        });
        if (known == nullptr)
            fail(Id::not_allowed_here, e.span,
                 fmt::format(
                     "the range of '{}' in '{}' is not known; write '\\sum_{{{}=1}}^{{N}}', or declare a letter with for = \"{} = 1..3\"",
                     index, e.span.text(), index, index));
        return node(Kind::sum, e.span, {known->from, known->to, e.children[0]}, index);
    }

    static bool is_same(const Expression& a, const Expression& b) {
        return a.kind == Kind::number && b.kind == Kind::number && a.value == b.value;
    }

    const Family* family_of(const std::string& name) const {
        for (const auto* letters : {&entry_.own, &catalogue_.letters})
            for (const CatalogueLetter& letter : *letters)
                if (letter.name == name) return letter.family ? &*letter.family : nullptr;
        if (model_ == nullptr) return nullptr;
        const Names names(*model_);
        const Named* const named = names.find(name);
        return named != nullptr && named->item->family ? &*named->item->family : nullptr;
    }

    /// In Cartesian coordinates.
    ExpressionPtr nabla(const Expression& e) const {
        const ExpressionPtr& inside = e.children[0];
        if (catalogue_.coordinates.empty())
            fail(Id::not_allowed_here, e.span,
                 fmt::format("the coordinates of '\\nabla' in '{}' are not known; if they are Cartesian, write coordinates = [\"x\", "
                             "\"y\", \"z\"] under [catalogue]",
                             e.span.text()));
        const Reach reach(catalogue_, entry_, *inside);
        if (std::none_of(catalogue_.coordinates.begin(), catalogue_.coordinates.end(), [&](const std::string& x) { return reach.has(x); }))
            fail(Id::not_allowed_here, inside->span,
                 fmt::format("the program does not know how '{}' depends on the coordinates; give its expression under 'with'",
                             inside->span.text()));
        std::vector<ExpressionPtr> parts, places;
        for (const std::string& x : catalogue_.coordinates) {
            const ExpressionPtr place = make_name(x, e.span);
            places.push_back(place);
            ExpressionPtr slope = call("diff", e.span, {inside, place});
            parts.push_back(e.name == "laplacian" ? call("diff", e.span, {std::move(slope), place}) : std::move(slope));
        }
        if (e.name == "gradient") return call("vector", e.span, std::move(parts));
        if (e.name == "divergence")
            return call("trace", e.span, {call("diff", e.span, {inside, call("vector", e.span, std::move(places))})});
        ExpressionPtr total = parts.front();
        for (std::size_t i = 1; i < parts.size(); ++i) total = node(Kind::add, e.span, {std::move(total), parts[i]});
        return total;
    }

    const Catalogue& catalogue_;
    const CatalogueEntry& entry_;
    const Model* model_;
};

/// Sides and their derivatives by the letter that is integrated over.
class Differentiation {
public:
    Differentiation(const Catalogue& catalogue, const CatalogueEntry& entry, const std::string& variable)
        : catalogue_(catalogue), entry_(entry), variable_(variable) {}

    ExpressionPtr operator()(const ExpressionPtr& e) const {
        const Span& span = e->span;
        if (is_constant(*e)) return make_number(0, span);
        const bool has_constant =
            (e->kind == Kind::add || e->kind == Kind::subtract) && (is_constant(*e->children[0]) || is_constant(*e->children[1]));
        if (!has_open_integral(*e) && !has_constant) return call("diff", span, {e, make_name(variable_, span)});
        if (is_open_integral(*e)) {
            if (e->children[1]->name != variable_)
                fail(Id::not_allowed_here, span,
                     fmt::format("the integrals run over '{}' and '{}'; write limits, so that each has a value", variable_,
                                 e->children[1]->written()));
            return e->children[0];
        }
        const auto part = [&](std::size_t i) { return (*this)(e->children[i]); };
        switch (e->kind) {
            case Kind::negate: return node(e->kind, span, {part(0)});
            case Kind::add:
            case Kind::subtract: return node(e->kind, span, {part(0), part(1)});
            case Kind::multiply:
            case Kind::divide: {
                const bool is_second = has_open_integral(*e->children[1]);
                const Expression& factor = *e->children[is_second ? 0 : 1];
                if ((is_second && e->kind == Kind::divide) || Reach(catalogue_, entry_, factor).has(variable_) || has_open_integral(factor))
                    break;
                return is_second ? node(e->kind, span, {e->children[0], part(1)}) : node(e->kind, span, {part(0), e->children[1]});
            }
            default: break;
        }
        fail(Id::not_allowed_here, span,
             fmt::format("the integral without limits in '{}' is neither a term of a sum nor one with a constant factor, so its constant "
                         "matters; write limits",
                         span.text()));
    }

private:
    const Catalogue& catalogue_;
    const CatalogueEntry& entry_;
    const std::string& variable_;
};

/// What moves in a model, also as a quantity that is derived.
bool moves(const Model& model, const Reach& reach) {
    const Names names(model);
    return std::any_of(reach.names().begin(), reach.names().end(), [&](const std::string& name) {
        const Named* const named = names.find(name);
        const bool is_moving = named != nullptr && (named->kind == Named::Kind::coordinate || named->kind == Named::Kind::state);
        return is_moving || (named == nullptr && find_quantity(name) != nullptr);
    });
}

}  // namespace

ExpressionPtr with_known_meaning(const ExpressionPtr& e, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    return Meanings(catalogue, entry, model)(e);
}

void take_constants_out(LatexEquation& read, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    std::vector<ExpressionPtr>& sides = read.equation.sides;
    const Expression* integral = nullptr;
    for (const ExpressionPtr& side : sides)
        for_each(*side, [&](const Expression& part) {
            if (integral == nullptr && is_open_integral(part)) integral = &part;
        });
    const auto is_equality = [](Relation relation) { return relation == Relation::equal; };
    if (!std::all_of(read.relations.begin(), read.relations.end(), is_equality) || !entry.solved.empty()) return;
    if (integral != nullptr) {
        const std::string variable = integral->children[1]->name;
        if (integral->children[1]->kind != Kind::name) return;
        for (ExpressionPtr& side : sides) {
            const bool is_plain = !has_open_integral(*side) && !is_constant(*side);
            if (is_plain && !Reach(catalogue, entry, *side).has(variable))
                fail(Id::not_allowed_here, side->span,
                     fmt::format("the program does not know how '{}' depends on '{}', the variable of the integral '{}'; write limits, or "
                                 "give its expression under 'with'",
                                 side->span.text(), variable, integral->span.text()));
            side = Differentiation(catalogue, entry, variable)(side);
        }
        return;
    }
    if (sides.size() != 2 || model == nullptr || is_constant(*sides[0]) || !is_constant(*sides[1]) ||
        !moves(*model, Reach(catalogue, entry, *sides[0])))
        return;
    sides = {call("dot", sides[0]->span, {sides[0]}), make_number(0, sides[1]->span)};
}

void mark_rounded(Equation& equation) {
    const std::function<ExpressionPtr(const ExpressionPtr&)> marked = [&](const ExpressionPtr& e) -> ExpressionPtr {
        if (e->kind == Kind::negate) return node(Kind::negate, e->span, {marked(e->children[0])});
        const bool has_decimals =
            e->kind == Kind::number && !is_zero(e->value) && e->span.text().find_first_of(".,") != std::string_view::npos;
        if (!has_decimals) return e;
        auto copy = std::make_shared<Expression>(*e);
        copy->name = "rounded";
        return copy;
    };
    for (ExpressionPtr& side : equation.sides)
        if (side->kind == Kind::number || (side->kind == Kind::negate && side->children[0]->kind == Kind::number)) side = marked(side);
}

bool is_rounded(const Expression& e) {
    const Expression& number = e.kind == Kind::negate ? *e.children[0] : e;
    return number.kind == Kind::number && number.name == "rounded";
}

}  // namespace dalembert
