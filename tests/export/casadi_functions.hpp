// SPDX-License-Identifier: GPL-3.0-or-later
// The functions for CasADi beside the table of the plant: signatures, values, Jacobians and products, also where arguments or results are
// left out.
#pragma once

#include <cstdlib>

#include "export/random_point.hpp"

using CasadiFunction = LoadedFunction<long long, int>;

inline std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
inline std::vector<std::string> with(const std::string& before, std::vector<std::string> names) {
    for (std::string& name : names) name = before + name;
    return names;
}

class Casadi {
public:
    Casadi(void* library, const dalembert_plant& table)
        : f(library, "f"), jac(library, "jac_f"), fwd(library, "fwd1_f"), adj(library, "adj1_f") {
        has_time = f.in.size() == 4;
        std::vector<std::string> ins{"x", "u", "p"};
        if (has_time) ins.push_back("t");
        const auto signatures = [&](const CasadiFunction& value, const CasadiFunction& jacobian, const CasadiFunction& forward,
                                    const CasadiFunction& adjoint, const std::string& name) {
            value.names_are(ins, {name});
            const auto all = joined(ins, {"out_" + name});
            jacobian.names_are(all, with("jac_" + name + "_", ins));
            forward.names_are(joined(all, with("fwd_", ins)), {"fwd_" + name});
            adjoint.names_are(joined(all, {"adj_" + name}), with("adj_", ins));
            const auto otherwise = value.symbol<double (*)(long long)>("_default_in");
            require(otherwise(0) == 0 && otherwise(1) == 0 && std::isnan(otherwise(2)) && otherwise(-1) == 0, name + ": defaults");
        };
        signatures(f, jac, fwd, adj, "xdot");
        CasadiFunction(library, "start").names_are({"p"}, {"x"});
        const CasadiFunction parameters(library, "parameters");
        same("parameters", parameters({})[0], Vector(table.parameter_defaults, table.parameter_defaults + table.parameters));
        if (table.outputs == 0) {
            require(dlsym(library, "y") == nullptr, "y without outputs");
            return;
        }
        for (const char* name : {"y", "jac_y", "fwd1_y", "adj1_y"}) outputs.emplace_back(library, name);
        signatures(outputs[0], outputs[1], outputs[2], outputs[3], "y");
    }

    std::vector<Vector> arguments(const Point& q, const std::vector<Vector>& more = {}) const {
        std::vector<Vector> a{q.x, q.u, q.p};
        if (has_time) a.push_back({q.t});
        a.insert(a.end(), more.begin(), more.end());
        return a;
    }

