// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/flow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/fluids.hpp"
#include "symbolic/functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::pow;

namespace {

// A flow says itself where its law has an edge, and where a width makes it smooth enough: what else changes with its direction is not
// located.

/// a where the direction is positive, b where it is negative.
ex upstream(const ex& direction, const ex& a, const ex& b) {
    if ((a - b).expand().is_zero()) return a;
    return unit_step(unlocated(direction)) * a + unit_step(unlocated(-direction)) * b;
}

class FlowMaking {
public:
    FlowMaking(const Scene& scene, const Translator& translate, Symbols& symbols, const Containers& containers)
        : scene_(scene), translate_(translate), symbols_(symbols), containers_(containers) {}

    FlowState operator()(const Member<Flow>& member) {
        const Flow& item = *member.item;
        indices_ = Translator::indices_of(member);
        FlowState f{member, nullptr, nullptr, nullptr, nullptr, {}, {}, {}, {}, {}, {}, {}, std::vector<ex>(symbols_.degrees(), 0), {}, {}};
        f.from = end(item.from, f.from_volume, f.from_junction);
        f.to = end(item.to, f.to_volume, f.to_junction);
        if (f.from == f.to)
            throw Failure(Diagnostic{Id::not_allowed_here, item.to.span,
                                     fmt::format("flow '{}' goes from '{}' to itself", member.name(),
                                                 (f.from_volume != nullptr ? f.from_volume->member.name() : item.from.name))});
        if (f.from_junction != nullptr || f.to_junction != nullptr) return at_junction(f);
        switch (item.law) {
            case Flow::Law::given_mass:
                f.mass_flow = value(item.mass_flow);
                f.density = upstream(f.mass_flow, f.from->density, f.to->density);
                break;
            case Flow::Law::given_volume: by_volume(f, value(item.volume_flow)); break;
            case Flow::Law::laminar: by_volume(f, value(item.conductance) * difference(f)); break;
            case Flow::Law::hydraulic_orifice: hydraulic_orifice(f); break;
            case Flow::Law::pneumatic_orifice: pneumatic_orifice(f); break;
            case Flow::Law::check_valve: check_valve(f); break;
            case Flow::Law::relief_valve: relief_valve(f); break;
            case Flow::Law::pump: pump(f); break;
            case Flow::Law::pipe: pipe(f); break;
        }
        return f;
    }

private:
    /// Of one density, so that the law is the same both ways.
    FlowState& at_junction(FlowState& f) {
        const Flow& item = *f.member.item;
        f.density = (f.from_junction != nullptr ? f.from_junction : f.to_junction)->medium->reference_density();
        const auto by_orifice = [&] { return value(item.coefficient) * value(item.area) * GiNaC::sqrt(2 * f.density); };
        switch (item.law) {
            case Flow::Law::given_mass: f.mass_flow = value(item.mass_flow); break;
            case Flow::Law::given_volume: f.mass_flow = f.density * value(item.volume_flow); break;
            case Flow::Law::laminar: f.law_at_junction = {false, f.density * value(item.conductance)}; break;
            case Flow::Law::hydraulic_orifice: f.law_at_junction = {true, by_orifice()}; break;
            case Flow::Law::check_valve:
                if (!is_in(f, "_open")) break;
                f.law_at_junction = {!item.conductance, item.conductance ? f.density * value(item.conductance) : by_orifice(),
                                     value(item.cracking_pressure)};
                break;
            case Flow::Law::pump: pump(f); break;
            case Flow::Law::pipe: pipe(f); break;
            case Flow::Law::pneumatic_orifice: break;  // was refused
            case Flow::Law::relief_valve:
                throw Failure(Diagnostic{Id::not_allowed_here, item.span,
                                         fmt::format("relief valve '{}' ends at a junction, but this version cannot solve the pressure "
                                                     "there with a relief valve; make the junction a small volume",
                                                     f.member.name())});
        }
        if (!f.law_at_junction) return f;
        const PressureLaw& law = *f.law_at_junction;
        const ex drive = f.from->pressure - f.to->pressure + f.density * (f.from->potential - f.to->potential) - law.opening;
        f.mass_flow = law.factor * (law.is_root ? signed_root(drive) : drive);
        return f;
    }

