// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/build.hpp"

#include <algorithm>

namespace dalembert {

std::uint32_t ParameterCache::add(const Polynomial& p) {
    const auto [found, is_new] = index_.emplace(p, static_cast<std::uint32_t>(values_.size()));
    if (is_new) values_.push_back(p);
    return found->second;
}

std::uint32_t ParameterCache::reserve(std::size_t count) {
    const auto first = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + count);
    return first;
}

std::optional<std::uint32_t> ParameterCache::find(const Polynomial& p) const {
    const auto found = index_.find(p);
    return found == index_.end() ? std::nullopt : std::optional(found->second);
}

NodeId reciprocal(Atoms& atoms, ParameterCache& cache, Program& program, NodeId x, const Passes& passes) {
    if (!passes.constants) return program.reciprocal(x);
    const Node& node = program[x];
    std::optional<Polynomial> value;
    if (node.kind == Node::Kind::cached) value = cache.values()[node.index];
    if (node.kind == Node::Kind::symbol && !atoms[node.index].is_dynamic) value = Polynomial::letter(node.index);
    if (!value || value->is_zero()) return program.reciprocal(x);
    Polynomial inverse;
    if (value->is_monomial()) {
        const auto& [monomial, coefficient] = *value->terms().begin();
        inverse.add(raised(monomial, -1), Rational(1) / coefficient);
    } else {
        inverse = Polynomial::letter(atoms.letter(Op::sum, {*value}), -1);
    }
    return program.cached(cache.add(inverse));
}

namespace {

constexpr std::uint32_t first_cached_number = 0x80000000;  ///< cached values that are found last stand behind all other numbers

}  // namespace

ProgramBuilder::ProgramBuilder(Atoms& atoms, ParameterCache& cache, ParameterParts parts, Program& program, const Passes& passes)
    : atoms_(atoms),
      cache_(cache),
      parts_(passes.constants ? parts : ParameterParts::in_place),
      factors_(passes.factoring),
      nests_(passes.nesting),
      program_(program),
      network_{} {}

void ProgramBuilder::prepare(const std::vector<Polynomial>& roots) {
    const bool split = splits();
    for (const Polynomial& root : roots) roots_.push_back(value_of(root, split));
    need_arguments();

    // Numbers for everything that cubes are made of, in the order cached, atoms, reciprocals; functions behind them.
    for (const auto& cubes : raw_)
        for (const RawCube& cube : cubes)
            for (const Reference& reference : cube.factors)
                if (reference.kind != Reference::Kind::function) numbers_.emplace(reference, 0);
    for (auto& [reference, number] : numbers_) {
        number = static_cast<std::uint32_t>(references_.size());
        references_.push_back(reference);
    }
    network_.first_letter = static_cast<std::uint32_t>(references_.size());
    for (const auto& cubes : raw_) {
        CubeSum sum;
        for (const RawCube& raw : cubes) {
            Cube cube{raw.coefficient, {}};
            for (const Reference& r : raw.factors)
                cube.letters.push_back(r.kind == Reference::Kind::function ? network_.first_letter + r.index : numbers_.at(r));
            std::sort(cube.letters.begin(), cube.letters.end());
            sum.push_back(std::move(cube));
        }
        network_.functions.push_back(std::move(sum));
    }
    if (factors_) extract(network_);
}

ProgramBuilder::Value ProgramBuilder::value_of(const Polynomial& p, bool split) {
    if (p.is_zero()) return {0, {}};
    if (p.is_constant()) return {p.terms().begin()->second, {}};
    const bool is_parameter_part = split && !atoms_.is_dynamic(p);
    // A single symbol needs no computation, only its sign or factor; a function of parameters is computed once.
    if (p.is_monomial()) {
        const auto& [monomial, coefficient] = *p.terms().begin();
        const bool is_plain = monomial.size() == 1 && monomial[0].exponent == 1;
        const bool is_unit = coefficient == 1 || coefficient == -1;
        const bool is_symbol = is_plain && atoms_[monomial[0].letter].arguments.empty();
        if (is_plain && ((is_unit && is_symbol) || !is_parameter_part)) {
            need_atom(monomial[0].letter);
            return {coefficient, Reference{Reference::Kind::atom, monomial[0].letter}};
        }
    }
    if (!is_parameter_part) return {1, Reference{Reference::Kind::function, function_of(p, split)}};
    Polynomial positive = p;
    const Rational sign = atoms_.leading_sign(p);
    positive *= sign;
    std::optional<std::uint32_t> cached = cache_.find(positive);
    if (!cached && parts_ == ParameterParts::cached) cached = cache_.add(positive);
    if (cached) return {sign, Reference{Reference::Kind::cached, *cached}};
    return {sign, Reference{Reference::Kind::function, function_of(positive, false)}};
}

