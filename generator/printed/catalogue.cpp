// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/catalogue.hpp"

#include <fmt/format.h>

#include <set>

#include "check/checks.hpp"
#include "check/written_values.hpp"
#include "elements/runs.hpp"
#include "printed/latex_conditions.hpp"
#include "printed/latex_meaning.hpp"
#include "printed/latex_reader.hpp"
#include "printed/latex_rounded.hpp"
#include "printed/latex_words.hpp"
#include "printed/letter_dependences.hpp"
#include "read/matrices.hpp"

namespace dalembert {

namespace {

/// The names in an entry that it does not explain itself, with those in the notation that it uses.
class UsedNames {
public:
    UsedNames(const Catalogue& catalogue, const CatalogueEntry& entry) : catalogue_(catalogue) {
        for (const PrintedLetter& letter : entry.letters) explained_.insert(letter.name);
        if (!entry.solved.empty())
            for (const Equation& equation : entry.equations) explained_.insert(equation.sides[0]->name);
        visit(static_cast<const PrintedEquation&>(entry), [&](const Site& site) { use(*site.expression); });
    }

    const std::set<std::string>& names() const { return names_; }
    const std::vector<PrintedLetter>& notation() const { return notation_; }

private:
    void use(const Expression& expression) {
        for_each(expression, [&](const Expression& e) {
            if (e.kind != Expression::Kind::name || explained_.contains(e.name) || !names_.insert(e.name).second) return;
            for (const LatexMeaning& meaning : catalogue_.notation) {
                if (meaning.letter.text != e.name) continue;
                explained_.insert(e.name);
                notation_.push_back({e.name, meaning.value, meaning.letter.whole()});
                use(*meaning.value);
            }
        });
    }

