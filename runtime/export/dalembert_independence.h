/* SPDX-License-Identifier: BSL-1.0 */
/* How independent the constraints of a plant are at a state: the smallest pivot of A D^-1 A', where D is the diagonal of M, each row
 * beside its largest size so far. Constraints that follow from others everywhere do not count.
 *
 * note [choice]: Of constraints that follow from each other wherever they hold a plant solves for as many as are independent. Any choice
 * of them has singular positions of its own, where the machine has none. So at the beginning of a step a run compares it with the best
 * pivots that elimination finds there, and chooses anew where what the chosen rows span has become small beside those. Within a step the
 * choice stays. */
#ifndef DALEMBERT_INDEPENDENCE_H
#define DALEMBERT_INDEPENDENCE_H

#include "dalembert_run.h"

/* Whether a run looks for singular positions of its constraints. */
static inline int dalembert_has_measure(const dalembert_run* run) {
    return run->plant->modes == 0 && run->plant->is_projected && run->plant->constraints > 0;
}

/* Constraints that follow from others were left out of the equations: their residuals correct nothing. One that is dependent at the
 * start alone does later. */
static inline void dalembert_see_used(dalembert_run* run, const double* x, double t) {
    dalembert_inside* const in = run->inside;
    const size_t m = run->plant->constraints, n = run->plant->degrees;
    if (in->kept->looks == 20) return;
    ++in->kept->looks;
    for (size_t i = 0; i < m; ++i) {
        if (in->is_used[i]) continue;
        memset(in->pivots, 0, m * sizeof(double));
        in->pivots[i] = 1;
        run->plant->correction(run->self, 0, x, t, in->pivots, in->weighted);
        for (size_t j = 0; j < n; ++j) in->is_used[i] = in->is_used[i] || in->weighted[j] > 0 || in->weighted[j] < 0;
    }
}

/* A D^(-1/2), row by row, in in->weighted. */
static inline void dalembert_weigh_rows(dalembert_run* run, const double* x, double t) {
    const dalembert_plant* const p = run->plant;
    dalembert_inside* const in = run->inside;
    const size_t m = p->constraints, n = p->degrees;
    double* const A = in->weighted + m * n;
    double* const M = A + m * n;
    double heaviest = 0;
    p->constraint_jacobian(run->self, 0, x, t, A);
    p->mass_matrix(run->self, 0, x, t, M);
    for (size_t j = 0; j < n; ++j) heaviest = fmax(heaviest, fabs(M[j * n + j]));
    for (size_t j = 0; j < n; ++j) {
        const double weight = 1 / sqrt(fmax(fabs(M[j * n + j]), heaviest * DBL_EPSILON));
        for (size_t i = 0; i < m; ++i) in->weighted[i * n + j] = in->is_used[i] ? A[j * m + i] * weight : 0;
    }
}

/* Elimination with the largest pivot first; of those first that `comes_first` says (null: none). Destroys g; returns the rank. */
static inline size_t dalembert_eliminate(dalembert_run* run, double* g, const int* comes_first, double* values, size_t* order) {
    dalembert_inside* const in = run->inside;
    const size_t m = run->plant->constraints;
    size_t rank = 0;
    memset(in->is_done, 0, m);
    for (size_t step = 0; step < m; ++step) {
        size_t p = m;
        for (size_t i = 0; i < m; ++i) {
            if (in->is_done[i]) continue;
            const int is_first = comes_first != NULL && comes_first[i], is_other = p < m && comes_first != NULL && comes_first[p];
            if (p == m || (is_first == is_other ? g[i * m + i] > g[p * m + p] : is_first)) p = i;
        }
        const double pivot = g[p * m + p];
        in->is_done[p] = 1;
        order[step] = p;
        values[step] = pivot > 0 ? pivot : 0;
        if (pivot > 1e-10) ++rank;
        if (!(pivot > 0)) continue;
        for (size_t i = 0; i < m; ++i) {
            if (in->is_done[i]) continue;
            const double factor = g[i * m + p] / pivot;
            for (size_t k = 0; k < m; ++k)
                if (!in->is_done[k]) g[i * m + k] -= factor * g[p * m + k];
        }
    }
    return rank;
}

/* Whether the choice of constraints changes: what the chosen rows span has fallen to half of the best. */
static inline int dalembert_choose_constraints(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    const size_t m = run->plant->constraints;
    double of_best = 1, of_chosen = 1;
    for (size_t i = 0; i < in->kept->rank; ++i) of_best *= in->pivots[i], of_chosen *= in->pivots_of_chosen[i];
    if (!(of_chosen < of_best / 4)) return 0;
    memset(in->chosen, 0, m * sizeof(int));
    for (size_t i = 0; i < in->kept->rank; ++i) in->chosen[in->order[i]] = 1;
    run->plant->solve_for(run->self, in->chosen);
    return 1;
}

/* `learns`: the state is one of the motion. */
static inline dalembert_independence dalembert_measure(dalembert_run* run, const double* x, double t, int learns) {
    const dalembert_plant* const p = run->plant;
    dalembert_inside* const in = run->inside;
    const size_t m = p->constraints, n = p->degrees;
    const int chooses = p->constraint_rank > 0;
    double* const gram = in->gram;
    double* const copy = gram + m * m;
    double* const sizes = copy + m * m;
    dalembert_independence result = {1, DALEMBERT_NONE, 0, 0};
    if (!chooses && learns) dalembert_see_used(run, x, t);
    dalembert_weigh_rows(run, x, t);
    for (size_t i = 0; i < m; ++i)
        for (size_t k = 0; k <= i; ++k) {
            double sum = 0;
            for (size_t j = 0; j < n; ++j) sum += in->weighted[i * n + j] * in->weighted[k * n + j];
            gram[i * m + k] = gram[k * m + i] = sum;
        }
    for (size_t i = 0; i < m; ++i) sizes[i] = fmax(in->row_sizes[i], gram[i * m + i]);
    if (learns) memcpy(in->row_sizes, sizes, m * sizeof(double));
    for (size_t i = 0; i < m; ++i)
        for (size_t k = 0; k < m; ++k) gram[i * m + k] = sizes[i] > 0 && sizes[k] > 0 ? gram[i * m + k] / sqrt(sizes[i] * sizes[k]) : 0;
    memcpy(copy, gram, m * m * sizeof(double));
    const size_t rank = dalembert_eliminate(run, gram, chooses ? in->is_held : NULL, in->pivots, in->order);
    if (chooses) {
        in->kept->rank = p->constraint_rank;
        if (learns) {
            (void)dalembert_eliminate(run, copy, in->chosen, in->pivots_of_chosen, in->order_of_chosen);
            result.is_chosen_anew = dalembert_choose_constraints(run) != 0;
        }
    } else if (learns && rank > in->kept->rank) {
        in->kept->rank = rank;
    }
    result.rank = in->kept->rank;
    if (result.rank == 0) return result;
    result.value = sqrt(in->pivots[result.rank - 1]);
    result.constraint = in->order[result.rank - 1];
    return result;
}

#endif
