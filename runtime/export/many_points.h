/* SPDX-License-Identifier: BSL-1.0 */
/* Values of a plant at many points at once. A language that calls C slowly calls it once for all of them. */
#ifndef MANY_POINTS_H
#define MANY_POINTS_H

#include <math.h>

#include "dalembert_plant.h"

/* Points in arrays. The distance from one point to the next in an array is its `step`: 0 if all points share the first one. */
typedef struct dalembert_points {
    size_t count;
    const unsigned* mode;
    size_t mode_step;
    const double* x;
    size_t x_step;
    const double* u;
    size_t u_step;
    const double* t;
    size_t t_step;
} dalembert_points;

enum dalembert_value {
    dalembert_value_rhs,
    dalembert_value_jacobian_x, /* with the rates before each matrix: states + stored entries numbers a point */
    dalembert_value_jacobian_u,
    dalembert_value_jacobian_p,
    dalembert_value_jacobian_t,
    dalembert_value_output,
    dalembert_value_output_jacobian_x,
    dalembert_value_output_jacobian_u,
    dalembert_value_output_jacobian_p,
    dalembert_value_output_jacobian_t,
    dalembert_value_mass_matrix,
    dalembert_value_energies, /* kinetic, potential, internal */
    dalembert_value_powers,   /* supplied, dissipated, prescribed, exchanged */
    dalembert_value_guards,   /* of a plant with modes: of its events */
    dalembert_value_guard_rates,
    dalembert_value_kinks,
    dalembert_value_holds, /* 1 or 0 */
    dalembert_value_constraint_positions,
    dalembert_value_constraint_rates,
    dalembert_value_constraint_jacobian,
    dalembert_values
};

/* Stored entries of a matrix. */
static inline size_t dalembert_entries(const dalembert_pattern* pattern, size_t rows, size_t columns) {
    return pattern->column_starts != NULL ? pattern->column_starts[columns] : rows * columns;
}

/* Numbers that a value has at one point. */
static inline size_t dalembert_value_size(const dalembert_plant* plant, enum dalembert_value value) {
    const size_t n = plant->states;
    switch (value) {
        case dalembert_value_rhs:
        case dalembert_value_jacobian_t:
            return n;
        case dalembert_value_jacobian_x:
            return n + dalembert_entries(&plant->pattern_x, n, n);
        case dalembert_value_jacobian_u:
            return dalembert_entries(&plant->pattern_u, n, plant->inputs);
        case dalembert_value_jacobian_p:
            return dalembert_entries(&plant->pattern_p, n, plant->parameters);
        case dalembert_value_output:
        case dalembert_value_output_jacobian_t:
            return plant->outputs;
        case dalembert_value_output_jacobian_x:
            return plant->outputs * n;
        case dalembert_value_output_jacobian_u:
            return plant->outputs * plant->inputs;
        case dalembert_value_output_jacobian_p:
            return plant->outputs * plant->parameters;
        case dalembert_value_mass_matrix:
            return plant->degrees * plant->degrees;
        case dalembert_value_energies:
            return 3;
        case dalembert_value_powers:
            return 4;
        case dalembert_value_guards:
        case dalembert_value_guard_rates:
            return plant->modes > 0 ? plant->events : plant->guards;
        case dalembert_value_kinks:
            return plant->kinks;
        case dalembert_value_holds:
            return 1;
        case dalembert_value_constraint_positions:
        case dalembert_value_constraint_rates:
            return plant->constraints;
        case dalembert_value_constraint_jacobian:
            return plant->constraints * plant->degrees;
        case dalembert_values:
            break;
    }
    return 0;
}

/* Whether the plant has the function; if not, the value is zero, or the plant does not know it: see plant.h. */
static inline int dalembert_has_value(const dalembert_plant* plant, enum dalembert_value value) {
    switch (value) {
        case dalembert_value_jacobian_u:
            return plant->jacobian_u != NULL;
        case dalembert_value_jacobian_p:
            return plant->jacobian_p != NULL;
        case dalembert_value_jacobian_t:
            return plant->jacobian_t != NULL;
        case dalembert_value_output:
            return plant->output != NULL;
        case dalembert_value_output_jacobian_x:
            return plant->output_jacobian_x != NULL;
        case dalembert_value_output_jacobian_u:
            return plant->output_jacobian_u != NULL;
        case dalembert_value_output_jacobian_p:
            return plant->output_jacobian_p != NULL || plant->outputs == 0;
        case dalembert_value_output_jacobian_t:
            return plant->output_jacobian_t != NULL || plant->outputs == 0;
        case dalembert_value_mass_matrix:
            return plant->mass_matrix != NULL;
        case dalembert_value_guards:
            return plant->guard_values != NULL;
        case dalembert_value_guard_rates:
            return plant->guard_rates != NULL;
        case dalembert_value_kinks:
            return plant->kink_values != NULL;
        case dalembert_value_constraint_positions:
            return plant->constraint_positions != NULL;
        case dalembert_value_constraint_rates:
            return plant->constraint_rates != NULL;
        case dalembert_value_constraint_jacobian:
            return plant->constraint_jacobian != NULL;
        default:
            return 1;
    }
}

