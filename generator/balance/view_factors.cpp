// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/view_factors.hpp"

#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>

#include "elements/heat.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using cln::cl_R;
using GiNaC::ex;

namespace {

class Completion {
public:
    Completion(const Enclosure& enclosure, const std::vector<ex>& areas, const std::vector<std::vector<std::optional<ex>>>& factors,
               const Defaults& value)
        : enclosure_(enclosure), areas_(areas), factors_(factors), value_(value), n_(areas.size()), direct_(n_, std::vector<ex>(n_)) {}

    std::vector<std::vector<ex>> run() {
        check_entries();
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = i; j < n_; ++j) {
                if (factors_[i][j] && factors_[j][i]) check_reciprocity(i, j);
                if (factors_[i][j]) set(i, j, areas_[i] * *factors_[i][j]);
                else if (factors_[j][i]) set(i, j, areas_[j] * *factors_[j][i]);
                else unknown_.emplace_back(i, j);
            }
        for (std::size_t i = 0; i < n_; ++i) check_row(i);
        if (!unknown_.empty()) complete();
        return std::move(direct_);
    }

private:
    void set(std::size_t i, std::size_t j, const ex& e) { direct_[i][j] = direct_[j][i] = e; }
    bool is_unknown(std::size_t i, std::size_t j) const {
        return std::find(unknown_.begin(), unknown_.end(), Pair(std::min(i, j), std::max(i, j))) != unknown_.end();
    }
    Span place(std::size_t i, std::size_t j) const {
        const ExpressionPtr& entry = enclosure_.view_factors[i][j];
        return entry ? entry->span : enclosure_.view_factors.span;
    }
    std::string name(std::size_t i) const { return surface_name(enclosure_, i); }
    [[noreturn]] void fail(Id id, const Span& span, const std::string& message, std::vector<Note> notes = {}) const {
        throw Failure(Diagnostic{id, span, message, std::move(notes)});
    }

    void check_entries() const {
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) {
                const auto number = factors_[i][j] ? value_(*factors_[i][j]) : std::nullopt;
                if (number && (sign_of_value(*number) < 0 || sign_of_value(*number - 1) > 0))
                    fail(
                        Id::value_out_of_range, place(i, j),
                        fmt::format("the view factor from {} to {} is {}, but must lie between 0 and 1", name(i), name(j), shown(*number)));
            }
    }

    void check_reciprocity(std::size_t i, std::size_t j) const {
        const ex here = areas_[i] * *factors_[i][j];
        const ex back = areas_[j] * *factors_[j][i];
        if ((here - back).expand().is_zero()) return;
        const auto left = value_(here);
        const auto right = value_(back);
        if (!left || !right || sign_of_value((*left - *right) / cln::max(cln::abs(*left), cln::abs(*right))) == 0) return;
        fail(Id::wrong_enclosure, place(j, i),
             fmt::format("the view factors of enclosure '{}' break the reciprocity A_i*F_ij = A_j*F_ji (4.45): from {} to {} it is {} m^2, "
                         "but back {} m^2; leave one of the two out as \"?\"",
                         enclosure_.name, name(i), name(j), shown(*left), shown(*right)),
             {{place(i, j), "the other one stands here"}});
    }

    /// Sums of what is given.
    void check_row(std::size_t i) const {
        ex sum = 0;
        bool is_complete = true;
        for (std::size_t j = 0; j < n_; ++j) {
            if (is_unknown(i, j)) is_complete = false;
            else sum += factors_[i][j] ? *factors_[i][j] : direct_[i][j] / areas_[i];
        }
        if ((sum - 1).expand().is_zero()) return;
        const auto number = value_(sum);
        if (!number) return;
        const int sign = sign_of_value(*number - 1);
        const char* given = is_complete ? "" : " that are given";
        if (sign > 0)
            fail(Id::wrong_enclosure, row_place(i),
                 fmt::format("the view factors from {}{} add up to {}, more than the 1 of (4.47)", name(i), given, shown(*number)));
        if (sign < 0 && is_complete)
            fail(Id::wrong_enclosure, row_place(i),
                 fmt::format("enclosure '{}' is open: the view factors from {} add up to {} instead of 1 (4.47). Leave one out as \"?\", "
                             "or add a black surface for the opening, held at the "
                             "temperature outside",
                             enclosure_.name, name(i), shown(*number)));
    }
    Span row_place(std::size_t i) const {
        for (const ExpressionPtr& entry : enclosure_.view_factors[i])
            if (entry) return entry->span;
        return enclosure_.view_factors.span;
    }

    void complete() {
        const SolvedRows solved = solve_rows(areas_, direct_, unknown_);
        if (solved.undetermined)
            fail(Id::undetermined, enclosure_.view_factors.span,
                 fmt::format("reciprocity (4.45) and the sums of rows (4.47) do not determine the view factor from {} to {}; give it",
                             name(solved.undetermined->first), name(solved.undetermined->second)));
        for (const ex& rest : solved.left_over) {
            const auto number = rest.expand().is_zero() ? std::nullopt : value_(rest);
            if (number && sign_of_value(*number) != 0)
                fail(Id::wrong_enclosure, enclosure_.view_factors.span,
                     fmt::format("the missing view factors of enclosure '{}' cannot make all rows add up to 1 (4.47) and keep the "
                                 "reciprocity (4.45): {} m^2 are left over",
                                 enclosure_.name, shown(*number)));
        }
        for (std::size_t u = 0; u < unknown_.size(); ++u) {
            const auto [i, j] = unknown_[u];
            set(i, j, solved.values[u]);
            const auto number = value_(direct_[i][j] / areas_[i]);
            if (number && sign_of_value(*number) < 0)
                fail(Id::wrong_enclosure, enclosure_.view_factors.span,
                     fmt::format("the view factor from {} to {} follows as {} from reciprocity (4.45) and the sums of rows (4.47), but "
                                 "must not be below 0",
                                 name(i), name(j), shown(*number)));
        }
    }

    const Enclosure& enclosure_;
    const std::vector<ex>& areas_;
    const std::vector<std::vector<std::optional<ex>>>& factors_;
    const Defaults& value_;
    std::size_t n_;
    std::vector<std::vector<ex>> direct_;
    std::vector<Pair> unknown_;
};

}  // namespace

