// SPDX-License-Identifier: GPL-3.0-or-later
// The controllers of a run: they measure outputs of a plant at their samples, and set inputs of it.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

#include <dalembert/clock.hpp>
#include <dalembert/plant_inputs.hpp>

#include "plant/simulation.hpp"

namespace dalembert::plant_run {

class Controllers {
public:
    explicit Controllers(const std::vector<ControllerOfRun>& controllers) {
        for (const ControllerOfRun& one : controllers) {
            list_.emplace_back(one, set_.places.size());
            set_.places.insert(set_.places.end(), one.sets.begin(), one.sets.end());
        }
        set_.values.assign(set_.places.size(), 0);
    }

    bool empty() const { return list_.empty(); }
    const SetInputs& set() const { return set_; }

    double next() const {
        double first = std::numeric_limits<double>::infinity();
        for (const One& one : list_) first = std::min(first, one.clock.next());
        return first;
    }

    /// Before the first samples take effect, inputs are what they would be if samples were taken at the start: outputs(y) gives what is
    /// measured.
    template <class Outputs>
    void begin(const Outputs& outputs) {
        for (One& one : list_) {
            const std::vector<double> x = one.x;
            sample(one, outputs);
            apply(one);
            one.x = x;
        }
    }

    /// What is due up to then; where instants agree, first what takes effect, then samples in the order of the list.
    template <class Outputs>
    void act(double until, const Outputs& outputs) {
        for (bool is_done = false; !is_done;) {
            is_done = true;
            for (One& one : list_)
                while (one.clock.is_effect_due(until)) {
                    apply(one);
                    one.clock.take_effect();
                }
            for (One& one : list_) {
                if (!one.clock.is_sample_due(until)) continue;
                sample(one, outputs);
                one.clock.take_sample();
                if (one.of.delay == 0) {
                    apply(one);
                    one.clock.take_effect();
                }
                is_done = false;
            }
        }
    }

    /// "speed_e_I", of all in their order.
    std::vector<Column> columns() const {
        std::vector<Column> columns;
        for (const One& one : list_)
            for (std::size_t i = 0; i < one.of.table->states; ++i)
                columns.push_back({one.of.name + "_" + one.of.table->state_table[i].name, one.of.table->state_table[i].unit});
        return columns;
    }
    void add_states(std::vector<double>& row) const {
        for (const One& one : list_) row.insert(row.end(), one.x.begin(), one.x.end());
    }

private:
    struct One {
        One(const ControllerOfRun& given, std::size_t first_set)
            : of(given),
              self(given.table->create(), given.table->destroy),
              clock(given.period, given.first, given.delay),
              first(first_set),
              measured(given.table->inputs),
              x(given.table->states),
              y(given.table->outputs) {
            if (self == nullptr) throw std::bad_alloc();
            of.table->set_parameters(self.get(), of.parameters.data());
            of.table->start_state(self.get(), x.data());
        }
        const ControllerOfRun& of;
        std::unique_ptr<void, void (*)(void*)> self;
        SampleClock clock;
        std::size_t first;  ///< of its values in set_
        std::vector<double> measured, x, y;
    };

    template <class Outputs>
    static void sample(One& one, const Outputs& outputs) {
        const auto y = outputs();
        for (std::size_t i = 0; i < one.measured.size(); ++i) one.measured[i] = y[one.of.measures[i]];
        one.of.table->sample(one.self.get(), one.measured.data(), one.x.data(), one.y.data());
    }
    void apply(const One& one) {
        for (std::size_t i = 0; i < one.of.outputs.size(); ++i) set_.values[one.first + i] = one.y[one.of.outputs[i]];
    }

    std::vector<One> list_;
    SetInputs set_;
};

}  // namespace dalembert::plant_run
