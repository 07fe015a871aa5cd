// SPDX-License-Identifier: GPL-3.0-or-later
// The functions that are exported for CasADi and acados, beside the table of the same plant: signatures, patterns, values, Jacobians and
// products, also where arguments or results are left out, where parameters change from call to call, and in several threads.
//     functions --modes PLANT.so
//     functions NAME PLANT.so CASADI.so ACADOS.so [MODE]
#include <cstring>
#include <thread>

#include "export/expected_values.hpp"

namespace {

using CasadiFunction = LoadedFunction<long long, int>;
using AcadosFunction = LoadedFunction<int, void*>;

const dalembert_plant& table_of(const char* file) {
    const auto table = reinterpret_cast<dalembert_plant_function>(dlsym(loaded(file), DALEMBERT_PLANT_FUNCTION));
    require(table != nullptr, std::string(file) + " is no plant");
    return *table();
}

class Random {
public:
    double operator()() {
        state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
        return static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }
    Vector vector(std::size_t n) {
        Vector v(n);
        for (double& value : v) value = 2 * (*this)() - 1;
        return v;
    }
    /// Near the start, with parameters near the defaults; the first one exactly there.
    Point point(ExpectedValues& plant, bool is_first) {
        Point q{{}, Vector(plant.inputs()), Vector(plant.parameters()), (*this)()};
        for (std::size_t i = 0; i < q.p.size(); ++i) q.p[i] = plant.table.parameter_defaults[i] * (is_first ? 1 : 1 + 0.01 * (*this)());
        q.x = plant.start(q.p);
        for (double& value : q.x) value = value * (1 + 0.1 * (*this)()) + 0.01 * ((*this)() - 0.5);
        for (std::size_t i = 0; i < q.u.size(); ++i)
            q.u[i] = std::isfinite(plant.table.input_table[i].low) ? plant.table.input_table[i].low : (*this)();
        return q;
    }

private:
    unsigned long long state_ = 88172645463325252ULL;
};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
std::vector<std::string> with(const std::string& before, std::vector<std::string> names) {
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

    void check(ExpectedValues& plant, const Point& q, Random& random) const {
        plant.at(q);
        std::vector<Vector> J{plant.by_x, plant.by_u, plant.by_p}, S{plant.C, plant.D, Vector(plant.outputs() * plant.parameters(), NAN)};
        if (has_time) J.push_back(plant.by_time), S.push_back(Vector(plant.outputs(), NAN));
        else same("df/dt", plant.by_time, Vector(plant.states(), 0.0));
        check(f, jac, fwd, adj, q, plant.rates, J, random);
        if (!outputs.empty()) check(outputs[0], outputs[1], outputs[2], outputs[3], q, plant.y, S, random);
    }

    bool has_time;
    CasadiFunction f, jac, fwd, adj;
    std::vector<CasadiFunction> outputs;
};

void check_acados(void* library, const std::string& name, ExpectedValues& plant, const Point& q, bool has_time, Random& random) {
    plant.at(q);
    const std::size_t n = plant.states(), m = plant.inputs(), p = plant.parameters();
    const auto function = [&](const char* which) { return AcadosFunction(library, name + "_" + which); };
    const auto columns = [&](const Vector& A, const Vector& S, std::size_t count) {  // A*S
        Vector result;
        for (std::size_t c = 0; c < count; ++c) {
            const Vector one = product(A, Vector(S.begin() + static_cast<long>(c * n), S.begin() + static_cast<long>((c + 1) * n)), n);
            result.insert(result.end(), one.begin(), one.end());
        }
        return result;
    };
    const Vector Sx = random.vector(n * n), Su = random.vector(n * m), Sp = random.vector(n * p), lambda = random.vector(n),
                 xdot = random.vector(n);
    const double size = std::max({size_of(plant.by_x, {1}), size_of(plant.by_u, {1}), size_of(plant.by_p, {1})}) * static_cast<double>(n);
    if (has_time) {
        require(dlsym(library, (name + "_expl_ode_fun").c_str()) == nullptr, "explicit functions of a model that depends on time");
    } else {
        same("expl_ode_fun", function("expl_ode_fun")({q.x, q.u, q.p})[0], plant.rates);
        const std::vector<Vector> forward = function("expl_vde_forw")({q.x, Sx, Su, q.u, q.p});
        same("expl_vde_forw", forward[0], plant.rates);
        same("expl_vde_forw, Sx", forward[1], columns(plant.by_x, Sx, n), 1e-13, size);
        same("expl_vde_forw, Su", forward[2], sum(plant.by_u, columns(plant.by_x, Su, m)), 1e-13, size);
        Vector adjoint = transposed_product(plant.by_x, lambda, n);
        const Vector by_u = transposed_product(plant.by_u, lambda, m);
        adjoint.insert(adjoint.end(), by_u.begin(), by_u.end());
        same("expl_vde_adj", function("expl_vde_adj")({q.x, lambda, q.u, q.p})[0], adjoint, 1e-13, size);
        same("expl_vde_forw_p", function("expl_vde_forw_p")({q.x, Sp, q.u, q.p})[0], sum(plant.by_p, columns(plant.by_x, Sp, p)), 1e-13,
             size);
    }
    const std::vector<Vector> arguments{q.x, xdot, q.u, {}, {q.t}, q.p};
    const Vector residual = sum(xdot, negative(plant.rates));
    Vector identity(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) identity[i * n + i] = 1;
    const Vector by_x = negative(plant.by_x), by_u = negative(plant.by_u);
    const auto results = [&](const char* which, const std::vector<Vector>& expected) {
        const std::vector<Vector> found = function(which).whole(arguments);
        require(found.size() == expected.size(), std::string(which) + ": number of results");
        for (std::size_t i = 0; i < found.size(); ++i) same(which, found[i], expected[i], 1e-14, i == 0 ? size_of(xdot, {1}) : 0);
    };
    results("impl_dae_fun", {residual});
    results("impl_dae_fun_jac_x_xdot_z", {residual, by_x, identity, {}});
    results("impl_dae_fun_jac_x_xdot_u_z", {residual, by_x, identity, by_u, {}});
    results("impl_dae_fun_jac_x_xdot_u", {residual, by_x, identity, by_u});
    results("impl_dae_jac_x_xdot_u_z", {by_x, identity, by_u, {}});
    results("impl_dae_jac_p", {negative(plant.by_p)});
}

/// J'*lambda by states and inputs.
Vector gradient(ExpectedValues& plant, const Point& q, const Vector& lambda) {
    plant.at(q);
    Vector result = transposed_product(plant.by_x, lambda, plant.states());
    const Vector by_u = transposed_product(plant.by_u, lambda, plant.inputs());
    result.insert(result.end(), by_u.begin(), by_u.end());
    return result;
}

/// The products of CasADi along a further direction s, with H = d^2(lambda' f)/d[x; u]^2: (J'*lambda)' along s, and with v of J*v.
void check_second_products(void* library, const Casadi& casadi, ExpectedValues& plant, const Point& q, const Vector& H, const Vector& lambda,
                           Random& random) {
    plant.at(q);
    const std::size_t n = plant.states(), m = plant.inputs(), w = n + m;
    const auto joined = [](Vector a, const Vector& b) { return a.insert(a.end(), b.begin(), b.end()), a; };
    const Vector sx = random.vector(n), su = random.vector(m), s_lambda = random.vector(n), vx = random.vector(n), vu = random.vector(m),
                 s_vx = random.vector(n), s_vu = random.vector(m), sp = random.vector(plant.parameters());
    const double size = (size_of(H, {1}) + size_of(plant.by_x, {1}) + size_of(plant.by_u, {1})) * static_cast<double>(w);
    const std::vector<Vector> time(casadi.has_time ? 1 : 0);
    const auto list = [&](std::vector<Vector> before, const std::vector<Vector>& after) {
        before.insert(before.end(), time.begin(), time.end());
        before.insert(before.end(), after.begin(), after.end());
        return before;
    };
    // x, u, p, (t), xdot, lambda; the adjoint; seeds of all of these
    const auto of_adjoint = [&](const Vector& along_p) {
        return casadi.arguments(q, list({{}, lambda, {}, {}, {}}, list({sx, su, along_p}, {{}, s_lambda})));
    };
    const CasadiFunction adjoint(library, "fwd1_adj1_f"), forward(library, "fwd1_fwd1_f");
    const std::vector<Vector> found = adjoint(of_adjoint({}));
    Vector expected = sum(product(H, joined(sx, su), w),
                          joined(transposed_product(plant.by_x, s_lambda, n), transposed_product(plant.by_u, s_lambda, m)));
    same("fwd1_adj1_f", joined(found[0], found[1]), expected, 1e-12, size);
    for (const double value : found[2]) require(std::isnan(value), "second derivatives by parameters are not there");
    const Vector along_p = adjoint(of_adjoint(sp))[0];
    for (const double value : along_p) require(sp.empty() || std::isnan(value), "second derivatives by parameters are not there");
    // x, u, p, (t), xdot, v; J*v; seeds
    const Vector twice = forward(casadi.arguments(q, list({{}, vx, vu, {}}, list({{}, sx, su, {}}, list({{}, s_vx, s_vu, {}}, {})))))[0];
    const Vector Hs = product(H, joined(sx, su), w), v = joined(vx, vu), Jv = sum(product(plant.by_x, s_vx, n), product(plant.by_u, s_vu, n));
    double weighted = 0, other = 0;
    for (std::size_t i = 0; i < n; ++i) weighted += lambda[i] * twice[i], other += lambda[i] * Jv[i];
    for (std::size_t i = 0; i < w; ++i) other += v[i] * Hs[i];
    same("fwd1_fwd1_f", {weighted}, {other}, 1e-11, size * static_cast<double>(w));
}

/// Second derivatives, where they are there, beside differences of first ones, and along sensitivities. Returns whether they are there.
bool check_hessian(void* library, const std::string& name, void* of_casadi, const Casadi& casadi, ExpectedValues& plant, const Point& q,
                   Random& random) {
    if (dlsym(library, (name + "_impl_dae_hess").c_str()) == nullptr) return false;
    const std::size_t n = plant.states(), m = plant.inputs(), w = n + m;
    const Vector lambda = random.vector(n);
    const AcadosFunction implicit(library, name + "_impl_dae_hess");
    const Vector whole = implicit.whole({q.x, random.vector(n), q.u, {}, lambda, {q.t}, q.p})[0];
    require(whole.size() == (w + n) * (w + n), "size of impl_dae_hess");
    const auto place = [&](std::size_t i) { return i < n ? i : n + i; };
    Vector H(w * w);
    for (std::size_t c = 0; c < w; ++c)
        for (std::size_t r = 0; r < w; ++r) H[c * w + r] = -whole[place(c) * (w + n) + place(r)];
    const Vector middle = gradient(plant, q, lambda);
    for (std::size_t c = 0; c < w; ++c) {
        const double at = c < n ? q.x[c] : q.u[c - n], h = 1e-5 * std::max(1e-3, std::abs(at));
        Point a = q, b = q;
        (c < n ? a.x[c] : a.u[c - n]) = at - h, (c < n ? b.x[c] : b.u[c - n]) = at + h;
        const Vector low = gradient(plant, a, lambda), high = gradient(plant, b, lambda);
        for (std::size_t r = 0; r < w; ++r) {
            const double slope = (high[r] - low[r]) / (2 * h), found = H[c * w + r];
            // Differences lose digits of what is large, and see kinks from both sides.
            const double error = 1e-4 * (std::abs(slope) + std::abs(found)) + (1e-13 / h + 1e-9) * std::abs(middle[r]) + 1e-9;
            char text[200];
            std::snprintf(text, sizeof text, "second derivative [%zu, %zu]: %.12g, by differences %.12g", r, c, found, slope);
            require(!std::isfinite(slope) || std::abs(slope - found) <= error, text);
            require(!std::isfinite(found) || found == H[r * w + c], "second derivatives are not symmetric");
        }
    }
    compared() += w * w;
    check_second_products(of_casadi, casadi, plant, q, H, lambda, random);
    if (casadi.has_time) return true;
    const Vector Sx = random.vector(n * n), Su = random.vector(n * m);
    const std::vector<Vector> found = AcadosFunction(library, name + "_expl_ode_hess")({q.x, Sx, Su, lambda, q.u, q.p});
    plant.at(q);
    same("expl_ode_hess, adjoint", found[0], middle, 1e-13, size_of(plant.by_x, lambda) + size_of(plant.by_u, lambda));
    Vector S(w * w, 0.0), expected;
    for (std::size_t c = 0; c < w; ++c)
        for (std::size_t r = 0; r < w; ++r) S[c * w + r] = r >= n ? (r == c ? 1 : 0) : c < n ? Sx[c * n + r] : Su[(c - n) * n + r];
    for (std::size_t c = 0; c < w; ++c) {
        const Vector along(S.begin() + static_cast<long>(c * w), S.begin() + static_cast<long>((c + 1) * w));
        const Vector column = transposed_product(S, product(H, along, w), w);
        expected.insert(expected.end(), column.begin() + static_cast<long>(c), column.end());
    }
    same("expl_ode_hess", found[1], expected, 1e-12, size_of(H, {1}) * static_cast<double>(w));
    return true;
}

/// Each thread has its own parameters, and changes them from call to call.
void check_threads(const Casadi& casadi, const dalembert_plant& table, unsigned mode) {
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([&, k] {
            ExpectedValues plant(table, mode);
            Random random;
            for (int i = 0; i < k; ++i) random();
            std::vector<Point> points;
            std::vector<Vector> expected;
            for (int i = 0; i < 3; ++i) {
                points.push_back(random.point(plant, i == 0));
                plant.at(points.back());
                expected.push_back(plant.rates);
            }
            for (std::size_t i = 0; i < 600; ++i) {
                const Vector found = casadi.f(casadi.arguments(points[i % 3]))[0];
                for (std::size_t j = 0; j < found.size(); ++j)
                    require(found[j] == expected[i % 3][j] || !(std::abs(found[j] - expected[i % 3][j]) > 1e-12 * std::abs(found[j])),
                            "another value in another thread");
            }
        });
    for (std::thread& thread : threads) thread.join();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--modes") == 0) {
        const dalembert_plant& table = table_of(argv[2]);
        for (std::size_t i = 0; i < table.modes; ++i) std::printf("%s\n", table.mode_names[i]);
        return 0;
    }
    if (argc < 5) return 2;
    const dalembert_plant& table = table_of(argv[2]);
    unsigned mode = 0;
    while (argc > 5 && mode < table.modes && std::strcmp(table.mode_names[mode], argv[5]) != 0) ++mode;
    require(argc == 5 ? table.modes == 0 : mode < table.modes, "the mode");
    void* const acados = loaded(argv[4]);
    void* const library = loaded(argv[3]);
    const Casadi casadi(library, table);
    ExpectedValues plant(table, mode);
    Random random;
    int finite = 0, hessians = 0;
    for (int i = 0; i < 10; ++i) {
        const Point q = random.point(plant, i == 0);
        same("start", CasadiFunction(library, "start")({q.p})[0], plant.start(q.p));
        casadi.check(plant, q, random);
        check_acados(acados, argv[1], plant, q, casadi.has_time, random);
        finite += plant.is_finite();
        hessians += check_hessian(acados, argv[1], library, casadi, plant, q, random);
    }
    require(finite >= 5, "most points are outside of the model");
    // What is left out is zero.
    Point zero{Vector(table.states, 0.0), Vector(table.inputs, 0.0), Vector(table.parameters, 0.0), 0};
    const std::vector<Vector> nothing(casadi.f.in.size());
    plant.at(zero);
    same("f of nothing", casadi.f(nothing)[0], plant.rates);
    check_threads(casadi, table, mode);
    std::printf("%zu values%s\n", compared(), hessians > 0 ? ", with second derivatives" : "");
    return 0;
}
