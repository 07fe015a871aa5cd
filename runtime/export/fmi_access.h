/* SPDX-License-Identifier: BSL-1.0 */
/* Variables of an instance by value reference: what is evaluated when it is asked for, and what may be set when. */
#ifndef DALEMBERT_FMI_ACCESS_H
#define DALEMBERT_FMI_ACCESS_H

#include "fmi_machine.h"

static enum fmi_kind fmi_find(const fmi_machine* m, size_t reference, size_t* index) {
    for (size_t kind = 0; kind < fmi_kinds; ++kind)
        if (reference < m->layout.first[kind + 1]) {
            *index = reference - m->layout.first[kind];
            return (enum fmi_kind)kind;
        }
    return fmi_kinds;
}

static int fmi_are_finite(const double* values, size_t count) {
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(values[i])) return 0;
    return 1;
}

/* --- the start ---------------------------------------------------------------------------------------------------------------------- */

/* The state at the start, from parameters and from what the importer has set: on the constraints, behind the resets of the start, in the
 * first mode that accepts it. A state that the importer has not set follows the parameters, as it does in the model. */
static fmi_status fmi_start(fmi_machine* m, const char* function) {
    if (m->is_consistent || !(m->phase & (fmi_instantiated | fmi_initialising))) return fmi_ok;
    const dalembert_plant* plant = m->plant;
    const double span = m->stop > m->start ? m->stop - m->start : 1.0;
    m->known = 0;
    m->t = m->start;
    plant->start_state(m->self, m->x);
    for (size_t i = 0; i < plant->states; ++i)
        if (m->is_given[i]) m->x[i] = m->given[i];
    enum dalembert_status status = dalembert_good;
    if (m->run) {
        if (m->tolerance > 0.0) m->run->options.tolerance = m->tolerance;
        status = dalembert_run_start(m->run, m->start, m->start + span, m->x);
        memcpy(m->x, m->run->x, plant->states * sizeof(double));
        m->mode = m->run->mode;
    } else {
        /* Of what switches each mode has constraints of its own. */
        const int is_broken = plant->modes == 0 && dalembert_project(plant, m->self, 0, m->t, m->x, m->work) != DALEMBERT_NONE;
        status = is_broken ? dalembert_constraint_broken : dalembert_modes_begin(m->modes, m->t, span, m->x);
        m->mode = m->modes->mode;
        if (status == dalembert_good && plant->modes > 0 &&
            dalembert_project(plant, m->self, m->mode, m->t, m->x, m->work) != DALEMBERT_NONE)
            status = dalembert_constraint_broken;
    }
    m->is_consistent = status == dalembert_good;
    return status == dalembert_good ? fmi_ok : fmi_say_of(m, fmi_error, function, dalembert_status_text(status));
}

/* --- getting ------------------------------------------------------------------------------------------------------------------------ */

static const double* fmi_rates(fmi_machine* m) {
    if (!(m->known & fmi_has_rates)) m->plant->rhs(m->self, m->mode, m->x, m->u, m->t, m->rates);
    m->known |= fmi_has_rates;
    return m->rates;
}

static const double* fmi_outputs(fmi_machine* m) {
    if (!(m->known & fmi_has_outputs) && m->plant->output) m->plant->output(m->self, m->mode, m->x, m->u, m->t, m->outputs);
    m->known |= fmi_has_outputs;
    return m->outputs;
}

/* In co-simulation there are none. An event that has just happened may leave its indicator at zero, or a rounding below. Importers look for
 * changes of sign alone, so it counts from there on, as something positive: else they would miss the next event, or see one where it rises.
 */
static const double* fmi_indicators(fmi_machine* m) {
    if (m->modes) dalembert_modes_values(m->modes, m->t, m->x, m->indicators);
    for (size_t i = 0; i < m->plant->events; ++i)
        if (m->behind[i] <= 0.0) m->indicators[i] = m->indicators[i] - m->behind[i] + DBL_MIN;
    return m->indicators;
}

static void fmi_note_indicators(fmi_machine* m) {
    if (m->modes) dalembert_modes_values(m->modes, m->t, m->x, m->behind);
}

static double fmi_energy_of(const fmi_machine* m, size_t index) {
    const dalembert_plant* plant = m->plant;
    double (*const energies[])(const void*, unsigned, const double*, double) = {plant->kinetic_energy, plant->potential_energy,
                                                                                plant->internal_energy};
    double (*const powers[])(const void*, unsigned, const double*, const double*, double) = {
        plant->supplied_power, plant->dissipated_power, plant->prescribed_power, plant->exchanged_power};
    if (index < fmi_supplied_power) return energies[index] ? energies[index](m->self, m->mode, m->x, m->t) : 0.0;
    const size_t power = index - fmi_supplied_power;
    return powers[power] ? powers[power](m->self, m->mode, m->x, m->u, m->t) : 0.0;
}

/* Numbers of type double. */
static fmi_status fmi_get(fmi_machine* m, const unsigned* references, size_t count, double* values, const char* function) {
    if (count > 0 && (!references || !values)) return fmi_say_of(m, fmi_error, function, "an array is missing");
    if (fmi_start(m, function) != fmi_ok) return fmi_error;
    for (size_t i = 0; i < count; ++i) {
        size_t at = 0;
        switch (fmi_find(m, references[i], &at)) {
        case fmi_time: values[i] = m->t; break;
        case fmi_state: values[i] = m->x[at]; break;
        case fmi_derivative: values[i] = fmi_rates(m)[at]; break;
        case fmi_input: values[i] = m->u[at]; break;
        case fmi_output: values[i] = fmi_outputs(m)[at]; break;
        case fmi_parameter: values[i] = m->p[at]; break;
        case fmi_indicator: values[i] = fmi_indicators(m)[at]; break;
        case fmi_energy: values[i] = fmi_energy_of(m, at); break;
        case fmi_mode:
        case fmi_kinds: return fmi_say_of(m, fmi_error, function, "a value reference is not that of a variable of type Real or Float64");
        }
    }
    if (!fmi_are_finite(values, count)) return fmi_say_of(m, fmi_discard, function, "a value is infinite or not a number");
    return fmi_ok;
}

