// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/printed_pair.hpp"

#include "balance/steps.hpp"
#include "form/constrained_motion.hpp"
#include "symbolic/squares.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_determinant = 5;

}  // namespace

PairCheck::PairCheck(const System& system, GiNaC::exmap at)
    : system_(system),
      prover_(system),
      at_(std::move(at)),
      held_(system.held_motion()),
      unknowns_(system.unknowns()),
      n_(unknowns_.size() - left_out_at_start(system)) {
    find_manifold();
}

PrintedResult PairCheck::run(const ex& left_side, const ex& right_side) {
    const ex left = prepared(left_side);
    const ex right = prepared(right_side);
    if (has_open_integral(left) || has_open_integral(right)) return run_by_quadrature(left, right);
    const ex rest = left - right;
    PrintedResult result;
    if (!contains_acceleration(rest)) {
        result.derived = left;
        result.comparison = prover_.equal(left, right);
        if (result.comparison.verdict != Verdict::wrong) return result;
        result.difference = rest;
        result.counterexample = counterexample(left, right, *result.comparison.counterexample);
        result.hint = order_hint(left, right);
        return result;
    }
    if (holds_on_motion(rest, result)) {
        result.comparison = {Verdict::proven};
        result.difference.reset();
        return result;
    }
    if (const auto solved = with_single_acceleration(left, right)) {
        result.comparison = *solved;
        result.difference.reset();
        return result;
    }
    result.comparison = prover_.compare_at_points(
        [this](const ex& e, const Point& point, int digits) { return value_on_motion(e, point, digits); }, left, right);
    if (result.comparison.verdict != Verdict::wrong) {
        result.difference.reset();
        return result;
    }
    result.counterexample = counterexample(left, right, *result.comparison.counterexample);
    result.hint = order_hint(left, right);
    return result;
}

PrintedResult PairCheck::run_number(const ex& value, const PrintedNumber& number) {
    PrintedResult result;
    if (has_open_integral(value)) return number_by_quadrature(at_point(value), number);
    const ex exact = at_point(value);
    result.comparison = compare_with_number(exact, number);
    if (result.comparison.verdict != Verdict::wrong) return result;
    result.counterexample = CounterExample{{}, number_text(exact, number.unit.value_or(Unit{})), decimal(number.value, 12)};
    return result;
}

bool PairCheck::contains_acceleration(const ex& e) const {
    return std::any_of(unknowns_.begin(), unknowns_.end(), [&](const ex& unknown) { return e.has(unknown); });
}

ex PairCheck::on_constraints(ex e) const {
    for (const GiNaC::exmap* map : {&held_, &velocities_, &positions_})
        if (!map->empty()) e = e.subs(*map, GiNaC::subs_options::no_pattern);
    return e;
}

void PairCheck::find_manifold() {
    const Symbols& symbols = system_.symbols;
    for (const std::size_t constraint : system_.motion.multipliers) {
        const ConstraintEquation& c = system_.constraints[constraint];
        if (c.is_redundant) {
            held_[symbols.get(SymbolKind::multiplier, constraint)] = 0;
            continue;
        }
        const ex rate = c.whole_rate.subs(held_, GiNaC::subs_options::no_pattern).subs(velocities_, GiNaC::subs_options::no_pattern);
        for (std::size_t j = symbols.degrees(); j-- > 0;) {
            const ex& velocity = symbols.get(SymbolKind::velocity, j);
            const ex factor = partial(rate, velocity);
            if (prover_.proven_equal(factor, 0)) continue;
            const ex value = -rate.subs(velocity == 0, GiNaC::subs_options::no_pattern) / factor;
            for (auto& [known, other] : velocities_) other = other.subs(velocity == value, GiNaC::subs_options::no_pattern);
            velocities_[velocity] = value;
            break;
        }
        if (!c.position) continue;
        if (const auto at_zero = coordinate_on(c.position->subs(positions_, GiNaC::subs_options::no_pattern))) {
            const ex& coordinate = symbols.get(SymbolKind::coordinate, at_zero->first);
            for (auto& [known, other] : positions_) other = other.subs(coordinate == at_zero->second, GiNaC::subs_options::no_pattern);
            positions_[coordinate] = at_zero->second;
        }
    }
}

