/* SPDX-License-Identifier: BSL-1.0 */
/* Value references of an FMU, and the nominal values of its states: what the adapters and the writer of modelDescription.xml must agree on.
 * C99 and C++. */
#ifndef DALEMBERT_FMI_VALUES_H
#define DALEMBERT_FMI_VALUES_H

#include <math.h>
#include <stddef.h>

/* Value references count through these vectors, one behind the other, each in the order of the plant's table. */
enum fmi_kind {
    fmi_time,
    fmi_state,
    fmi_derivative,
    fmi_input,
    fmi_output,
    fmi_parameter,
    fmi_indicator, /* what must be watched for events: dalembert_event_values() of them */
    fmi_energy,    /* all that the table knows, whether the plant has them or not */
    fmi_mode,
    fmi_kinds      /* their number, and the kind of an unknown value reference */
};

enum fmi_energy_value {
    fmi_kinetic_energy,
    fmi_potential_energy,
    fmi_internal_energy,
    fmi_supplied_power,
    fmi_dissipated_power,
    fmi_prescribed_power,
    fmi_exchanged_power,
    fmi_energies
};

typedef struct fmi_layout {
    size_t first[fmi_kinds + 1]; /* value reference of the first entry of each vector, and behind the last */
} fmi_layout;

static inline fmi_layout fmi_layout_of(size_t states, size_t inputs, size_t outputs, size_t parameters, size_t indicators, size_t modes) {
    const size_t counts[fmi_kinds] = {1, states, states, inputs, outputs, parameters, indicators, fmi_energies, modes > 0 ? 1u : 0u};
    fmi_layout layout;
    layout.first[0] = 0;
    for (size_t kind = 0; kind < fmi_kinds; ++kind) layout.first[kind + 1] = layout.first[kind] + counts[kind];
    return layout;
}

/* Inputs that nobody has set: zero, or the end of their range that is next to it. */
static inline double fmi_input_start(double low, double high) { return low > 0.0 ? low : high < 0.0 ? high : 0.0; }

/* The power of ten at or below a typical size of a state: that of its start value, or else of its range, or else 1. */
static inline double fmi_nominal(double start, double low, double high) {
    double size = fabs(start);
    if (!(size > 0.0) && isfinite(low) && isfinite(high)) size = fmax(fabs(low), fabs(high));
    if (!(size > 0.0) || !isfinite(size)) return 1.0;
    double power = 1.0; /* by products, so that all compilers give the same bits */
    while (power > size && power > 1e-300) power /= 10.0;
    while (power * 10.0 <= size) power *= 10.0;
    return power;
}

#endif