#define DALEMBERT_EACH(call)                               \
    for (i = 0; i < at->count; ++i) {                      \
        const unsigned mode = at->mode[i * at->mode_step]; \
        const double* const x = at->x + i * at->x_step;    \
        const double* const u = at->u + i * at->u_step;    \
        const double t = at->t[i * at->t_step];            \
        double* const y = result + i * size;               \
        (void)mode;                                        \
        (void)u;                                           \
        (void)t;                                           \
        call;                                              \
    }

/* Writes the value at every point, one after the other. Values that the plant does not have are zero; `holds` is 1 then. Guards, their
 * rates and kinks that are not watched in a mode are no number. */
static inline void dalembert_many(const dalembert_plant* plant, const void* self, enum dalembert_value value, const dalembert_points* at,
                                  double* result) {
    const size_t size = dalembert_value_size(plant, value);
    const size_t n = plant->states;
    size_t i;
    if (!dalembert_has_value(plant, value)) {
        for (i = 0; i < at->count * size; ++i) result[i] = 0;
        return;
    }
    if (value == dalembert_value_guards || value == dalembert_value_guard_rates || value == dalembert_value_kinks)
        for (i = 0; i < at->count * size; ++i) result[i] = (double)NAN;
    switch (value) {
        case dalembert_value_rhs:
            DALEMBERT_EACH(plant->rhs(self, mode, x, u, t, y)) break;
        case dalembert_value_jacobian_x:
            DALEMBERT_EACH(plant->rhs_and_jacobian(self, mode, x, u, t, y, y + n)) break;
        case dalembert_value_jacobian_u:
            DALEMBERT_EACH(plant->jacobian_u(self, mode, x, u, t, y)) break;
        case dalembert_value_jacobian_p:
            DALEMBERT_EACH(plant->jacobian_p(self, mode, x, u, t, y)) break;
        case dalembert_value_jacobian_t:
            DALEMBERT_EACH(plant->jacobian_t(self, mode, x, u, t, y)) break;
        case dalembert_value_output:
            DALEMBERT_EACH(plant->output(self, mode, x, u, t, y)) break;
        case dalembert_value_output_jacobian_x:
            DALEMBERT_EACH(plant->output_jacobian_x(self, mode, x, u, t, y)) break;
        case dalembert_value_output_jacobian_u:
            DALEMBERT_EACH(plant->output_jacobian_u(self, mode, x, u, t, y)) break;
        case dalembert_value_output_jacobian_p:
            if (size > 0) DALEMBERT_EACH(plant->output_jacobian_p(self, mode, x, u, t, y))
            break;
        case dalembert_value_output_jacobian_t:
            if (size > 0) DALEMBERT_EACH(plant->output_jacobian_t(self, mode, x, u, t, y))
            break;
        case dalembert_value_mass_matrix:
            DALEMBERT_EACH(plant->mass_matrix(self, mode, x, t, y)) break;
        case dalembert_value_energies:
            DALEMBERT_EACH(y[0] = plant->kinetic_energy != NULL ? plant->kinetic_energy(self, mode, x, t) : 0;
                           y[1] = plant->potential_energy != NULL ? plant->potential_energy(self, mode, x, t) : 0;
                           y[2] = plant->internal_energy != NULL ? plant->internal_energy(self, mode, x, t) : 0)
            break;
        case dalembert_value_powers:
            DALEMBERT_EACH(y[0] = plant->supplied_power != NULL ? plant->supplied_power(self, mode, x, u, t) : 0;
                           y[1] = plant->dissipated_power != NULL ? plant->dissipated_power(self, mode, x, u, t) : 0;
                           y[2] = plant->prescribed_power != NULL ? plant->prescribed_power(self, mode, x, u, t) : 0;
                           y[3] = plant->exchanged_power != NULL ? plant->exchanged_power(self, mode, x, u, t) : 0)
            break;
        case dalembert_value_guards:
            DALEMBERT_EACH(plant->guard_values(self, mode, x, u, t, y)) break;
        case dalembert_value_guard_rates:
            DALEMBERT_EACH(plant->guard_rates(self, mode, x, u, t, y)) break;
        case dalembert_value_kinks:
            DALEMBERT_EACH(plant->kink_values(self, mode, x, u, t, y)) break;
        case dalembert_value_holds:
            DALEMBERT_EACH(y[0] = plant->holds == NULL || plant->holds(self, mode, x, u, t)) break;
        case dalembert_value_constraint_positions:
            DALEMBERT_EACH(plant->constraint_positions(self, mode, x, t, y)) break;
        case dalembert_value_constraint_rates:
            DALEMBERT_EACH(plant->constraint_rates(self, mode, x, t, y)) break;
        case dalembert_value_constraint_jacobian:
            DALEMBERT_EACH(plant->constraint_jacobian(self, mode, x, t, y)) break;
        case dalembert_values:
            break;
    }
}

#undef DALEMBERT_EACH

#endif
