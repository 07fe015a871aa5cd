// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpp/helpers.hpp"

#include <vector>

#include "text/template.hpp"

namespace dalembert {

namespace {

struct Helper {
    const char* name;
    const char* file;
    std::vector<const char*> needs;
};

/// Each behind those that it needs.
const std::vector<Helper>& helpers() {
    static constexpr const char* scalars = "scalar_functions.hpp";
    static constexpr const char* angles = "angle_functions.hpp";
    static constexpr const char* fluids = "fluid_functions.hpp";
    static constexpr const char* heat = "heat_functions.hpp";
    static constexpr const char* networks = "heat_networks.hpp";
    static constexpr const char* junctions = "junctions.hpp";
    static const std::vector<Helper> table{
        {"select", scalars, {}},
        {"sign", scalars, {"select"}},
        {"step", scalars, {"select"}},
        {"if_else", scalars, {"select"}},
        {"min", scalars, {"select"}},
        {"max", scalars, {"select"}},
        {"inverse_norm", scalars, {"select"}},
        {"is_near", scalars, {}},
        {"independent_inverse", scalars, {"select"}},
        {"one_minus_cos", scalars, {}},
        {"sinc", scalars, {"select"}},
        {"sinc_slope", scalars, {"select"}},
        {"cosc", scalars, {"sinc"}},
        {"cosc_slope", scalars, {"sinc", "sinc_slope"}},
        {"growth_mean", scalars, {"select"}},
        {"logc", scalars, {"select"}},
        {"turn_back", scalars, {}},
        {"pi", scalars, {}},
        {"sin_and_cos", scalars, {}},
        {"far_angle", angles, {}},
        {"combined_sin_and_cos", angles, {"sin_and_cos", "far_angle"}},
        {"combined_sin", angles, {"combined_sin_and_cos"}},
        {"combined_cos", angles, {"combined_sin_and_cos"}},
        {"exponential_remainder", fluids, {}},
        {"compression", fluids, {"select", "exponential_remainder"}},
        {"signed_root", fluids, {"select"}},
        {"inverse_root", fluids, {}},
        {"forward_root", fluids, {"select"}},
        {"outflow_logarithm", fluids, {"select"}},
        {"critical_logarithm", fluids, {"select"}},
        {"outflow_factor", fluids, {"outflow_logarithm", "critical_logarithm"}},
        {"outflow_factor_slope", fluids, {"exponential_remainder", "outflow_factor"}},
        {"outflow_factor_by_exponent", fluids, {"exponential_remainder", "outflow_factor"}},
        {"decay_mean", heat, {"select"}},
        {"decay_mean_slope", heat, {"select", "exponential_remainder", "compression"}},
        {"logc_slope", heat, {"select", "logc", "decay_mean_slope"}},
        {"log_ratio", heat, {"select"}},
        {"log_mean", heat, {"select", "log_ratio"}},
        {"log_mean_slope", heat, {"select", "exponential_remainder", "log_ratio"}},
        {"root_excess", heat, {"select"}},
        {"sum_of_three", heat, {}},
        {"radiant_temperature", heat, {"select"}},
        {"unroll", "unroll.hpp", {}},
        {"network", networks, {}},
        {"network_inverse", networks, {"network"}},
        {"is_certain", scalars, {}},
        {"balanced_temperature", networks, {"select", "network", "is_certain"}},
        {"junction_root", junctions, {"select", "signed_root", "is_certain"}},
        {"series_sums", "series_functions.hpp", {}},
        {"ldlt", "ldlt.hpp", {"unroll"}},
    };
    return table;
}

}  // namespace

std::string helper_source(std::set<std::string> names) {
    const auto& table = helpers();
    for (auto helper = table.rbegin(); helper != table.rend(); ++helper)
        if (names.contains(helper->name)) names.insert(helper->needs.begin(), helper->needs.end());
    std::string text;
    for (const Helper& helper : table)
        if (names.contains(helper.name)) text += marked_section(embedded_file(helper.file), helper.name) + "\n";
    return text;
}

}  // namespace dalembert
