// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/view.hpp"
#include "report/machine_builder.hpp"
#include "report/maker.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;

void add_bodies(MachineBuilder& machine) {
    for (const BodyMotion& body : machine.system.bodies) {
        if (!body.has_position) continue;
        machine.drawing.bodies.push_back(body.member.name());
        machine.hidden.push_back(is_hidden(*machine.system.scene.model, body.member.name()));
        machine.add({machine.plain(body.position[0]), machine.plain(body.position[1]), machine.plain(body.position[2])});
        machine.shown.push_back(&body);
        machine.drawn.insert("body " + body.member.name());
    }
}

/// Of the ground that nothing leaves.
void find_plane(MachineBuilder& machine) {
    for (const std::vector<std::size_t>& plane : {std::vector<std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
        const std::size_t across = 3 - plane[0] - plane[1];
        const auto is_in = [&](const DrawnPoint& p) { return p[across].is_zero(); };
        if (std::all_of(machine.points.begin(), machine.points.end(), is_in)) {
            machine.drawing.plane = plane;
            return;
        }
    }
}

void add_view(MachineBuilder& machine) {
    const std::optional<View>& view = machine.system.scene.model->view;
    if (!view) return;
    MachineDrawing& drawing = machine.drawing;
    const auto measure = [&](const ExpressionPtr& e) -> std::optional<std::size_t> {
        if (!e) return std::nullopt;
        return machine.measure(machine.system.translate(*e, {}));
    };
    drawing.ground = measure(view->ground);
    drawing.turn = measure(view->turn);
    drawing.tilt = measure(view->tilt);
    drawing.has_trails = view->trails.value_or(true);
    for (std::size_t b = 0; b < machine.shown.size(); ++b) {
        MachineDrawing::Look look;
        look.hidden = machine.hidden[b];
        if (const ViewPart* part = find_view(*machine.system.scene.model, drawing.bodies[b])) {
            look.colour = part->colour;
            if (!drawing.plane.empty()) {
                for (const auto& choice : view_shapes())
                    if (choice.value == part->shape) look.shape = choice.word;
                look.radius = measure(part->radius);
                look.width = measure(part->width);
                look.height = measure(part->height);
                if (machine.shown[b]->has_rotation && drawing.plane == std::vector<std::size_t>{0, 1})
                    look.rotation = machine.measure(machine.shown[b]->rotation);
            }
            if (part->shape == ViewPart::Shape::wheel && !drawing.plane.empty() && !look.rotation)
                drawing.not_drawn.push_back(
                    fmt::format("how the wheel '{}' turns, as its body has no `rotation` in the plane of x and y", drawing.bodies[b]));
        }
        drawing.looks.push_back(std::move(look));
    }
}

/// The bodies of a machine and what acts on them in any of its modes, as "spring shaft"; and how the page calls them.
class Elements {
public:
    explicit Elements(const Machine& machine) : model_(*machine.system->scene.model) {
        add_all(*machine.system);
        for (const Machine& other : machine.other_modes) add_all(*other.system);
    }

    std::vector<std::string> names;

    /// "springs 'a' and 'b'", or how many where they are many.
    std::vector<std::string> tell() const {
        constexpr std::size_t most_named = 3;
        std::vector<std::pair<std::string, std::vector<std::string>>> kinds;
        for (const std::string& name : names) {
            const auto& [kind, own] = told_.at(name);
            auto known = std::find_if(kinds.begin(), kinds.end(), [&kind = kind](const auto& one) { return one.first == kind; });
            if (known == kinds.end()) known = kinds.insert(known, {kind, {}});
            if (std::find(known->second.begin(), known->second.end(), own) == known->second.end()) known->second.push_back(own);
        }
        std::vector<std::string> lines;
        for (const auto& [kind, list] : kinds) {
            const std::string many = kind.ends_with("y") ? kind.substr(0, kind.size() - 1) + "ies" : kind + "s";
            std::string text = list.size() > most_named ? fmt::format("{} {}", list.size(), many) : list.size() > 1 ? many : kind;
            for (std::size_t i = 0; i < list.size() && list.size() <= most_named; ++i)
                text += fmt::format("{}'{}'", i == 0 ? " " : i + 1 == list.size() ? " and " : ", ", list[i]);
            lines.push_back(text);
        }
        return lines;
    }

private:
    void add_all(const System& system) {
        for (const BodyMotion& one : system.bodies) add("body", *one.member.item, one.member.name());
        for (const auto& one : system.scene.springs) add("spring", *one.item, one.name());
        for (const auto& one : system.scene.dampers) add("damper", *one.item, one.name());
        for (const auto& one : system.scene.forces) add("force", *one.item, one.name());
        for (const auto& one : system.scene.torques) add("torque", *one.item, one.name());
        for (const ConstraintEquation& one : system.constraints) add("constraint", *one.item, one.name);
    }

    void add(const std::string& kind, const Item& item, const std::string& name) {
        const std::string whole = kind + " " + name;
        if (!told_.emplace(whole, std::pair(kind, name)).second) return;
        names.push_back(whole);
        if (const std::optional<Maker> maker = maker_of(item, model_)) told_[whole] = {maker->kind, maker->name};
    }

    const Model& model_;
    std::map<std::string, std::pair<std::string, std::string>> told_;  ///< kind and name
};

}  // namespace

MachineDrawing drawing_of(const Machine& machine) {
    MachineBuilder maker(machine);
    add_bodies(maker);
    find_plane(maker);
    add_bars(maker);
    add_forces(maker);
    maker.drawing.framed = maker.points.size();
    add_connectors(maker);
    add_view(maker);
    add_solids(maker);
    MachineDrawing drawing = std::move(maker.drawing);
    for (const DrawnPoint& p : maker.points) drawing.coordinates.insert(drawing.coordinates.end(), p.begin(), p.end());
    Elements unplaced(machine);
    std::erase_if(unplaced.names, [&](const std::string& one) { return maker.drawn.contains(one); });
    drawing.networks = networks_of(machine, unplaced.names);
    const NetworkDrawing& network = drawing.networks.front();
    std::erase_if(unplaced.names, [&](const std::string& one) { return network.drawn.contains(one); });
    const std::vector<std::string> told = unplaced.tell();
    drawing.not_drawn.insert(drawing.not_drawn.end(), told.begin(), told.end());
    drawing.not_drawn.insert(drawing.not_drawn.end(), network.not_drawn.begin(), network.not_drawn.end());
    return drawing;
}

}  // namespace dalembert
