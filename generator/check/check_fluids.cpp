// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "elements/fluids.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

class FluidCheck {
public:
    FluidCheck(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics)
        : model_(model), names_(names), claims_(claims), diagnostics_(diagnostics) {}

    void run() {
        for (const Junction& junction : model_.junctions) check(junction);
        for (const Volume& volume : model_.volumes) check(volume);
        for (const Flow& flow : model_.flows) check(flow);
    }

private:
    /// Null where there is none, which was said already.
    const Medium* medium_of(const Reference& reference) const {
        return static_cast<const Medium*>(names_.find_element(reference.name, {"medium"}).item);
    }

    const State* claim(const ExpressionPtr& named, const char* key, const char* kind, const Item& item) {
        if (!named) return nullptr;
        return claims_.claim(*named, key, fmt::format("{} '{}'", kind, item.name));
    }

    void wrong(const Span& span, std::string message, const Medium& medium) {
        diagnostics_.error(Id::wrong_medium, span, std::move(message),
                           {{medium.span, fmt::format("medium '{}' is defined here", medium.name)}});
    }

    void check(const Junction& junction) {
        const Medium* medium = medium_of(junction.medium);
        if (medium != nullptr && medium->law != Medium::Law::liquid && medium->law != Medium::Law::incompressible)
            wrong(junction.span,
                  fmt::format("junction '{}' stores nothing; this version solves its pressure only for liquids, but '{}' is {}. Make the "
                              "junction a small volume",
                              junction.name, medium->name, medium->law == Medium::Law::ideal_gas ? "a gas" : "a medium of given laws"),
                  *medium);
    }

    /// What the pressure of a junction cannot be solved for exactly.
    void check_at_junction(const Flow& flow, const Reference& end, const Reference& other) {
        const Junction* junction = names_.find_element<Junction>(end.name);
        if (junction == nullptr) return;
        const Note defined{junction->span, fmt::format("junction '{}' is defined here", end.name)};
        const auto refuse = [&](const Span& span, const std::string& why) {
            diagnostics_.error(Id::not_allowed_here, span, fmt::format("flow '{}' ends at junction '{}', {}", flow.name, end.name, why),
                               {defined});
        };
        if (flow.width)
            refuse(
                flow.width->span,
                "which is solved with the exact root, also at equal pressures; leave the width out, or make the junction a small volume");
        if (flow.law == Flow::Law::check_valve && !flow.switches)
            refuse(flow.span,
                   "and this version solves its pressure only if open and shut are modes of the valve; give the valve switches = true, or "
                   "make the junction a small volume");
        if (const Volume* volume = names_.find_element<Volume>(other.name); volume != nullptr && volume->empties)
            refuse(other.span, fmt::format("and begins or ends at volume '{}', which may run empty; this version does not solve both at "
                                           "once. Leave out empties, or make the junction a small volume",
                                           other.name));
    }

    void check(const Volume& volume) {
        if (!volume.filling) claim(volume.pressure, "pressure", "volume", volume);
        claim(volume.density, "density", "volume", volume);
        claim(volume.mass, "mass", "volume", volume);
        claim(volume.filling, "filling", "volume", volume);
        claim(volume.temperature, "temperature", "volume", volume);
        const Medium* medium = medium_of(volume.medium);
        if (medium == nullptr) return;
        if (medium->law == Medium::Law::incompressible && !volume.filling)
            diagnostics_.error(Id::undetermined, volume.span,
                               fmt::format("volume '{}' holds the incompressible medium '{}': no balance determines its pressure, and it "
                                           "can store nothing; give it a filling",
                                           volume.name, medium->name),
                               {{medium->span, fmt::format("medium '{}' is defined here", medium->name)}});
        if (volume.polytropic && medium->law != Medium::Law::ideal_gas)
            wrong(
                volume.polytropic->span,
                fmt::format("volume '{}' follows a polytropic course, which needs an ideal gas, but holds '{}'", volume.name, medium->name),
                *medium);
        if (volume.empties && volume.temperature)
            diagnostics_.error(
                Id::not_allowed_here, volume.temperature->span,
                fmt::format("volume '{}' may run empty, and an empty volume has no temperature; leave out the temperature or empties",
                            volume.name));
        if (volume.empties)
            for (const Flow& flow : model_.flows)
                if (flow.law == Flow::Law::pipe && flow.from.name == volume.name)
                    diagnostics_.error(Id::not_allowed_here, flow.from.span,
                                       fmt::format("volume '{}' may run empty, but pipe '{}' leaves it; the flow of a pipe has inertia, "
                                                   "and a pipe cannot run empty",
                                                   volume.name, flow.name),
                                       {{volume.span, fmt::format("'{}' is defined here", volume.name)}});
        if (volume.head && medium->law != Medium::Law::incompressible)
            wrong(volume.head->span,
                  fmt::format(
                      "volume '{}' has a head, which needs an incompressible medium, but holds '{}'; a vessel behind an open tank may "
                      "have elastic walls instead: volume = \"V*(1 + (p - p_0)/beta)\", filling = \"p\"",
                      volume.name, medium->name),
                  *medium);
        if ((volume.density || volume.mass) && medium->law == Medium::Law::given && !medium->pressure)
            wrong(volume.span,
                  fmt::format("volume '{}' has its {} as a state, so medium '{}' needs a pressure law \"(rho, T) -> ...\"", volume.name,
                              volume.density ? "density" : "mass", medium->name),
                  *medium);
    }

