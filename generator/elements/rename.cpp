// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/rename.hpp"

#include <algorithm>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "elements/references.hpp"
#include "elements/sites.hpp"
#include "elements/walk.hpp"
#include "language/expression_text.hpp"
#include "language/parser.hpp"
#include "language/vocabulary.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

bool contains(const std::vector<const char*>& kinds, std::string_view kind) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

bool is_of_formulas(const std::vector<const char*>& kinds) {
    return std::all_of(kinds.begin(), kinds.end(),
                       [](std::string_view kind) { return kind == "coordinate" || kind == "state" || kind == "input"; });
}

/// Of the kinds that joins replace.
bool can_stand_for_another(const std::vector<const char*>& kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [](std::string_view kind) {
        return kind == "body" || kind == "volume" || kind == "reservoir" || kind == "junction" || kind == "node" || kind == "medium" ||
               kind == "pin";
    });
}

class RenameWalk {
public:
    using Bound = std::map<std::string, std::string, std::less<>>;  ///< names of indices and variables of laws: what they are called then

    /// Inside a family, if there is one.
    explicit RenameWalk(const Renaming& to, std::optional<Family>* family = nullptr) : to_(to) {
        if (family != nullptr && *family) bind((*family)->index, bound_);
    }

    template <class Member>
    void operator()(const char*, Member& member, const Key& key) const {
        change(member, key);
    }
    void operator()(const char* name, std::string& text, const Key&) const {
        if (std::string_view(name) == "level_of" && !text.empty()) text = to_.prefix + text;
    }
    template <class Value>
    void choice(const char*, const Value&, const Key&, const KeyChoices<Value>&) const {}
    template <class One, class Other>
    void alternatives(const char*, One& one, Other& other, const Key& key) const {
        change(one, key);
        change(other, key);
    }
    void either(const char*, const char*, const char*) const {}
    void by_hand(const char*, const Key&) const {}
    void item(const ItemKeys&) const {}
    template <class Part>
    void table(const char*, std::optional<Part>& part, const Key&) const {
        if (part) describe(*this, *part);
    }
    template <class Part>
    void list(const char*, std::vector<Part>& parts, const Key&) const {
        for (Part& part : parts) {
            if constexpr (requires { part.when; }) change(part.when);
            if constexpr (std::same_as<Part, Unknown> || std::same_as<Part, Bar>) part.name = of_name(part.name);
            describe(*this, part);
        }
    }
    template <class Part>
    void named(const char* name, std::vector<Part>& parts, const Key& key) const {
        list(name, parts, key);
    }
    template <class Of>
    std::optional<Dimension> dimension_of(const Of&) const {
        return std::nullopt;
    }

    void change(std::optional<Condition>& when) const {
        if (when) change(*when);
    }
    void change(Condition& condition) const {
        if (condition.kind == Condition::Kind::effect) condition.effect = of_effect(condition.effect);
        for (Condition& part : condition.parts) change(part);
    }
    void change(PrintedEquation& printed) const {
        Bound letters = bound_;
        for (const PrintedLetter& letter : printed.letters) letters[letter.name] = letter.name;
        const auto each = [&](ExpressionPtr& e) { e = of(e, letters); };
        for (auto* list : {&printed.letters, &printed.shown_letters})
            for (PrintedLetter& letter : *list) each(letter.value);
        for (auto* list : {&printed.equations, &printed.shown, &printed.solved})
            for (Equation& equation : *list) std::for_each(equation.sides.begin(), equation.sides.end(), each);
        for (AtPoint& at : printed.at) {
            each(at.variable);
            each(at.value);
        }
    }
    void change(Family& family) const {
        family.from = of(family.from);
        family.to = of(family.to);
    }

    ExpressionPtr of(const ExpressionPtr& e) const { return e ? of(e, bound_) : e; }
    std::string of_name(const std::string& name) const { return to_.formulas.contains(name) ? to_.prefix + name : name; }

private:
    using Kind = Expression::Kind;

    /// An index or variable that means something else in the model gets the prefix, too.
    void bind(std::string& name, Bound& bound) const {
        const std::string now = to_.taken.contains(name) ? to_.prefix + name : name;
        bound[name] = now;
        name = now;
    }

    std::string of_effect(const std::string& name) const {
        const auto found = to_.effects.find(name);
        return found == to_.effects.end() ? to_.prefix + name : found->second;
    }