/* The mode: integers of 32 bits in version 2, an enumeration in version 3. */
static fmi_status fmi_get_mode(fmi_machine* m, const unsigned* references, size_t count, const char* function) {
    size_t at = 0;
    if (count > 0 && !references) return fmi_say_of(m, fmi_error, function, "an array is missing");
    for (size_t i = 0; i < count; ++i)
        if (fmi_find(m, references[i], &at) != fmi_mode)
            return fmi_say_of(m, fmi_error, function, "a value reference is not that of a variable of this type");
    return fmi_start(m, function);
}

/* A type of which the FMU has no variables. */
static fmi_status fmi_no_variables(const fmi_machine* m, size_t count, const char* function) {
    return count == 0 ? fmi_ok : fmi_say_of(m, fmi_error, function, "the FMU has no variables of this type that can be read or set so");
}

/* --- setting ------------------------------------------------------------------------------------------------------------------------ */

/* Where entries of each kind may be set. Parameters are tunable. */
static unsigned fmi_phases_to_set(enum fmi_kind kind) {
    if (kind == fmi_state) return fmi_instantiated | fmi_initialising;
    if (kind == fmi_parameter) return fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_stepping;
    if (kind == fmi_input) return fmi_instantiated | fmi_initialising | fmi_event_mode | fmi_continuous | fmi_stepping;
    return 0;
}

/* All or nothing: a value that is refused leaves the others as they were. */
static fmi_status fmi_set(fmi_machine* m, const unsigned* references, size_t count, const double* values, const char* function) {
    if (count > 0 && (!references || !values)) return fmi_say_of(m, fmi_error, function, "an array is missing");
    for (size_t i = 0; i < count; ++i) {
        size_t at = 0;
        const enum fmi_kind kind = fmi_find(m, references[i], &at);
        if (kind == fmi_kinds) return fmi_say_of(m, fmi_error, function, "there is no such value reference");
        if (!(m->phase & fmi_phases_to_set(kind))) return fmi_say_of(m, fmi_error, function, "a variable cannot be set, or not now");
        if (!isfinite(values[i])) return fmi_say_of(m, fmi_discard, function, "a value is infinite or not a number");
        if (kind == fmi_parameter && (values[i] < m->plant->parameter_table[at].low || values[i] > m->plant->parameter_table[at].high))
            return fmi_say_of(m, fmi_discard, function, "a parameter would leave its range");
    }
    int has_parameters = 0, has_jumps = 0;
    for (size_t i = 0; i < count; ++i) {
        size_t at = 0;
        const enum fmi_kind kind = fmi_find(m, references[i], &at);
        double* place = kind == fmi_state ? m->given : kind == fmi_parameter ? m->p : m->u;
        has_jumps = has_jumps || place[at] != values[i];
        place[at] = values[i];
        if (kind == fmi_state) m->is_given[at] = 1;
        if (kind == fmi_parameter) has_parameters = 1;
    }
    if (has_parameters) m->plant->set_parameters(m->self, m->p);
    if (count > 0) m->is_consistent = 0;
    if (count > 0) m->known = 0;
    if (has_jumps && (m->phase & (fmi_event_mode | fmi_stepping))) m->is_disturbed = 1;
    return fmi_ok;
}

static fmi_status fmi_set_state(fmi_machine* m, const double* x, size_t count, const char* function) {
    if (count != m->plant->states || (count > 0 && !x))
        return fmi_say_of(m, fmi_error, function, "the number of states is not that of the FMU");
    if (!fmi_are_finite(x, count)) return fmi_say_of(m, fmi_discard, function, "a state is infinite or not a number");
    memcpy(m->x, x, count * sizeof(double));
    m->known = 0;
    return fmi_ok;
}

static fmi_status fmi_set_time(fmi_machine* m, double t, const char* function) {
    if (!isfinite(t)) return fmi_say_of(m, fmi_error, function, "the time is infinite or not a number");
    m->t = t;
    m->known = 0;
    return fmi_ok;
}

/* Copies a vector of known length to the importer. */
static fmi_status fmi_give(const fmi_machine* m, const double* values, size_t own, double* result, size_t count, const char* function) {
    if (count != own || (count > 0 && !result)) return fmi_say_of(m, fmi_error, function, "the length of the array is not that of the FMU");
    if (count > 0) memcpy(result, values, count * sizeof(double));
    if (!fmi_are_finite(values, count)) return fmi_say_of(m, fmi_discard, function, "a value is infinite or not a number");
    return fmi_ok;
}

static fmi_status fmi_give_nominals(const fmi_machine* m, double* result, size_t count, const char* function) {
    if (count != m->plant->states || (count > 0 && !result))
        return fmi_say_of(m, fmi_error, function, "the number of states is not that of the FMU");
    for (size_t i = 0; i < count; ++i)
        result[i] = fmi_nominal(m->plant->start_values[i], m->plant->state_table[i].low, m->plant->state_table[i].high);
    return fmi_ok;
}

#endif
