// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/modal.hpp"

#include <dalembert/modal.hpp>
#include <dalembert/reduced_motions.hpp>

#include "plant/eigen_rows.hpp"

namespace dalembert {

namespace {

std::vector<std::complex<double>> numbers_of(const Eigen::VectorXcd& vector) { return {vector.data(), vector.data() + vector.size()}; }

template <class System>
PlantModalForm modes_of(const ModalPointOfPlant& point) {
    const System system(point.parameters, point.mode);
    const auto x = array_of<typename System::State>(point.x);
    const auto u = array_of<typename System::Input>(point.u);
    PlantModalForm result;
    typename System::State rate;
    system.rhs(x, u, 0.0, rate);
    result.rates.assign(rate.begin(), rate.end());
    LinearSystem linear;
    if (point.is_held) {
        const auto reduced = reduced_motions(system, x, u, 0.0,
                                             point.takes_rows_of_plant ? constraint_rows(system, x, 0.0) : constraint_rows_of(point.rows));
        result.reduction = PlantModalReduction{reduced.is_closed,      reduced.coordinates,        reduced.apart,
                                               reduced.motions.states, rows_of(reduced.motions.N), reduced.of_apart};
        linear = reduced.system;
    } else {
        linear = linear_system(system, x, u, 0.0);
    }
    const Modes found = modes(linear);
    result.status = to_string(found.status);
    result.M = rows_of(linear.M);
    result.D = rows_of(linear.D);
    result.C = rows_of(linear.C);
    result.B = rows_of(linear.B);
    result.of_M = to_string(definiteness(linear.M));
    result.of_D = to_string(definiteness(linear.D));
    result.of_C = to_string(definiteness(linear.C));
    if (found.status != ModalStatus::success) return result;
    result.eigenvalues = numbers_of(found.eigenvalues);
    result.alpha = numbers_of(found.alpha);
    result.vectors = rows_of(found.vectors);
    result.matrix = rows_of(found.matrix);
    result.input = rows_of(found.input);
    for (const auto& block : found.blocks)
        result.blocks.push_back({static_cast<std::size_t>(block.first), static_cast<std::size_t>(block.size), block.is_real});
    return result;
}

}  // namespace

PlantModalForm modes_of_plant(const dalembert_plant& plant, const ModalPointOfPlant& point) {
    const UsePlant use(plant);
    if (plant.is_projected != 0 && plant.constraints > 0) return modes_of<PlantSystem<PlantKind::constrained>>(point);
    return modes_of<PlantSystem<PlantKind::free>>(point);
}

}  // namespace dalembert
