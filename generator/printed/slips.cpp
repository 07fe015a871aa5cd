// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/slips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "language/vocabulary.hpp"
#include "language/expression_text.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

struct Change {
    SlipKind kind;
    std::string words;
    ExpressionPtr tree;     ///< the whole with the change
    ExpressionPtr printed;  ///< the part that is changed
    ExpressionPtr mended;
    int weight = 0;         ///< among those of one kind
};

ExpressionPtr rebuilt(const Expression& e, std::vector<ExpressionPtr> children) {
    auto copy = std::make_shared<Expression>(e);
    copy->children = std::move(children);
    return copy;
}

ExpressionPtr node(Kind kind, const Span& span, std::vector<ExpressionPtr> children, std::string name = {}) {
    return std::make_shared<Expression>(Expression{kind, span, 0, std::move(name), std::move(children)});
}

ExpressionPtr call(const std::string& name, const ExpressionPtr& argument) { return node(Kind::call, argument->span, {argument}, name); }

bool is_sum(const Expression& e) { return e.kind == Kind::add || e.kind == Kind::subtract; }

/// Entries of matrices and values of cases are terms of their own.
bool has_entries(const Expression& e) {
    return e.kind == Kind::call && (e.name == "row" || e.name == "vector" || e.name == "diag" || e.name == "cases");
}

/// Where cases leave nothing out, another condition does not either; else it would only say less.
bool is_condition(const Expression& e, std::size_t i) {
    return e.kind == Kind::call && e.name == "cases" && i % 2 == 1 && e.children.size() % 2 == 0;
}

/// "m_1" and "m_2" have the stem "m".
std::string stem(const std::string& name) { return name.substr(0, name.find('_')); }

/// The name of a function that another is mixed up with.
using NamePair = std::pair<const char*, const char*>;
constexpr NamePair mixed_up[]{{"sin", "cos"},   {"sinh", "cosh"}, {"sin", "sinh"},  {"cos", "cosh"},  {"tan", "tanh"},
                              {"asin", "acos"}, {"tan", "atan"},  {"exp", "expm1"}, {"log", "log1p"}, {"min", "max"}};
constexpr NamePair rarely_mixed_up[]{{"tanh", "cosh"}, {"tanh", "sinh"}, {"tan", "sin"}, {"tan", "cos"}};

/// A letter of the text may stand for an expression. Dots of a letter belong to the text, and so does a row of a single entry.
bool stands_for_letter(const Expression& e) {
    if (!e.span || (e.kind == Kind::call && (e.name == "dot" || e.name == "ddot" || e.name == "row"))) return false;
    return std::any_of(e.children.begin(), e.children.end(), [&](const ExpressionPtr& child) {
        return child->span.source == e.span.source && child->span.begin == e.span.begin && child->span.end == e.span.end;
    });
}

/// The minus that the first factor of a term has; null where it has none.
ExpressionPtr leading_minus(const ExpressionPtr& e) {
    if (e->kind == Kind::negate) return e;
    return e->kind == Kind::multiply || e->kind == Kind::divide ? leading_minus(e->children[0]) : nullptr;
}

/// The term with another part in the place of that minus.
ExpressionPtr with_leading(const ExpressionPtr& e, const ExpressionPtr& instead) {
    return e->kind == Kind::negate ? instead : rebuilt(*e, {with_leading(e->children[0], instead), e->children[1]});
}

/// 2, -2, 1/2: numbers alone, without units.
bool is_number(const Expression& e) {
    if (e.kind == Kind::number) return is_integer(e.value) && e.name.empty();
    return (e.kind == Kind::negate || e.kind == Kind::divide) &&
           std::all_of(e.children.begin(), e.children.end(), [](const ExpressionPtr& child) { return is_number(*child); });
}

/// 2/4 and 3/1, which nobody prints.
bool is_unreduced(const Expression& e) {
    const auto is_whole = [](const Expression& part) { return part.kind == Kind::number && is_integer(part.value); };
    if (e.kind != Kind::divide || !is_whole(*e.children[0]) || !is_whole(*e.children[1])) return false;
    const Rational &above = e.children[0]->value, &below = e.children[1]->value;
    return below == 1 || (!is_zero(below) && cln::denominator(above / below) != cln::numerator(below));
}

