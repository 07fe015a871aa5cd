/* SPDX-License-Identifier: BSL-1.0 */
/* Partial derivatives of rates and outputs, forward and adjoint, from the exact Jacobians of the plant. They are evaluated once for a
 * point. */
#ifndef DALEMBERT_FMI_DERIVATIVES_H
#define DALEMBERT_FMI_DERIVATIVES_H

#include <float.h>

#include "fmi_access.h"

typedef void fmi_jacobian(const void* self, unsigned mode, const double* x, const double* u, double t, double* J);

/* A matrix of the plant, by one of its functions; null: zero. */
static const double* fmi_matrix(fmi_machine* m, unsigned bit, fmi_jacobian* function, double* values) {
    if (!function) return NULL;
    if (!(m->known & bit)) function(m->self, m->mode, m->x, m->u, m->t, values);
    m->known |= bit;
    return values;
}

static const double* fmi_by_state(fmi_machine* m) {
    if (!(m->known & fmi_has_by_state)) {
        m->plant->rhs_and_jacobian(m->self, m->mode, m->x, m->u, m->t, m->rates, m->by_state);
        if (m->plant->output_jacobian_x) m->plant->output_jacobian_x(m->self, m->mode, m->x, m->u, m->t, m->outputs_by_state);
        m->known |= fmi_has_by_state | fmi_has_rates;
    }
    return m->by_state;
}

static const double* fmi_by_input(fmi_machine* m) {
    if (!(m->known & fmi_has_by_input) && m->plant->output_jacobian_u)
        m->plant->output_jacobian_u(m->self, m->mode, m->x, m->u, m->t, m->outputs_by_input);
    return fmi_matrix(m, fmi_has_by_input, m->plant->jacobian_u, m->by_input);
}

/* Column `column` of a matrix in its pattern, written out. */
static void fmi_write_column(const double* values, const dalembert_pattern* pattern, size_t rows, size_t column, double* result) {
    for (size_t i = 0; i < rows; ++i) result[i] = 0.0;
    if (!values) return;
    if (!pattern || !pattern->column_starts) memcpy(result, values + column * rows, rows * sizeof(double));
    else
        for (size_t k = pattern->column_starts[column]; k < pattern->column_starts[column + 1]; ++k)
            result[pattern->row_indices[k]] = values[k];
}

/* Outputs by a parameter or the time where the plant does not have them: differences of fourth order, good to about 1e-11 of the outputs. */
static void fmi_differences(fmi_machine* m, size_t parameter, int is_time, double* result) {
    const dalembert_plant* plant = m->plant;
    double* p = m->work;
    double* y = p + plant->parameters;
    const double at = is_time ? m->t : m->p[parameter];
    const double h = 1e-3 * fmax(fabs(at), at == 0.0 ? 1.0 : 0.0);
    static const double places[4] = {-2.0, -1.0, 1.0, 2.0}, weights[4] = {1.0, -8.0, 8.0, -1.0};
    for (size_t i = 0; i < plant->outputs; ++i) result[i] = 0.0;
    if (!plant->output) return;
    memcpy(p, m->p, plant->parameters * sizeof(double));
    for (int k = 0; k < 4; ++k) {
        if (!is_time) {
            p[parameter] = at + places[k] * h;
            plant->set_parameters(m->self, p);
        }
        plant->output(m->self, m->mode, m->x, m->u, is_time ? at + places[k] * h : m->t, y);
        for (size_t i = 0; i < plant->outputs; ++i) result[i] += weights[k] * y[i] / (12.0 * h);
    }
    if (!is_time) plant->set_parameters(m->self, m->p);
}

