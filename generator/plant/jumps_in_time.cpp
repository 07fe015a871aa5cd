// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/jumps_in_time.hpp"

#include <dalembert_jumps.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <new>

#include "text/diagnostic.hpp"

namespace dalembert {

struct JumpsInTime::Modes {
    std::unique_ptr<dalembert_modes, void (*)(dalembert_modes*)> of;
    std::vector<double> x;  ///< functions of time do not ask for it
};

JumpsInTime::JumpsInTime(const dalembert_plant& plant, const std::vector<double>& parameters) : self_(plant.create(), plant.destroy) {
    if (self_ == nullptr) throw std::bad_alloc();
    plant.set_parameters(self_.get(), parameters.data());
    modes_.reset(new Modes{{dalembert_modes_new(&plant, self_.get()), dalembert_modes_free}, std::vector<double>(plant.states)});
    if (modes_->of == nullptr) throw std::bad_alloc();
}

JumpsInTime::~JumpsInTime() = default;

double JumpsInTime::room(double t, double limit) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    return 64 * epsilon * std::max(t, limit * epsilon);
}

double JumpsInTime::next(double t, const double* inputs, double limit) {
    modes_->of->inputs.held = inputs;
    return dalembert_next_jump(modes_->of.get(), t, modes_->x.data(), limit, room(t, limit));
}

std::vector<double> jump_times(const dalembert_plant& plant, const std::vector<double>& parameters, const std::vector<double>& inputs,
                               double until) {
    constexpr std::size_t most = 1000000;
    std::vector<double> times;
    if (plant.time_switches == 0) return times;
    JumpsInTime jumps(plant, parameters);
    for (double t = 0; (t = jumps.next(t, inputs.data(), until)) < until; t += JumpsInTime::room(t, until)) {
        times.push_back(t);
        if (times.size() > most)
            throw Failure(Diagnostic{Id::too_large,
                                     {},
                                     fmt::format("up to {:.6g} s there are more than {} kinks or jumps at known times, which is the "
                                                 "limit; choose a shorter run",
                                                 until, most)});
    }
    return times;
}

}  // namespace dalembert
