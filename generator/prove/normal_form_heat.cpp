// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of heat transfer in the normal form, by what they mean. Where an argument makes a function 0/0 it is continuous there, so
// that what is proven beside such a point holds at it.
#include <algorithm>

#include "prove/normal_form.hpp"
#include "symbolic/network_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

bool is_heat_function(const std::string& name) {
    static const std::set<std::string> names{"decay_mean",           "decay_mean_slope", "log_ratio",           "log_mean",
                                             "log_mean_slope",       "root_excess",      "radiant_temperature", "network_inverse",
                                             "balanced_temperature", "junction_root"};
    return names.contains(name);
}

bool is_function(const ex& e, const char* name) { return GiNaC::is_a<GiNaC::function>(e) && ex_to<GiNaC::function>(e).get_name() == name; }

}  // namespace

bool NormalForm::has_heat_functions(const ex& e) {
    return std::any_of(e.preorder_begin(), e.preorder_end(), [](const ex& part) {
        return GiNaC::is_a<GiNaC::function>(part) && is_heat_function(ex_to<GiNaC::function>(part).get_name());
    });
}

std::optional<Polynomial> NormalForm::heat_function(const std::string& name, const ex& e) {
    if (!is_heat_function(name)) return std::nullopt;
    if (is_network_function(e)) return network(name, e);
    if (functions_are_letters_) return atom(name, e);
    const Polynomial a = convert(e.op(0));
    if (name == "decay_mean" || name == "decay_mean_slope") {
        note_argument(e.op(0));
        return decay_mean(a, name == "decay_mean_slope");
    }
    const Polynomial b = convert(e.op(1));
    if (name == "log_ratio") return logarithm(a) - logarithm(b);
    if (name == "radiant_temperature") {
        note_argument(e.op(0));
        return radiant_temperature(a, b);
    }
    if (name == "root_excess") {
        note_argument(GiNaC::pow(e.op(0), 2) + e.op(1));
        Polynomial square = multiply(a, a);
        square += b;
        return root_of_product(square) - a;
    }
    note_argument(e.op(0) - e.op(1));
    return log_mean(a, b, name == "log_mean_slope");
}

/// (1 - exp(-z))/z, or ((1 + z) exp(-z) - 1)/z^2
Polynomial NormalForm::decay_mean(const Polynomial& z, bool slope) {
    if (vanishes(z)) return Polynomial(slope ? Rational(-1) / 2 : Rational(1));
    Polynomial result = exponential(-z);
    if (slope) {
        Polynomial more = z;
        more += Polynomial(1);
        result = multiply(more, result) - Polynomial(1);
        return multiply(result, integer_power(z, -2));
    }
    return multiply(Polynomial(1) - result, inverse(z));
}

/// (a - b)/l, or (l - 1 + b/a)/l^2, with l = log(a) - log(b)
Polynomial NormalForm::log_mean(const Polynomial& a, const Polynomial& b, bool slope) {
    const Polynomial difference = a - b;
    if (vanishes(difference)) return slope ? Polynomial(Rational(1) / 2) : a;
    const Polynomial l = logarithm(a) - logarithm(b);
    if (!slope) return multiply(difference, inverse(l));
    return multiply(l - multiply(difference, inverse(a)), integer_power(l, -2));
}

/// The square root, as the product of two roots that the expression has already where it is one: (4.56) leads to differences such as
/// sqrt(p) sqrt(q) - c, of which root_excess only says p q.
Polynomial NormalForm::root_of_product(const Polynomial& base) {
    std::vector<std::pair<Polynomial, Letter>> roots;
    for (const auto& [key, letter] : roots_)
        if (key.second == 2) roots.emplace_back(key.first, letter);
    for (std::size_t i = 0; i < roots.size(); ++i)
        for (std::size_t k = i; k < roots.size(); ++k) {
            Polynomial product = multiply(roots[i].first, roots[k].first);
            if (product.size() != base.size()) continue;
            const Rational ratio = leading(base) / leading(product);
            product *= ratio;
            if (is_negative(ratio) || !(product == base)) continue;
            return multiply(root_of_number(ratio, 2), multiply(Polynomial::letter(roots[i].second), Polynomial::letter(roots[k].second)));
        }
    return root(base, 2);
}

/// The letter t with a t^4 = b - t
Polynomial NormalForm::radiant_temperature(const Polynomial& a, const Polynomial& b) {
    if (vanishes(a) || vanishes(b)) return b;
    const Polynomial over_a = inverse(a);
    const auto [found, is_new] = atoms_.emplace(std::pair(std::string("radiant_temperature"), std::vector<Polynomial>{a, b}), 0);
    if (is_new) {
        found->second = new_letter();
        relate(found->second, 4, multiply(b - Polynomial::letter(found->second), over_a));
    }
    return Polynomial::letter(found->second);
}

/// A letter for each function of the same network. Where nothing radiates, temperatures are written out with the inverse.
Polynomial NormalForm::network(const std::string& name, const ex& e) {
    const ex& list = e.op(e.nops() - 1);
    if (name == "balanced_temperature" && NetworkData(list).is_linear()) return convert(in_inverse(e));
    std::vector<Polynomial> arguments;
    for (std::size_t i = 0; i + 1 < e.nops(); ++i) arguments.push_back(convert(e.op(i)));
    for (const ex& entry : list) arguments.push_back(convert(entry));
    const auto [found, is_new] = atoms_.emplace(std::pair(name, std::move(arguments)), 0);
    if (is_new) found->second = new_letter();
    return Polynomial::letter(found->second);
}

/// Makes the letters of all roots, so that root_of_product finds them, in whatever order the expression stands.
void NormalForm::roots_first(const ex& e) {
    if (std::none_of(e.preorder_begin(), e.preorder_end(), [](const ex& part) { return is_function(part, "root_excess"); })) return;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        const bool is_root = GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::rational) &&
                             !part->op(1).info(GiNaC::info_flags::integer);
        if (is_root || is_function(*part, "norm") || is_function(*part, "inverse_norm")) convert(*part);
    }
}

}  // namespace dalembert
