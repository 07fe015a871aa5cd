/* SPDX-License-Identifier: BSL-1.0 */
/* What the Rosenbrock method needs of a plant: its Jacobian with that of the inputs, in a matrix that is a band, and LU factors of such
 * a matrix with row exchanges (Golub, Van Loan: Matrix Computations, 4th edition, section 4.3). A full matrix is a band as wide as
 * itself. */
#ifndef DALEMBERT_JACOBIAN_H
#define DALEMBERT_JACOBIAN_H

#include "dalembert_run.h"

static inline size_t dalembert_band_above(const dalembert_band* m) { return m->is_factored ? m->lower + m->upper : m->upper; }
static inline size_t dalembert_band_height(const dalembert_band* m) { return dalembert_band_above(m) + m->lower + 1; }
/* Where an entry stands. */
static inline size_t dalembert_band_place(const dalembert_band* m, size_t row, size_t column) {
    return column * dalembert_band_height(m) + (dalembert_band_above(m) + row - column);
}
static inline double* dalembert_band_at(const dalembert_band* m, size_t row, size_t column) {
    return m->entries + dalembert_band_place(m, row, column);
}
/* Rows of a column, of which the last is the one before the end. */
static inline size_t dalembert_band_begin(const dalembert_band* m, size_t column) { return column > m->upper ? column - m->upper : 0; }
static inline size_t dalembert_band_reach(const dalembert_band* m, size_t k, size_t reach) {
    return k + reach + 1 < m->n ? k + reach + 1 : m->n;
}
static inline size_t dalembert_band_end(const dalembert_band* m, size_t column) { return dalembert_band_reach(m, column, m->lower); }

/* How far the entries of the Jacobian reach from the diagonal. */
static inline void dalembert_find_band(const dalembert_plant* plant, dalembert_band* m) {
    m->n = plant->states;
    m->lower = m->upper = m->n > 0 ? m->n - 1 : 0;
    if (plant->pattern_x.column_starts == NULL) return;
    m->lower = m->upper = 0;
    for (size_t c = 0; c < m->n; ++c)
        for (size_t k = plant->pattern_x.column_starts[c]; k < plant->pattern_x.column_starts[c + 1]; ++k) {
            const size_t r = plant->pattern_x.row_indices[k];
            if (r > c && r - c > m->lower) m->lower = r - c;
            if (c > r && c - r > m->upper) m->upper = c - r;
        }
}

/* 1/pivot in its place. False for a pivot that is zero or not finite, or whose inverse is not. */
static inline int dalembert_invert_pivot(double* pivot) {
    const int is_number = isfinite(*pivot) && (*pivot > 0 || *pivot < 0);
    *pivot = 1 / *pivot;
    return is_number && isfinite(*pivot);
}

/* Without row exchanges, so that what does not move keeps its value exactly. False where too many digits of a pivot cancel. */
static inline int dalembert_band_factor_straight(dalembert_band* m) {
    for (size_t k = 0; k < m->n; ++k) m->sizes[k] = fabs(m->entries[dalembert_band_place(m, k, k)]);
    for (size_t k = 0; k < m->n; ++k) {
        double* const column = dalembert_band_at(m, k, k);
        const size_t below = dalembert_band_reach(m, k, m->lower) - k, last_column = dalembert_band_reach(m, k, m->upper);
        m->exchanges[k] = k;
        if (!(fabs(*column) > sqrt(DBL_EPSILON) * m->sizes[k]) || !dalembert_invert_pivot(column)) return 0;
        for (size_t r = 1; r < below; ++r) column[r] *= column[0];
        for (size_t c = k + 1; c < last_column; ++c) {
            double* const other = dalembert_band_at(m, k, c);
            const double factor = other[0];
            if (!(factor > 0 || factor < 0 || isnan(factor))) continue;
            for (size_t r = 1; r < below; ++r) other[r] -= column[r] * factor;
            if (c - k < below) m->sizes[c] += fabs(column[c - k] * factor);
        }
    }
    return 1;
}

