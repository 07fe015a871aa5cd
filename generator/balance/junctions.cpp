// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/junctions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"
#include "text/diagnostic.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

// All flows that end at a junction have one density rho. Pressures are counted here with their heights, p + rho*potential.

struct End {
    std::optional<std::size_t> junction;
    ex pressure;  ///< of a volume or reservoir

    bool is_same(const End& other) const { return junction && junction == other.junction; }
};

/// factor*d or factor*signed_root(d), where d = pressure at `from` - pressure at `to` - opening: a flow, or what stands for several.
struct Edge {
    FlowState* flow;  ///< null: made by elimination
    bool is_root;
    ex factor;
    ex opening;
    End from, to;
    bool is_there = true;
    ex drive = 0;  ///< once it is known: d, or signed_root(d)
    std::optional<ex> mass_flow = {};

    ex carries() const { return mass_flow ? *mass_flow : factor * drive; }
};

struct JunctionRow {
    JunctionState* state;
    ex source = 0;  ///< kg/s into it that no pressure of a junction changes
    ex pressure = 0;
    bool is_done = false;
};

/// An edge as a junction sees it.
struct Arm {
    Edge* edge;
    bool is_inward;

    const End& other() const { return is_inward ? edge->from : edge->to; }
    /// The pressure at which nothing flows, less that of the other end.
    ex shift() const { return is_inward ? ex(-edge->opening) : edge->opening; }
    int sign() const { return is_inward ? 1 : -1; }
};

/// sqrt(G)-free solution of r*s + G*s*|s| + c = 0.
ex root_of_quadratic(const ex& r, const ex& G, const ex& c) {
    if (c.is_zero()) return 0;
    return -2 * c / whole(r + GiNaC::sqrt(pow(r, 2) + 4 * G * magnitude(c)));
}

class Solving {
public:
    Solving(std::vector<FlowState>& flows, Containers& containers, const Scene& scene) : flows_(flows), scene_(scene) {
        for (JunctionState& junction : containers.junctions) rows_.push_back({&junction});
    }

    void run() {
        gather();
        for (std::size_t k = 0; k < rows_.size(); ++k) check(k);
        while (eliminate_next()) continue;
        for (std::size_t k = 0; k < rows_.size(); ++k)
            if (!rows_[k].is_done) fail_linked(k);
        while (!steps_.empty()) {
            put_back(steps_.back());
            steps_.pop_back();
        }
        put_in();
    }

private:
    /// A junction that is eliminated, with the edges that it had; `made` stands for the two of a junction between two orifices.
    struct Step {
        std::size_t junction;
        std::vector<Arm> arms;
        Edge* made = nullptr;
    };

    [[noreturn]] void fail(std::size_t k, const std::string& why) const {
        const std::string mode = scene_.mode ? fmt::format("in mode '{}' ", scene_.modes[*scene_.mode].name) : "";
        throw Failure(Diagnostic{Id::undetermined, rows_[k].state->member.item->span,
                                 fmt::format("junction '{}' stores nothing, so its flows determine its pressure; but {}{}",
                                             rows_[k].state->member.name(), mode, why)});
    }

    [[noreturn]] void fail_linked(std::size_t k) const {
        std::vector<std::string> others;
        for (const Arm& arm : arms_of(k))
            if (arm.other().junction) others.push_back(rows_[*arm.other().junction].state->member.name());
        std::sort(others.begin(), others.end());
        others.erase(std::unique(others.begin(), others.end()), others.end());
        fail(k,
             fmt::format(
                 "orifices join it to {}, and both have more flows than this version can solve together. Give one of them a small volume",
                 quoted_list(others)));
    }

    std::optional<std::size_t> row_of(const JunctionState* junction) const {
        for (std::size_t k = 0; k < rows_.size(); ++k)
            if (rows_[k].state == junction) return k;
        return std::nullopt;
    }

    bool has_letter(const ex& e) const {
        return std::any_of(rows_.begin(), rows_.end(), [&](const JunctionRow& row) { return e.has(row.state->letter); });
    }

    void gather() {
        for (FlowState& f : flows_) {
            const auto from = row_of(f.from_junction), to = row_of(f.to_junction);
            if (!from && !to) {
                if (has_letter(f.mass_flow)) fail_dependent(f);
                continue;
            }
            if (!f.law_at_junction) {
                if (has_letter(f.mass_flow)) fail_dependent(f);
                if (from) rows_[*from].source -= f.mass_flow;
                if (to) rows_[*to].source += f.mass_flow;
                continue;
            }
            const PressureLaw& law = *f.law_at_junction;
            if (has_letter(law.factor) || has_letter(law.opening)) fail_dependent(f);
            const auto end = [&](std::optional<std::size_t> row, const FluidState& fluid) {
                return row ? End{row, 0} : End{std::nullopt, fluid.pressure + f.density * fluid.potential};
            };
            edges_.push_back({&f, law.is_root, law.factor, law.opening, end(from, *f.from), end(to, *f.to)});
        }
    }