/// Of several slips in a factor that come to the same the shortest text is meant: one number less, another number, a factor, a fraction.
enum FactorWeight : int { left_out, other_number, other_factor, broken_number };

/// Whether all letters of a side are what others say of them. There a slip is seldom.
bool is_said(const Expression& side, const SlipOptions& options) {
    if (!options.is_wide) return false;
    bool has_letter = false, is_all = true;
    for_each(side, [&](const Expression& e) {
        if (e.kind != Kind::name || e.name == "t" || e.name == "pi") return;
        has_letter = true;
        is_all = is_all && (find_quantity(e.name) != nullptr || options.said.contains(e.name));
    });
    return side.kind == Kind::name || (has_letter && is_all);
}

class Slips {
public:
    Slips(const std::vector<KnownLetter>& letters, const SlipOptions& options) : letters_(letters), options_(options) {}

    /// Every change of a tree. `is_term` says that it stands alone or in a sum, so that it may have a sign and a factor of its own.
    std::vector<Change> of(const ExpressionPtr& e, bool is_term) {
        std::vector<Change> found;
        const auto add = [&](SlipKind kind, std::string words, const ExpressionPtr& tree, int weight = 0) {
            found.push_back({kind, std::move(words), tree, e, tree, weight});
        };
        if (is_term) {
            if (const ExpressionPtr minus = leading_minus(e); minus && minus != e) found.push_back(without_minus(e, minus));
            term(e, add);
        }
        if (stands_for_letter(*e)) return found;
        switch (e->kind) {
            case Kind::number: number(*e, add); return found;
            case Kind::name: name(e, add); return found;
            case Kind::negate: add(SlipKind::sign, fmt::format("the sign of '{}'", spelled(*e->children[0])), e->children[0]); break;
            case Kind::add:
            case Kind::subtract: sum(*e, add); break;
            case Kind::multiply:
            case Kind::divide: product(*e, add); break;
            case Kind::power: power(e, add); break;
            case Kind::call: function(e, add); break;
            case Kind::sum: break;
        }
        if (options_.is_wide && !is_term && is_sum(*e)) square(e, add);
        for (std::size_t i = 0; i < e->children.size(); ++i) {
            if (e->kind == Kind::sum && i < 2) continue;
            if (e->kind == Kind::call &&
                (e->name == "diff" || e->name == "integral" || e->name == "limit" || e->name == "at" || e->name == "quantity") && i == 1)
                continue;
            if (e->kind == Kind::call && e->name == "limit" && i == 3) continue;  // its side
            if (is_condition(*e, i)) continue;
            for (Change& change : of(e->children[i], (is_sum(*e) || has_entries(*e)) && !is_sum(*e->children[i]))) {
                std::vector<ExpressionPtr> children = e->children;
                children[i] = change.tree;
                change.tree = rebuilt(*e, std::move(children));
                if (is_unreduced(*change.tree)) change.weight = broken_number;
                found.push_back(std::move(change));
            }
        }
        return found;
    }

private:
    std::string spelled(const Expression& e) const { return options_.spelled ? options_.spelled(e) : in_model_language(e); }

    /// The minus alone is changed, so that the rest of the term stays as it is printed.
    Change without_minus(const ExpressionPtr& e, const ExpressionPtr& minus) const {
        std::string text = spelled(*e);
        text.erase(0, text.find_first_not_of("- "));
        return {SlipKind::sign, fmt::format("the sign of '{}'", text), with_leading(e, minus->children[0]), minus, minus->children[0]};
    }

    template <class Add>
    void square(const ExpressionPtr& e, Add add) {
        add(SlipKind::exponent, fmt::format("'{}' must be squared", spelled(*e)), node(Kind::power, e->span, {e, make_number(2, e->span)}));
    }