    ex value(const ExpressionPtr& e) const { return e ? translate_(e, indices_) : ex(0); }

    const FluidState* end(const Reference& reference, const ControlVolume*& volume, const JunctionState*& junction) const {
        const int index = reference.index ? index_value(*reference.index, scene_, indices_) : 0;
        volume = containers_.find_volume(reference.name, index);
        if (volume != nullptr) return &volume->fluid;
        junction = containers_.find_junction(reference.name, index);
        if (junction != nullptr) return &junction->fluid;
        if (const ReservoirState* reservoir = containers_.find_reservoir(reference.name, index)) return &reservoir->fluid;
        throw Failure(
            Diagnostic{Id::index_out_of_range, reference.span, fmt::format("the scene has no '{}'", std::string(reference.span.text()))});
    }

    /// What drives a flow between its ends, Pa: p_from - p_to + rho*(potential_from - potential_to) less what opens it, where the column
    /// between them has the mean of the two densities. Kept whole, because the two are often close.
    static ex difference(const FlowState& f, const ex& opening = 0) {
        const ex height = f.from->potential - f.to->potential;
        const ex column = height.expand().is_zero() ? ex(0) : ex((f.from->density + f.to->density) / 2 * height);
        return whole((f.from->pressure - f.to->pressure + column - opening).expand());
    }

    static void by_volume(FlowState& f, const ex& volume_flow) {
        f.density = upstream(volume_flow, f.from->density, f.to->density);
        f.mass_flow = f.density * volume_flow;
    }

    void edge(FlowState& f, const char* what, const ex& guard) const {
        f.edges.push_back({f.member.name(), fmt::format("flow {} {}", f.member.name(), what), false, guard});
    }

    /// sqrt(2/rho)*sign(dp)*sqrt(|dp|), the velocity behind (3.150); with a width the smooth law. Where dp is the head of a level that
    /// is integrated as its root, the root is the level's own and ends where the tank is empty.
    ex outflow_velocity(FlowState& f, const ex& difference, const ex& density, bool one_way) {
        if (f.member.item->width) {
            const ex width = value(f.member.item->width);
            const ex dp = one_way ? maximum(unlocated(difference), 0) : difference;
            return GiNaC::sqrt(2 / density) * dp * pow(pow(dp, 2) + pow(width, 2), numeric(-1, 4));
        }
        const ex dp = is_ex_the_function(difference, whole) ? difference.op(0) : difference;
        for (const Variable& z : symbols_.all(SymbolKind::state)) {
            const ex square = (2 * dp / density / pow(z.symbol, 2)).expand();
            if (!z.is_root || square.has(z.symbol)) continue;
            if (!square.info(GiNaC::info_flags::positive))
                throw Failure(Diagnostic{Id::not_allowed_here, f.member.item->span,
                                         fmt::format("flow '{}' is proportional to the root of '{}', and the program integrates this root; "
                                                     "density and gravity need ranges that make them positive",
                                                     f.member.name(), z.base)});
            edge(f, fmt::format("ends, {} is zero", z.base).c_str(), z.symbol);
            return GiNaC::sqrt(square) * z.symbol * unit_step(unlocated(z.symbol));
        }
        edge(f, one_way ? "opens or closes" : "changes its direction", difference);
        const ex argument = 2 * difference / density;
        return one_way ? forward_root(argument) : signed_root(argument);
    }

    void hydraulic_orifice(FlowState& f) {
        const Flow& item = *f.member.item;
        const ex dp = difference(f);
        f.density = upstream(dp, f.from->density, f.to->density);
        f.mass_flow = f.density * value(item.coefficient) * value(item.area) * outflow_velocity(f, dp, f.density, false);
    }

