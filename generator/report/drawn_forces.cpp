// SPDX-License-Identifier: GPL-3.0-or-later
// Forces, torques and the resistance of media in the picture of a machine, as arrows.
#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "report/machine_builder.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;

/// What acts on bodies or points, and how much in each mode.
class ForceMaker {
public:
    explicit ForceMaker(MachineBuilder& machine) : machine_(machine) {
        systems_.push_back(machine.machine.system.get());
        for (const Machine& other : machine.machine.other_modes) systems_.push_back(other.system.get());
        machine.drawing.force_values.resize(systems_.size());
    }

    void run() {
        for_each(&Scene::forces, [&](const Member<Force>& member, const System& system) {
            const auto at = member.item->on ? place_of(*member.item->on, member) : point_of(member, system);
            add("force ", member, at, false, [&](const System& of) {
                return find_in(of, &Scene::forces, member) ? in_ground(of, member, member.item->force, member.item->on) : zero();
            });
        });
        for_each(&Scene::dampers, [&](const Member<Damper>& member, const System&) {
            const auto at = member.item->on ? place_of(*member.item->on, member) : std::nullopt;
            add("damper ", member, at, false, [&](const System& of) {
                return find_in(of, &Scene::dampers, member) ? resistance(of, member, *at) : zero();
            });
        });
        for_each(&Scene::torques, [&](const Member<Torque>& member, const System& system) {
            if (member.item->rate) return add_at_joint(member, system);
            add("torque ", member, place_of(*member.item->on, member), true, [&](const System& of) {
                if (!find_in(of, &Scene::torques, member)) return zero();
                if (member.item->vector) return in_ground(of, member, *member.item->vector, member.item->on);
                return SpaceVector{0, 0, of.translate(member.item->torque, Translator::indices_of(member))};
            });
        });
    }

private:
    static SpaceVector zero() { return {0, 0, 0}; }

    template <class Item>
    static bool find_in(const System& system, std::vector<Member<Item>> Scene::*list, const Member<Item>& wanted) {
        const auto is_it = [&](const Member<Item>& one) { return one.item == wanted.item && one.index == wanted.index; };
        return std::any_of((system.scene.*list).begin(), (system.scene.*list).end(), is_it);
    }

    /// Each once, with the first system that has it.
    template <class Item, class Visit>
    void for_each(std::vector<Member<Item>> Scene::*list, const Visit& visit) {
        for (std::size_t i = 0; i < systems_.size(); ++i)
            for (const Member<Item>& member : systems_[i]->scene.*list) {
                const auto has_it = [&](const System* earlier) { return find_in(*earlier, list, member); };
                if (std::none_of(systems_.begin(), systems_.begin() + static_cast<std::ptrdiff_t>(i), has_it)) visit(member, *systems_[i]);
            }
    }

    /// Of a medium at rest on a body: against its velocity.
    SpaceVector resistance(const System& system, const Member<Damper>& member, std::size_t body) const {
        const Damper& damper = *member.item;
        const Indices indices = Translator::indices_of(member);
        const SpaceVector& velocity = find_motion_of(system, body)->velocity;
        if (damper.coefficient) return -system.translate(damper.coefficient, indices) * velocity;
        const ex speed = GiNaC::sqrt(dot(velocity, velocity));
        const GiNaC::realsymbol letter(damper.force->variable);
        const ex law = system.translate(*damper.force->body, indices, {{damper.force->variable, letter}}).subs(letter == speed);
        return ex(-law / speed) * velocity;
    }

