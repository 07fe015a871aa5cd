// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/sought_temperatures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

constexpr auto no_pattern = GiNaC::subs_options::no_pattern;

/// Of linked nodes, how many temperatures are written out at most.
constexpr std::size_t most_written_out = 4;

/// To a temperature that is known, and to others that are sought; in W/K, or in W/K^4.
struct Conductances {
    ex to_known = 0;
    std::map<std::size_t, ex> to_sought = {};

    bool none() const { return to_known.is_zero() && to_sought.empty(); }
};

/// What a node without a capacity balances.
struct Row {
    NodeState* node;
    Conductances conduction = {};
    Conductances radiation = {};
    ex source = 0;  ///< W, from sources and known temperatures
    bool done = false;

    const ex& T() const { return node->warmth.temperature; }
    const ex& fourth() const { return node->warmth.fourth; }
};

class Elimination {
public:
    explicit Elimination(HeatNetwork& network) : network_(network) {
        for (NodeState& node : network.nodes)
            if (node.kind == NodeState::Kind::sought) rows_.push_back({&node});
    }

    void run() {
        for (const LinkState& link : network_.links) gather(link);
        for (std::size_t i = 0; i < rows_.size(); ++i) add(i, rows_[i].node->source);
        for (NodeState& node : network_.nodes)
            if (node.kind != NodeState::Kind::held) node.balance = network_.heat_into(node);  // with letters for what is sought
        while (eliminate_next()) continue;
        for (std::size_t i = 0; i < rows_.size(); ++i)
            if (!rows_[i].done) balance(connected_to(i));
        put_in();
    }

private:
    [[noreturn]] static void fail(const NodeState& node, const std::string& why) {
        throw Failure(
            Diagnostic{Id::undetermined, node.place,
                       fmt::format("node '{}' stores nothing, so its heat balance determines its temperature; but {}", node.name, why)});
    }

    std::optional<std::size_t> row_of(const NodeState* node) const {
        for (std::size_t i = 0; i < rows_.size(); ++i)
            if (rows_[i].node == node) return i;
        return std::nullopt;
    }

    /// The first row whose temperature, or its fourth power, an expression has.
    const Row* letter_in(const ex& e) const {
        for (const Row& row : rows_)
            if (e.has(row.T()) || e.has(row.fourth())) return &row;
        return nullptr;
    }

    /// By how much heat grows with a temperature, or its fourth power.
    ex slope(const Row& at, const ex& heat, const Row& by, const ex& letter) const {
        const ex result = partial(heat, letter);
        if (letter_in(result) == nullptr) return result;
        fail(*at.node,
             &at == &by
                 ? std::string("the balance is linear neither in the temperature nor in its fourth power. Give the node a capacity")
                 : fmt::format(
                       "the balance is linear neither in the temperature of '{}' nor in its fourth power. Give one of the two a capacity",
                       by.node->name));
    }

    void gather(const LinkState& link) {
        const auto from = row_of(link.from.node);
        const auto to = row_of(link.to.node);
        if (from && to) return join(*from, *to, link);
        if (from) add(*from, -link.heat);
        if (to) add(*to, link.heat);
    }

    void join(std::size_t a, std::size_t b, const LinkState& link) {
        Row& from = rows_[a];
        Row& to = rows_[b];
        const ex conduction = slope(from, link.heat, to, to.T()) * -1;
        const ex radiation = slope(from, link.heat, to, to.fourth()) * -1;
        slope(to, link.heat, from, from.T());
        const ex rest = (link.heat - conduction * (from.T() - to.T()) - radiation * (from.fourth() - to.fourth())).expand();
        if (letter_in(rest) != nullptr)
            fail(*from.node, fmt::format("the heat of '{}' is not zero when its ends are equally warm. Give '{}' or '{}' a capacity",
                                         link.name, from.node->name, to.node->name));
        join(&Row::conduction, a, b, conduction);
        join(&Row::radiation, a, b, radiation);
        from.source -= rest;
        to.source += rest;
    }