    template <class Add>
    void term(const ExpressionPtr& e, Add add) {
        if (e->kind == Kind::number && is_zero(e->value)) return;
        const std::string text = spelled(*e);
        if (!leading_minus(e)) add(SlipKind::sign, fmt::format("the sign of '{}'", text), node(Kind::negate, e->span, {e}));
        for (const int factor : {2, 3, 4}) {
            add(SlipKind::factor, fmt::format("'{}' lacks a factor {}", text, factor),
                node(Kind::multiply, e->span, {make_number(factor, e->span), e}), other_factor);
            add(SlipKind::factor, fmt::format("'{}' is {} times too large", text, factor),
                node(Kind::divide, e->span, {e, make_number(factor, e->span)}), other_factor);
        }
        if (!options_.is_wide) return;
        for (const KnownLetter& letter : letters_) {
            const ExpressionPtr factor = make_name(letter.name, e->span);
            add(SlipKind::letter, fmt::format("'{}' lacks the factor '{}'", text, spelled(*factor)),
                node(Kind::multiply, e->span, {factor, e}));
            add(SlipKind::letter, fmt::format("'{}' has the extra factor '{}'", text, spelled(*factor)),
                node(Kind::divide, e->span, {e, factor}));
        }
    }

    template <class Add>
    void number(const Expression& e, Add add) {
        const auto other = [&](const Rational& value) { return make_number(value, e.span); };
        if (is_zero(e.value)) return;
        const auto instead = [&](const Rational& value) {
            add(SlipKind::factor, fmt::format("{} instead of {}", spelled(*other(value)), spelled(e)), other(value),
                is_integer(value) || !is_integer(e.value) ? other_number : broken_number);
        };
        instead(e.value + 1);
        if (e.value != 1) instead(e.value - 1);
        instead(e.value * 2);
        instead(e.value / 2);
    }

    template <class Add>
    void name(const ExpressionPtr& e, Add add) {
        if (find_quantity(e->name) != nullptr) return quantity(*e, add);
        if (e->name == "pi" || e->name == "infinity") return;
        const auto own = std::find_if(letters_.begin(), letters_.end(), [&](const KnownLetter& l) { return l.name == e->name; });
        for (const KnownLetter& letter : letters_) {
            if (letter.name == e->name) continue;
            const bool has_unit = own != letters_.end() && own->unit == letter.unit;
            if (!has_unit && stem(letter.name) != stem(e->name)) continue;
            auto other = std::make_shared<Expression>(*e);
            other->name = letter.name;
            add(SlipKind::index, fmt::format("'{}' instead of '{}'", spelled(*other), spelled(*e)), other);
        }
        indices(*e, 0, add);
        if (own == letters_.end()) return;
        square(e, add);
        add(SlipKind::dot, fmt::format("a dot is missing on '{}'", spelled(*e)), call("dot", e));
    }

    /// position[bob, 1]: another axis.
    template <class Add>
    void quantity(const Expression& e, Add add) {
        indices(e, 1, add);
    }

    template <class Add>
    void indices(const Expression& e, std::size_t from, Add add) {
        for (std::size_t i = from; i < e.children.size(); ++i) {
            if (e.children[i]->kind != Kind::number) continue;
            for (const int step : {1, -1}) {
                if (e.children[i]->value + step < 1) continue;
                std::vector<ExpressionPtr> children = e.children;
                children[i] = make_number(e.children[i]->value + step, e.span);
                const ExpressionPtr other = rebuilt(e, std::move(children));
                add(SlipKind::index, fmt::format("'{}' instead of '{}'", spelled(*other), spelled(e)), other);
            }
        }
    }

