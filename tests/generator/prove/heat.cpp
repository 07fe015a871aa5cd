// SPDX-License-Identifier: GPL-3.0-or-later
// What can be proven about functions of heat transfer, and that their values and derivatives are those of their definitions.
#include "generator/machine.hpp"
#include "prove/normal_form.hpp"
#include "prove/printed.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/heat_formulas.hpp"
#include "symbolic/scalar_functions.hpp"

using namespace dalembert;
using namespace GiNaC;

namespace {

const realsymbol x("x"), y("y"), z("z");
const possymbol p("p"), q("q"), r("r");
bool zero(const ex& e) { return NormalForm().is_zero(e); }

ex f(const char* name, const std::vector<ex>& arguments) {
    if (const ScalarFunction* row = scalar_function_named(name)) return applied(*row, {arguments.begin(), arguments.end()});
    return heat_function(name, arguments).value();
}

/// A model with positive parameters and nothing but an equation to be checked.
Verdict verdict(const std::string& equation) {
    const Machine machine = machine_from(
        "[states]\nelapsed = { unit = \"s\", derivative = \"1\" }\n"
        "[parameters]\n"
        "N = { value = 2, unit = \"1\", range = [0.1, 5] }\nc = { value = 0.5, unit = \"1\", range = [0.1, 0.9] }\n"
        "T_h = { value = 360, unit = \"K\", range = [350, 400] }\nT_c = { value = 290, unit = \"K\", range = [280, 300] }\n"
        "C = { value = 100, unit = \"W/K\", range = [10, 1000] }\nk = { value = 1e-9, unit = \"1/K^3\", range = [1e-10, 1e-8] }\n"
        "L = { value = 1, unit = \"m\", range = [0.1, 3] }\ny = { value = 1, unit = \"m\", range = [0.1, 3] }\n"
        "[outputs]\nused = { value = \"elapsed*N*c*T_h*T_c*C*k*L*y\" }\n"
        "[printed.one]\nequation = \"" + equation + "\"\n");
    return check_printed(*machine.system, {&machine.loaded->model.printed[0]}).verdict();
}

}  // namespace

TEST_CASE("functions of heat transfer are proven to be what they are") {
    const std::vector<ex> identities{
        x * decay_mean(x) - 1 + exp(-x),
        decay_mean(-x) - exp(x) * decay_mean(x),
        x * x * decay_mean_slope(x) - (1 + x) * exp(-x) + 1,
        x * decay_mean_slope(x) + decay_mean(x) - exp(-x),
        log_ratio(p, q) + log_ratio(q, r) - log_ratio(p, r),
        log_ratio(p * q, q) - log(p),
        log_mean(p, q) * log_ratio(p, q) - p + q,
        log_mean(p, q) - log_mean(q, p),
        log_mean(p * r, q * r) - r * log_mean(p, q),
        log_mean_slope(p, q) * p + log_mean_slope(q, p) * q - log_mean(p, q),
        root_excess(x, y * y) - sqrt(x * x + y * y) + x,
        root_excess(x, y * y) * root_excess(-x, y * y) - y * y,
        sqrt(x * x + 1) * sqrt(y * y + 1) - root_excess(x * y + 1, pow(x - y, 2)) - x * y - 1,
        p * pow(radiant_temperature(p, q), 4) + radiant_temperature(p, q) - q,
        p * pow(radiant_temperature(p, q), 6) + pow(radiant_temperature(p, q), 3) - q * pow(radiant_temperature(p, q), 2),
        1 / radiant_temperature(p, q) - (p * pow(radiant_temperature(p, q), 3) + 1) / q,
        sum_of_three(x, y, -z) - x - y + z,
        f("sinh_ratio", {x, y}) * sinh(y) - sinh(x),
        f("cosh_ratio", {x, y}) * cosh(y) - cosh(x),
        f("fin_temperature", {p, p, x}) * (cosh(p) + x * sinh(p)) - 1,
        f("effectiveness_counter_flow", {p, 1}) - p / (1 + p),
        f("view_wedge", {p, p, Pi / 2}) - 1 + sqrt(ex(2)) / 2,
        f("view_groove", {p, p}) - f("view_wedge", {p, p, Pi / 2}),
        p * f("view_wedge", {p, q, x}) - q * f("view_wedge", {q, p, x}),
        p * f("view_parallel_strips", {0, y, p, q}) - q * f("view_parallel_strips", {0, y, q, p}),
    };
    for (const ex& e : identities) {
        CAPTURE(e);
        CHECK(zero(e));
    }
}

