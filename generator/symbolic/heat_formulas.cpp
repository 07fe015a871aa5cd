// SPDX-License-Identifier: GPL-3.0-or-later
// Equation and table numbers are those of chapter 4. The forms are those of runtime/dalembert/heat_functions.hpp, where the reasons
// stand; sums that would lose their digits when multiplied out are kept whole.
#include "symbolic/heat_formulas.hpp"

#include <map>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::cosh;
using GiNaC::ex;
using GiNaC::exp;
using GiNaC::numeric;
using GiNaC::pow;
using GiNaC::sqrt;
using GiNaC::tanh;

namespace {

using Arguments = std::vector<ex>;

ex square(const ex& x) { return pow(x, 2); }
ex kept(const ex& x) { return whole(x); }

ex sinh_ratio_of(const ex& a, const ex& b) { return exp(a - b) * exp_minus_one(-2 * a) / exp_minus_one(-2 * b); }
ex cosh_ratio_of(const ex& a, const ex& b) { return exp(a - b) * kept(1 + exp(-2 * a)) / kept(1 + exp(-2 * b)); }

ex fin_temperature_of(const ex& mL, const ex& mx, const ex& h) {
    const ex rest = kept(mL - mx);
    const ex insulated = exp(-mx) * kept(1 + exp(-2 * rest)) / kept(1 + exp(-2 * mL));
    return insulated * kept(1 + h * tanh(rest)) / kept(1 + h * tanh(mL));
}
ex fin_heat_of(const ex& mL, const ex& h) { return kept(tanh(mL) + h) / kept(1 + h * tanh(mL)); }
ex rod_heat_of(const ex& mL, const ex& ratio) { return tanh(mL / 2) - 2 * kept(1 - ratio) * exp(-mL) / exp_minus_one(-2 * mL); }

ex effectiveness_parallel_flow_of(const ex& N, const ex& c) { return N * decay_mean(N * kept(1 + c)); }
ex effectiveness_counter_flow_of(const ex& N, const ex& c) {
    const ex transferred = N * decay_mean(N * kept(1 - c));
    return transferred / kept(1 + c * transferred);
}

/// (4.24) with (4.19b); the decimals exactly as they are printed.
ex plate_nusselt_of(const ex& Re, const ex& Pr) {
    const numeric critical(500'000);
    const numeric four_fifths(4, 5);
    const ex sum = 1 + numeric(1973, 1000) * pow(Pr, numeric(272, 1000)) + numeric(2129, 100) * Pr;
    const ex phi = sqrt(Pr) / (sqrt(ex(GiNaC::Pi)) * pow(sum, numeric(1, 6)));
    const ex growth = exp_minus_one(four_fifths * log_ratio(maximum(Re, critical), critical));
    const ex critical_power =
        10'000 * pow(ex(5), four_fifths);  // 500000^(4/5); the smaller the base, the less its rounded exponent matters
    return 2 * sqrt(ex(minimum(Re, critical))) * phi + numeric(370, 10000) * critical_power * growth * pow(Pr, numeric(1, 3));
}

/// sqrt(y^2 + a^2)
ex root(const ex& a, const ex& y) { return norm(square(a) + square(y)); }
/// A B - (a b - y^2) with the roots A and B of a and b
ex excess(const ex& a, const ex& b, const ex& y) { return root_excess(a * b - square(y), square(y) * square(kept(a + b))); }

ex view_parallel_strips_of(const ex& x, const ex& y, const ex& L_i, const ex& L_j) {
    const ex a = kept(x + L_j);
    const ex b = sum_of_three(x, L_j, -L_i);
    const ex c = kept(x);
    const ex d = kept(x - L_i);
    const ex A = root(a, y);
    const ex B = root(b, y);
    const ex C = root(c, y);
    const ex D = root(d, y);
    return L_j * kept(excess(a, d, y) + excess(b, c, y)) / (kept(A * D + B * C) * kept(A + B + C + D));
}

ex view_half_plane_of(const ex& x, const ex& y, const ex& L_i) {
    const ex d = kept(x - L_i);
    return kept(root_excess(x, square(y)) + root_excess(d, square(y))) / (2 * kept(root(x, y) + root(d, y)));
}

ex view_perpendicular_strips_of(const ex& x, const ex& y, const ex& L_i, const ex& L_j) {
    const ex a = kept(x + L_j);
    return L_j * kept(root_excess(x, square(y)) + root_excess(a, square(y))) / (2 * L_i * kept(root(x, y) + root(a, y)));
}

ex view_wedge_of(const ex& L_i, const ex& L_j, const ex& theta) {
    const ex third_side = norm(square(kept(L_i - L_j)) + 4 * L_i * L_j * square(GiNaC::sin(theta / 2)));
    return 2 * L_j * square(GiNaC::cos(theta / 2)) / kept(L_i + L_j + third_side);
}

ex view_groove_of(const ex& x, const ex& y) { return 2 * x * y / (kept(x + y) * kept(x + y + root(x, y))); }

using Formula = ex (*)(const Arguments&);
const std::map<std::string_view, Formula>& formulas() {
    static const std::map<std::string_view, Formula> table{
        {"fourth_power_difference", [](const Arguments& x) { return fourth_power_difference(x[0], x[1]); }},
        {"plate_resistance", [](const Arguments& x) -> ex { return x[0] / (x[1] * x[2]); }},
        {"pipe_resistance", [](const Arguments& x) -> ex { return log_ratio(x[1], x[0]) / (2 * GiNaC::Pi * x[2] * x[3]); }},
        {"in_series", [](const Arguments& x) -> ex { return x[0] + x[1]; }},
        {"in_parallel", [](const Arguments& x) -> ex { return x[0] * x[1] / kept(x[0] + x[1]); }},
        {"sinh_ratio", [](const Arguments& x) { return sinh_ratio_of(x[0], x[1]); }},
        {"cosh_ratio", [](const Arguments& x) { return cosh_ratio_of(x[0], x[1]); }},
        {"fin_temperature", [](const Arguments& x) { return fin_temperature_of(x[0], x[1], x[2]); }},
        {"fin_heat", [](const Arguments& x) { return fin_heat_of(x[0], x[1]); }},
        {"rod_heat", [](const Arguments& x) { return rod_heat_of(x[0], x[1]); }},
        {"effectiveness_parallel_flow", [](const Arguments& x) { return effectiveness_parallel_flow_of(x[0], x[1]); }},
        {"effectiveness_counter_flow", [](const Arguments& x) { return effectiveness_counter_flow_of(x[0], x[1]); }},
        {"plate_nusselt", [](const Arguments& x) { return plate_nusselt_of(x[0], x[1]); }},
        {"view_parallel_strips", [](const Arguments& x) { return view_parallel_strips_of(x[0], x[1], x[2], x[3]); }},
        {"view_half_plane", [](const Arguments& x) { return view_half_plane_of(x[0], x[1], x[2]); }},
        {"view_perpendicular_strips", [](const Arguments& x) { return view_perpendicular_strips_of(x[0], x[1], x[2], x[3]); }},
        {"view_wedge", [](const Arguments& x) { return view_wedge_of(x[0], x[1], x[2]); }},
        {"view_groove", [](const Arguments& x) { return view_groove_of(x[0], x[1]); }},
    };
    return table;
}

}  // namespace

Rational stefan_boltzmann() { return Rational(cln::cl_I(5670374419L)) / cln::expt_pos(cln::cl_I(10), 17); }

ex fourth_power_difference(const ex& a, const ex& b) {
    return kept((a - b).expand()) * kept((a + b).expand()) * kept(square(a) + square(b));
}

std::optional<ex> heat_function(std::string_view name, const Arguments& arguments) {
    const auto formula = formulas().find(name);
    return formula == formulas().end() ? std::nullopt : std::optional<ex>(formula->second(arguments));
}

}  // namespace dalembert
