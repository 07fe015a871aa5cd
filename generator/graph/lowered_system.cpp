// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/lowered_system.hpp"

#include <algorithm>

#include "graph/lower.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class Lowerer {
public:
    Lowerer(const System& system, Atoms& atoms) : system_(system), atoms_(atoms) {}

    LoweredSystem run() {
        LoweredSystem l;
        const std::size_t n = system_.symbols.degrees();
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j <= i; ++j) l.mass.push_back(one(system_.mass(i, j)));
        for (std::size_t j = 0; j < n; ++j) l.force.push_back(one(system_.supplied[j] - system_.bias[j]));
        l.bias = all(system_.bias);
        l.generalised_force = all(system_.supplied);
        l.state_rate = all(system_.state_rates);
        for (const OutputEquation& output : system_.outputs) l.output.push_back(one(system_.with_rates(output.value)));
        l.definitions = all(system_.symbols.definition_values());
        l.start = all(start_values(system_));
        for (const Guard& guard : system_.fluids.guards) l.guards.push_back(one(guard.value));
        for (const By by : {By::state, By::input, By::parameter, By::time}) {
            const Partials p = partials(system_, by);
            auto& columns = l.by[static_cast<std::size_t>(by)];
            for (const auto& column : p.residual) columns.residual.push_back(all(column));
            for (const auto& column : p.state_rate) columns.state_rate.push_back(all(column));
            for (const auto& column : p.output) columns.output.push_back(all(column));
        }
        for (const auto& column : output_by_acceleration(system_)) l.output_by_acceleration.push_back(all(column));
        l.scalars = all({system_.kinetic_energy, system_.potential_energy, system_.supplied_power, system_.dissipated_power, system_.prescribed_power, system_.internal_energy, system_.exchanged_power});

        std::vector<Polynomial*> everything;
        each(l, [&](Polynomial& p) { everything.push_back(&p); });
        atoms_.canonicalise(everything);
        return l;
    }

private:
    Polynomial one(const ex& e) { return lower(e, atoms_); }
    std::vector<Polynomial> all(const std::vector<ex>& expressions) {
        std::vector<Polynomial> result;
        for (const ex& e : expressions) result.push_back(one(e));
        return result;
    }

    template <class Visit>
    static void each(LoweredSystem& l, const Visit& visit) {
        const auto list = [&](std::vector<Polynomial>& polynomials) { std::for_each(polynomials.begin(), polynomials.end(), visit); };
        for (auto* part : {&l.mass, &l.force, &l.bias, &l.generalised_force, &l.state_rate, &l.output, &l.definitions, &l.start, &l.guards, &l.scalars}) list(*part);
        for (auto& columns : l.by)
            for (auto* part : {&columns.residual, &columns.state_rate, &columns.output}) std::for_each(part->begin(), part->end(), list);
        std::for_each(l.output_by_acceleration.begin(), l.output_by_acceleration.end(), list);
    }

    const System& system_;
    Atoms& atoms_;
};

}  // namespace

std::vector<ex> start_values(const System& system) {
    std::vector<ex> values;
    const auto add = [&](const ExpressionPtr& e, const Indices& indices) { values.push_back(e ? system.translate(e, indices) : ex(0)); };
    for (const auto& member : system.scene.coordinates) add(member.item->start, Translator::indices_of(member));
    for (const auto& member : system.scene.coordinates) add(member.item->start_rate, Translator::indices_of(member));
    for (const auto& member : system.scene.states) {
        add(member.item->start, Translator::indices_of(member));
        if (member.item->root) values.back() = GiNaC::sqrt(values.back());
    }
    return values;
}

LoweredSystem lower_system(const System& system, Atoms& atoms) { return Lowerer(system, atoms).run(); }

}  // namespace dalembert
