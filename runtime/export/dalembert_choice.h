/* SPDX-License-Identifier: BSL-1.0 */
/* Which method makes the next steps: explicit as long as accuracy decides how long they may be, Rodas5P where stability would. */
#ifndef DALEMBERT_CHOICE_H
#define DALEMBERT_CHOICE_H

#include "dalembert_rodas5p.h"

static inline double dalembert_normalise(size_t n, double* v, const double* size) {
    double norm = 0;
    for (size_t i = 0; i < n; ++i)
        if (!(fabs(v[i]) / size[i] <= norm)) norm = fabs(v[i]) / size[i];
    for (size_t i = 0; norm > 0 && i < n; ++i) v[i] /= norm;
    return norm;
}

static inline double dalembert_grow(dalembert_inside* in, const double* size) {
    const dalembert_band* const J = &in->J;
    memset(in->other, 0, J->n * sizeof(double));
    for (size_t c = 0; c < J->n; ++c)
        for (size_t r = dalembert_band_begin(J, c); r < dalembert_band_end(J, c); ++r)
            in->other[r] += J->entries[dalembert_band_place(J, r, c)] * in->radius[c];
    memcpy(in->radius, in->other, J->n * sizeof(double));
    return dalembert_normalise(J->n, in->radius, size);
}

/* The magnitude of the largest eigenvalue of the Jacobian by the power method. Its vector stays from one call to the next, as the
 * Jacobian changes little in between. Not a number if the Jacobian is not finite. */
static inline double dalembert_spectral_radius(dalembert_inside* in, const double* size) {
    double growth = 0;
    /* Of two complex conjugate eigenvalues the growth of one product swings about their magnitude; that of two does so less. */
    for (int k = in->kept->is_radius_begun ? 4 : 16; k > 0; k -= 2) {
        if (!in->kept->is_radius_begun) {
            for (size_t i = 0; i < in->J.n; ++i) in->radius[i] = size[i] / (double)(1 + i * 7 % 11) * (i % 3 == 1 ? -1 : 1);
            (void)dalembert_normalise(in->J.n, in->radius, size);
        }
        const double one = dalembert_grow(in, size);
        const double two = one > 0 || isnan(one) ? dalembert_grow(in, size) : one;
        growth = sqrt(one * two);
        in->kept->is_radius_begun = growth > 0; /* false also for what is no number: the next one begins anew */
        if (!in->kept->is_radius_begun) break;
    }
    return growth;
}

/* How many explicit steps cost as much as an implicit one: four, or more where linear systems are what takes the time. Entries of a
 * Jacobian tell how long the right-hand side is: some eight operations each. */
static inline double dalembert_explicit_steps_for_one(const dalembert_run* run) {
    const dalembert_band* const J = &run->inside->J;
    const double n = (double)J->n, lower = (double)J->lower, width = (double)(J->lower + J->upper);
    const int is_full = 2 * (2 * J->lower + J->upper + 1) > J->n;
    const size_t* const starts = run->plant->pattern_x.column_starts;
    const double entries = starts != NULL ? (double)starts[J->n] : n * n;
    const double systems = (is_full ? n * n * (n / 3 + 8) : n * (lower * width + 8 * (lower + width))) / (8 * (entries + 1));
    return fmax(4, (16 + systems) / 6);
}

/* How long a step of the explicit method may be, times the spectral radius, to be stable on the negative real axis; a little less. */
static const double dalembert_stable_reach = 5;

static inline void dalembert_take_up(dalembert_run* run, int is_implicit) {
    run->inside->kept->is_implicit = is_implicit;
    run->inside->kept->stint = 0;
    run->inside->kept->often = 0;
}

/* Looks back at a window of steps. */
static inline void dalembert_weigh(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    dalembert_prepare_jacobian(run, run->x, run->t);
    for (size_t i = 0; i < run->plant->states; ++i) in->difference[i] = fmax(run->scale[i], fabs(run->x[i]));
    const double reach = k->longest * dalembert_spectral_radius(in, in->difference), dear = dalembert_explicit_steps_for_one(run);
    if (!k->is_implicit) {
        k->often = reach > dalembert_stable_reach ? k->often + 1 : 0;
        const double pace = (run->t - k->window_begin) / (double)k->tried;
        if (k->often >= k->patience || (k->often > 1 && 8 * pace < k->implicit_pace)) dalembert_take_up(run, 1);
    } else {
        /* Where an implicit step is not worth what it costs, it is not tried again so soon. */
        k->often = reach > dear * dalembert_stable_reach ? 0 : k->often + 1;
        if (k->often < 2) return;
        if (reach > dalembert_stable_reach) k->patience = k->patience < 250 ? 4 * k->patience : 1000;
        k->implicit_pace = (run->t - k->stint_begin) / ((double)k->stint * dear);
        dalembert_take_up(run, 0);
    }
}

/* Before a step is tried. */
static inline void dalembert_choose_method(dalembert_run* run) {
    dalembert_run_memory* const k = run->inside->kept;
    if (run->options.method != dalembert_automatic || !run->inside->has_matrix) {
        k->is_implicit = run->options.method == dalembert_rosenbrock;
        return;
    }
    if (k->tried == 8) {
        if (k->accepted > 0) dalembert_weigh(run);
        k->tried = k->accepted = 0;
        k->longest = 0;
    }
    if (k->tried == 0) k->window_begin = run->t;
    if (k->stint == 0) k->stint_begin = run->t;
    ++k->tried;
    ++k->stint;
}

#endif
