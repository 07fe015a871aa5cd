// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/equilibrium.hpp"

#include <dalembert/equilibrium.hpp>

#include "plant/eigen_rows.hpp"

namespace dalembert {

namespace {

template <class System>
PlantEquilibrium find(const EquilibriumSearchOfPlant& search) {
    using State = typename System::State;
    using Input = typename System::Input;
    const System system(search.parameters, search.mode);
    const auto found = find_equilibrium(
        system, array_of<State>(search.x), array_of<Input>(search.u), array_of<detail::Like<State, bool>>(search.free_states),
        array_of<detail::Like<Input, bool>>(search.free_inputs), 0.0, 100, array_of<detail::Like<State, bool>>(search.moving));
    PlantEquilibrium result{to_string(found.status),
                            to_string(found.kind),
                            found.dimension,
                            found.iterations,
                            found.residual,
                            numbers_of(found.x),
                            numbers_of(found.u),
                            {},
                            {},
                            {}};
    State rates;
    system.rhs(found.x, found.u, 0.0, rates);
    result.rates = numbers_of(rates);
    if (found.status != Status::success) return result;
    typename System::Output y;
    system.output(found.x, found.u, 0.0, y);
    result.y = numbers_of(y);
    const auto rows = search.takes_rows_of_plant ? constraint_rows(system, found.x, 0.0) : constraint_rows_of(search.rows);
    const auto linear = linearise(system, found.x, found.u, 0.0, rows);
    result.linearisation = PlantLinearisation{rows_of(linear.A), rows_of(linear.B), rows_of(linear.C), rows_of(linear.D),
                                              linear.free,       linear.ignorable,  linear.eigenvalues};
    return result;
}

}  // namespace

PlantEquilibrium find_equilibrium_of(const dalembert_plant& plant, const EquilibriumSearchOfPlant& search) {
    const UsePlant use(plant);
    if (plant.is_projected != 0 && plant.constraints > 0) return find<PlantSystem<PlantKind::constrained>>(search);
    return find<PlantSystem<PlantKind::free>>(search);
}

}  // namespace dalembert