    void check_valve(FlowState& f) {
        const Flow& item = *f.member.item;
        const ex dp = difference(f, value(item.cracking_pressure));
        f.density = f.from->density;
        if (item.switches) {
            const bool is_open = scene_.mode && scene_.modes[*scene_.mode].is_in(item.name + "_open");
            const ex volume_flow = item.conductance ? ex(value(item.conductance) * dp)
                                                    : value(item.coefficient) * value(item.area) * forward_root(2 * dp / f.density);
            f.mass_flow = is_open ? ex(f.density * volume_flow) : ex(0);
        } else if (item.conductance) {
            edge(f, "opens or closes", dp);
            f.mass_flow = f.density * value(item.conductance) * maximum(unlocated(dp), 0);
        } else {
            f.mass_flow = f.density * value(item.coefficient) * value(item.area) * outflow_velocity(f, dp, f.density, true);
        }
    }

    /// An orifice (3.150) whose area grows linearly from zero at the cracking pressure. While it is shut the root is that of the cracking
    /// pressure: its slope stays finite where the difference passes zero.
    void relief_valve(FlowState& f) {
        const Flow& item = *f.member.item;
        const ex cracking = value(item.cracking_pressure);
        const ex dp = difference(f), excess = difference(f, cracking), remaining = difference(f, cracking + value(item.override_pressure));
        edge(f, "opens or closes", excess);
        edge(f, "is open with its whole area", remaining);
        const ex opening = minimum(maximum(unlocated(excess), 0) / value(item.override_pressure), 1);
        f.density = f.from->density;
        f.mass_flow = f.density * value(item.coefficient) * value(item.area) * opening *
                      GiNaC::sqrt(2 * maximum(unlocated(dp), cracking) / f.density);
    }

    /// (3.156) in both directions. With d = |p_1 - p_2|/p_u and p_u the higher pressure: p_u*Psi = sqrt(p_u*|p_1 - p_2|)*outflow_factor(d).
    void pneumatic_orifice(FlowState& f) {
        const Flow& item = *f.member.item;
        if (!(f.from->potential - f.to->potential).expand().is_zero())
            throw Failure(Diagnostic{Id::not_allowed_here, item.span,
                                     fmt::format("the law of the pneumatic orifice '{}' contains no height, but the potentials of '{}' and "
                                                 "'{}' differ; give both ends the same potential",
                                                 f.member.name(), std::string(item.from.span.text()), std::string(item.to.span.text()))});
        const MediumModel& gas = *(f.from_volume != nullptr ? f.from_volume->medium : reservoir_medium(item.from));
        const ex k = gas.isentropic_exponent();
        const ex dp = difference(f);
        if (item.switches) return switched_orifice(f, k, gas.gas_constant(), dp);
        const ex higher = maximum(unlocated(f.from->pressure), f.to->pressure);
        const ex temperature_root = upstream(dp, pow(*f.from->temperature, numeric(-1, 2)), pow(*f.to->temperature, numeric(-1, 2)));
        const ex relative = magnitude(unlocated(dp)) / higher;
        ex root = signed_root(higher * dp);
        if (item.width) root = GiNaC::sqrt(higher) * dp * pow(pow(dp, 2) + pow(value(item.width), 2), numeric(-1, 4));
        else edge(f, "changes its direction", dp);
        edge(f, "changes between choked and subsonic", magnitude(dp) - (1 - pow(2 / (k + 1), k / (k - 1))) * higher);
        f.density = upstream(dp, f.from->density, f.to->density);
        f.mass_flow = value(item.coefficient) * value(item.area) * GiNaC::sqrt(2 / gas.gas_constant()) * temperature_root *
                      outflow_factor(relative, k) * root;
    }

    bool is_in(const FlowState& f, const char* mode) const {
        return scene_.mode && scene_.modes[*scene_.mode].is_in(f.member.item->name + mode);
    }