SolvedRows solve_rows(const std::vector<ex>& areas, const std::vector<std::vector<ex>>& direct, const std::vector<Pair>& unknown) {
    struct Row {
        std::vector<GiNaC::numeric> factors;
        ex right;
    };
    const std::size_t n = areas.size();
    std::vector<Row> rows;
    for (std::size_t i = 0; i < n; ++i) {
        Row row{std::vector<GiNaC::numeric>(unknown.size(), 0), areas[i] - GiNaC::add(GiNaC::exvector(direct[i].begin(), direct[i].end()))};
        for (std::size_t u = 0; u < unknown.size(); ++u)
            if (unknown[u].first == i || unknown[u].second == i) row.factors[u] = 1;
        rows.push_back(std::move(row));
    }
    SolvedRows result;
    for (std::size_t u = 0; u < unknown.size(); ++u) {
        std::size_t pivot = u;
        while (pivot < n && rows[pivot].factors[u].is_zero()) ++pivot;
        if (pivot >= n) {
            result.undetermined = unknown[u];
            return result;
        }
        std::swap(rows[u], rows[pivot]);
        for (std::size_t i = 0; i < n; ++i) {
            if (i == u || rows[i].factors[u].is_zero()) continue;
            const GiNaC::numeric factor = rows[i].factors[u] / rows[u].factors[u];
            for (std::size_t v = u; v < unknown.size(); ++v) rows[i].factors[v] -= factor * rows[u].factors[v];
            rows[i].right -= factor * rows[u].right;
        }
    }
    for (std::size_t u = 0; u < unknown.size(); ++u) result.values.push_back((rows[u].right / rows[u].factors[u]).expand());
    for (std::size_t i = unknown.size(); i < n; ++i) result.left_over.push_back(rows[i].right);
    return result;
}

std::string surface_name(const Enclosure& enclosure, std::size_t i) {
    const auto name = [](const Reference& surface) { return std::string(surface.span.text()); };
    const std::string own = name(enclosure.surfaces[i]);
    const auto same =
        std::count_if(enclosure.surfaces.begin(), enclosure.surfaces.end(), [&](const Reference& surface) { return name(surface) == own; });
    return same == 1 ? fmt::format("'{}'", own) : fmt::format("'{}' (surface {})", own, i + 1);
}

Defaults::Defaults(const Scene& scene, const Translator& translate)
    : symbols_(translate.symbols()), values_(Values(scene, translate).substitution()) {
    for (const Variable& input : symbols_.all(SymbolKind::input)) values_.erase(input.symbol);
}

std::optional<cl_R> Defaults::operator()(const ex& e) const {
    GiNaC::Digits = 60;
    try {
        ex value = e.subs(values_, GiNaC::subs_options::no_pattern);
        if (!GiNaC::is_exactly_a<GiNaC::numeric>(value)) value = value.evalf();
        if (!GiNaC::is_exactly_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_real()) return std::nullopt;
        return cln::realpart(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
    } catch (const std::exception&) {  // a pole
        return std::nullopt;
    }
}

int sign_of_value(const cl_R& value) {
    static const cln::cl_RA tiny = cln::expt(cln::cl_RA(10), -45);
    return cln::abs(value) <= tiny ? 0 : cln::minusp(value) ? -1 : 1;
}

std::vector<std::vector<ex>> complete_view_factors(const Enclosure& enclosure, const std::vector<ex>& areas,
                                                   const std::vector<std::vector<std::optional<ex>>>& factors, const Defaults& value) {
    return Completion(enclosure, areas, factors, value).run();
}

std::string shown(const cl_R& value) { return fmt::format("{:.6g}", cln::double_approx(value)); }

}  // namespace dalembert