/* With row exchanges. L stays where it was made: its rows are exchanged while solving. */
static inline int dalembert_band_factor(dalembert_band* m) {
    size_t last_column = 0; /* that a row of U reaches so far */
    for (size_t k = 0; k < m->n; ++k) {
        const size_t last_row = dalembert_band_reach(m, k, m->lower), below = last_row - k;
        size_t pivot = k;
        for (size_t r = k + 1; r < last_row; ++r)
            if (fabs(m->entries[dalembert_band_place(m, r, k)]) > fabs(m->entries[dalembert_band_place(m, pivot, k)])) pivot = r;
        m->exchanges[k] = pivot;
        if (dalembert_band_reach(m, pivot, m->upper) > last_column) last_column = dalembert_band_reach(m, pivot, m->upper);
        for (size_t c = k; pivot != k && c < last_column; ++c) {
            const double other = m->entries[dalembert_band_place(m, k, c)];
            m->entries[dalembert_band_place(m, k, c)] = m->entries[dalembert_band_place(m, pivot, c)];
            m->entries[dalembert_band_place(m, pivot, c)] = other;
        }
        double* const column = dalembert_band_at(m, k, k);
        if (!dalembert_invert_pivot(column)) return 0;
        for (size_t r = 1; r < below; ++r) column[r] *= column[0];
        for (size_t c = k + 1; c < last_column; ++c) {
            double* const other = dalembert_band_at(m, k, c);
            const double factor = other[0];
            for (size_t r = 1; r < below; ++r) other[r] -= column[r] * factor;
        }
    }
    return 1;
}

/* Solves A x = b in place. */
static inline void dalembert_band_solve(const dalembert_band* m, double* b) {
    for (size_t k = 0; k < m->n; ++k) {
        const double value = b[m->exchanges[k]];
        b[m->exchanges[k]] = b[k];
        b[k] = value;
        const double* const column = dalembert_band_at(m, k, k);
        for (size_t r = k + 1; r < dalembert_band_end(m, k); ++r) b[r] -= column[r - k] * value;
    }
    for (size_t k = m->n; k-- > 0;) {
        const double* const column = dalembert_band_at(m, k, k);
        b[k] *= column[0];
        const size_t above = m->lower + m->upper;
        for (size_t r = k > above ? k - above : 0; r < k; ++r) b[r] -= m->entries[dalembert_band_place(m, r, k)] * b[k];
    }
}

static inline void dalembert_add_entry(dalembert_band* m, size_t row, size_t column, double value) {
    if (row <= column + m->lower && column <= row + m->upper) m->entries[dalembert_band_place(m, row, column)] += value;
}

/* Adds du/dx, by central differences; what lies outside the band is left out, which costs steps, not accuracy. */
static inline void dalembert_add_feedback(dalembert_run* run, double t) {
    const dalembert_plant* const plant = run->plant;
    dalembert_inside* const in = run->inside;
    const size_t n = plant->states, count = plant->inputs;
    double* const x = in->other;
    double* const d = in->difference; /* central differences lose a third of the digits */
    for (size_t i = 0; i < n; ++i) {
        d[i] = cbrt(DBL_EPSILON) * fmax(run->scale[i], fabs(in->prepared_x[i]));
        x[i] = in->prepared_x[i] + d[i] / (double)(1 + i * 7 % 11);
    }
    dalembert_inputs_at(&in->modes, t, x, in->u_ahead);
    if (memcmp(in->u_ahead, in->prepared_u, count * sizeof(double)) == 0) return;
    memcpy(x, in->prepared_x, n * sizeof(double));
    for (size_t i = 0; i < n; ++i) {
        x[i] = in->prepared_x[i] + d[i];
        dalembert_inputs_at(&in->modes, t, x, in->u_ahead);
        x[i] = in->prepared_x[i] - d[i];
        dalembert_inputs_at(&in->modes, t, x, in->u_behind);
        x[i] = in->prepared_x[i];
        for (size_t j = 0; j < count; ++j) {
            const double gain = (in->u_ahead[j] - in->u_behind[j]) / (2 * d[i]);
            if (!(gain > 0 || gain < 0)) continue;
            const size_t* const starts = plant->pattern_u.column_starts;
            for (size_t k = starts ? starts[j] : j * n; k < (starts ? starts[j + 1] : (j + 1) * n); ++k)
                dalembert_add_entry(&in->J, starts ? plant->pattern_u.row_indices[k] : k % n, i, in->J_u[k] * gain);
        }
    }
}