    /// The medium at an end of a flow, if the end is one.
    const Medium* end(const Reference& reference) const {
        if (const Volume* volume = names_.find_element<Volume>(reference.name)) return medium_of(volume->medium);
        if (const Junction* junction = names_.find_element<Junction>(reference.name)) return medium_of(junction->medium);
        if (const Reservoir* reservoir = names_.find_element<Reservoir>(reference.name)) return medium_of(reservoir->medium);
        return nullptr;
    }

    void check(const Flow& flow) {
        if (const State* state = claim(flow.velocity, "velocity", "pipe", flow); state != nullptr && state->root)
            diagnostics_.error(Id::not_allowed_here, flow.velocity->span,
                               fmt::format("the velocity of pipe '{}' may become negative, so its root cannot be a state", flow.name),
                               {{state->span, fmt::format("'{}' is declared here", state->name)}});
        const Medium* from = end(flow.from);
        const Medium* to = end(flow.to);
        if (from == nullptr || to == nullptr) return;
        if (flow.from.name == flow.to.name && !flow.from.index)
            diagnostics_.error(Id::not_allowed_here, flow.to.span,
                               fmt::format("flow '{}' goes from '{}' to '{}' itself", flow.name, flow.from.name, flow.to.name));
        check_at_junction(flow, flow.from, flow.to);
        check_at_junction(flow, flow.to, flow.from);
        if (from != to)
            diagnostics_.error(Id::wrong_medium, flow.span,
                               fmt::format("flow '{}' goes from '{}', which holds '{}', to '{}', which holds '{}'; media do not mix",
                                           flow.name, flow.from.name, from->name, flow.to.name, to->name),
                               {{from->span, fmt::format("medium '{}' is defined here", from->name)},
                                {to->span, fmt::format("medium '{}' is defined here", to->name)}});
        const bool is_gas = from->law == Medium::Law::ideal_gas;
        if ((flow.law == Flow::Law::hydraulic_orifice || flow.law == Flow::Law::relief_valve) && is_gas)
            wrong(flow.span,
                  fmt::format("flow '{}' follows the law of a {}, which holds for liquids, but '{}' is a gas{}", flow.name,
                              flow.law == Flow::Law::relief_valve ? "relief valve" : "hydraulic orifice", from->name,
                              flow.law == Flow::Law::relief_valve ? "" : "; take \"pneumatic_orifice\""),
                  *from);
        if (flow.law == Flow::Law::pneumatic_orifice && !is_gas)
            wrong(flow.span,
                  fmt::format("flow '{}' follows the law of a pneumatic orifice, which holds for ideal gases, but '{}' is not one; take "
                              "\"hydraulic_orifice\"",
                              flow.name, from->name),
                  *from);
        if (flow.law == Flow::Law::check_valve && flow.area && is_gas)
            wrong(flow.span,
                  fmt::format("check valve '{}' follows the law of a hydraulic orifice, which holds for liquids, but '{}' is a gas; give "
                              "it a conductance",
                              flow.name, from->name),
                  *from);
        if (flow.law == Flow::Law::pneumatic_orifice && is_gas && !from->isochoric_heat)
            wrong(flow.span,
                  fmt::format("flow '{}' needs the ratio of specific heats of '{}', which has no isochoric_heat", flow.name, from->name),
                  *from);
        if (flow.law == Flow::Law::pipe && from->law != Medium::Law::liquid && from->law != Medium::Law::incompressible)
            wrong(flow.span, fmt::format("pipe '{}' needs a medium of constant density, but '{}' is not a liquid", flow.name, from->name),
                  *from);
    }

    const Model& model_;
    const Names& names_;
    Claims& claims_;
    Diagnostics& diagnostics_;
};

}  // namespace

void check_fluids(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics) {
    FluidCheck(model, names, claims, diagnostics).run();
}

}  // namespace dalembert
