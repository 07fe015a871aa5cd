// SPDX-License-Identifier: GPL-3.0-or-later
// What expressions come to when the definitions in them are written out, before anything is written out: a few lines may double each other
// until no memory holds them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check/checks.hpp"
#include "elements/model.hpp"
#include "text/budgets.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

struct Extent {
    double size = 1, depth = 1, degree = 0;
};

std::optional<Rational> number_in(const Expression& e) {
    if (e.kind == Kind::number) return e.value;
    if (e.kind == Kind::negate && e.children[0]->kind == Kind::number) return -e.children[0]->value;
    return std::nullopt;
}

class WrittenSize {
public:
    WrittenSize(const Names& names, const std::vector<PrintedLetter>& letters) : names_(names), letters_(letters) {}

    Extent of(const Expression& e) {
        Extent whole;
        std::vector<Extent> parts;
        for (const ExpressionPtr& child : e.children) {
            parts.push_back(of(*child));
            whole.size += parts.back().size;
            whole.depth = std::max(whole.depth, parts.back().depth + 1);
            whole.degree = std::max(whole.degree, parts.back().degree);
        }
        switch (e.kind) {
            case Kind::name: return name(e, whole);
            case Kind::multiply:
            case Kind::divide: whole.degree = parts[0].degree + parts[1].degree; break;
            case Kind::power: {
                const auto exponent = number_in(*e.children[1]);
                whole.degree =
                    exponent ? parts[0].degree * std::max(1.0, cln::double_approx(cln::abs(*exponent))) : std::max(1.0, parts[0].degree);
                break;
            }
            case Kind::call: whole.degree = std::min(1.0, whole.degree); break;
            default: break;
        }
        return whole;
    }

private:
    Extent name(const Expression& e, const Extent& indices) {
        const auto letter = std::find_if(letters_.begin(), letters_.end(), [&](const PrintedLetter& l) { return l.name == e.name; });
        if (letter != letters_.end()) return once(&*letter, *letter->value);
        const Named* named = names_.find(e.name);
        if (named != nullptr && named->kind == Named::Kind::definition) return once(&named->definition(), *named->definition().value);
        return {indices.size, indices.depth, 1};
    }

    /// A letter that needs itself is told elsewhere.
    Extent once(const void* item, const Expression& value) {
        if (const auto found = known_.find(item); found != known_.end()) return found->second;
        known_[item] = {};
        return known_[item] = of(value);
    }

    const Names& names_;
    const std::vector<PrintedLetter>& letters_;
    std::map<const void*, Extent> known_;
};

class SizeCheck {
public:
    SizeCheck(const Names& names, const std::vector<PrintedLetter>& letters, double most, Diagnostics& diagnostics)
        : size_(names, letters), most_(most), diagnostics_(diagnostics) {}

    /// The first that is too large: what is made of it is, too.
    void check(const Site& site) {
        if (is_told_) return;
        const Extent extent = size_.of(*site.expression);
        const auto tell = [&](const char* counted, double value, double most) {
            is_told_ = true;
            diagnostics_.error(
                Id::too_large, site.expression->span,
                fmt::format("with all definitions written out, {} {} is {:.4g}; the limit is {:.0f}", counted, site.what, value, most));
        };
        if (extent.size > most_) tell("the number of operations in", extent.size, most_);
        else if (extent.depth > budget::written_depth)
            tell("the number of nested operations in", extent.depth, budget::written_depth);
        else if (extent.degree > budget::exponent) tell("the degree of", extent.degree, budget::exponent);
    }

private:
    WrittenSize size_;
    double most_;
    Diagnostics& diagnostics_;
    bool is_told_ = false;
};

}  // namespace

void check_written_sizes(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    const std::vector<PrintedLetter> none;
    SizeCheck check(names, none, budget::written_size, diagnostics);
    visit(model, [&](const Site& site) { check.check(site); });
    for (const PrintedEquation& printed : model.printed) check_written_sizes(printed, names, diagnostics);
}

void check_written_sizes(const PrintedEquation& printed, const Names& names, Diagnostics& diagnostics) {
    SizeCheck check(names, printed.letters, budget::printed_size, diagnostics);
    visit(printed, [&](const Site& site) { check.check(site); });
}

}  // namespace dalembert