/* J at (x, t). Events repeat steps from one point, and the end of a step is the next start: it is computed there once. */
static inline void dalembert_prepare_jacobian(dalembert_run* run, const double* x, double t) {
    const dalembert_plant* const plant = run->plant;
    dalembert_inside* const in = run->inside;
    const size_t n = plant->states;
    if (in->is_prepared && !(t < in->prepared_t || t > in->prepared_t) && memcmp(x, in->prepared_x, n * sizeof(double)) == 0) return;
    ++run->jacobians;
    in->is_prepared = 1;
    in->prepared_t = t;
    memcpy(in->prepared_x, x, n * sizeof(double));
    dalembert_inputs_at(&in->modes, t, x, in->prepared_u);
    plant->rhs_and_jacobian(run->self, in->modes.mode, x, in->prepared_u, t, in->other, in->J_values);
    memset(in->J.entries, 0, n * dalembert_band_height(&in->J) * sizeof(double));
    const size_t* const starts = plant->pattern_x.column_starts;
    for (size_t c = 0; c < n; ++c)
        for (size_t k = starts ? starts[c] : c * n; k < (starts ? starts[c + 1] : (c + 1) * n); ++k)
            in->J.entries[dalembert_band_place(&in->J, starts ? plant->pattern_x.row_indices[k] : k % n, c)] += in->J_values[k];
    if (plant->jacobian_u == NULL || plant->inputs == 0 || run->inputs.function == NULL) return;
    plant->jacobian_u(run->self, in->modes.mode, x, in->prepared_u, t, in->J_u);
    dalembert_add_feedback(run, t);
}

/* df/dt at the point of the Jacobian, for a step of this length. For du/dt: the derivative of the polynomial of degree 4 through equal
 * parts of the step. It looks no further than the step does, and is exact for inputs that rest. */
static inline void dalembert_time_derivative(dalembert_run* run, double t, double length, double* dfdt) {
    static const double weights[] = {48, -36, 16, -3};
    const dalembert_plant* const plant = run->plant;
    dalembert_inside* const in = run->inside;
    const size_t n = plant->states;
    if (plant->jacobian_t != NULL)
        plant->jacobian_t(run->self, in->modes.mode, in->prepared_x, in->prepared_u, t, dfdt);
    else
        memset(dfdt, 0, n * sizeof(double));
    if (plant->jacobian_u == NULL || plant->inputs == 0 || run->inputs.function == NULL) return;
    memset(in->u_behind, 0, plant->inputs * sizeof(double));
    for (int k = 1; k <= 4; ++k) {
        dalembert_inputs_at(&in->modes, t + length * (k / 4.0), in->prepared_x, in->u_ahead);
        for (size_t j = 0; j < plant->inputs; ++j) in->u_behind[j] += weights[k - 1] * (in->u_ahead[j] - in->prepared_u[j]);
    }
    const size_t* const starts = plant->pattern_u.column_starts;
    for (size_t j = 0; j < plant->inputs; ++j) {
        const double slope = in->u_behind[j] / (3 * length);
        if (!(slope > 0 || slope < 0)) continue;
        for (size_t k = starts ? starts[j] : j * n; k < (starts ? starts[j + 1] : (j + 1) * n); ++k)
            dfdt[starts ? plant->pattern_u.row_indices[k] : k % n] += in->J_u[k] * slope;
    }
}

#endif