TEST_CASE("what functions of heat transfer are not is not proven") {
    const std::vector<ex> others{
        x * decay_mean(x) - 1 + exp(x), decay_mean_slope(x) - decay_mean(x), log_ratio(p, q) - log_ratio(q, p), log_mean(p, q) - (p + q) / 2,
        root_excess(x, y * y) + sqrt(x * x + y * y) - x, sqrt(x * x + 1) * sqrt(y * y + 1) - root_excess(x * y + 1, pow(x + y, 2)) - x * y - 1,
        p * pow(radiant_temperature(p, q), 4) - q, pow(radiant_temperature(p, q), 5) - radiant_temperature(p, q), sum_of_three(x, y, z) - x - y + z,
        f("view_wedge", {p, q, x}) - f("view_wedge", {q, p, x})};
    for (const ex& e : others) {
        CAPTURE(e);
        CHECK_FALSE(zero(e));
    }
}

TEST_CASE("balances of heat exchangers and radiating surfaces") {
    // What the hot side gives is what the wall lets through by (4.86a); N = K/C on both sides.
    CHECK(verdict("C*(T_h - T_c)*effectiveness_parallel_flow(N, 1) = C*N*log_mean(T_h - T_c, (T_h - T_c)*exp(-2*N))") == Verdict::proven);
    CHECK(verdict("C*(T_h - T_c)*effectiveness_parallel_flow(N, 1) = C*N*log_mean(T_h - T_c, (T_h - T_c)*exp(-N))") == Verdict::wrong);
    CHECK(verdict("effectiveness_counter_flow(N, 1) = N/(1 + N)") == Verdict::proven);
    CHECK(verdict("effectiveness_counter_flow(N, c) = (1 - exp(-N*(1 - c)))/(1 - c*exp(-N*(1 - c)))") == Verdict::proven);
    CHECK(verdict("effectiveness_counter_flow(N, c) = (1 - exp(-N*(1 - c)))/(1 + c*exp(-N*(1 - c)))") == Verdict::wrong);
    CHECK(verdict("k*radiant_temperature(k, T_h)^4 + radiant_temperature(k, T_h) = T_h") == Verdict::proven);
    CHECK(verdict("k*radiant_temperature(k, T_h)^4 - radiant_temperature(k, T_h) = T_h") == Verdict::wrong);
    CHECK(verdict("diff(radiant_temperature(k, T_h), T_h)*(1 + 4*k*radiant_temperature(k, T_h)^3) = 1") == Verdict::proven);
    CHECK(verdict("diff(fourth_power_difference(T_h, T_c), T_h) = 4*T_h^3") == Verdict::proven);
    CHECK(verdict("view_parallel_strips(0, y, L, L) = (sqrt(y^2 + L^2) - y)/L") == Verdict::proven);
    CHECK(verdict("view_parallel_strips(0, y, L, L) = (sqrt(y^2 + L^2) - L)/y") == Verdict::wrong);
    CHECK(verdict("2*view_perpendicular_strips(0, y, y, L) = 1 + L/y - sqrt(1 + L^2/y^2)") == Verdict::proven);
    CHECK(verdict("plate_nusselt(500000*c, 1) = 2*sqrt(500000*c)/(sqrt(pi)*(1 + 1.973 + 21.29)^(1/6))") != Verdict::wrong);
}

TEST_CASE("units of functions of heat transfer") {
    CHECK(verdict("log_mean(T_h, T_c) = T_h*log_ratio(T_h, T_c)") == Verdict::wrong);
    CHECK(verdict("log_ratio(T_h, T_c) = T_h") == Verdict::dimensionally_wrong);
    CHECK(verdict("log_ratio(T_h, L) = 1") == Verdict::dimensionally_wrong);
    CHECK(verdict("root_excess(L, y^2) = y^2") == Verdict::dimensionally_wrong);
    CHECK(verdict("root_excess(L, y) = y") == Verdict::dimensionally_wrong);
    CHECK(verdict("radiant_temperature(k, L) = L") == Verdict::dimensionally_wrong);
    CHECK(verdict("fourth_power_difference(T_h, T_c) = T_h^3") == Verdict::dimensionally_wrong);
    CHECK(verdict("view_wedge(L, y, T_h) = 1") == Verdict::dimensionally_wrong);
    CHECK(verdict("fin_heat(N, T_h) = 1") == Verdict::dimensionally_wrong);
}

