/* SPDX-License-Identifier: BSL-1.0 */
/* Brings states back to constraints, by the smallest step in the metric of the mass matrix: integration uses only second derivatives,
 * and drifts away. */
#ifndef DALEMBERT_PROJECTION_H
#define DALEMBERT_PROJECTION_H

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "dalembert_plant.h"

#define DALEMBERT_NONE ((size_t)-1)

/* Numbers of `work` for dalembert_project(). */
static inline size_t dalembert_projection_room(const dalembert_plant* plant) {
    return plant->states + plant->constraints * (2 + plant->degrees) + plant->degrees;
}

static inline double dalembert_largest(size_t n, const double* values) {
    double result = 0;
    for (size_t i = 0; i < n; ++i)
        if (!(fabs(values[i]) <= result)) result = fabs(values[i]); /* what is no number stays */
    return result;
}

/* Newton's method for positions or rates. Stops where the residual shrinks no more; of a last step that made it larger nothing is left. */
static inline double dalembert_newton(const dalembert_plant* plant, const void* self, unsigned mode, double t, double* x, int is_rate,
                                      double* work) {
    const size_t m = plant->constraints, n = plant->degrees;
    double* const before = work;
    double* const residual = before + plant->states;
    double* const step = residual + m;
    void (*const value)(const void*, unsigned, const double*, double, double*) =
        is_rate ? plant->constraint_rates : plant->constraint_positions;
    value(self, mode, x, t, residual);
    double size = dalembert_largest(m, residual);
    for (int i = 0; i < (is_rate ? 3 : 10) && size > 0; ++i) {
        memcpy(before, x, plant->states * sizeof(double));
        plant->correction(self, mode, x, t, residual, step);
        if (is_rate)
            for (size_t j = 0; j < n; ++j) {
                double* const v = &x[plant->velocity_place + j];
                *v -= step[j];
                if (fabs(*v) < 2.2250738585072014e-308) *v = 0; /* below the smallest normal number steps change it no more */
            }
        else
            plant->move_back(self, x, step);
        value(self, mode, x, t, residual);
        const double now = dalembert_largest(m, residual);
        if (!(now < size)) {
            memcpy(x, before, plant->states * sizeof(double));
            break;
        }
        const int is_slow = now > size / 2;
        size = now;
        if (is_slow) break;
    }
    return size;
}

/* A constraint whose position or rate is not zero beside sum |A_ij q_j| or sum |A_ij v_j|, and beside half of the digits of a unit. */
static inline size_t dalembert_broken_constraint(const dalembert_plant* plant, const void* self, unsigned mode, double t, const double* x,
                                                 double* work) {
    const size_t m = plant->constraints, n = plant->degrees, velocities = plant->velocity_place;
    double* const f = work;
    double* const w = f + m;
    double* const A = w + m;
    plant->constraint_positions(self, mode, x, t, f);
    plant->constraint_rates(self, mode, x, t, w);
    plant->constraint_jacobian(self, mode, x, t, A);
    for (size_t i = 0; i < m; ++i) {
        double of_positions = 0, of_rates = 0;
        for (size_t j = 0; j < n; ++j) {
            of_rates += fabs(A[j * m + i] * x[velocities + j]);
            of_positions += velocities == n ? fabs(A[j * m + i] * x[j]) : fabs(A[j * m + i]); /* turned angles have no value */
        }
        if (!(fabs(f[i]) <= 1e-6 * (of_positions + 0.01)) || !(fabs(w[i]) <= 1e-6 * (of_rates + 0.01))) return i;
    }
    return DALEMBERT_NONE;
}

/* Brings x back to the constraints of the plant, and quaternions to the norm one; nothing where plant->is_projected is zero. Returns the
 * number of the constraint that cannot be met, or DALEMBERT_NONE. `work`: dalembert_projection_room() numbers. */
static inline size_t dalembert_project(const dalembert_plant* plant, const void* self, unsigned mode, double t, double* x, double* work) {
    if (!plant->is_projected) return DALEMBERT_NONE;
    memset(work, 0, plant->degrees * sizeof(double));
    plant->move_back(self, x, work);
    if (plant->constraints == 0) return DALEMBERT_NONE;
    const double position = dalembert_newton(plant, self, mode, t, x, 0, work);
    const double rate = dalembert_newton(plant, self, mode, t, x, 1, work);
    if (position <= 1e-10 && rate <= 1e-10) return DALEMBERT_NONE;
    return dalembert_broken_constraint(plant, self, mode, t, x, work);
}

#endif