    const Catalogue& catalogue_;
    std::set<std::string> explained_, names_;
    std::vector<PrintedLetter> notation_;
};

/// From half to twice what a positive letter is, or one.
Range range_about(const CatalogueLetter& letter) {
    const ExpressionPtr middle = letter.value ? letter.value : make_number(1, letter.span);
    const ExpressionPtr two = make_number(2, letter.span);
    return {make_binary(Expression::Kind::divide, middle, two), make_binary(Expression::Kind::multiply, two, middle), letter.span,
            letter.value == nullptr};
}

/// A letter without a value of its own is a number like any other; what is positive is so by its range.
void add(Model& model, const CatalogueLetter& letter, bool is_dimensionless, Diagnostics& diagnostics) {
    Quantity quantity = letter;
    if (is_dimensionless) quantity.unit = Unit{};
    if (letter.is_positive && !letter.range) quantity.range = range_about(letter);
    if (letter.is_positive && letter.range && letter.range->low && letter.range->low->kind == Expression::Kind::number &&
        !cln::plusp(letter.range->low->value))
        diagnostics.error(Id::value_out_of_range, letter.range->span,
                          fmt::format("'{}' stands under [positive], so its range must begin above zero", letter.name));
    if (letter.moves) {
        Coordinate coordinate;
        static_cast<Quantity&>(coordinate) = quantity;
        if (quantity.range) coordinate.start = quantity.range->low;
        model.coordinates.push_back(std::move(coordinate));
        return;
    }
    Parameter parameter;
    static_cast<Quantity&>(parameter) = quantity;
    const bool has_low = quantity.range && quantity.range->low;
    parameter.values.push_back(letter.value ? letter.value : has_low ? quantity.range->low : make_number(0, letter.span));
    model.parameters.push_back(std::move(parameter));
}

/// The letters that an entry uses, in order of declaration; its own come before those of the file.
std::vector<const CatalogueLetter*> letters_of(const Catalogue& catalogue, const CatalogueEntry& entry, const UsedNames& used) {
    std::vector<const CatalogueLetter*> result;
    const auto is_new = [&](const CatalogueLetter& letter) {
        return std::none_of(result.begin(), result.end(), [&](const CatalogueLetter* other) { return other->name == letter.name; });
    };
    for (const auto* letters : {&entry.own, &catalogue.letters})
        for (const CatalogueLetter& letter : *letters)
            if (used.names().contains(letter.name) && is_new(letter)) result.push_back(&letter);
    return result;
}

/// Names of the model and of letters are read as words, not as products.
PrintedNotation notation_of(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    PrintedNotation notation;
    notation.set_decimal_mark(catalogue.decimal_mark);
    if (catalogue.preamble) notation.add_macros(*catalogue.preamble);
    for (const auto& [name, body] : catalogue.macros) notation.add_macro(name, body);
    for (const auto* letters : {&entry.own, &catalogue.letters})
        for (const CatalogueLetter& letter : *letters) {
            notation.add_word(letter.name);
            if (letter.name == "e") notation.define("e", "e");  // and not Euler's number
        }
    for (const PrintedLetter& letter : entry.letters) notation.add_word(letter.name);
    if (model != nullptr)
        for (const std::string& name : Names(*model).all()) notation.add_word(name);
    for (const auto* meanings : {&catalogue.notation, &entry.notation})
        for (const LatexMeaning& meaning : *meanings) notation.define(meaning.letter, meaning.value);
    for (const auto* functions : {&catalogue.functions, &entry.functions})
        for (const Excerpt& function : *functions) notation.define_function(function);
    add_dependences(notation, catalogue, entry, model);
    return notation;
}

/// An unknown name counts as a number, so that sizes say nothing before it is told.
void check_known(const PrintedEquation& entry, const Names& names, Diagnostics& diagnostics) {
    std::set<std::string> running, told;  // t and the indices of sums and integrals are known
    const auto visit = [&](const Expression& e) {
        if (e.kind == Expression::Kind::sum) running.insert(e.name);
        if (e.kind == Expression::Kind::call && e.children.size() > 1 && (e.name == "integral" || e.name == "limit" || e.name == "at"))
            running.insert(e.children[1]->name);
        if (e.kind != Expression::Kind::name || !e.children.empty() || e.name == "t" || e.name == "pi" || e.name == "infinity" ||
            running.contains(e.name))
            return;
        const bool is_letter = std::any_of(entry.shown_letters.begin(), entry.shown_letters.end(),
                                           [&](const PrintedLetter& letter) { return letter.name == e.name; });
        if (is_letter || names.find(e.name) != nullptr || find_quantity(e.name) != nullptr || !told.insert(e.name).second) return;
        diagnostics.error(Id::unknown_name, e.span, fmt::format("'{}' is not defined{}", e.name, hint_for_unknown(e, names)));
    };
    for (const Equation& equation : entry.shown)
        for (const ExpressionPtr& side : equation.sides) for_each(*side, visit);
}

/// In an equation with a limit a letter e that is nowhere declared is Euler's number.
ExpressionPtr with_eulers_number(const ExpressionPtr& e) {
    if (e->kind == Expression::Kind::name && e->name == "e" && e->children.empty())
        return std::make_shared<Expression>(Expression{Expression::Kind::call, e->span, 0, "exp", {make_number(1, e->span)}});
    auto copy = std::make_shared<Expression>(*e);
    for (ExpressionPtr& child : copy->children) child = with_eulers_number(child);
    return copy;
}

bool has_limit(const Equation& equation) {
    bool has = false;
    for (const ExpressionPtr& side : equation.sides)
        for_each(*side, [&](const Expression& e) { has = has || (e.kind == Expression::Kind::call && e.name == "limit"); });
    return has;
}

bool declares_e(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    const auto is_e = [](const auto& letter) { return letter.name == "e"; };
    const auto is_meant = [](const LatexMeaning& meaning) { return meaning.letter.text == "e"; };
    return std::any_of(entry.own.begin(), entry.own.end(), is_e) || std::any_of(catalogue.letters.begin(), catalogue.letters.end(), is_e) ||
           std::any_of(entry.letters.begin(), entry.letters.end(), is_e) ||
           std::any_of(catalogue.notation.begin(), catalogue.notation.end(), is_meant) ||
           std::any_of(entry.notation.begin(), entry.notation.end(), is_meant) || (model != nullptr && Names(*model).find("e") != nullptr);
}

/// An entry that solves equations says what letters are.
void check_solution(const CatalogueEntry& entry) {
    for (const Equation& equation : entry.equations)
        if (const Expression& left = *equation.sides[0]; left.kind != Expression::Kind::name || !left.children.empty())
            fail(Id::wrong_type, left.span,
                 fmt::format("'{}' is not a letter; an entry with 'solves' gives the values of letters, as in 'x = ...'", left.written()));
}

}  // namespace

namespace {

/// What stands on one side only holds of one of the signs, and the equation does not say of which.
void refuse_one_sided_signs(const LatexEquation& read) {
    const auto& has = read.has_both_signs;
    if (std::find(has.begin(), has.end(), true) != has.end() && std::find(has.begin(), has.end(), false) != has.end())
        fail(Id::not_allowed_here, read.equation.span,
             fmt::format("'\\pm' stands on one side of '{}' only, so the sign is not known; write the sign, or give under 'solves' the "
                         "equation that both values solve",
                         read.equation.span.text()));
}

/// Adds one printed equation, in the words of the model language.
void add_equation(LatexEquation& read, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model,
                  CatalogueEntry& result) {
    // Said to be rounded: what stands without a unit is a number all the same.
    const bool is_rounded = std::find(read.relations.begin(), read.relations.end(), Relation::approximately) != read.relations.end();
    for (const Relation relation : read.relations)
        if (relation != Relation::equal && relation != Relation::approximately)
            fail(Id::not_allowed_here, read.equation.span,
                 fmt::format("'{}' is not an equation; a comparison by '{}' is not checked", read.equation.span.text(), sign_of(relation)));
    if (read.relations.empty())
        fail(Id::syntax, read.equation.span, fmt::format("'{}' is an expression where an equation is expected", read.equation.span.text()));
    for (ExpressionPtr& side : read.equation.sides) side = with_known_meaning(side, catalogue, entry, model);
    take_constants_out(read, catalogue, entry, model);
    const bool has_e = !declares_e(catalogue, entry, model) && has_limit(read.equation);  // of the whole chain
    std::vector<Equation> equations = with_rounded_numbers(read);
    for (Equation& equation : equations) {
        mark_rounded(equation);
        for (ExpressionPtr& side : equation.sides) {
            side = in_model_words(side);
            if (has_e) side = with_eulers_number(side);
        }
    }
    std::move(equations.begin(), equations.end(), std::back_inserter(result.equations));
    if (is_rounded && !result.number_unit) result.number_unit = Unit{};
}

/// Adds the equations of the LaTeX with the upper or the lower signs. Whether there are such signs.
bool add_equations(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model, bool is_lower_sign,
                   CatalogueEntry& result) {
    PrintedNotation notation = notation_of(catalogue, entry, model);
    if (is_lower_sign) notation.take_lower_signs();
    bool has_signs = false;
    const std::size_t first = result.equations.size();
    std::vector<RefusedEquation> refused;
    std::size_t count = 0;
    for (LatexEquation& read : read_latex(*entry.latex, notation, refused)) {
        count = std::max(count, read.number);
        const bool is_signed = std::find(read.has_both_signs.begin(), read.has_both_signs.end(), true) != read.has_both_signs.end();
        has_signs = has_signs || is_signed;
        if (is_lower_sign && !is_signed && entry.solved.empty()) continue;
        const bool is_said_of_equations = is_condition(read) && result.equations.size() > first;
        try {
            if (is_signed && entry.solved.empty()) refuse_one_sided_signs(read);
            if (is_said_of_equations || !read.conditions.empty()) check_conditions(read, catalogue, entry, model);
            if (!is_said_of_equations) add_equation(read, catalogue, entry, model, result);
        } catch (const Failure& failure) {
            if (is_condition(read)) throw;  // of the others, too
            refused.push_back({read.number, failure.diagnostics().front()});
        }
    }
    EntryParts& parts = result.parts;
    for (RefusedEquation& one : refused) {
        count = std::max(count, one.number);
        const bool is_known = std::any_of(parts.refused.begin(), parts.refused.end(),
                                          [&](const RefusedEquation& other) { return other.number == one.number; });
        if (!is_known) parts.refused.push_back(std::move(one));
    }
    parts.equations = std::max(parts.equations, count);
    std::sort(parts.refused.begin(), parts.refused.end(),
              [](const RefusedEquation& a, const RefusedEquation& b) { return a.number < b.number; });
    return has_signs;
}

/// Where nothing is left to be checked, or where what is left stands on what is not read, the whole entry is refused.
void refuse_as_a_whole(const CatalogueEntry& entry) {
    const std::vector<RefusedEquation>& refused = entry.parts.refused;
    if (refused.empty() || (!entry.equations.empty() && entry.solved.empty())) return;
    std::vector<Diagnostic> all;
    for (const RefusedEquation& one : refused) all.push_back(one.why);
    throw Failure(std::move(all));
}

}  // namespace

std::vector<CatalogueEntry> with_equations(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    std::vector<CatalogueEntry> result{entry};
    if (entry.latex && add_equations(catalogue, entry, model, false, result.front())) {
        if (!entry.solved.empty()) result.push_back(entry);
        add_equations(catalogue, entry, model, true, result.back());
    }
    for (const CatalogueEntry& one : result) {
        refuse_as_a_whole(one);
        if (!entry.solved.empty()) check_solution(one);
    }
    return result;
}

Model with_letters(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* base) {
    Model model;
    if (base != nullptr) {
        model = *base;
    } else {
        model.source = catalogue.source;
        model.name = "letters";
        model.name_span = entry.span;
        model.reference = catalogue.title;
    }
    const UsedNames used(catalogue, entry);
    Diagnostics diagnostics;
    const Names known(base != nullptr ? *base : model);
    for (const CatalogueLetter* letter : letters_of(catalogue, entry, used))
        if (known.find(letter->name) == nullptr) add(model, *letter, entry.is_dimensionless, diagnostics);
    check_letter_names(model, diagnostics);
    diagnostics.stop_on_errors();
    return model;
}

PrintedEquation checked_entry(const Catalogue& catalogue, const CatalogueEntry& entry, const Model& model, Diagnostics& diagnostics) {
    PrintedEquation result = entry;
    const Names names(model);
    convert_numbers(result.at, names);
    const UsedNames used(catalogue, entry);
    for (const PrintedLetter& letter : used.notation()) result.letters.push_back(letter);
    // What the file says of a letter is not said of a parameter of the model that is called the same; what the entry says is.
    const auto is_meant = [&](const CatalogueLetter& letter) {
        const Named* named = names.find(letter.name);
        const bool is_own = std::any_of(entry.own.begin(), entry.own.end(), [&](const CatalogueLetter& own) { return &own == &letter; });
        return is_own || (named != nullptr && named->item->span.source == letter.span.source);
    };
    for (const CatalogueLetter* letter : letters_of(catalogue, entry, used))
        if (letter->value && is_meant(*letter)) result.at.push_back({make_name(letter->name, letter->span), letter->value, true});
    result.shown = result.equations;
    result.shown_letters = result.letters;
    take_matrices_apart(result);
    if (!result.sizes.empty()) check_known(result, names, diagnostics);
    check_expressions(result, names, diagnostics);
    if (!diagnostics.has_errors()) check_written_sizes(result, names, diagnostics);
    return result;
}

}  // namespace dalembert