    void join(Conductances Row::*kind, std::size_t a, std::size_t b, const ex& conductance) {
        if (conductance.is_zero()) return;
        for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
            ex& there = (rows_[i].*kind).to_sought[j];
            there += conductance;
        }
    }

    /// Heat into one node that comes from what is known.
    void add(std::size_t i, const ex& heat) {
        Row& row = rows_[i];
        for (const Row& other : rows_)
            if (&other != &row && (heat.has(other.T()) || heat.has(other.fourth())))
                fail(*row.node, fmt::format("it takes up heat that depends on the temperature of '{}' and does not come from there. Give "
                                            "one of the two a capacity",
                                            other.node->name));
        row.conduction.to_known -= slope(row, heat, row, row.T());
        row.radiation.to_known -= slope(row, heat, row, row.fourth());
        row.source += heat.subs(GiNaC::exmap{{row.T(), 0}, {row.fourth(), 0}}, no_pattern);
    }

    /// A node that only conducts, or only radiates, to at most one other, or to two and nothing else, is a resistance before the next: its
    /// closed form is short. So is that of a node by itself. But closed forms of many nodes contain each other.
    bool eliminate_next() {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            Row& row = rows_[i];
            if (row.done) continue;
            if (row.conduction.none() && row.radiation.none()) fail(*row.node, "nothing links it to a known temperature");
            if (row.conduction.none() != row.radiation.none()) {
                const bool conducts = row.radiation.none();
                const Conductances& own = conducts ? row.conduction : row.radiation;
                const std::size_t others = own.to_sought.size();
                if (others == 0 && own.to_known.is_zero()) fail(*row.node, "nothing links it to a known temperature");
                if (others > 0 && connected_to(i).size() > most_written_out) continue;
                if (others > 2 || (others == 2 && !own.to_known.is_zero())) continue;
                eliminate(i, conducts);
                return true;
            }
            if (!row.conduction.to_sought.empty() || !row.radiation.to_sought.empty()) continue;
            const ex temperature =
                radiant_temperature(row.radiation.to_known / row.conduction.to_known, row.source / row.conduction.to_known);
            settle(row, temperature, pow(temperature, 4));
            return true;
        }
        return false;
    }

    static ex in_series(const ex& a, const ex& b) {
        if (a.is_zero() || b.is_zero()) return 0;
        // As resistances, chains of any length stay short; but not where one may be infinite.
        const auto positive = GiNaC::info_flags::positive;
        return a.info(positive) && b.info(positive) ? pow(1 / a + 1 / b, -1) : a * b / (a + b);
    }

    /// A sum over a conductance, term by term: those that have it as a factor lose it, where multiplying out 1/conductance would hide it.
    static ex divided(const ex& sum, const ex& conductance) {
        const ex terms = sum.expand();
        if (!GiNaC::is_a<GiNaC::add>(terms)) return terms / conductance;
        ex result = 0;
        for (const ex& term : terms) result += term / conductance;
        return result;
    }

    void eliminate(std::size_t k, bool conducts) {
        const auto kind = conducts ? &Row::conduction : &Row::radiation;
        Row& row = rows_[k];
        const Conductances own = row.*kind;
        ex all = own.to_known;
        ex heat = row.source;
        for (const auto& [i, conductance] : own.to_sought) {
            all += conductance;
            heat += conductance * (conducts ? rows_[i].T() : rows_[i].fourth());
        }
        for (const auto& [i, conductance] : own.to_sought) {
            Conductances& other = rows_[i].*kind;
            other.to_sought.erase(k);
            other.to_known += in_series(conductance, own.to_known);
            // Over what is known, as in the conductance: so that the two are seen to belong together.
            if (conductance.is_equal(all)) rows_[i].source += row.source;
            else if (own.to_known.is_zero()) rows_[i].source += row.source * conductance / all;
            else rows_[i].source += in_series(conductance, own.to_known) * divided(row.source, own.to_known);
        }
        if (own.to_sought.size() == 2)
            join(kind, own.to_sought.begin()->first, own.to_sought.rbegin()->first,
                 in_series(own.to_sought.begin()->second, own.to_sought.rbegin()->second));
        const ex value = heat / all;
        put_into_heat(conducts ? row.T() : row.fourth(), heat, all);
        conducts ? settle(row, value, pow(value, 4)) : settle(row, pow(value, GiNaC::numeric(1, 4)), value);
    }

    /// Heat that is linear in a temperature heat/all, over the same denominator: g*(T - heat/all) = g*(T*all - heat)/all, in which what T
    /// has of its own in `heat` cancels here, and not in numbers.
    void put_into_heat(const ex& letter, const ex& heat, const ex& all) {
        for (LinkState& link : network_.links) {
            if (!link.heat.has(letter)) continue;
            const ex slope = partial(link.heat, letter);
            if (slope.has(letter)) continue;
            const ex rest = link.heat.subs(letter == 0, no_pattern);
            link.heat = over((rest * all + slope * heat).expand(), all);
        }
    }

    /// A sum over two conductances. Terms with both become conductances in series, 1/(1/a + 1/b), whose slopes keep their digits: by the
    /// product rule, the slope of a*b/(a + b) is a difference, 1 - a/(a + b).
    static ex over(const ex& sum, const ex& all) {
        if (!GiNaC::is_a<GiNaC::add>(all) || all.nops() != 2) return sum / all;
        const ex &a = all.op(0), &b = all.op(1);
        ex result = 0, rest = 0;
        const auto add = [&](const ex& term) {
            const ex factor = term / (a * b);
            if (share_letters(factor, all)) rest += term;
            else result += factor * in_series(a, b);
        };
        if (GiNaC::is_a<GiNaC::add>(sum)) std::for_each(sum.begin(), sum.end(), add);
        else add(sum);
        return result + rest / all;
    }

    static bool share_letters(const ex& e, const ex& with) {
        return std::any_of(e.preorder_begin(), e.preorder_end(),
                           [&](const ex& part) { return GiNaC::is_a<GiNaC::symbol>(part) && with.has(part); });
    }

    std::vector<std::size_t> connected_to(std::size_t first) const {
        std::vector<std::size_t> part{first};
        for (std::size_t n = 0; n < part.size(); ++n)
            for (const Conductances* c : {&rows_[part[n]].conduction, &rows_[part[n]].radiation})
                for (const auto& [j, conductance] : c->to_sought)
                    if (std::find(part.begin(), part.end(), j) == part.end()) part.push_back(j);
        std::sort(part.begin(), part.end());
        return part;
    }

    /// Nodes that hold each other in balance.
    void balance(const std::vector<std::size_t>& part) {
        const auto conducts = [&](std::size_t i) { return !rows_[i].conduction.none(); };
        const bool only_radiates = std::none_of(part.begin(), part.end(), conducts);
        const bool is_known = std::any_of(part.begin(), part.end(), [&](std::size_t i) {
            return !rows_[i].conduction.to_known.is_zero() || !rows_[i].radiation.to_known.is_zero();
        });
        if (!is_known) fail(*rows_[part[0]].node, "nothing links it to a known temperature");
        NetworkData data(part.size());
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Row& row = rows_[part[i]];
            const auto fill = [&](std::vector<std::vector<ex>>& table, const Conductances& conductances) {
                table[i][i] = conductances.to_known;
                for (const auto& [other, conductance] : conductances.to_sought)
                    table[i][static_cast<std::size_t>(std::find(part.begin(), part.end(), other) - part.begin())] = conductance;
            };
            fill(data.conduction, only_radiates ? row.radiation : row.conduction);
            if (!only_radiates) fill(data.radiation, row.radiation);
            data.sources[i] = row.source;
        }
        const std::vector<ex> temperatures = data.temperatures();
        for (std::size_t i = 0; i < part.size(); ++i) {
            const ex& value = temperatures[i];
            network_.defined[rows_[part[i]].node] = data.balance(i, temperatures);
            only_radiates ? settle(rows_[part[i]], pow(value, GiNaC::numeric(1, 4)), value) : settle(rows_[part[i]], value, pow(value, 4));
        }
    }

    /// Takes a temperature for known.
    void settle(Row& row, const ex& temperature, const ex& fourth_power) {
        const GiNaC::exmap known{{row.T(), temperature}, {row.fourth(), fourth_power}};
        for (auto& [letter, value] : network_.solved) value = value.subs(known, no_pattern);
        network_.solved.insert(known.begin(), known.end());
        row.done = true;
    }

    void put_in() {
        const auto in = [&](ex& e) { e = e.subs(network_.solved, no_pattern); };
        for (NodeState& node : network_.nodes) {
            in(node.warmth.temperature);
            in(node.warmth.fourth);
            node.warmth.is_sought = false;
            in(node.source);
        }
        for (LinkState& link : network_.links) in(link.heat);
    }

    HeatNetwork& network_;
    std::vector<Row> rows_;
};

}  // namespace

void find_sought_temperatures(HeatNetwork& network) { Elimination(network).run(); }

}  // namespace dalembert