    /// Along a rate that is one velocity, on the first body that turns with it: where that is joined to what carries it, about the axis.
    void add_at_joint(const Member<Torque>& member, const System& system) {
        const Symbols& symbols = system.symbols;
        const Indices indices = Translator::indices_of(member);
        const ex rate = symbols.without_definitions(system.translate(member.item->rate, indices)).expand();
        for (std::size_t j = 0; j < symbols.degrees(); ++j) {
            const ex& velocity = symbols.get(SymbolKind::velocity, j);
            const ex factor = rate.coeff(velocity, 1);
            if (factor.is_zero() || !GiNaC::is_a<GiNaC::numeric>(factor) || !is_zero_after_expansion(rate - factor * velocity)) continue;
            for (std::size_t b = 0; b < machine_.shown.size(); ++b) {
                if (is_zero(axis_of(machine_.system, b, j)) || machine_.hidden[b]) continue;
                const auto joint = machine_.joints.find(b);
                return add("torque ", member, joint == machine_.joints.end() ? b : joint->second, true, [&](const System& of) {
                    if (!find_in(of, &Scene::torques, member)) return zero();
                    return of.translate(member.item->torque, indices) * factor * axis_of(of, b, j);
                });
            }
        }
    }

    /// By which the angular velocity of a body changes with a velocity, in the axes of the ground.
    SpaceVector axis_of(const System& system, std::size_t body, std::size_t j) const {
        const BodyMotion& motion = *find_motion_of(system, body);
        const auto& velocity = GiNaC::ex_to<GiNaC::symbol>(system.symbols.get(SymbolKind::velocity, j));
        const auto slope = [&](const ex& e) { return system.symbols.without_definitions(e).diff(velocity); };
        if (!motion.frame) return {0, 0, slope(motion.angular_velocity)};
        const SpaceVector& own = motion.frame->angular_velocity;
        return motion.frame->to_ground({slope(own[0]), slope(own[1]), slope(own[2])});
    }

    const BodyMotion* find_motion_of(const System& system, std::size_t body) const {
        const Member<Body>& wanted = machine_.shown[body]->member;
        const auto is_it = [&](const BodyMotion& one) { return one.member.item == wanted.item && one.member.index == wanted.index; };
        return &*std::find_if(system.bodies.begin(), system.bodies.end(), is_it);
    }

    template <class Item>
    std::optional<std::size_t> place_of(const Reference& body, const Member<Item>& member) const {
        const BodyMotion* motion = find_motion(machine_.system.bodies, body, machine_.system.scene, Translator::indices_of(member));
        const auto found = std::find(machine_.shown.begin(), machine_.shown.end(), motion);
        if (motion == nullptr || found == machine_.shown.end()) return std::nullopt;
        return static_cast<std::size_t>(found - machine_.shown.begin());
    }

    /// Points are those of the first mode.
    std::optional<std::size_t> point_of(const Member<Force>& member, const System& system) {
        if (&system != &machine_.system) return std::nullopt;
        DrawnPoint point;
        for (std::size_t i = 0; i < 3; ++i)
            point[i] = machine_.plain(system.translate((*member.item->at)[i], Translator::indices_of(member)));
        return machine_.add(point);
    }

    template <class Item>
    static SpaceVector in_ground(const System& system, const Member<Item>& member, const VectorExpression& given,
                                 const std::optional<Reference>& on) {
        const Indices indices = Translator::indices_of(member);
        const SpaceVector value = system.translate(given, indices);
        const BodyMotion* body = on ? find_motion(system.bodies, *on, system.scene, indices) : nullptr;
        return member.item->in_axes && body != nullptr && body->frame ? body->frame->to_ground(value) : value;
    }

    template <class Item, class Value>
    void add(const char* kind, const Member<Item>& member, std::optional<std::size_t> at, bool is_torque, const Value& value_in) {
        if (!at) return;
        for (std::size_t i = 0; i < systems_.size(); ++i)
            for (const ex& component : value_in(*systems_[i]))
                machine_.drawing.force_values[i].push_back(systems_[i]->symbols.without_definitions(component));
        machine_.drawing.forces.push_back({member.name(), *at, is_torque});
        machine_.drawn.insert(kind + member.name());
    }

    MachineBuilder& machine_;
    std::vector<const System*> systems_;
};

}  // namespace

void add_forces(MachineBuilder& machine) { ForceMaker(machine).run(); }

}  // namespace dalembert
