// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/definiteness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

/// Of an expression over the ranges: positive inside of them, or everywhere; unknown may be anything.
enum class PivotSign { unknown, zero, inside, positive };

class Signs {
public:
    explicit Signs(const Symbols& symbols) {
        for (const Variable& p : symbols.all(SymbolKind::parameter))
            if (!p.is_positive && p.declared != nullptr && p.declared->range && p.declared->range->low &&
                p.declared->range->low->kind == Expression::Kind::number && cln::zerop(p.declared->range->low->value))
                from_zero_.emplace(p.symbol, p.name);
    }

    /// Of a sum or product whose parts tell.
    PivotSign of(const ex& e) const {
        if (e.is_zero()) return PivotSign::zero;
        if (e.info(GiNaC::info_flags::positive)) return PivotSign::positive;
        if (from_zero_.contains(e)) return PivotSign::inside;
        if (GiNaC::is_a<GiNaC::power>(e)) return GiNaC::is_a<numeric>(e.op(1)) ? of(e.op(0)) : PivotSign::unknown;
        if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return PivotSign::unknown;
        const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
        PivotSign result = is_sum ? PivotSign::zero : PivotSign::positive;
        for (std::size_t i = 0; i < e.nops(); ++i) {
            const PivotSign part = of(e.op(i));
            if (part == PivotSign::unknown) return part;
            result = is_sum ? std::max(result, part) : std::min(result, part);
        }
        return result;
    }
    PivotSign of_fraction(const ex& e) const {
        const ex parts = e.numer_denom();
        ex above = parts.op(0).expand(), below = parts.op(1).expand();
        if (of(below) == PivotSign::unknown) above = -above, below = -below;
        const PivotSign sign = of(below);
        return sign == PivotSign::unknown ? sign : std::min(of(above), sign);
    }
    std::vector<std::string> names_in(const GiNaC::matrix& A, const Symbols& symbols) const {
        std::vector<std::string> names;
        for (const Variable& p : symbols.all(SymbolKind::parameter))
            if (from_zero_.contains(p.symbol) && ex(A).has(p.symbol)) names.push_back(p.name);
        return names;
    }

private:
    std::map<ex, std::string, GiNaC::ex_is_less> from_zero_;
};

/// The matrix is positive semidefinite for all parameters if the pivots are positive for those inside their ranges, since it is
/// continuous: nothing is divided by in A itself. Empty where the signs do not tell.
std::optional<DefinitenessVerdict> by_pivots(GiNaC::matrix A, const Symbols& symbols) {
    const Signs signs(symbols);
    const std::vector<std::string> from_zero = signs.names_in(A, symbols);
    std::vector<unsigned> left(A.rows());
    for (unsigned i = 0; i < A.rows(); ++i) left[i] = i;
    bool is_strict = true;
    while (!left.empty()) {
        auto pivot = left.end();
        PivotSign sign = PivotSign::zero;
        for (auto i = left.begin(); i != left.end(); ++i)
            if (const PivotSign s = signs.of_fraction(A(*i, *i));
                s == PivotSign::positive || (s == PivotSign::inside && sign == PivotSign::zero)) {
                pivot = i;
                sign = s;
                if (s == PivotSign::positive) break;
            }
        if (pivot == left.end()) {
            for (const unsigned i : left)
                for (const unsigned j : left)
                    if (!A(i, j).is_zero()) return std::nullopt;
            return DefinitenessVerdict{"positive semidefinite", true};
        }
        is_strict = is_strict && sign == PivotSign::positive;
        const unsigned p = *pivot;
        left.erase(pivot);
        for (const unsigned i : left)
            for (const unsigned j : left)
                if (j <= i) A(j, i) = A(i, j) = (A(i, j) - A(i, p) * A(p, j) / A(p, p)).normal();
    }
    if (is_strict) return DefinitenessVerdict{"positive definite", true};
    return DefinitenessVerdict{"positive semidefinite", true, from_zero};
}

/// The signs of the eigenvalues are those of the pivots (Sylvester), exact where the values are rational.
std::string at_values(const GiNaC::matrix& A, const System& system) {
    GiNaC::exmap point = Values(system.scene, system.translate).substitution();
    constexpr int digits = 60;
    add_steps(point, system.symbols, digits);
    const std::size_t n = A.rows();
    std::vector<std::vector<cln::cl_R>> S(n, std::vector<cln::cl_R>(n, 0));
    cln::cl_R largest = 0;
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
            const auto value = value_at(A(i, j), point, digits);
            if (!value) return "not defined";
            S[i][j] = *value;
            largest = cln::max(largest, cln::abs(*value));
        }
    const auto is_zero = [&](const cln::cl_R& x) {
        return cln::zerop(x) || cln::abs(x) < largest / cln::expt_pos(cln::cl_I(10), digits / 2);
    };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!is_zero(S[i][j] - S[j][i])) return "not symmetric";
    std::set<std::size_t> left;
    for (std::size_t i = 0; i < n; ++i) left.insert(i);
    std::size_t positive = 0, negative = 0;
    while (!left.empty()) {
        const std::size_t p = *std::max_element(left.begin(), left.end(),
                                                [&](std::size_t i, std::size_t j) { return cln::abs(S[i][i]) < cln::abs(S[j][j]); });
        if (is_zero(S[p][p])) {
            for (const std::size_t i : left)
                for (const std::size_t j : left)
                    if (!is_zero(S[i][j])) return "indefinite";
            break;
        }
        ++(cln::plusp(S[p][p]) ? positive : negative);
        left.erase(p);
        for (const std::size_t i : left)
            for (const std::size_t j : left) S[i][j] = S[i][j] - S[i][p] * S[p][j] / S[p][p];
    }
    if (positive > 0 && negative > 0) return "indefinite";
    if (positive + negative == 0) return "zero";
    return fmt::format("{} {}definite", positive > 0 ? "positive" : "negative", left.empty() ? "" : "semi");
}

}  // namespace

std::string DefinitenessVerdict::sentence() const {
    if (kind == "zero") return kind;
    const std::string inside =
        where.empty() ? ""
                      : fmt::format(", definite where {} {}", fmt::join(where, ", "), where.size() == 1 ? "is not zero" : "are not zero");
    return kind + (is_proven ? " for all parameters in their ranges" + inside : " at the values of the parameters");
}

DefinitenessVerdict definiteness(const GiNaC::matrix& A, const System& system) {
    GiNaC::matrix written(A.rows(), A.cols());
    bool is_zero = true, is_symmetric = true;
    for (unsigned i = 0; i < A.rows(); ++i)
        for (unsigned j = 0; j < A.cols(); ++j) {
            written(i, j) = system.symbols.without_definitions(A(i, j)).normal();
            is_zero = is_zero && written(i, j).is_zero();
        }
    if (is_zero) return {"zero", true};
    for (unsigned i = 0; i < A.rows(); ++i)
        for (unsigned j = 0; j < i; ++j) is_symmetric = is_symmetric && (written(i, j) - written(j, i)).expand().is_zero();
    if (is_symmetric)
        if (const auto proven = by_pivots(written, system.symbols)) return *proven;
    return {at_values(written, system), false};
}

}  // namespace dalembert
