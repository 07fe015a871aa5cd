// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of every committed fluid model does what flows, heat, shafts and forces bring: one row a scene, with inputs that are
// small, constant and within their ranges. The work is integrated with the state, energies are functions of the state alone.
#include <doctest/doctest.h>

#include <string>

#include "dalembert/plant_system.hpp"
#include "hydraulics/diesel_compression_adiabatic.hpp"
#include "hydraulics/diesel_compression_isothermal.hpp"
#include "hydraulics/hydraulic_cylinder_damped.hpp"
#include "hydraulics/hydraulic_cylinder_density_leaking.hpp"
#include "hydraulics/hydraulic_cylinder_density_real.hpp"
#include "hydraulics/hydraulic_cylinder_density_tight.hpp"
#include "hydraulics/hydraulic_cylinder_incompressible.hpp"
#include "hydraulics/hydraulic_cylinder_isothermal.hpp"
#include "hydraulics/hydraulic_cylinder_leaking.hpp"
#include "hydraulics/hydraulic_cylinder_loaded.hpp"
#include "hydraulics/hydraulic_cylinder_real.hpp"
#include "hydraulics/hydraulic_cylinder_thermal.hpp"
#include "hydraulics/hydraulic_orifice_full.hpp"
#include "hydraulics/liquid_reservoir_full.hpp"
#include "hydraulics/penstock_ideal.hpp"
#include "hydraulics/penstock_rough.hpp"
#include "hydraulics/pumped_storage_full.hpp"
#include "hydraulics/streamline_full.hpp"
#include "hydraulics/streamline_gas_full.hpp"
#include "hydraulics/tank_with_inflow_exact.hpp"
#include "hydraulics/tank_with_inflow_smooth.hpp"
#include "hydraulics/torricelli_book.hpp"
#include "hydraulics/torricelli_moving_surface.hpp"
#include "hydraulics/valve_cylinder_exact.hpp"
#include "hydraulics/valve_cylinder_ideal.hpp"
#include "hydraulics/valve_cylinder_smooth.hpp"
#include "hydraulics/water_tank_full.hpp"
#include "plants/plant_of.hpp"
#include "pneumatics/air_expansion_adiabatic.hpp"
#include "pneumatics/air_expansion_polytropic.hpp"
#include "pneumatics/air_reservoir_isentropic.hpp"
#include "pneumatics/air_reservoir_isothermal.hpp"
#include "pneumatics/air_reservoir_thermal_isothermal.hpp"
#include "pneumatics/air_reservoir_thermal_isothermal_smooth.hpp"
#include "pneumatics/air_reservoir_thermal_thermal.hpp"
#include "pneumatics/air_reservoir_thermal_thermal_smooth.hpp"
#include "pneumatics/changes_of_state_heated.hpp"
#include "pneumatics/changes_of_state_polytropic.hpp"
#include "pneumatics/pneumatic_cylinder_full.hpp"
#include "pneumatics/pneumatic_cylinder_leaking.hpp"
#include "pneumatics/pneumatic_cylinder_plain.hpp"
#include "pneumatics/pneumatic_cylinder_polytropic.hpp"
#include "pneumatics/pneumatic_cylinder_smooth.hpp"
#include "pneumatics/pneumatic_cylinder_thermal.hpp"
#include "pneumatics/pneumatic_isobaric_full.hpp"
#include "pneumatics/pneumatic_orifice_full.hpp"
#include "pneumatics/thermodynamic_identities_full.hpp"

namespace {

struct Worst {
    double error = 0;
    std::string name;
};

/// Runs as a plant: the integrator is compiled once.
void row(const char* name, const dalembert_plant& table, const std::vector<double>& inputs, double until, Worst& worst) {
    using Plant = dalembert::PlantSystem<dalembert::PlantKind::free>;
    REQUIRE(dalembert::kind_of(table) == dalembert::PlantKind::free);
    REQUIRE(inputs.size() <= table.inputs);  // others are zero
    const dalembert::UsePlant use(table);
    const Plant plant(plants::default_parameters(table));
    Plant::Input u;
    u.fill(0);
    std::copy(inputs.begin(), inputs.end(), u.begin());
    auto x = plant.start_state();
    dalembert::SimulationOptions<Plant> options;
    options.tolerance = 1e-10;
    options.intervals = 100;
    options.max_steps = 300000;
    for (std::size_t i = 0; i < x.size(); ++i) options.scale[i] = std::max(1e-3, std::abs(x[i]));
    const double energy = plant.kinetic_energy(x, 0) + std::abs(plant.potential_energy(x, 0)) + std::abs(plant.internal_energy(x, 0));
    options.scale[x.size()] = energy > 0 ? energy : 1;
    const auto result = dalembert::simulate(plant, [u](const auto&, double) { return u; }, x, 0.0, until, options, [](const auto&) {});
    const double error = result.energy.relative_error();
    CAPTURE(std::string(name));
    INFO(dalembert::message(result.outcome, Plant::state_table(), Plant::guard_table()));
    CHECK(result.outcome.status == dalembert::Status::success);
    CHECK(error < 1e-8);
    if (!(error <= worst.error)) worst = {error, name};
}

}  // namespace

