// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/raise.hpp"

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

ex element_of(Op array, const ex& which, const ex& list) {
    if (array == Op::balanced_temperature) return balanced_temperature(which, list);
    if (array == Op::junction_root) return junction_root(which, list);
    const auto n = network_order(list);
    const auto k = static_cast<unsigned long>(GiNaC::ex_to<GiNaC::numeric>(which).to_long());
    return network_inverse(k / n, k % n, list);
}

ex raised_letter(Letter letter, const Atoms& atoms) {
    const Atom& atom = atoms[letter];
    if (atom.op == Op::symbol) return atom.variable->symbol;
    if (atom.op == Op::pi) return GiNaC::Pi;
    std::vector<ex> arguments;
    for (const Polynomial& argument : atom.arguments) arguments.push_back(raised(argument, atoms));
    if (atom.op == Op::sum) return arguments[0];
    if (is_array(atom.op)) return element_of(atom.op, arguments[0], GiNaC::exprseq(arguments.begin() + 1, arguments.end()));
    return applied(scalar_function(atom.op), arguments);
}

}  // namespace

ex raised(const Polynomial& p, const Atoms& atoms) {
    GiNaC::exvector terms;
    for (const auto& [monomial, coefficient] : p.terms()) {
        GiNaC::exvector factors{GiNaC::numeric(coefficient)};
        for (const LetterPower& power : monomial) factors.push_back(GiNaC::pow(raised_letter(power.letter, atoms), power.exponent));
        terms.push_back(GiNaC::mul(factors));
    }
    return GiNaC::add(terms);
}

ex Raiser::operator()(NodeId id) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    for (const NodeId argument : program_[id].arguments) (*this)(argument);
    return known_[id] = raise(program_[id]);
}

/// Of an array its list of arguments was raised.
ex Raiser::element(const Node& node) const {
    return element_of(program_[node.arguments[0]].op, known_.at(node.arguments[1]), known_.at(node.arguments[0]));
}

ex Raiser::raise(const Node& node) {
    GiNaC::exvector parts;
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
        const ex& part = known_.at(node.arguments[i]);
        const bool negative = !node.negative.empty() && node.negative[i];
        parts.push_back(negative ? ex(-part) : part);
    }
    switch (node.kind) {
        case Node::Kind::constant: return GiNaC::numeric(node.value);
        case Node::Kind::symbol: return atoms_[node.index].op == Op::pi ? ex(GiNaC::Pi) : atoms_[node.index].variable->symbol;
        case Node::Kind::cached: return cached_(node.index);
        case Node::Kind::sum: return sums_ == Sums::kept_whole ? ex(whole(GiNaC::add(parts))) : ex(GiNaC::add(parts));
        case Node::Kind::product: return GiNaC::mul(parts);
        case Node::Kind::reciprocal: return GiNaC::pow(parts[0], -1);
        case Node::Kind::function: break;
    }
    if (node.op == Op::element) return element(node);
    return applied(scalar_function(node.op), parts);
}

CachedMeaning cached_meaning(const Code& code) {
    const FunctionCode& update = code[Function::update];
    auto raiser = std::make_shared<Raiser>(update.program, code.atoms,
                                           [](std::uint32_t) -> ex { throw std::logic_error("cached values of cached values"); });
    const std::size_t first = code.definition_order.size();
    const Solve& s = code.solve;
    return [&update, &s, raiser, first](std::uint32_t index) {
        const bool is_choice = s.left_out > 0 && index >= s.first_chosen && index < s.first_chosen + s.multipliers;
        return is_choice ? ex(1) : (*raiser)(update.results[first + index]);  // of constraints that are solved for
    };
}

}  // namespace dalembert