    ExpressionPtr of(const ExpressionPtr& e, const Bound& bound) const {
        if (!e || (e->kind == Kind::number)) return e;
        auto made = std::make_shared<Expression>(*e);
        const auto change_children = [&](std::size_t from, const Bound& names) {
            for (std::size_t i = from; i < made->children.size(); ++i) made->children[i] = of(made->children[i], names);
        };
        if (e->kind == Kind::sum) {
            made->children[0] = of(e->children[0], bound);
            made->children[1] = of(e->children[1], bound);
            Bound inside = bound;
            bind(made->name, inside);
            made->children[2] = of(e->children[2], inside);
            return made;
        }
        const QuantitySpec* quantity = e->kind == Kind::name && !e->children.empty() ? find_quantity(e->name) : nullptr;
        if (quantity != nullptr) {
            const std::vector<const char*> kinds = kinds_of_first(*quantity, e->children.size());
            const bool is_element = !kinds.empty() && !is_of_formulas(kinds) && e->children[0]->kind == Kind::name;
            if (is_element) made->children[0] = element(*e->children[0], kinds, bound);
            change_children(is_element ? 1 : 0, bound);
            const bool is_potential = to_.pins && contains(kinds, "pin") && to_.pins->contains(e->children[0]->name);
            return is_potential ? from_own_ground(made) : made;
        }
        change_children(0, bound);
        if (e->kind == Kind::call) made->name = of_name(e->name);
        if (e->kind != Kind::name) return made;
        if (const auto found = bound.find(e->name); found != bound.end()) {
            made->name = found->second;
            return made;
        }
        if (const auto found = to_.values.find(e->name); found != to_.values.end() && e->children.empty()) return found->second;
        made->name = of_name(e->name);
        return made;
    }

    /// The ground of a circuit is that of all parts, but of those that have it as a port.
    bool is_shared(const std::string& name, const std::vector<const char*>& kinds) const {
        return name == ground_pin && contains(kinds, "pin") && !to_.pins;
    }

    /// The potential of a pin from that of the part's own ground.
    ExpressionPtr from_own_ground(const ExpressionPtr& potential) const {
        auto ground = std::make_shared<Expression>(*potential);
        ground->children = {make_name(to_.prefix + ground_pin, potential->children[0]->span)};
        return make_binary(Kind::subtract, potential, ground);
    }

    /// What stands for an element that one of these kinds is; null for itself.
    const Reference* other(const std::string& name, const std::vector<const char*>& kinds) const {
        if (!can_stand_for_another(kinds)) return nullptr;
        const auto found = to_.elements.find(Renaming::key_of(name, contains(kinds, "body")));
        return found == to_.elements.end() ? nullptr : &found->second;
    }

    /// In square brackets: "tank", "tank[2]", "bar.first".
    ExpressionPtr element(const Expression& e, const std::vector<const char*>& kinds, const Bound& bound) const {
        auto made = std::make_shared<Expression>(e);
        for (ExpressionPtr& child : made->children) child = of(child, bound);
        if (is_shared(e.name, kinds)) return made;
        const Reference* instead = other(e.name, kinds);
        made->name = instead == nullptr ? to_.prefix + e.name : instead->name;
        if (instead != nullptr && instead->index) made->children = {instead->index};
        return made;
    }

    void formula_reference(std::string& name, ExpressionPtr& index) const {
        index = of(index);
        if (const auto found = to_.values.find(name); found != to_.values.end() && found->second->kind == Kind::name) {
            name = found->second->name;
            if (!found->second->children.empty()) index = found->second->children[0];
        } else {
            name = of_name(name);
        }
    }