#define ROW(space, until, ...) row(#space, plants::plant_of<space::System<double>>(), {__VA_ARGS__}, until, worst)

TEST_CASE("energy balance of liquids") {
    Worst worst;
    ROW(diesel_compression::adiabatic, 1, );
    ROW(diesel_compression::isothermal, 1, );
    ROW(hydraulic_cylinder::incompressible, 1, 1e-5, 100);
    ROW(hydraulic_cylinder::isothermal, 0.5, 1e-5, -6e-6, 100);
    ROW(hydraulic_cylinder::leaking, 0.5, 1e-5, -6e-6, 100);
    ROW(hydraulic_cylinder::damped, 0.5, 1e-5, -6e-6, 100);
    ROW(hydraulic_cylinder::loaded, 0.5, 1e-5, -6e-6, 100);
    ROW(hydraulic_cylinder::thermal, 0.5, 1e-5, -6e-6, 100);
    ROW(hydraulic_cylinder::real, 0.5, 1e-5, -6e-6, 100);
    ROW(hydraulic_cylinder_density::tight, 0.5, 0.01, -0.006, 100);
    ROW(hydraulic_cylinder_density::leaking, 0.5, 0.01, -0.006, 100);
    ROW(hydraulic_cylinder_density::real, 0.5, 0.01, -0.006, 100);
    ROW(hydraulic_orifice::full, 10, );
    ROW(liquid_reservoir::full, 2, 1e-5);
    ROW(penstock::ideal, 60, 1e7);
    ROW(penstock::rough, 60, 1e7);
    ROW(pumped_storage::full, 86400, 20);
    ROW(streamline::full, 2, );
    ROW(streamline_gas::full, 0.005, );
    ROW(tank_with_inflow::exact, 1000, 0.006);
    ROW(tank_with_inflow::smooth, 1000, 0.006);
    ROW(torricelli::book, 1200, );
    ROW(torricelli::moving_surface, 1200, );
    ROW(valve_cylinder::ideal, 0.3, 1e-4, 100);
    ROW(valve_cylinder::exact, 0.3, 1e-4, 100);
    ROW(valve_cylinder::smooth, 0.3, 1e-4, 100);
    ROW(water_tank::full, 200, 0.01, 0.009);
    MESSAGE("worst: ", worst.error, " of ", worst.name);
}

TEST_CASE("energy balance of gases") {
    Worst worst;
    ROW(air_expansion::adiabatic, 1, );
    ROW(air_expansion::polytropic, 1, );
    ROW(air_reservoir::isentropic, 60, 0.002, 0.0015);
    ROW(air_reservoir::isothermal, 60, 0.002, 0.0015);
    ROW(air_reservoir_thermal::isothermal, 60, 1, 0.1, 0);
    ROW(air_reservoir_thermal::isothermal_smooth, 100, 1, 0.1, 0);
    ROW(air_reservoir_thermal::thermal, 60, 1, 0.1, 1e-4);
    ROW(air_reservoir_thermal::thermal_smooth, 100, 1, 0.1, 1e-4);
    ROW(changes_of_state::heated, 2, 20, 10);
    ROW(changes_of_state::polytropic, 2, 20);
    ROW(pneumatic_cylinder::plain, 0.3, 0.1, 10);
    ROW(pneumatic_cylinder::polytropic, 0.3, 0.1, 10);
    ROW(pneumatic_cylinder::thermal, 0.3, 0.1, 10);
    ROW(pneumatic_cylinder::leaking, 0.3, 0.1, 10);
    ROW(pneumatic_cylinder::smooth, 0.3, 0.1, 10);
    ROW(pneumatic_cylinder::full, 0.3, 0.1, 10);
    ROW(pneumatic_isobaric::full, 20, 60);
    ROW(pneumatic_orifice::full, 10, 3e5);
    ROW(thermodynamic_identities::full, 10, 10, 0, 1e5, 7180);
    MESSAGE("worst: ", worst.error, " of ", worst.name);
}
