// SPDX-License-Identifier: GPL-3.0-or-later
// A generated system run by templates, with sizes known to the compiler, and as a plant, with sizes known when it is loaded: the same
// steps, events and numbers, bit by bit.
#pragma once

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "dalembert/plant_inputs.hpp"
#include "dalembert/run_program.hpp"
#include "plants/plant_of.hpp"

namespace plants {

/// All that a run has shown, as numbers.
struct Shown {
    std::vector<double> numbers;
    std::vector<double> changes;
    dalembert::Outcome outcome;
};

template <class System, class Inputs>
Shown run(const System& system, const Inputs& inputs, double until, dalembert::Method method) {
    using Running = dalembert::detail::Running<System>;
    auto x = system.start_state();
    typename Running::Options options;
    options.method = method;
    options.max_steps = 20000;
    dalembert::detail::set_run(options, system, inputs, x, 1e-7, 0.0, 50, until, 1.0);
    if (options.has_fixed_steps()) options.step = until / 200;
    Shown shown;
    const auto observe = [&](const auto& sample) {
        shown.numbers.push_back(sample.t);
        shown.numbers.insert(shown.numbers.end(), sample.x.begin(), sample.x.end());
        shown.numbers.insert(shown.numbers.end(), sample.y.begin(), sample.y.end());
        shown.numbers.insert(shown.numbers.end(), {sample.kinetic_energy, sample.potential_energy, sample.internal_energy, sample.work});
    };
    if constexpr (dalembert::detail::is_switching<System>) {
        using Mode = typename System::Mode;
        shown.outcome = Running::run(system, inputs, x, until, options, observe,
                                     [&](double t, std::size_t event, Mode from, Mode to, const auto&, const auto&, bool) {
                                         shown.changes.insert(shown.changes.end(), {t, double(event), double(static_cast<unsigned>(from)),
                                                                                    double(static_cast<unsigned>(to))});
                                     })
                            .outcome;
    } else {
        shown.outcome = Running::run(system, inputs, x, until, options, observe).outcome;
    }
    return shown;
}

/// Numbers that are no numbers are equal, too.
inline std::size_t differences(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::memcmp(&a[i], &b[i], sizeof(double)) != 0 && !(a[i] != a[i] && b[i] != b[i]) ? 1 : 0;
    return count;
}

inline void check_same(const Shown& a, const Shown& b) {
    CHECK(a.outcome.status == b.outcome.status);
    CHECK(a.outcome.t == b.outcome.t);
    CHECK(a.outcome.state == b.outcome.state);
    CHECK(a.outcome.guard == b.outcome.guard);
    CHECK(a.outcome.constraint == b.outcome.constraint);
    CHECK(a.outcome.events == b.outcome.events);
    CHECK(a.outcome.steps == b.outcome.steps);
    CHECK(a.outcome.rejected == b.outcome.rejected);
    CHECK(a.outcome.rhs_calls == b.outcome.rhs_calls);
    CHECK(a.outcome.steps_by == b.outcome.steps_by);
    CHECK(differences(a.numbers, b.numbers) == 0);
    CHECK(differences(a.changes, b.changes) == 0);
}

template <dalembert::PlantKind kind, class System>
void check_kind(const dalembert_plant& plant, double until, const std::vector<dalembert::Method>& methods) {
    const dalembert::UsePlant use(plant);
    using AsPlant = dalembert::PlantSystem<kind>;
    const System system;
    const AsPlant as_plant(default_parameters(plant));
    for (const dalembert::Method method : methods) {
        CAPTURE(static_cast<int>(method));
        check_same(run(system, dalembert::ZeroInputs<System>{}, until, method),
                   run(as_plant, dalembert::InputsOfPlant(as_plant, {}), until, method));
    }
}

template <class System>
void check_plant(double until, const std::vector<dalembert::Method>& methods) {
    const dalembert_plant plant = plant_of<System>();
    using dalembert::PlantKind;
    constexpr bool switches = dalembert::detail::is_switching<System>;
    if constexpr (switches) return check_kind<PlantKind::switching, System>(plant, until, methods);
    else if constexpr (dalembert::detail::chooses_constraints<System>)
        return check_kind<PlantKind::choosing, System>(plant, until, methods);
    else if constexpr (dalembert::detail::can_be_singular<System>) return check_kind<PlantKind::constrained, System>(plant, until, methods);
    else if constexpr (dalembert::detail::needs_projection<System>) return check_kind<PlantKind::normed, System>(plant, until, methods);
    else check_kind<PlantKind::free, System>(plant, until, methods);
}

}  // namespace plants