std::optional<std::pair<std::size_t, ex>> PairCheck::coordinate_on(const ex& position) {
    return coordinate_at_zero(position, system_.symbols, [&](const ex& factor) {
        return is_of_parameters(factor, system_.symbols) && !prover_.proven_equal(factor, 0);
    });
}

ex PairCheck::mass(std::size_t j, std::size_t l) const {
    return at_point(on_constraints(system_.motion.matrix(static_cast<unsigned>(j), static_cast<unsigned>(l))));
}

bool PairCheck::holds_on_motion(const ex& rest, PrintedResult& result) {
    if (!at_.empty() && !has_inverse()) return false;
    std::vector<ex> a;
    GiNaC::exmap without;
    for (std::size_t k = 0; k < n_; ++k) {
        a.push_back(partial(rest, acceleration(k)));
        without[acceleration(k)] = 0;
        for (std::size_t l = 0; l < n_; ++l)
            if (!partial(a.back(), acceleration(l)).is_zero()) return false;  // not linear: left to numbers
    }
    const ex b = rest.subs(without, GiNaC::subs_options::no_pattern);
    for (std::size_t j = 0; j < n_; ++j) {
        const auto ratio = multiple_of_row(a, j);
        if (!ratio) continue;
        const ex row_difference = b + *ratio * force(j);
        const bool holds = prover_.proven_equal(row_difference, 0);
        if (holds || !result.difference) {
            result.is_motion = true;
            result.derived = rest - (holds ? ex(0) : b + shortened(a, j) * force(j));
            result.difference = b + (holds ? *ratio : shortened(a, j)) * force(j);
        }
        if (holds) return true;
    }
    if (n_ > most_determinant) return false;
    // det [M, force; a', -b] = -det(M) (a' M^-1 force + b)
    const auto size = static_cast<unsigned>(n_ + 1);
    GiNaC::matrix bordered(size, size);
    for (unsigned j = 0; j + 1 < size; ++j) {
        for (unsigned l = 0; l + 1 < size; ++l) bordered(j, l) = mass(j, l);
        bordered(j, size - 1) = force(j);
        bordered(size - 1, j) = a[j];
    }
    bordered(size - 1, size - 1) = -b;
    return prover_.proven_equal(bordered.determinant(GiNaC::determinant_algo::laplace), 0);
}

std::optional<Comparison> PairCheck::with_single_acceleration(const ex& left, const ex& right) {
    if (n_ != 1 || !has_inverse()) return std::nullopt;
    const GiNaC::exmap solved{{acceleration(0), force(0) / mass(0, 0)}};
    const Comparison comparison =
        prover_.equal(left.subs(solved, GiNaC::subs_options::no_pattern), right.subs(solved, GiNaC::subs_options::no_pattern));
    const bool is_proven = comparison.verdict == Verdict::proven || comparison.verdict == Verdict::proven_under_assumption;
    return is_proven ? std::optional(comparison) : std::nullopt;
}

ex PairCheck::shortened(const std::vector<ex>& a, std::size_t j) const {
    Squares squares{PositiveByRange(system_.translate)};
    for (std::size_t l = 0; l < n_; ++l)
        if (!a[l].is_zero() && !mass(j, l).is_zero())
            return squares.shortened(system_.symbols.without_definitions(a[l])) /
                   squares.shortened(system_.symbols.without_definitions(mass(j, l)));
    return 0;
}

bool PairCheck::has_inverse() {
    if (n_ > most_determinant) return true;
    GiNaC::matrix m(static_cast<unsigned>(n_), static_cast<unsigned>(n_));
    for (unsigned j = 0; j < n_; ++j)
        for (unsigned l = 0; l < n_; ++l) m(j, l) = mass(j, l);
    return n_ == 0 || !prover_.proven_equal(m.determinant(GiNaC::determinant_algo::laplace), 0);
}

std::optional<ex> PairCheck::multiple_of_row(const std::vector<ex>& a, std::size_t j) {
    std::size_t pivot = n_;
    for (std::size_t l = 0; l < n_ && pivot == n_; ++l)
        if (!a[l].is_zero() && !mass(j, l).is_zero()) pivot = l;
    if (pivot == n_) return std::nullopt;
    for (std::size_t l = 0; l < n_; ++l)
        if (!prover_.proven_equal(a[l] * mass(j, pivot), a[pivot] * mass(j, l))) return std::nullopt;
    return a[pivot] / mass(j, pivot);
}

