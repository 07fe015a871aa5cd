// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/raise.hpp"

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"

namespace dalembert {

using GiNaC::ex;

ex applied(Op op, const std::vector<ex>& a) {
    switch (op) {
        case Op::sin: return GiNaC::sin(a[0]);
        case Op::cos: return GiNaC::cos(a[0]);
        case Op::tan: return GiNaC::tan(a[0]);
        case Op::asin: return GiNaC::asin(a[0]);
        case Op::acos: return GiNaC::acos(a[0]);
        case Op::atan: return GiNaC::atan(a[0]);
        case Op::atan2: return GiNaC::atan2(a[0], a[1]);
        case Op::sinh: return GiNaC::sinh(a[0]);
        case Op::cosh: return GiNaC::cosh(a[0]);
        case Op::tanh: return GiNaC::tanh(a[0]);
        case Op::exp: return GiNaC::exp(a[0]);
        case Op::log: return GiNaC::log(a[0]);
        case Op::sqrt: return GiNaC::sqrt(a[0]);
        case Op::inverse_norm: return inverse_norm(a[0]);
        case Op::abs: return magnitude(a[0]);
        case Op::sign: return sign_of(a[0]);
        case Op::step: return unit_step(a[0]);
        case Op::if_else: return if_else(a[0], a[1], a[2]);
        case Op::floor: return floor_of(a[0]);
        case Op::independent_inverse: return 1 / a[0];  // of constraints that are independent
        case Op::min: return minimum(a[0], a[1]);
        case Op::max: return maximum(a[0], a[1]);
        case Op::expm1: return exp_minus_one(a[0]);
        case Op::log1p: return log_one_plus(a[0]);
        case Op::one_minus_cos: return one_minus_cos(a[0]);
        case Op::sinc: return sinc(a[0]);
        case Op::sinc_slope: return sinc_slope(a[0]);
        case Op::cosc: return cosc(a[0]);
        case Op::cosc_slope: return cosc_slope(a[0]);
        case Op::growth_mean: return growth_mean(a[0]);
        case Op::logc: return logc(a[0]);
        case Op::logc_slope: return logc_slope(a[0]);
        case Op::compression: return compression(a[0]);
        case Op::signed_root: return signed_root(a[0]);
        case Op::inverse_root: return inverse_root(a[0]);
        case Op::forward_root: return forward_root(a[0]);
        case Op::outflow_factor: return outflow_factor(a[0], a[1]);
        case Op::outflow_factor_slope: return outflow_factor_slope(a[0], a[1]);
        case Op::outflow_factor_by_exponent: return outflow_factor_by_exponent(a[0], a[1]);
        case Op::decay_mean: return decay_mean(a[0]);
        case Op::decay_mean_slope: return decay_mean_slope(a[0]);
        case Op::log_ratio: return log_ratio(a[0], a[1]);
        case Op::log_mean: return log_mean(a[0], a[1]);
        case Op::log_mean_slope: return log_mean_slope(a[0], a[1]);
        case Op::root_excess: return root_excess(a[0], a[1]);
        case Op::sum_of_three: return sum_of_three(a[0], a[1], a[2]);
        case Op::radiant_temperature: return radiant_temperature(a[0], a[1]);
        case Op::network_inverse:
        case Op::balanced_temperature:
        case Op::junction_root: return GiNaC::exprseq(a.begin(), a.end());
        case Op::power: return GiNaC::pow(a[0], a[1]);
        case Op::symbol:
        case Op::pi:
        case Op::element:
        case Op::in_column:
        case Op::sum: break;
    }
    throw std::logic_error("an operation that is no function");
}

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
    return applied(atom.op, arguments);
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
        case Node::Kind::sum: return GiNaC::add(parts);
        case Node::Kind::product: return GiNaC::mul(parts);
        case Node::Kind::reciprocal: return GiNaC::pow(parts[0], -1);
        case Node::Kind::function: break;
    }
    if (node.op == Op::element) return element(node);
    return applied(node.op, {parts.begin(), parts.end()});
}

CachedMeaning cached_meaning(const Code& code) {
    const FunctionCode& update = code[Function::update];
    auto raiser = std::make_shared<Raiser>(update.program, code.atoms, [](std::uint32_t) -> ex { throw std::logic_error("cached values of cached values"); });
    const std::size_t first = code.definition_order.size();
    const Solve& s = code.solve;
    return [&update, &s, raiser, first](std::uint32_t index) {
        const bool is_choice = s.left_out > 0 && index >= s.first_chosen && index < s.first_chosen + s.multipliers;
        return is_choice ? ex(1) : (*raiser)(update.results[first + index]);  // of constraints that are solved for
    };
}

}  // namespace dalembert