std::uint32_t ProgramBuilder::function_of(const Polynomial& p, bool split) {
    const auto [known, is_new] = functions_.emplace(p, static_cast<std::uint32_t>(raw_.size()));
    if (!is_new) return known->second;
    const std::uint32_t function = known->second;
    raw_.emplace_back();
    std::vector<RawCube> cubes;
    if (!split) {
        for (const auto& [monomial, coefficient] : p.terms()) {
            RawCube cube{coefficient, {}};
            for (const LetterPower& power : monomial) add_factor(cube, power);
            cubes.push_back(std::move(cube));
        }
    } else {
        std::map<Monomial, Polynomial> by_motion;
        for (const auto& [monomial, coefficient] : p.terms()) {
            Monomial moving;
            Monomial fixed;
            for (const LetterPower& power : monomial) (atoms_[power.letter].is_dynamic ? moving : fixed).push_back(power);
            by_motion[moving].add(fixed, coefficient);
        }
        for (const auto& [moving, factor] : by_motion) {
            const Value value = value_of(factor, true);
            RawCube cube{value.coefficient, {}};
            if (value.reference) cube.factors.push_back(*value.reference);
            for (const LetterPower& power : moving) add_factor(cube, power);
            cubes.push_back(std::move(cube));
        }
    }
    raw_[function] = std::move(cubes);
    return function;
}

void ProgramBuilder::add_factor(RawCube& cube, const LetterPower& power) {
    need_atom(power.letter);
    const auto kind = power.exponent > 0 ? Reference::Kind::atom : Reference::Kind::reciprocal;
    for (int i = std::abs(power.exponent); i > 0; --i) cube.factors.push_back({kind, power.letter});
}

void ProgramBuilder::need_atom(Letter letter) {
    if (!atoms_[letter].arguments.empty() && atom_arguments_.emplace(letter, std::vector<Value>()).second) pending_atoms_.push_back(letter);
}

/// Arguments of functions are polynomials too, and may need further functions.
void ProgramBuilder::need_arguments() {
    while (!pending_atoms_.empty()) {
        const Letter letter = pending_atoms_.back();
        pending_atoms_.pop_back();
        std::vector<Value> values;
        for (const Polynomial& argument : atoms_[letter].arguments) values.push_back(value_of(argument, splits()));
        atom_arguments_[letter] = std::move(values);
    }
}

NodeId ProgramBuilder::root(std::size_t i) { return node(roots_[i]); }

NodeId ProgramBuilder::node(const Value& value) {
    if (!value.reference) return program_.constant(value.coefficient);
    const Reference& r = *value.reference;
    const NodeId plain = r.kind == Reference::Kind::function ? node(network_.first_letter + r.index)
                         : r.kind == Reference::Kind::cached ? program_.cached(r.index)
                                                             : atom_node(r.index);
    if (value.coefficient == 1) return plain;
    if (value.coefficient == -1) return program_.negated(plain);
    const NodeId scaled = program_.product({program_.constant(cln::abs(value.coefficient)), plain});
    return is_negative(value.coefficient) ? program_.negated(scaled) : scaled;
}

NodeId ProgramBuilder::node(std::uint32_t number) {
    if (const auto known = nodes_.find(number); known != nodes_.end()) return known->second;
    NodeId result = 0;
    if (number >= first_cached_number) {
        result = program_.cached(number - first_cached_number);
    } else if (parts_ == ParameterParts::cached_last && is_fixed(number) && !is_symbol(number)) {
        result = node(fixed_part(fixed_value(number)));
    } else if (number >= network_.first_letter) {
        result = sum_node(network_.functions[number - network_.first_letter]);
    } else {
        const Reference& r = references_[number];
        switch (r.kind) {
            case Reference::Kind::cached: result = program_.cached(r.index); break;
            case Reference::Kind::reciprocal: result = program_.reciprocal(atom_node(r.index)); break;
            default: result = atom_node(r.index); break;
        }
    }
    return nodes_[number] = result;
}

