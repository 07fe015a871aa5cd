// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/switches.hpp"

#include <algorithm>

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/parts.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// A term of a sum or a factor of a product.
bool is_unlocated(const ex& e) {
    if (is_ex_the_function(e, unlocated)) return true;
    if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return false;
    for (const ex& part : e)
        if (is_unlocated(part)) return true;
    return false;
}

std::optional<Switch> switch_by(const ex& by, int order) { return Switch{by, order, !is_unlocated(by), false}; }

struct Unlocated : GiNaC::map_function {
    ex operator()(const ex& e) override {
        const ex inside = e.map(*this);
        if (const auto call = curve_call(inside)) return curve_function(call->order, unlocated(inside.op(0)), inside.op(1));
        if (map_call(inside)) return map_value(unlocated(inside.op(0)), unlocated(inside.op(1)), inside.op(2));
        if (!switch_of(inside)) return inside;
        if (is_ex_the_function(inside, minimum)) return minimum(unlocated(inside.op(0)), unlocated(inside.op(1)));
        if (is_ex_the_function(inside, maximum)) return maximum(unlocated(inside.op(0)), unlocated(inside.op(1)));
        if (is_ex_the_function(inside, if_else)) return if_else(unlocated(inside.op(0)), inside.op(1), inside.op(2));
        if (is_ex_the_function(inside, magnitude)) return magnitude(unlocated(inside.op(0)));
        if (is_ex_the_function(inside, sign_of)) return sign_of(unlocated(inside.op(0)));
        if (is_ex_the_function(inside, unit_step)) return unit_step(unlocated(inside.op(0)));
        return floor_of(unlocated(inside.op(0)));
    }
};

/// Orders of kinks and of zeros at one switch.
class KinkOrder {
public:
    explicit KinkOrder(const ex& by) : by_(by.expand()) {
        for (auto part = by_.preorder_begin(); part != by_.preorder_end() && at_zero_.empty(); ++part) {
            if (!GiNaC::is_a<GiNaC::symbol>(*part) || !by_.is_polynomial(*part) || by_.degree(*part) != 1) continue;
            const ex slope = by_.coeff(*part, 1), rest = by_.coeff(*part, 0);
            if (!slope.has(*part) && !rest.has(*part)) at_zero_[*part] = -rest / slope;
        }
    }

    std::optional<numeric> operator()(const ex& e) const {
        std::optional<numeric> lowest;
        const auto note = [&](const std::optional<numeric>& order) {
            if (order && (!lowest || *order < *lowest)) lowest = order;
        };
        if (GiNaC::is_a<GiNaC::mul>(e)) {
            for (std::size_t i = 0; i < e.nops(); ++i) {
                auto order = (*this)(e.op(i));
                for (std::size_t k = 0; order && k < e.nops(); ++k)
                    if (k != i) *order = *order + zero(e.op(k));
                note(order);
            }
            return lowest;
        }
        if (GiNaC::is_a<GiNaC::power>(e)) {
            auto order = (*this)(e.op(0));
            if (order && GiNaC::is_exactly_a<numeric>(e.op(1))) *order = *order + (ex_to<numeric>(e.op(1)) - 1) * zero(e.op(0));
            note(order);
            note((*this)(e.op(1)));
            return lowest;
        }
        if (const auto own = switch_of(e); own && is_same(own->by)) note(numeric(own->order));
        for (std::size_t i = 0; i < e.nops(); ++i) note((*this)(e.op(i)));
        return lowest;
    }

private:
    bool is_same(const ex& other) const { return (other - by_).expand().is_zero() || (other + by_).expand().is_zero(); }

    /// How often e is zero with the switch, as far as that is seen.
    numeric zero(const ex& e) const {
        if (GiNaC::is_a<GiNaC::power>(e) && GiNaC::is_exactly_a<numeric>(e.op(1))) return zero(e.op(0)) * ex_to<numeric>(e.op(1));
        if (const auto own = switch_of(e)) {
            const bool from_zero =
                is_ex_the_function(e, magnitude) ||
                ((is_ex_the_function(e, minimum) || is_ex_the_function(e, maximum)) && (e.op(0).is_zero() || e.op(1).is_zero()));
            return from_zero && is_same(own->by) ? 1 : 0;
        }
        if (at_zero_.empty() || !e.has(at_zero_.begin()->first)) return 0;
        return e.subs(at_zero_, GiNaC::subs_options::no_pattern).expand().is_zero() ? 1 : 0;
    }

    ex by_;
    GiNaC::exmap at_zero_;  ///< a letter of the switch, solved for
};

}  // namespace

std::optional<Switch> switch_of(const ex& f) {
    if (!GiNaC::is_a<GiNaC::function>(f)) return std::nullopt;
    if (is_ex_the_function(f, magnitude)) return switch_by(f.op(0), 1);
    if (is_ex_the_function(f, minimum) || is_ex_the_function(f, maximum)) return switch_by(f.op(0) - f.op(1), 1);
    if (is_ex_the_function(f, sign_of) || is_ex_the_function(f, unit_step) || is_ex_the_function(f, if_else)) return switch_by(f.op(0), 0);
    // At every whole number.
    if (is_ex_the_function(f, floor_of)) return Switch{GiNaC::sin(GiNaC::Pi * f.op(0)), 0, !is_unlocated(f.op(0)), false};
    return std::nullopt;
}

namespace {

std::vector<Switch> switches_of_map(const ex& f, const MapCall& call) {
    std::vector<Switch> result;
    for (const std::size_t axis : {0U, 1U}) {
        const std::vector<Rational>& knots = call.map->axes[axis].knots;
        for (std::size_t i = 0; i < knots.size(); ++i)
            if (const auto order = call.map->order_of_jump(axis, i, call.orders))
                result.push_back({f.op(axis) - numeric(knots[i]), *order - call.orders[axis], !is_unlocated(f.op(axis)), true});
    }
    return result;
}

}  // namespace

std::vector<Switch> switches_of_curve(const ex& f) {
    if (const auto call = map_call(f)) return switches_of_map(f, *call);
    const auto call = curve_call(f);
    if (!call) return {};
    std::vector<Switch> result;
    for (std::size_t i = 0; i < call->curve->knots.size(); ++i)
        if (const int order = call->curve->order_of_jump(i, std::max(call->order, 0)); order <= 3)
            result.push_back({f.op(0) - numeric(call->curve->knots[i]), order - call->order, !is_unlocated(f.op(0)), true});
    return result;
}

std::vector<Switch> switches_in(const ex& e) {
    std::vector<Switch> result;
    each_part_once(e, [&](const ex& part) {
        if (auto found = switch_of(part)) result.push_back(std::move(*found));
        for (Switch& knot : switches_of_curve(part)) result.push_back(std::move(knot));
    });
    return result;
}

ex with_unlocated_switches(const ex& e) {
    Unlocated without;
    return without(e);
}

std::optional<numeric> order_of_kink(const ex& e, const ex& by) { return KinkOrder(by)(e); }

}  // namespace dalembert