CounterExample PairCheck::counterexample(const ex& left, const ex& right, const Point& found) const {
    Point point = found;
    for (auto& [letter, value] : point) value = rounded(value, 3);
    const auto difference = [&](int digits) { return value_on_motion(left - right, point, digits); };
    if (sign_at(difference) != Sign::not_zero) point = found;
    CounterExample result;
    const ex written_out[]{system_.symbols.without_definitions(left), system_.symbols.without_definitions(right)};
    for (const auto& [letter, value] : point) {
        const Variable* variable = system_.symbols.find(letter);
        if (variable == nullptr || variable->kind == SymbolKind::acceleration || variable->kind == SymbolKind::state_rate ||
            variable->kind == SymbolKind::multiplier)
            continue;
        if (needed(written_out[0], letter) || needed(written_out[1], letter)) result.values.emplace_back(variable->name, decimal(value, 6));
    }
    const auto number = [&](const ex& e, int digits) {
        const auto value = value_on_motion(e, point, 60);
        return value ? decimal(cln::rational(*value), digits) : std::string("none");
    };
    for (int digits = 6; digits <= 48 && result.left == result.right; digits *= 2) {  // as many as show the difference
        result.left = number(left, digits);
        result.right = number(right, digits);
    }
    return result;
}

bool PairCheck::needed(const ex& e, const ex& letter) const {
    if (e.has(letter)) return true;
    for (std::size_t j = 0; j < n_; ++j) {
        if (!e.has(acceleration(j))) continue;
        for (std::size_t i = 0; i < n_; ++i)
            if (system_.symbols.without_definitions(system_.motion.residual[i]).has(letter)) return true;
    }
    return false;
}

std::optional<cln::cl_R> PairCheck::value_on_motion(const ex& e, const Point& point, int digits) const {
    if (!contains_acceleration(e)) return value_at(e, system_.symbols, point, digits);
    std::vector<std::vector<cln::cl_R>> m(n_, std::vector<cln::cl_R>(n_ + 1));
    for (std::size_t j = 0; j < n_; ++j)
        for (std::size_t l = 0; l <= n_; ++l) {
            const auto value = value_at(l < n_ ? mass(j, l) : force(j), system_.symbols, point, digits);
            if (!value) return std::nullopt;
            m[j][l] = *value;
        }
    for (std::size_t k = 0; k < n_; ++k) {
        std::size_t best = k;
        for (std::size_t j = k + 1; j < n_; ++j)
            if (cln::abs(m[j][k]) > cln::abs(m[best][k])) best = j;
        std::swap(m[k], m[best]);
        if (cln::zerop(m[k][k])) return std::nullopt;
        for (std::size_t j = 0; j < n_; ++j) {
            if (j == k) continue;
            const cln::cl_R factor = m[j][k] / m[k][k];
            for (std::size_t l = k; l <= n_; ++l) m[j][l] = m[j][l] - factor * m[k][l];
        }
    }
    GiNaC::exmap solved;
    for (std::size_t j = 0; j < n_; ++j) solved[acceleration(j)] = GiNaC::numeric(m[j][n_] / m[j][j]);
    return value_at(e.subs(solved, GiNaC::subs_options::no_pattern), system_.symbols, point, digits);
}

bool PairCheck::may_hold(const ex& left_side, const ex& right_side) const {
    constexpr int tries = 6, enough = 2, digits = 60;
    const ex left = prepared(left_side), difference = left - prepared(right_side);
    if (has_open_integral(difference) || has_open_integral(left)) return false;  // nothing that is proven
    const cln::cl_R small = cln::expt(cln::cl_RA(10), -40);
    RandomPoints points(system_);
    for (int i = 0, valid = 0; i < tries && valid < enough; ++i) {
        const Point point = points.next();
        const auto size = value_on_motion(left, point, digits), off = value_on_motion(difference, point, digits);
        if (!size || !off) continue;
        ++valid;
        if (cln::abs(*off) > small * (cln::abs(*size) + small)) return false;
    }
    return true;
}

}  // namespace dalembert