TEST_CASE("what chapter 4 prints, in the model whose header is tested") {
    Diagnostics diagnostics;
    const Machine machine = derive_machine(load(std::string(SOURCE_DIR) + "/tests/stability/heat_functions.toml", diagnostics), "", {});
    for (const PrintedEquation& printed : machine.loaded->model.printed) {
        CAPTURE(printed.name);
        const Verdict found = check_printed(*machine.system, {&printed}).verdict();
        CHECK((found == Verdict::proven || found == Verdict::proven_under_assumption));
        if (printed.name.starts_with("table")) CHECK(found == Verdict::proven);
    }
}

TEST_CASE("values of functions of heat transfer to sixty digits, also where the definitions cancel") {
    Digits = 80;
    const auto close = [](const ex& a, const ex& b) {
        const numeric expected = ex_to<numeric>(b.evalf());
        return abs(ex_to<numeric>(a.evalf()) - expected) <= abs(expected) * pow(numeric(10), numeric(-60));
    };
    for (const numeric& at : {numeric(1, 3), numeric(-7, 5), numeric(40), numeric(-40)}) {
        CHECK(close(decay_mean(at), (1 - exp(-at)) / at));
        CHECK(close(decay_mean_slope(at), ((1 + at) * exp(-at) - 1) / (at * at)));
    }
    const numeric tiny = pow(numeric(10), numeric(-70));
    CHECK(close(decay_mean(tiny), 1 - tiny / 2));
    CHECK(close(decay_mean_slope(tiny), numeric(-1, 2) + tiny / 3));
    CHECK(close(log_mean(3, 2), 1 / log(ex(numeric(3, 2)))));
    CHECK(close(log_mean_slope(3, 2), (1 - 1 / (3 * log(ex(numeric(3, 2))))) / log(ex(numeric(3, 2)))));
    CHECK(close(log_mean_slope(2, 2 + tiny), numeric(1, 2)));
    CHECK(close(root_excess(1 / tiny, 1), tiny / 2));
    CHECK(close(root_excess(-3, 16), 8));
    CHECK(close(radiant_temperature(1, 18), 2));
    CHECK(close(radiant_temperature(tiny, 5), 5));
    CHECK(close(radiant_temperature(1 / tiny, 2 + 16 / tiny), 2));
    for (const char* name : {"decay_mean", "log_ratio", "log_mean", "root_excess", "radiant_temperature"}) {
        CAPTURE(name);
        const std::size_t count = std::string(name) == "decay_mean" ? 1 : 2;
        const std::vector<ex> point{numeric(5, 3), numeric(7, 4)};
        const std::vector<ex> letters{p, q};
        const ex function = f(name, {letters.begin(), letters.begin() + static_cast<std::ptrdiff_t>(count)});
        for (std::size_t i = 0; i < count; ++i) {
            const numeric step = pow(numeric(10), numeric(-20));
            const auto value = [&](const ex& e, const numeric& moved) { return e.subs(lst{p == point[0] + (i == 0 ? moved : numeric(0)), q == point[1] + (i == 1 ? moved : numeric(0))}).evalf(); };
            const ex difference = (value(function, step) - value(function, -step)) / (2 * step);
            CHECK(abs(ex_to<numeric>((difference - value(partial(function, letters[i]), 0)).evalf())) < pow(numeric(10), numeric(-36)));
            // Second derivatives too.
            const ex slope = partial(function, letters[i]);
            const ex second = (value(slope, step) - value(slope, -step)) / (2 * step);
            CHECK(abs(ex_to<numeric>((second - value(partial(slope, letters[i]), 0)).evalf())) < pow(numeric(10), numeric(-36)));
        }
    }
    Digits = 17;
}