    [[noreturn]] void fail_dependent(const FlowState& f) const {
        throw Failure(Diagnostic{Id::undetermined, f.member.item->span,
                                 fmt::format("the law of flow '{}' depends on the pressure of a junction, which follows from the flows; a "
                                             "law may contain such a pressure only at the ends of its flow",
                                             f.member.name())});
    }

    std::vector<Arm> arms_of(std::size_t k) const {
        std::vector<Arm> arms;
        for (Edge& edge : edges_) {
            if (!edge.is_there) continue;
            if (edge.to.junction == k) arms.push_back({&edge, true});
            if (edge.from.junction == k) arms.push_back({&edge, false});
        }
        return arms;
    }

    void check(std::size_t k) const {
        std::vector<std::string> names;
        for (const FlowState& f : flows_)
            if (f.from_junction == rows_[k].state || f.to_junction == rows_[k].state) names.push_back(f.member.name());
        if (names.empty()) fail(k, "no flow ends there");
        if (names.size() == 1) fail(k, fmt::format("only '{}' ends there, so nothing can flow through it", names[0]));
        if (arms_of(k).empty())
            fail(k, fmt::format("{} are given flows, pumps, pipes or shut valves, and no pressure changes their flow at once. Add an "
                                "orifice or a laminar flow, or make it a small volume",
                                quoted_list(names)));
    }