    /// The same in one of its modes: the direction is known, and whether it is choked, where the outflow function has its largest value.
    void switched_orifice(FlowState& f, const ex& k, const ex& gas_constant, const ex& dp) const {
        const Flow& item = *f.member.item;
        const bool is_back = is_in(f, "_subsonic_back") || is_in(f, "_choked_back");
        const FluidState& upstream = is_back ? *f.to : *f.from;
        const ex drop = is_back ? ex(-dp) : dp;
        const ex choked = GiNaC::sqrt(k / (k + 1)) * pow(2 / (k + 1), 1 / (k - 1)) * upstream.pressure;
        const bool is_choked = is_in(f, "_choked") || is_in(f, "_choked_back");
        const ex outflow = is_choked ? choked : outflow_factor(drop / upstream.pressure, k) * forward_root(upstream.pressure * drop);
        f.density = upstream.density;
        f.mass_flow = (is_back ? -1 : 1) * value(item.coefficient) * value(item.area) * GiNaC::sqrt(2 / gas_constant) *
                      pow(*upstream.temperature, numeric(-1, 2)) * outflow;
    }

    const MediumModel* reservoir_medium(const Reference& reference) const {
        return containers_.find_reservoir(reference.name, reference.index ? index_value(*reference.index, scene_, indices_) : 0)->medium;
    }

    /// The shaft lifts what flows from one pressure and potential to the other.
    void pump(FlowState& f) {
        const Flow& item = *f.member.item;
        const ex displacement = value(item.displacement);
        const ex speed = value(item.speed);
        const ex volume_flow = item.volume_flow ? value(item.volume_flow) : displacement * speed;
        if (f.from_junction != nullptr || f.to_junction != nullptr) f.mass_flow = f.density * volume_flow;
        else by_volume(f, volume_flow);
        const ex lift = f.to->pressure - f.from->pressure + f.density * (f.to->potential - f.from->potential);
        f.shaft_power = volume_flow * lift;
        f.outside_power = f.shaft_power;
        if (item.volume_flow) return;
        const AffineRate rate = affine_rate(speed, symbols_, item.speed->span, fmt::format("the speed of pump '{}'", f.member.name()));
        for (std::size_t j = 0; j < rate.jacobian.size(); ++j) f.torque[j] = -displacement * lift * rate.jacobian[j];
        f.outside_power = displacement * rate.drift * lift;
    }

    /// The momentum of a stream of one density (3.131) along a pipe: rho*l*dv/dt = p_1 - p_2 + rho*(potential_1 - potential_2) - loss.
    void pipe(FlowState& f) {
        const Flow& item = *f.member.item;
        const int index = item.velocity->children.empty() ? 0 : index_value(*item.velocity->children[0], scene_, indices_);
        const Variable* state = symbols_.find(SymbolKind::state, item.velocity->name, index);
        if (state == nullptr)
            throw Failure(Diagnostic{Id::index_out_of_range, item.velocity->span,
                                     fmt::format("the scene has no state '{}'", item.velocity->written())});
        f.velocity_state = state->position;
        const ex v = translate_(item.velocity, indices_);
        const ex area = value(item.area);
        const ex length = value(item.length);
        if (f.from_junction == nullptr)
            f.density = (f.from_volume != nullptr ? f.from_volume->medium : reservoir_medium(item.from))->reference_density();
        ex loss = 0;
        if (item.loss) {
            const ex letter = symbols_.letter(item.loss->variable);
            loss =
                translate_(*item.loss->body, indices_, {{item.loss->variable, letter}}).subs(letter == v, GiNaC::subs_options::no_pattern);
        }
        const ex drive = f.from->pressure - f.to->pressure + f.density * (f.from->potential - f.to->potential) - loss;
        f.mass_flow = f.density * area * v;
        f.acceleration = drive / (f.density * length);
        f.stored_energy = f.density * area * length * pow(v, 2) / 2;
        f.storing = area * v * drive;
    }

    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    const Containers& containers_;
    Indices indices_;
};

/// The power that a shaft takes out and a stream stores on the way.
ex kept(const FlowState& f) { return f.storing - f.shaft_power; }

ex carried(const FlowState& f) {
    const ex difference = (f.from->carried() - f.to->carried()).expand();
    if (difference.is_zero()) return f.mass_flow * f.from->carried();
    return maximum(unlocated(f.mass_flow), 0) * f.from->carried() + minimum(unlocated(f.mass_flow), 0) * f.to->carried();
}

/// a - b, kept whole but for the factors of both, as c_p of a gas.
ex whole_difference(const ex& a, const ex& b) {
    if (!GiNaC::is_a<GiNaC::mul>(a) || !GiNaC::is_a<GiNaC::mul>(b)) return whole(a - b);
    ex common = 1;
    for (const ex& factor : a)
        if (std::any_of(b.begin(), b.end(), [&](const ex& other) { return other.is_equal(factor); })) common *= factor;
    return common * whole(a / common - b / common);
}

}  // namespace

