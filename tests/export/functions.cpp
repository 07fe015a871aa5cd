// SPDX-License-Identifier: GPL-3.0-or-later
// The functions that are exported for CasADi and acados, beside the table of the same plant: signatures, patterns, values, Jacobians and
// products, also where arguments or results are left out, where parameters change from call to call, and in several threads.
//     functions --modes PLANT.so
//     functions NAME PLANT.so CASADI.so ACADOS.so [MODE]
#include <cstring>
#include <thread>

#include "export/second_derivatives.hpp"

namespace {

const dalembert_plant& table_of(const char* file) {
    const auto table = reinterpret_cast<dalembert_plant_function>(dlsym(loaded(file), DALEMBERT_PLANT_FUNCTION));
    require(table != nullptr, std::string(file) + " is no plant");
    return *table();
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
