// SPDX-License-Identifier: GPL-3.0-or-later
// Can a volume become zero? By interval arithmetic over the declared ranges.
#include <fmt/format.h>

#include <algorithm>

#include "check/checks.hpp"
#include "elements/fluids.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// Bounds; one that is not there is infinite.
struct Interval {
    std::optional<Rational> low, high;
};

class Bounding {
public:
    explicit Bounding(const Names& names) : names_(names) {}

    /// Nothing where the form of the expression is beyond this arithmetic.
    std::optional<Interval> operator()(const Expression& e) {
        if (e.kind == Kind::number) return Interval{e.value, e.value};
        if (e.kind == Kind::name) return name(e);
        if (e.kind == Kind::call && (e.name == "sin" || e.name == "cos")) return Interval{Rational(-1), Rational(1)};
        std::vector<Interval> parts;
        for (const ExpressionPtr& child : e.children) {
            const auto part = (*this)(*child);
            if (!part) return std::nullopt;
            parts.push_back(*part);
        }
        switch (e.kind) {
            case Kind::negate: return negated(parts[0]);
            case Kind::add: return sum(parts[0], parts[1]);
            case Kind::subtract: return sum(parts[0], negated(parts[1]));
            case Kind::multiply: return product(parts[0], parts[1]);
            case Kind::divide: {
                const auto& d = parts[1];
                if (!d.low || !d.high || is_zero(*d.low) || *d.low != *d.high) return std::nullopt;
                return product(parts[0], {Rational(1) / *d.low, Rational(1) / *d.low});
            }
            case Kind::power: {
                const auto n = parts[1].low && parts[1].high && *parts[1].low == *parts[1].high ? to_int(*parts[1].low) : std::nullopt;
                if (!n || *n < 1 || *n > 8) return std::nullopt;
                Interval result = parts[0];
                for (int i = 1; i < *n; ++i) result = product(result, parts[0]);
                return result;
            }
            default: return std::nullopt;
        }
    }

    /// The first name without bounds that was met.
    const std::string& unbounded() const { return unbounded_; }

private:
    std::optional<Interval> name(const Expression& e) {
        const Named* named = names_.find(e.name);
        // More digits of pi than make a difference to a bound that is told in words.
        if (e.name == "pi") return Interval{Rational(314159265) / 100000000, Rational(314159266) / 100000000};
        if (e.name == "t") return Interval{Rational(0), std::nullopt};  // runs begin at zero or later
        if (named == nullptr || !e.children.empty()) return std::nullopt;
        switch (named->kind) {
            case Named::Kind::definition: return (*this)(*named->definition().value);
            case Named::Kind::parameter: {
                const MemberValues& values = static_cast<const Parameter&>(*named->item).values;
                return values.empty() ? std::nullopt : (*this)(*values[0]);
            }
            case Named::Kind::coordinate:
            case Named::Kind::state: break;
            default: return std::nullopt;
        }
        const auto& range = named->quantity().range;
        const auto bound = [&](const ExpressionPtr& at) -> std::optional<Rational> {
            const auto value = at ? (*this)(*at) : std::nullopt;
            return value ? value->low : std::nullopt;
        };
        Interval result;
        if (range) result = {bound(range->low), bound(range->high)};
        if ((!result.low || !result.high) && unbounded_.empty()) unbounded_ = e.name;
        return result;
    }

    static Interval negated(const Interval& a) {
        return {a.high ? std::optional(-*a.high) : std::nullopt, a.low ? std::optional(-*a.low) : std::nullopt};
    }
    static Interval sum(const Interval& a, const Interval& b) {
        Interval result;
        if (a.low && b.low) result.low = *a.low + *b.low;
        if (a.high && b.high) result.high = *a.high + *b.high;
        return result;
    }
    static std::optional<Interval> bounded_product(const Interval& a, const Interval& b) {
        if (!a.low || !a.high || !b.low || !b.high) return std::nullopt;
        const Rational corners[]{*a.low * *b.low, *a.low * *b.high, *a.high * *b.low, *a.high * *b.high};
        return Interval{*std::min_element(std::begin(corners), std::end(corners)),
                        *std::max_element(std::begin(corners), std::end(corners))};
    }
    /// A factor that is known and positive keeps a bound where the other side has one.
    static Interval product(const Interval& a, const Interval& b) {
        if (const auto bounded = bounded_product(a, b)) return *bounded;
        const auto scaled = [](const Interval& positive, const Interval& x) -> std::optional<Interval> {
            if (!positive.low || !positive.high || !cln::plusp(*positive.low)) return std::nullopt;
            Interval result;
            if (x.low) result.low = is_negative(*x.low) ? *x.low * *positive.high : *x.low * *positive.low;
            if (x.high) result.high = is_negative(*x.high) ? *x.high * *positive.low : *x.high * *positive.high;
            return result;
        };
        if (const auto result = scaled(a, b)) return *result;
        if (const auto result = scaled(b, a)) return *result;
        return {};
    }

    const Names& names_;
    std::string unbounded_;
};

}  // namespace

void warn_of_vanishing(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    for (const Volume& volume : model.volumes) {
        const unsigned moves = on_coordinates | on_time | on_states;
        if (volume.filling || (dependence(*volume.volume, names) & moves) == 0) continue;
        Bounding bounds(names);
        const auto size = bounds(*volume.volume);
        if (size && size->low && cln::plusp(*size->low)) continue;
        const std::string why = !size       ? "the program finds no lower bound of its size"
                                : size->low ? fmt::format("within the declared ranges it gets down to {} m^3", decimal(*size->low, 3))
                                            : fmt::format("'{}' has no range that keeps it away from zero", bounds.unbounded());
        diagnostics.warning(Id::can_vanish, volume.volume->span,
                            fmt::format("volume '{}' can reach zero: {}; a run stops before it does", volume.name, why));
    }
}

}  // namespace dalembert