NodeId ProgramBuilder::atom_node(Letter letter) {
    if (const auto defined = symbol_nodes_.find(letter); defined != symbol_nodes_.end()) return defined->second;
    const Atom& atom = atoms_[letter];
    if (atom.op == Op::symbol || atom.op == Op::pi) return program_.symbol(letter);
    if (parts_ == ParameterParts::cached_last && !atom.is_dynamic) return node(fixed_part(Polynomial::letter(letter)));
    if (atom.op == Op::expm1) {
        // exp(x) - 1 = x exp(x) - compression(-x), where both are there: near zero, where exp(x) - 1 itself cancels, the second is small
        // beside the first.
        Polynomial minus = atom.arguments[0];
        minus *= Rational(-1);
        const auto exponential = needed(Op::exp, atom.arguments[0]), compressed = needed(Op::compression, minus);
        if (exponential && compressed)
            return program_.sum({{false, program_.product({node(atom_arguments_.at(letter)[0]), atom_node(*exponential)})},
                                 {true, atom_node(*compressed)}});
    }
    std::vector<NodeId> arguments;
    for (const Value& value : atom_arguments_.at(letter)) arguments.push_back(node(value));
    if (atom.op == Op::sum) return arguments[0];
    if (!is_array(atom.op)) return program_.function(atom.op, std::move(arguments));
    // All elements come from one computation.
    const NodeId which = arguments[0];
    arguments.erase(arguments.begin());
    return program_.function(Op::element, {program_.function(atom.op, std::move(arguments)), which});
}

std::optional<Letter> ProgramBuilder::needed(Op op, const Polynomial& argument) const {
    for (const auto& [letter, values] : atom_arguments_)
        if (atoms_[letter].op == op && atoms_[letter].arguments[0] == argument) return letter;
    return {};
}

bool ProgramBuilder::is_symbol(std::uint32_t number) const {
    return number < network_.first_letter && references_[number].kind == Reference::Kind::atom &&
           atoms_[references_[number].index].arguments.empty();
}

/// Whether what a number stands for depends on parameters alone.
bool ProgramBuilder::is_fixed(std::uint32_t number) {
    if (number >= first_cached_number) return true;
    if (number < network_.first_letter) return !atoms_[references_[number].index].is_dynamic;
    if (const auto known = is_fixed_.find(number); known != is_fixed_.end()) return known->second;
    const CubeSum& sum = network_.functions[number - network_.first_letter];
    const bool result = std::all_of(sum.begin(), sum.end(), [&](const Cube& cube) {
        return std::all_of(cube.letters.begin(), cube.letters.end(), [&](std::uint32_t l) { return is_fixed(l); });
    });
    return is_fixed_[number] = result;
}

/// Its value, in which sums within products are kept whole.
Polynomial ProgramBuilder::fixed_value(std::uint32_t number) {
    if (number >= first_cached_number) return cache_.values()[number - first_cached_number];
    if (number < network_.first_letter)
        return Polynomial::letter(references_[number].index, references_[number].kind == Reference::Kind::reciprocal ? -1 : 1);
    Polynomial sum;
    for (const Cube& cube : network_.functions[number - network_.first_letter]) sum += fixed_value(cube);
    return sum;
}

Polynomial ProgramBuilder::fixed_value(const Cube& cube) {
    Polynomial product(cube.coefficient);
    for (const std::uint32_t letter : cube.letters) {
        Polynomial factor = fixed_value(letter);
        if (product.is_zero() || factor.is_zero()) return {};
        if (!factor.is_monomial()) factor = Polynomial::letter(atoms_.letter(Op::sum, {factor}));
        const auto& [monomial, coefficient] = *factor.terms().begin();
        product = product * monomial;
        product *= coefficient;
    }
    return product;
}