ex FlowState::leaving() const { return carried(*this) + unit_step(unlocated(-mass_flow)) * kept(*this); }
ex FlowState::arriving() const { return carried(*this) - unit_step(unlocated(mass_flow)) * kept(*this); }

ex FlowState::excess_at_from(bool is_whole) const {
    const ex a = to->carried(), b = from->carried();
    return -minimum(unlocated(mass_flow), 0) * (is_whole ? whole_difference(a, b) : a - b) - unit_step(unlocated(-mass_flow)) * kept(*this);
}
ex FlowState::excess_at_to(bool is_whole) const {
    const ex a = from->carried(), b = to->carried();
    return maximum(unlocated(mass_flow), 0) * (is_whole ? whole_difference(a, b) : a - b) - unit_step(unlocated(mass_flow)) * kept(*this);
}

namespace {

void share_inflow(std::vector<FlowState>& flows, const ControlVolume& volume, const Symbols& symbols) {
    const ex& filling = symbols.get(SymbolKind::state, volume.state);
    ex inflow = 0, demand = 0;
    for (FlowState& f : flows) {
        if (f.to_volume == &volume) inflow += f.mass_flow;
        if (f.from_volume != &volume) continue;
        f.demand = f.mass_flow.subs(filling == 0, GiNaC::subs_options::no_pattern);
        demand += f.demand;
    }
    for (FlowState& f : flows) {
        if (f.from_volume != &volume) continue;
        // Where nothing is asked for nothing flows in either, and the quotient is not to be asked for.
        const bool is_alone = demand.is_equal(f.demand);
        const ex part = demand.is_zero() ? ex(0) : is_alone ? ex(inflow / demand) : inflow * demand * pow(inverse_norm(pow(demand, 2)), 2);
        f.mass_flow = f.demand * part;
        f.shaft_power *= part;
        f.outside_power *= part;
        for (ex& torque : f.torque) torque *= part;
        f.edges.clear();
    }
}

/// A volume comes after those that feed it.
void share_inflows(std::vector<FlowState>& flows, const Scene& scene, const Symbols& symbols, const Containers& containers) {
    std::vector<const ControlVolume*> pending;
    for (const ControlVolume& volume : containers.volumes)
        if (volume.is_empty) pending.push_back(&volume);
    const auto is_pending = [&](const ControlVolume* volume) { return std::find(pending.begin(), pending.end(), volume) != pending.end(); };
    while (!pending.empty()) {
        const auto next = std::find_if(pending.begin(), pending.end(), [&](const ControlVolume* volume) {
            return std::none_of(flows.begin(), flows.end(),
                                [&](const FlowState& f) { return f.to_volume == volume && is_pending(f.from_volume); });
        });
        if (next == pending.end()) {
            const Volume& one = *pending.front()->member.item;
            throw Failure(Diagnostic{
                Id::undetermined, one.span,
                fmt::format("in mode '{}' volume '{}' and the volumes that feed it in a ring are all empty, so nothing determines the flow",
                            scene.modes[*scene.mode].name, one.name)});
        }
        share_inflow(flows, **next, symbols);
        pending.erase(next);
    }
}

}  // namespace

std::vector<FlowState> make_flows(const Scene& scene, const Translator& translate, Symbols& symbols, const Containers& containers) {
    FlowMaking make(scene, translate, symbols, containers);
    std::vector<FlowState> flows;
    for (const auto& member : scene.flows) flows.push_back(make(member));
    for (FlowState& flow : flows) flow.demand = flow.mass_flow;
    share_inflows(flows, scene, symbols, containers);
    return flows;
}

}  // namespace dalembert