    bool eliminate_next() {
        constexpr std::size_t most_ends = 6;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (rows_[k].is_done) continue;
            const std::vector<Arm> arms = arms_of(k);
            if (arms.empty()) fail(k, "no flow joins it to a place of known pressure. Add such a flow, or make it a small volume");
            const bool is_linear = std::none_of(arms.begin(), arms.end(), [](const Arm& arm) { return arm.edge->is_root; });
            const bool is_known = std::none_of(arms.begin(), arms.end(), [](const Arm& arm) { return arm.other().junction.has_value(); });
            Step step{k, arms};
            if (is_linear && (is_known || arms.size() <= most_ends)) join_linear(step);
            else if (is_between_orifices(k, arms)) join_orifices(step);
            else if (!is_known) continue;
            for (const Arm& arm : arms) arm.edge->is_there = false;
            rows_[k].is_done = true;
            steps_.push_back(std::move(step));
            return true;
        }
        return false;
    }

    bool is_between_orifices(std::size_t k, const std::vector<Arm>& arms) const {
        return arms.size() == 2 && arms[0].edge->is_root && arms[1].edge->is_root && rows_[k].source.is_zero() &&
               !arms[0].other().is_same(arms[1].other());
    }

    /// From a star to what joins its ends directly.
    void join_linear(const Step& step) {
        const ex all = conductance(step);
        for (std::size_t a = 0; a < step.arms.size(); ++a) {
            const Arm& arm = step.arms[a];
            if (arm.other().junction) rows_[*arm.other().junction].source += arm.edge->factor * rows_[step.junction].source / all;
            for (std::size_t b = a + 1; b < step.arms.size(); ++b) {
                const Arm& next = step.arms[b];
                const bool is_known = !arm.other().junction && !next.other().junction;
                if (is_known || arm.other().is_same(next.other())) continue;
                edges_.push_back(
                    {nullptr, false, arm.edge->factor * next.edge->factor / all, next.shift() - arm.shift(), arm.other(), next.other()});
            }
        }
    }

    static ex conductance(const Step& step) {
        ex all = 0;
        for (const Arm& arm : step.arms)
            if (!arm.edge->is_root) all += arm.edge->factor;
        return all;
    }

    /// Two orifices one behind the other: 1/r^2 = 1/r_1^2 + 1/r_2^2.
    void join_orifices(Step& step) {
        const Arm &a = step.arms[0], &b = step.arms[1];
        edges_.push_back({nullptr, true, a.edge->factor * b.edge->factor * in_series(step), b.shift() - a.shift(), a.other(), b.other()});
        step.made = &edges_.back();
        if (a.other().junction || b.other().junction) return;
        step.made->is_there = false;
        step.made->drive = signed_root(whole((a.other().pressure + a.shift() - b.other().pressure - b.shift()).expand()));
    }

    static ex in_series(const Step& step) { return inverse_norm(pow(step.arms[0].edge->factor, 2) + pow(step.arms[1].edge->factor, 2)); }

    /// The pressure that drives nothing through an arm.
    ex pressure(const Arm& arm) const {
        return (arm.other().junction ? rows_[*arm.other().junction].pressure : arm.other().pressure) + arm.shift();
    }

    void put_back(const Step& step) {
        const bool has_roots = std::any_of(step.arms.begin(), step.arms.end(), [](const Arm& arm) { return arm.edge->is_root; });
        if (step.made != nullptr) put_back_orifices(step);
        else if (has_roots) put_back_known(step);
        else put_back_linear(step);
    }

    void put_back_linear(const Step& step) {
        JunctionRow& row = rows_[step.junction];
        const ex all = conductance(step);
        ex sum = row.source;
        for (const Arm& arm : step.arms) sum += arm.edge->factor * pressure(arm);
        row.pressure = sum / whole(all);
        for (const Arm& arm : step.arms) {
            ex drives = -row.source;
            for (const Arm& other : step.arms) drives += other.edge->factor * difference(arm, other);
            arm.edge->drive = arm.sign() * drives / whole(all);
        }
    }

    ex difference(const Arm& a, const Arm& b) const { return whole((pressure(a) - pressure(b)).expand()); }

    void put_back_orifices(const Step& step) {
        JunctionRow& row = rows_[step.junction];
        const Arm &a = step.arms[0], &b = step.arms[1];
        const ex root = step.made->drive * in_series(step);
        a.edge->drive = a.sign() * b.edge->factor * root;
        b.edge->drive = -b.sign() * a.edge->factor * root;
        a.edge->mass_flow = a.sign() * step.made->carries();
        b.edge->mass_flow = -b.sign() * step.made->carries();
        const ex into = b.edge->factor * root;
        row.pressure = pressure(a) - into * magnitude(into);
    }

    /// All other ends are known, and at least one flow goes like a root. The law of that one gives the pressure, and the balance its
    /// flow.
    void put_back_known(const Step& step) {
        JunctionRow& row = rows_[step.junction];
        std::vector<const Arm*> roots, linear;
        for (const Arm& arm : step.arms) (arm.edge->is_root ? roots : linear).push_back(&arm);
        const Arm& first = *roots[0];
        const ex all = conductance(step);
        ex inflow = row.source;
        for (const Arm* arm : linear) inflow += arm->edge->factor * difference(*arm, first);
        std::vector<ex> values;
        if (roots.size() == 1) {
            values.push_back(root_of_quadratic(first.edge->factor, all, inflow));
        } else {
            GiNaC::exvector list{all, inflow};
            for (const Arm* arm : roots) {
                list.push_back(arm == &first ? ex(0) : difference(*arm, first));
                list.push_back(arm->edge->factor);
            }
            const ex data = GiNaC::exprseq(list.begin(), list.end());
            for (std::size_t i = 0; i < roots.size(); ++i) values.push_back(junction_root(static_cast<unsigned long>(i), data));
        }
        const ex drop = values[0] * magnitude(values[0]);
        row.pressure = pressure(first) - drop;
        for (std::size_t i = 0; i < roots.size(); ++i) roots[i]->edge->drive = roots[i]->sign() * values[i];
        if (roots.size() == 1 && linear.size() == 1 && row.source.is_zero()) {  // one through the other: a difference would lose digits
            const Arm& next = *linear[0];
            next.edge->mass_flow = -next.sign() * first.sign() * first.edge->carries();
            return;
        }
        ex others = row.source;
        for (const Arm* arm : linear) {
            arm->edge->drive = arm->sign() * (difference(*arm, first) + drop);
            others += arm->sign() * arm->edge->carries();
        }
        for (std::size_t i = 1; i < roots.size(); ++i) others += roots[i]->sign() * roots[i]->edge->carries();
        first.edge->mass_flow = -first.sign() * others;
    }

    void put_in() {
        GiNaC::exmap solved;
        for (const JunctionRow& row : rows_)
            solved[row.state->letter] = row.pressure - row.state->medium->reference_density() * row.state->fluid.potential;
        for (const Edge& edge : edges_) {
            if (edge.flow == nullptr) continue;
            edge.flow->mass_flow = edge.carries();
            if (edge.is_root)
                edge.flow->edges.push_back(
                    {edge.flow->member.name(), fmt::format("flow {} changes its direction", edge.flow->member.name()), false, edge.drive});
        }
        const auto in = [&](ex& e) { e = e.subs(solved, GiNaC::subs_options::no_pattern); };
        for (FlowState& f : flows_) {
            for (ex* e : {&f.mass_flow, &f.shaft_power, &f.outside_power, &f.acceleration, &f.storing}) in(*e);
            std::for_each(f.torque.begin(), f.torque.end(), in);
            if (f.from_junction != nullptr || f.to_junction != nullptr) f.demand = f.mass_flow;
        }
        for (JunctionRow& row : rows_) row.state->take_pressure(solved.at(row.state->letter));
    }

    std::vector<FlowState>& flows_;
    const Scene& scene_;
    std::vector<JunctionRow> rows_;
    mutable std::deque<Edge> edges_;  // addresses are kept
    std::vector<Step> steps_;
};

}  // namespace

void solve_junctions(std::vector<FlowState>& flows, Containers& containers, const Scene& scene) {
    if (!containers.junctions.empty()) Solving(flows, containers, scene).run();
}

}  // namespace dalembert
