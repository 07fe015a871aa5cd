// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/atoms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "text/digest.hpp"

namespace dalembert {

namespace {

/// The order in which symbols are numbered.
constexpr std::array symbol_order{
    SymbolKind::parameter, SymbolKind::definition, SymbolKind::time,         SymbolKind::input,           SymbolKind::coordinate,
    SymbolKind::velocity,  SymbolKind::state,      SymbolKind::acceleration, SymbolKind::state_rate,      SymbolKind::grid,
    SymbolKind::letter,    SymbolKind::jerk,       SymbolKind::multiplier,   SymbolKind::multiplier_rate, SymbolKind::residual,
    SymbolKind::costate,   SymbolKind::adjoint};

bool is_parameter(SymbolKind kind) { return kind == SymbolKind::parameter || kind == SymbolKind::definition || kind == SymbolKind::grid; }

Polynomial renumbered(const Polynomial& p, const std::vector<Letter>& new_letter) {
    Polynomial result;
    for (const auto& [monomial, coefficient] : p.terms()) {
        Monomial m;
        for (const LetterPower& power : monomial) m.push_back({new_letter[power.letter], power.exponent});
        std::sort(m.begin(), m.end());
        result.add(m, coefficient);
    }
    return result;
}

}  // namespace

Atoms::Atoms(const Symbols& symbols) : symbols_(symbols) {
    for (std::size_t k = 0; k < symbol_order.size(); ++k)
        for (const Variable& variable : symbols.all(symbol_order[k]))
            add({Op::symbol,
                 {},
                 fmt::format("{}{:05}", static_cast<char>('a' + k), variable.position),
                 0,
                 !is_parameter(variable.kind),
                 &variable});
    add({Op::pi, {}, "pi", 0, false});
}

Letter Atoms::add(Atom atom) {
    const auto letter = static_cast<Letter>(atoms_.size());
    by_key_.emplace(atom.key, letter);
    atoms_.push_back(std::move(atom));
    return letter;
}

Letter Atoms::symbol(const Variable& variable) const {
    std::size_t first = 0;
    for (const SymbolKind kind : symbol_order) {
        if (kind == variable.kind) return static_cast<Letter>(first + variable.position);
        first += symbols_.count(kind);
    }
    throw std::logic_error("a symbol that the graph does not know: " + variable.name);
}

std::string Atoms::key(const Monomial& m) const {
    std::vector<std::string> parts;
    for (const LetterPower& power : m) parts.push_back(fmt::format("{}^{}", atoms_[power.letter].key, power.exponent));
    std::sort(parts.begin(), parts.end());
    return fmt::format("{}", fmt::join(parts, "*"));
}

std::string Atoms::key(const Polynomial& p) const {
    std::vector<std::string> parts;
    for (const auto& [monomial, coefficient] : p.terms()) parts.push_back(key(monomial) + "#" + to_string(coefficient));
    std::sort(parts.begin(), parts.end());
    return fmt::format("{}", fmt::join(parts, "+"));
}

int Atoms::leading_sign(const Polynomial& p) const {
    std::string first;
    int sign = 0;
    for (const auto& [monomial, coefficient] : p.terms()) {
        std::string k = key(monomial);
        if (sign != 0 && k >= first) continue;
        first = std::move(k);
        sign = is_negative(coefficient) ? -1 : 1;
    }
    return sign;
}

bool Atoms::is_dynamic(const Polynomial& p) const {
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial)
            if (atoms_[power.letter].is_dynamic) return true;
    return false;
}

std::string Atoms::key(Op op, const std::vector<Polynomial>& arguments) const {
    constexpr std::size_t longest = 1000;
    std::string result = name_of(op);
    for (const Polynomial& argument : arguments) result += "(" + key(argument) + ")";
    return result.size() <= longest ? result : fmt::format("{}~{:016x}", result.substr(0, longest), digest(result));
}

std::optional<Letter> Atoms::find(const std::string& key, const std::vector<Polynomial>& arguments) const {
    const auto known = by_key_.find(key);
    if (known == by_key_.end()) return std::nullopt;
    if (atoms_[known->second].arguments != arguments) throw std::logic_error("two sums have one key");
    return known->second;
}

std::optional<Letter> Atoms::find(Op op, const std::vector<Polynomial>& arguments) const { return find(key(op, arguments), arguments); }

Letter Atoms::letter(Op op, std::vector<Polynomial> arguments) {
    std::string own = key(op, arguments);
    if (const auto known = find(own, arguments)) return *known;
    int level = 0;
    bool dynamic = false;
    for (const Polynomial& argument : arguments) {
        dynamic = dynamic || is_dynamic(argument);
        for (const auto& [monomial, coefficient] : argument.terms())
            for (const LetterPower& power : monomial) level = std::max(level, atoms_[power.letter].level);
    }
    return add({op, std::move(arguments), std::move(own), level + 1, dynamic});
}

std::vector<Letter> Atoms::in_order(std::size_t first) const {
    std::vector<Letter> order(atoms_.size() - first);
    std::iota(order.begin(), order.end(), static_cast<Letter>(first));
    std::stable_sort(order.begin(), order.end(), [&](Letter a, Letter b) {
        const Atom &x = atoms_[a], &y = atoms_[b];
        if (x.level != y.level) return x.level < y.level;
        return x.level > 0 && x.key < y.key;  // symbols keep their order
    });
    return order;
}

void Atoms::add_in_order(const Atoms& grown) {
    std::vector<Letter> letter_here(grown.size());
    std::iota(letter_here.begin(), letter_here.end(), 0U);
    for (const Letter there : grown.in_order(size())) {
        std::vector<Polynomial> arguments;
        for (const Polynomial& argument : grown[there].arguments) arguments.push_back(renumbered(argument, letter_here));
        letter_here[there] = letter(grown[there].op, std::move(arguments));
    }
}

void Atoms::canonicalise(const std::vector<Polynomial*>& polynomials) {
    const std::vector<Letter> order = in_order(0);
    std::vector<Letter> new_letter(atoms_.size());
    std::vector<Atom> sorted;
    for (std::size_t i = 0; i < order.size(); ++i) {
        new_letter[order[i]] = static_cast<Letter>(i);
        sorted.push_back(std::move(atoms_[order[i]]));
    }
    atoms_ = std::move(sorted);
    by_key_.clear();
    for (std::size_t i = 0; i < atoms_.size(); ++i) {
        for (Polynomial& argument : atoms_[i].arguments) argument = renumbered(argument, new_letter);
        by_key_.emplace(atoms_[i].key, static_cast<Letter>(i));
    }
    for (Polynomial* p : polynomials) *p = renumbered(*p, new_letter);
}

}  // namespace dalembert
