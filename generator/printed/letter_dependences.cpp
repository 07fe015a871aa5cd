// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/letter_dependences.hpp"

#include <algorithm>
#include <set>

#include "elements/names.hpp"
#include "elements/runs.hpp"

namespace dalembert {

namespace {

class LetterDependences {
public:
    LetterDependences(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) : catalogue_(catalogue), entry_(entry) {
        if (model != nullptr) names_.emplace(*model);
    }

    void add_to(PrintedNotation& notation) {
        const auto add = [&](const std::string& name) {
            if (auto known = of_name(name)) notation.define_dependence(name, std::move(*known));
        };
        for (const auto* letters : {&catalogue_.letters, &entry_.own})
            for (const CatalogueLetter& letter : *letters) add(letter.name);
        for (const PrintedLetter& letter : entry_.letters) add(letter.name);
        for (const LatexMeaning& meaning : catalogue_.notation) add(meaning.letter.text);
        if (names_)
            for (const auto& [name, named] : names_->table()) add(name);
    }

private:
    using Kind = Expression::Kind;

    static LetterDependence moving(const std::string& name) { return {false, true, {name, "t"}}; }

    std::optional<LetterDependence> of_name(const std::string& name) {
        const auto is_name = [&](const auto& item) { return item.name == name; };
        if (const auto letter = std::find_if(entry_.letters.begin(), entry_.letters.end(), is_name); letter != entry_.letters.end())
            return of_value(name, *letter->value);
        if (name == "pi") return LetterDependence{};
        if (name == "t") return LetterDependence{false, false, {"t"}};
        if (const Named* named = names_ ? names_->find(name) : nullptr) {
            if (named->kind == Named::Kind::parameter || named->kind == Named::Kind::size) return LetterDependence{};
            if (named->kind == Named::Kind::coordinate || named->kind == Named::Kind::input || named->kind == Named::Kind::state)
                return moving(name);
            return std::nullopt;
        }
        for (const auto* letters : {&entry_.own, &catalogue_.letters})
            if (const auto letter = std::find_if(letters->begin(), letters->end(), is_name); letter != letters->end()) {
                if (letter->moves) return moving(name);
                return letter->value ? LetterDependence{} : LetterDependence{false, false, {name}};
            }
        const auto meaning = std::find_if(catalogue_.notation.begin(), catalogue_.notation.end(),
                                          [&](const LatexMeaning& m) { return m.letter.text == name; });
        return meaning != catalogue_.notation.end() ? of_value(name, *meaning->value) : std::nullopt;
    }

    std::optional<LetterDependence> of_value(const std::string& name, const Expression& value) {
        if (const auto known = of_values_.find(name); known != of_values_.end()) return known->second;
        of_values_[name] = std::nullopt;  // what needs itself is told where letters are ordered
        LetterDependence result{true, false, {}};
        return of_values_[name] = add_letters(value, result) ? std::optional(result) : std::nullopt;
    }

    /// False where something in the expression depends on what is not seen.
    bool add_letters(const Expression& e, LetterDependence& result) {
        if (e.kind == Kind::name) {
            if (running_.contains(e.name)) return true;
            const auto part = of_name(e.name);
            if (part) result.of.insert(part->of.begin(), part->of.end());
            return part.has_value();
        }
        const auto all = [&](std::size_t from, std::size_t to) {
            return std::all_of(e.children.begin() + static_cast<std::ptrdiff_t>(from), e.children.begin() + static_cast<std::ptrdiff_t>(to),
                               [&](const ExpressionPtr& child) { return add_letters(*child, result); });
        };
        const bool is_sum = e.kind == Kind::sum, is_place = e.kind == Kind::call && e.children.size() > 2 &&
                                                            (e.name == "integral" || e.name == "limit" || e.name == "at");
        if (!is_sum && !is_place) return all(0, e.children.size());
        // The letter that runs is none of those that the whole depends on.
        const auto running = running_.insert(is_sum ? e.name : e.children[1]->name);
        const bool is_known = is_sum ? all(2, 3) : all(0, 1);
        if (running.second) running_.erase(running.first);
        return is_known && (is_sum ? all(0, 2) : all(2, e.children.size()));
    }

    const Catalogue& catalogue_;
    const CatalogueEntry& entry_;
    std::optional<Names> names_;
    std::map<std::string, std::optional<LetterDependence>> of_values_;
    std::set<std::string> running_;
};

}  // namespace

void add_dependences(PrintedNotation& notation, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model) {
    LetterDependences(catalogue, entry, model).add_to(notation);
}

}  // namespace dalembert