    void change(Reference& reference, const Key& key) const {
        if (reference.name.empty() || is_shared(reference.name, key.refers)) return;
        if (is_of_formulas(key.refers)) return formula_reference(reference.name, reference.index);
        reference.index = of(reference.index);
        const Reference* instead = other(reference.name, key.refers);
        reference.name = instead == nullptr ? to_.prefix + reference.name : instead->name;
        if (instead == nullptr || !instead->index) return;
        reference.index = instead->index;
        reference.span = instead->span;  // where a member is named that may not be there
    }
    void change(CoordinateEntry& entry, const Key&) const {
        if (!entry.coordinate.empty()) formula_reference(entry.coordinate, entry.index);
        entry.value = of(entry.value);
    }
    void change(RunEntry& entry, const Key&) const {
        entry.variable = of(entry.variable);
        entry.value = of(entry.value);
    }
    void change(NamesWithPlaces& names, const Key& key) const {
        if (key.is_own) return;
        for (auto& [name, span] : names) name = of_effect(name);
    }
    void change(std::vector<Plot>& plots, const Key&) const {
        for (Plot& plot : plots) {
            plot.x = of_text(plot.x);
            for (std::string& name : plot.y) name = of_text(name);
        }
    }
    /// "dot(x)"; of what has another name only.
    std::string of_text(const std::string& text) const {
        try {
            const ExpressionPtr written = parse_expression(excerpt_of(std::make_shared<const Source>("plot", text)));
            bool is_meant = false;
            for_each(*written, [&](const Expression& e) { is_meant = is_meant || to_.values.contains(e.name); });
            return is_meant ? in_model_language(*of(written)) : text;
        } catch (const Failure&) {  // told where plots are checked
            return text;
        }
    }
    void change(std::vector<Condition>& conditions, const Key&) const {
        for (Condition& condition : conditions) change(condition);
    }
    void change(ExpressionPtr& e, const Key& key) const {
        Bound inside = bound_;
        for (const char* letter : key.letters) inside[letter] = letter;
        e = of(e, inside);
    }
    void change(Law& law, const Key&) const {
        Bound inside = bound_;
        bind(law.variable, inside);
        law.body = of(law.body, inside);
    }
    void change(Property& property, const Key&) const {
        Bound inside = bound_;
        for (std::string& variable : property.variables) bind(variable, inside);
        property.body = of(property.body, inside);
    }
    void change(Range& range, const Key&) const {
        range.low = of(range.low);
        range.high = of(range.high);
    }
    void change(Turn& turn, const Key&) const { turn.angle = of(turn.angle); }
    void change(BlockPiece& piece, const Key&) const {
        piece.length = of(piece.length);
        piece.cells = of(piece.cells);
    }
    template <Plain Member>
    requires(!std::same_as<Member, NamesWithPlaces> && !std::same_as<Member, std::vector<Condition>> &&
             !std::same_as<Member, std::vector<Plot>>) void change(Member&, const Key&) const {}
    template <class Member, std::size_t n>
    void change(std::array<Member, n>& members, const Key& key) const {
        for (Member& member : members) change(member, key);
    }
    template <class Member>
    requires(!Plain<std::optional<Member>>) void change(std::optional<Member>& member, const Key& key) const {
        if (member) change(*member, key);
    }
    template <class Member>
    requires(!Plain<std::vector<Member>>) void change(std::vector<Member>& members, const Key& key) const {
        for (Member& member : members) change(member, key);
    }

    const Renaming& to_;
    Bound bound_;
};

}  // namespace

void rename(Model& model, const Renaming& renaming) {
    for_each_kind(model, [&](const char*, auto& items) {
        for_each_item(items, [&](auto& item) {
            using Element = std::remove_reference_t<decltype(item)>;
            const RenameWalk outside(renaming);
            std::optional<Family>* family = nullptr;
            if constexpr (std::derived_from<Element, Item>) {
                item.name = renaming.prefix + item.name;
                family = &item.family;
                if (item.family) outside.change(*item.family);
            }
            const RenameWalk inside(renaming, family);
            if constexpr (requires { item.when; }) outside.change(item.when);
            if constexpr (std::same_as<Element, ModeGroup>)
                for (Mode& mode : item.modes) {
                    mode.name = renaming.prefix + mode.name;
                    outside.change(mode.when);
                }
            if constexpr (std::same_as<Element, PrintedEquation>) inside.change(item);
            describe(inside, item);
        });
    });
}

ExpressionPtr renamed(const ExpressionPtr& expression, const Renaming& renaming) { return RenameWalk(renaming).of(expression); }

bool is_named_as_coordinate(const Model& model, const std::string& coordinate) {
    bool is_named = false;
    for_each_kind(model, [&]<class Items>(const char*, const Items& items) {
        for_each_item(items, [&](const auto& item) {
            using Element = std::remove_cvref_t<decltype(item)>;
            if constexpr (!std::same_as<Element, Port>)
                visit_references(item, [&](const Referred& referred) {
                    is_named = is_named || (referred.to.name == coordinate && contains(referred.kinds, "coordinate"));
                });
            visit(item, [&](const Site& site) {
                for_each(*site.expression, [&](const Expression& e) {
                    const QuantitySpec* quantity =
                        e.kind == Expression::Kind::name && !e.children.empty() ? find_quantity(e.name) : nullptr;
                    if (quantity == nullptr) return;
                    for (const ExpressionPtr& child : e.children) is_named = is_named || child->name == coordinate;
                });
            });
        });
    });
    return is_named;
}

}  // namespace dalembert