    /// `functions`: value, Jacobian and products. By time and, of outputs, by parameters as `J` says.
    void check(const CasadiFunction& value, const CasadiFunction& jacobian, const CasadiFunction& forward, const CasadiFunction& adjoint,
               const Point& q, const Vector& values, const std::vector<Vector>& J, Random& random) const {
        const std::size_t rows = values.size();
        const std::string name = value.name();
        same(name, value(arguments(q))[0], values);
        const std::vector<Vector> found = jacobian.whole(arguments(q, {Vector()}));
        for (std::size_t i = 0; i < J.size(); ++i) same("jac_" + name + ", by " + std::to_string(i), found[i], J[i]);
        for (unsigned which = 0; which < (1U << J.size()); ++which) {  // all choices of results
            std::vector<bool> wanted(J.size());
            for (std::size_t i = 0; i < J.size(); ++i) wanted[i] = (which >> i & 1) != 0;
            const std::vector<Vector> some = jacobian(arguments(q, {Vector()}), wanted);
            for (std::size_t i = 0; i < J.size(); ++i)
                if (wanted[i]) same("part of jac_" + name, jacobian.out[i].spread(some[i]), J[i]);
                else require(std::all_of(some[i].begin(), some[i].end(), [](double v) { return v == -12345.0; }), "an unwanted result");
        }
        // Forward: all seeds that J knows, and each alone.
        std::vector<Vector> seeds, none(J.size() + 1);
        Vector all(rows, 0.0);
        double size = 0;
        for (const Vector& A : J) {
            const bool is_known = std::all_of(A.begin(), A.end(), [](double v) { return std::isfinite(v); });
            seeds.push_back(is_known ? random.vector(rows == 0 ? 0 : A.size() / rows) : Vector());
            if (seeds.back().empty()) continue;
            std::vector<Vector> alone = none;
            alone[seeds.size()] = seeds.back();
            same("fwd1_" + name, forward(arguments(q, alone))[0], product(A, seeds.back(), rows), 1e-13, size_of(A, seeds.back()));
            all = sum(all, product(A, seeds.back(), rows)), size = std::max(size, size_of(A, seeds.back()));
        }
        std::vector<Vector> together = {Vector()};
        together.insert(together.end(), seeds.begin(), seeds.end());
        same("fwd1_" + name, forward(arguments(q, together))[0], all, 1e-13, size);
        same("fwd1_" + name + " without seeds", forward(arguments(q, none))[0], Vector(rows, 0.0));
        // Adjoint.
        const Vector seed = random.vector(rows);
        const std::vector<Vector> against = adjoint(arguments(q, {Vector(), seed}));
        for (std::size_t i = 0; i < J.size(); ++i) {
            const Vector expected = transposed_product(J[i], seed, J[i].size() / rows);
            same("adj1_" + name, against[i], expected, 1e-13, size_of(J[i], seed));
            std::vector<bool> wanted(J.size(), false);
            wanted[i] = true;
            same("part of adj1_" + name, adjoint(arguments(q, {Vector(), seed}), wanted)[i], expected, 1e-13, size_of(J[i], seed));
        }
    }

    /// Slopes of outputs by parameters or time, which the table does not have: as the function says, compared with differences.
    Vector slopes_of_outputs(ExpectedValues& plant, const Point& q, std::size_t result) const {
        const std::size_t rows = plant.outputs(), columns = result == 2 ? plant.parameters() : 1;
        Vector found = outputs[1].whole(arguments(q, {Vector()}))[result];
        if (!has_slopes || !plant.is_finite()) return found;
        for (std::size_t c = 0; c < columns; ++c) {
            const auto [slopes, unsure] = plant.slopes_of_outputs(q, result == 2 ? c : plant.parameters());
            const double step = result == 2 && q.p[c] != 0 ? std::abs(q.p[c]) : 1;
            double largest = 0;  // of outputs, of which some may be differences
            for (const double y : plant.y) largest = std::isfinite(y) ? std::max(largest, std::abs(y)) : largest;
            for (std::size_t r = 0; r < rows; ++r) {
                const double size = std::abs(slopes[r]) + std::abs(plant.y[r]) / step, distance = std::abs(found[c * rows + r] - slopes[r]);
                if (!std::isfinite(slopes[r])) continue;
                ++compared();
                require(distance <= 1e-8 * size + 20 * unsure[r] + 1e-11 * largest / step,
                        "slope of output " + std::to_string(r) + " by " + std::to_string(c) + " of " + std::to_string(result) + ": " +
                            std::to_string(found[c * rows + r]) + ", differences say " + std::to_string(slopes[r]));
            }
        }
        return found;
    }

    void check(ExpectedValues& plant, const Point& q, Random& random) const {
        plant.at(q);
        std::vector<Vector> J{plant.by_x, plant.by_u, plant.by_p}, S{plant.C, plant.D};
        if (!outputs.empty()) S.push_back(slopes_of_outputs(plant, q, 2));
        if (!outputs.empty() && has_time) S.push_back(slopes_of_outputs(plant, q, 3));
        plant.at(q);
        if (has_time) J.push_back(plant.by_time);
        else same("df/dt", plant.by_time, Vector(plant.states(), 0.0));
        check(f, jac, fwd, adj, q, plant.rates, J, random);
        if (!outputs.empty()) check(outputs[0], outputs[1], outputs[2], outputs[3], q, plant.y, S, random);
    }

    bool has_time;
    bool has_slopes = std::getenv("NO_SLOPES") == nullptr;  ///< of outputs by parameters and time; else they are NaN
    CasadiFunction f, jac, fwd, adj;
    std::vector<CasadiFunction> outputs;
};