/// A number that stands for a value of parameters, and what it is multiplied by.
ProgramBuilder::FixedPart ProgramBuilder::fixed_part(const Polynomial& value) {
    if (value.is_constant()) return {value.is_zero() ? Rational(0) : leading(value), {}};
    if (value.is_monomial()) {
        const auto& [monomial, coefficient] = *value.terms().begin();
        const bool is_plain = monomial.size() == 1 && monomial[0].exponent == 1 && atoms_[monomial[0].letter].arguments.empty();
        if (is_plain && cln::abs(coefficient) == 1) return {coefficient, numbers_.at({Reference::Kind::atom, monomial[0].letter})};
    }
    Polynomial positive = value;
    const Rational sign = atoms_.leading_sign(value);
    positive *= sign;
    return {sign, first_cached_number + cache_.add(positive)};
}

NodeId ProgramBuilder::node(const FixedPart& part) {
    const NodeId plain = part.number ? node(*part.number) : program_.constant(1);
    return program_.product({program_.constant(part.coefficient), plain});
}

/// Terms that move alike become one, whose factor of parameters is a cached value.
CubeSum ProgramBuilder::with_fixed_parts_cached(const CubeSum& sum) {
    std::map<std::vector<std::uint32_t>, Polynomial> by_motion;
    for (const Cube& cube : sum) {
        std::vector<std::uint32_t> moving;
        Cube fixed{cube.coefficient, {}};
        for (const std::uint32_t letter : cube.letters) (is_fixed(letter) ? fixed.letters : moving).push_back(letter);
        by_motion[moving] += fixed_value(fixed);
    }
    CubeSum result;
    for (const auto& [moving, value] : by_motion) {
        const FixedPart part = fixed_part(value);
        if (part.coefficient == 0) continue;
        Cube cube{part.coefficient, moving};
        if (part.number) cube.letters.push_back(*part.number);
        std::sort(cube.letters.begin(), cube.letters.end());
        result.push_back(std::move(cube));
    }
    return result;
}

NodeId ProgramBuilder::sum_node(const CubeSum& given) {
    const CubeSum sum = parts_ == ParameterParts::cached_last ? with_fixed_parts_cached(given) : given;
    // A number that all terms share is multiplied once.
    const bool same = sum.size() > 1 && std::all_of(sum.begin(), sum.end(),
                                                    [&](const Cube& c) { return cln::abs(c.coefficient) == cln::abs(sum[0].coefficient); });
    const Rational factor = same ? cln::abs(sum[0].coefficient) : Rational(1);
    CubeSum scaled = sum;
    for (Cube& cube : scaled) cube.coefficient = cube.coefficient / factor;
    std::vector<std::pair<bool, NodeId>> terms;
    collect_terms(scaled, terms);
    return program_.product({program_.constant(factor), program_.sum(std::move(terms))});
}

/// Horner's scheme: the letter that most terms share is taken out of them, and so on with what is left.
void ProgramBuilder::collect_terms(const CubeSum& sum, std::vector<std::pair<bool, NodeId>>& terms) {
    std::map<std::uint32_t, int> uses;
    for (const Cube& cube : sum) {
        std::uint32_t last = UINT32_MAX;
        for (const std::uint32_t letter : cube.letters) {
            if (letter != last) ++uses[letter];
            last = letter;
        }
    }
    const auto most = std::max_element(uses.begin(), uses.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (!nests_ || most == uses.end() || most->second < 2) {
        for (const Cube& cube : sum) {
            std::vector<NodeId> factors;
            const Rational size = cln::abs(cube.coefficient);
            if (size != 1 || cube.letters.empty()) factors.push_back(program_.constant(size));
            for (const std::uint32_t letter : cube.letters) factors.push_back(node(letter));
            terms.emplace_back(is_negative(cube.coefficient), program_.product(std::move(factors)));
        }
        return;
    }
    CubeSum inside;
    CubeSum outside;
    for (const Cube& cube : sum) {
        const auto found = std::find(cube.letters.begin(), cube.letters.end(), most->first);
        if (found == cube.letters.end()) {
            outside.push_back(cube);
            continue;
        }
        Cube rest = cube;
        rest.letters.erase(rest.letters.begin() + (found - cube.letters.begin()));
        inside.push_back(std::move(rest));
    }
    const bool negative = is_negative(inside.front().coefficient);
    if (negative)
        for (Cube& cube : inside) cube.coefficient = -cube.coefficient;
    terms.emplace_back(negative, program_.product({node(most->first), sum_node(inside)}));
    collect_terms(outside, terms);
}

}  // namespace dalembert
