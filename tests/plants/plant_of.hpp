// SPDX-License-Identifier: GPL-3.0-or-later
// Generated systems as plants in tests: what runs them is compiled once for all of them, and not once for each.
#pragma once

#include <cstring>
#include <vector>

#include "dalembert/plant_export.hpp"

namespace plants {

/// What a plant is compiled for: nothing but the system, with inputs that are given from outside.
template <class System>
struct NoRun {
    static const char* name() { return ""; }
    static const char* scene() { return ""; }
    static const char* title() { return ""; }
    static constexpr bool has_inputs = false;
    static auto inputs(const System&) {
        return [](const typename System::State&, double) { return typename System::Input{}; };
    }
    /// Parameters are numbers one after the other.
    template <class Parameters>
    static void set_parameters(Parameters& parameters, const double* numbers) {
        std::memcpy(static_cast<void*>(&parameters), numbers, System::parameter_table().size() * sizeof(double));
    }
    template <class Parameters>
    static void get_parameters(const Parameters& parameters, double* numbers) {
        std::memcpy(numbers, static_cast<const void*>(&parameters), System::parameter_table().size() * sizeof(double));
    }
};

template <class System>
dalembert_plant plant_of() {
    return dalembert::detail::PlantTable<System, NoRun<System>>::make();
}

inline std::vector<double> default_parameters(const dalembert_plant& plant) {
    return {plant.parameter_defaults, plant.parameter_defaults + plant.parameters};
}

}  // namespace plants