    template <class Add>
    void sum(const Expression& e, Add add) {
        const bool plus = e.kind == Kind::add;
        const ExpressionPtr &a = e.children[0], &b = e.children[1];
        add(SlipKind::sign, fmt::format("'{}' instead of '{}' before '{}'", plus ? '-' : '+', plus ? '+' : '-', spelled(*b)),
            node(plus ? Kind::subtract : Kind::add, e.span, {a, b}));
        add(SlipKind::term, fmt::format("without '{}'", spelled(*b)), a);
        add(SlipKind::term, fmt::format("without '{}'", spelled(*a)), plus ? b : node(Kind::negate, e.span, {b}));
        // a*b + c for a*(b + c), a/c + b for (a + b)/c, and the like.
        const auto sums = [&](const ExpressionPtr& x, const ExpressionPtr& y) { return node(e.kind, e.span, {x, y}); };
        const auto bracket = [&](ExpressionPtr tree) {
            add(SlipKind::bracket, fmt::format("a bracket around '{}'", spelled(e)), std::move(tree));
        };
        if (a->kind == Kind::multiply) bracket(rebuilt(*a, {a->children[0], sums(a->children[1], b)}));
        if (b->kind == Kind::multiply) bracket(rebuilt(*b, {sums(a, b->children[0]), b->children[1]}));
        if (b->kind == Kind::divide) bracket(rebuilt(*b, {sums(a, b->children[0]), b->children[1]}));
        if (a->kind == Kind::divide) bracket(rebuilt(*a, {a->children[0], sums(a->children[1], b)}));
        if (a->kind == Kind::call && a->children.size() == 1) bracket(rebuilt(*a, {sums(a->children[0], b)}));
        if (is_sum(*b))
            add(SlipKind::bracket, fmt::format("no bracket around '{}'", spelled(*b)),
                rebuilt(*b, {sums(a, b->children[0]), b->children[1]}));
    }

    template <class Add>
    void product(const Expression& e, Add add) {
        const ExpressionPtr &a = e.children[0], &b = e.children[1];
        const bool times = e.kind == Kind::multiply;
        if (options_.is_wide) number_left_out(e, add);
        if (times) add(SlipKind::exponent, fmt::format("'{}' belongs below", spelled(*b)), node(Kind::divide, e.span, {a, b}));
        else add(SlipKind::exponent, fmt::format("'{}' belongs above", spelled(*b)), node(Kind::multiply, e.span, {a, b}));
        if (times && options_.is_wide && a->kind != Kind::multiply && a->kind != Kind::divide)
            add(SlipKind::exponent, fmt::format("'{}' belongs below", spelled(*a)), node(Kind::divide, e.span, {b, a}));
        if (!times) add(SlipKind::exponent, fmt::format("'{}' is upside down", spelled(e)), node(Kind::divide, e.span, {b, a}));
        const auto opened = [&](const Expression& inner, const ExpressionPtr& first, const ExpressionPtr& second) {
            add(SlipKind::bracket, fmt::format("no bracket around '{}'", in_model_language(inner)),
                node(inner.kind, e.span, {first, second}));
        };
        if (is_sum(*b)) opened(*b, rebuilt(e, {a, b->children[0]}), b->children[1]);
        if (is_sum(*a)) opened(*a, a->children[0], rebuilt(e, {a->children[1], b}));
        if (!times && b->kind == Kind::multiply) opened(*b, rebuilt(e, {a, b->children[0]}), b->children[1]);
    }

    template <class Add>
    void number_left_out(const Expression& e, Add add) {
        const ExpressionPtr &a = e.children[0], &b = e.children[1];
        const auto leave_out = [&](const ExpressionPtr& number, const ExpressionPtr& rest, const char* words) {
            const ExpressionPtr minus = leading_minus(number);
            const ExpressionPtr size = minus ? with_leading(number, minus->children[0]) : number;
            if (!is_number(*number) || is_number(*rest) || (size->kind == Kind::number && size->value == 1)) return;
            add(SlipKind::factor, fmt::format(fmt::runtime(words), spelled(*size), spelled(*rest)),
                minus ? node(Kind::negate, e.span, {rest}) : rest, left_out);
        };
        leave_out(b, a, e.kind == Kind::multiply ? "no factor {} behind '{}'" : "no division by {} of '{}'");
        if (e.kind == Kind::multiply) leave_out(a, b, "no factor {} before '{}'");
    }

    template <class Add>
    void power(const ExpressionPtr& e, Add add) {
        const ExpressionPtr &base = e->children[0], &exponent = e->children[1];
        const auto other = [&](const Rational& value) {
            add(SlipKind::exponent, fmt::format("'{}' to the power {}", spelled(*base), spelled(*make_number(value, e->span))),
                value == 1 ? base : rebuilt(*e, {base, make_number(value, e->span)}));
        };
        if (exponent->kind == Kind::number) {
            other(exponent->value + 1);
            if (exponent->value != 1) other(exponent->value - 1);
            other(-exponent->value);
        } else {
            add(SlipKind::exponent, fmt::format("the sign of the exponent of '{}'", spelled(*base)),
                rebuilt(*e, {base, node(Kind::negate, e->span, {exponent})}));
        }
        if (base->kind == Kind::multiply || base->kind == Kind::divide)
            add(SlipKind::bracket, fmt::format("no bracket around '{}'", spelled(*base)),
                rebuilt(*base, {base->children[0], rebuilt(*e, {base->children[1], exponent})}));
    }