/* Derivatives of all rates and outputs by one variable. False if there are none by it. */
static int fmi_column(fmi_machine* m, size_t reference, double* rates, double* outputs) {
    const dalembert_plant* plant = m->plant;
    const size_t n = plant->states;
    size_t at = 0;
    switch (fmi_find(m, reference, &at)) {
    case fmi_state:
        fmi_write_column(fmi_by_state(m), &plant->pattern_x, n, at, rates);
        fmi_write_column(plant->output_jacobian_x ? m->outputs_by_state : NULL, NULL, plant->outputs, at, outputs);
        return 1;
    case fmi_input:
        fmi_write_column(fmi_by_input(m), &plant->pattern_u, n, at, rates);
        fmi_write_column(plant->output_jacobian_u ? m->outputs_by_input : NULL, NULL, plant->outputs, at, outputs);
        return 1;
    case fmi_parameter:
        fmi_write_column(fmi_matrix(m, fmi_has_by_parameter, plant->jacobian_p, m->by_parameter), &plant->pattern_p, n, at, rates);
        if (plant->output_jacobian_p)
            fmi_write_column(fmi_matrix(m, fmi_has_outputs_by_parameter, plant->output_jacobian_p, m->outputs_by_parameter), NULL,
                             plant->outputs, at, outputs);
        else fmi_differences(m, at, 0, outputs);
        return 1;
    case fmi_time:
        fmi_write_column(fmi_matrix(m, fmi_has_by_time, plant->jacobian_t, m->by_time), NULL, n, 0, rates);
        if (plant->output_jacobian_t)
            fmi_write_column(fmi_matrix(m, fmi_has_outputs_by_time, plant->output_jacobian_t, m->outputs_by_time), NULL, plant->outputs, 0,
                             outputs);
        else fmi_differences(m, 0, 1, outputs);
        return 1;
    default: return 0;
    }
}

/* The place of an unknown in the vector of all rates and outputs; none if it has no derivatives. */
static size_t fmi_row(const fmi_machine* m, size_t reference) {
    size_t at = 0;
    const enum fmi_kind kind = fmi_find(m, reference, &at);
    return kind == fmi_derivative ? at : kind == fmi_output ? m->plant->states + at : DALEMBERT_NONE;
}

/* sensitivity = J seed, or where `is_adjoint` J' seed. */
static fmi_status fmi_differentiate(fmi_machine* m, int is_adjoint, const unsigned* unknowns, size_t unknown_count, const unsigned* knowns,
                                    size_t known_count, const double* seed, double* sensitivity, const char* function) {
    if (unknown_count == 0 || known_count == 0) return fmi_ok;
    if (!unknowns || !knowns || !seed || !sensitivity) return fmi_say_of(m, fmi_error, function, "an array is missing");
    const size_t n = m->plant->states, results = is_adjoint ? known_count : unknown_count;
    for (size_t i = 0; i < unknown_count; ++i)
        if (fmi_row(m, unknowns[i]) == DALEMBERT_NONE)
            return fmi_say_of(m, fmi_error, function, "an unknown is neither the derivative of a state nor an output");
    if (fmi_start(m, function) != fmi_ok) return fmi_error;
    double* rates = m->work + m->plant->parameters + m->plant->outputs; /* differences work before it */
    double* outputs = rates + n;
    for (size_t i = 0; i < results; ++i) sensitivity[i] = 0.0;
    for (size_t j = 0; j < known_count; ++j) {
        if (!fmi_column(m, knowns[j], rates, outputs))
            return fmi_say_of(m, fmi_error, function, "a known is neither a state, an input, a parameter nor the time");
        for (size_t i = 0; i < unknown_count; ++i) {
            const size_t row = fmi_row(m, unknowns[i]);
            const double entry = row < n ? rates[row] : outputs[row - n];
            if (is_adjoint) sensitivity[j] += entry * seed[i];
            else if (seed[j] != 0.0) sensitivity[i] += entry * seed[j];
        }
    }
    if (!fmi_are_finite(sensitivity, results)) return fmi_say_of(m, fmi_discard, function, "a derivative is infinite or not a number");
    return fmi_ok;
}

#endif
