// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/sampling.hpp"

#include <fmt/format.h>

#include "elements/samplers.hpp"
#include "form/signs.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

SampleTimes sample_times(const System& controller, const Values& values) {
    const ControllerSampling& sampling = *controller.scene.sampling;
    const StartValues value(controller, values);
    const auto check = [&](const Written& written) {
        if (written.key.sign)
            value.check(*written.key.sign, controller.translate(written.expression, {}), written.expression.span, written.what);
    };
    walk(sampling, check);
    const auto seconds = [&](const ExpressionPtr& e) {
        const auto number = e ? value(controller.translate(e, {})) : std::optional<GiNaC::numeric>(0);
        if (!number) throw Failure(Diagnostic{Id::division_by_zero, e->span, "a time of the sampling has no value"});
        return number->to_double();
    };
    const SampleTimes times{seconds(sampling.every), seconds(sampling.offset), seconds(sampling.delay)};
    if (times.delay > times.every)
        throw Failure(Diagnostic{Id::value_out_of_range, sampling.delay->span,
                                 fmt::format("the delay of {:g} s is longer than the period of {:g} s; delay outputs by whole periods with "
                                             "states",
                                             times.delay, times.every)});
    return times;
}

}  // namespace dalembert