    template <class Add>
    void function(const ExpressionPtr& e, Add add) {
        if (e->children.empty()) return;
        const ExpressionPtr& x = e->children[0];
        const auto mixed_up_with = [&](const NamePair& names) {
            for (const auto& [from, to] : {names, NamePair(names.second, names.first)}) {
                if (e->name != from) continue;
                auto other = std::make_shared<Expression>(*e);
                other->name = to;
                add(SlipKind::function, fmt::format("{} instead of {} in '{}'", to, from, spelled(*e)), other);
            }
        };
        std::for_each(std::begin(mixed_up), std::end(mixed_up), mixed_up_with);
        if (options_.is_wide) std::for_each(std::begin(rarely_mixed_up), std::end(rarely_mixed_up), mixed_up_with);
        if (options_.is_wide && (e->name == "dot" || e->name == "ddot" || e->name == "integral")) square(e, add);
        if (e->name == "dot") {
            add(SlipKind::dot, fmt::format("'{}' without its dot", spelled(*x)), x);
            add(SlipKind::dot, fmt::format("a second dot is missing on '{}'", spelled(*x)), call("ddot", x));
        }
        if (e->name == "ddot") add(SlipKind::dot, fmt::format("one dot on '{}'", spelled(*x)), call("dot", x));
        if (e->name == "cases" && e->children.size() > 2) {
            std::vector<ExpressionPtr> children = e->children;
            std::swap(children[0], children[2]);
            add(SlipKind::sign, fmt::format("'{}' and '{}' change places", spelled(*x), spelled(*e->children[2])),
                rebuilt(*e, std::move(children)));
        }
        if (e->name == "less" || e->name == "greater" || e->name == "less_equal" || e->name == "greater_equal") {
            auto other = std::make_shared<Expression>(*e);
            other->name = e->name.starts_with("less") ? "greater" : "less";
            add(SlipKind::sign,
                fmt::format("'{}' instead of '{}' between '{}' and '{}'", e->name.starts_with("less") ? '>' : '<',
                            e->name.starts_with("less") ? '<' : '>', spelled(*x), spelled(*e->children[1])),
                other);
        }
        if (e->name == "sqrt") add(SlipKind::exponent, fmt::format("no root of '{}'", spelled(*x)), x);
        const FunctionSpec* known = find_function(e->name);
        if (known == nullptr || e->children.size() != 1) return;
        square(e, add);
        if (is_sum(*x))
            add(SlipKind::bracket, fmt::format("'{}' does not belong in {}", spelled(*x->children[1]), e->name),
                rebuilt(*x, {rebuilt(*e, {x->children[0]}), x->children[1]}));
    }

    const std::vector<KnownLetter>& letters_;
    const SlipOptions& options_;
};

}  // namespace

std::vector<Slip> slips_of(const Equation& equation, const std::vector<KnownLetter>& letters, const SlipOptions& options) {
    Slips slips(letters, options);
    std::vector<Slip> result;
    for (std::size_t i = 0; i < equation.sides.size(); ++i) {
        const bool is_seldom = is_said(*equation.sides[i], options);
        for (Change& change : slips.of(equation.sides[i], !is_sum(*equation.sides[i]))) {
            Equation other = equation;
            other.sides[i] = std::move(change.tree);
            result.push_back({change.kind, i, std::move(change.words), std::move(other), std::move(change.printed), std::move(change.mended),
                              is_seldom, options.is_wide ? change.weight : 0});
        }
    }
    std::stable_sort(result.begin(), result.end(), is_tried_before);
    return result;
}

bool is_tried_before(const Slip& a, const Slip& b) {
    return std::tuple(a.is_seldom, a.kind, a.weight) < std::tuple(b.is_seldom, b.kind, b.weight);
}

}  // namespace dalembert
