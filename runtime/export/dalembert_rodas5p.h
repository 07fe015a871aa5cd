/* SPDX-License-Identifier: BSL-1.0 */
/* Rodas5P, a Rosenbrock method for stiff plants: Steinebach: Construction of Rosenbrock-Wanner method Rodas5P and numerical benchmarks
 * within the Julia Differential Equations package, BIT Numerical Mathematics 63 (2023), article 27. Order 5 with one of order 4 in it, 8
 * stages, L-stable, stiffly accurate, dense output of order 4. In the form without products with the Jacobian (Hairer, Wanner: Solving
 * Ordinary Differential Equations II, section IV.7): with W = 1/(h gamma) - J the stages are W u_i = f(t + time_i h, x + sum a_ij u_j) +
 * sum c_ij/h u_j + gradient_i h df/dt, and y = (the last stage's state) + u_8, of which u_8 is the error. */
#ifndef DALEMBERT_RODAS5P_H
#define DALEMBERT_RODAS5P_H

#include "dalembert_control.h"
#include "dalembert_jacobian.h"

static const double dalembert_rodas5p_gamma = 0.21193756319429014;
/* Of the stages' states. A stage from the seventh on adds the increment before it to the state of that; so does the result. */
static const double dalembert_rodas5p_a[6][5] = {
    {0},
    {3.0},
    {2.849394379747939, 0.45842242204463923},
    {-6.954028509809101, 2.489845061869568, -10.358996098473584},
    {2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641},
    {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946},
};
static const double dalembert_rodas5p_c[8][7] = {
    {0},
    {-14.155112264123755},
    {-17.97296035885952, -2.859693295451294},
    {147.12150275711716, -1.41221402718213, 71.68940251302358},
    {165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306},
    {24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471},
    {30.91273214028599, -3.1208243349937974, 77.79954646070892, 34.28646028294783, -19.097331116725623, -28.087943162872662},
    {37.80277123390563, -3.2571969029072276, 112.26918849496327, 66.9347231244047, -40.06618937091002, -54.66780262877968,
     -9.48861652309627},
};
/* Of the stages' times, and of df/dt. */
static const double dalembert_rodas5p_times[8] = {0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716, 0.4288403609558664, 1, 1,
                                                  1};
static const double dalembert_rodas5p_gradient[8] = {
    0.21193756319429014, -0.42387512638858027, -0.3384627126235924, 1.8046452872882734, 2.325825639765069, 0, 0, 0};
/* Of the dense output x + s (y - x + (1 - s) (d[0] + s (d[1] + s d[2]))), s from 0 to 1. */
static const double dalembert_rodas5p_dense[3][8] = {
    {25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204, 0.524948541321073, 1.1241088310450404,
     0.4272876194431874, -0.17202221070155493},
    {-9.91568850695171, -0.9689944594115154, 3.0438037242978453, -24.495224566215796, 20.176138334709044, 15.98066361424651,
     -6.789040303419874, -6.710236069923372},
    {11.419903575922262, 2.8879645146136994, 72.92137995996029, 80.12511834622643, -52.072871366152654, -59.78993625266729,
     -0.15582684282751913, 4.883087185713722},
};

/* W = 1/(length gamma) - J without infinite entries; false where there are such. */
static inline int dalembert_rodas5p_fill(dalembert_inside* in, double length) {
    int is_finite = 1;
    memset(in->W.entries, 0, in->W.n * dalembert_band_height(&in->W) * sizeof(double));
    for (size_t c = 0; c < in->W.n; ++c) {
        for (size_t r = dalembert_band_begin(&in->W, c); r < dalembert_band_end(&in->W, c); ++r) {
            const double entry = in->J.entries[dalembert_band_place(&in->J, r, c)];
            is_finite = is_finite && !isinf(entry);
            in->W.entries[dalembert_band_place(&in->W, r, c)] = isinf(entry) ? 0 : -entry;
        }
        in->W.entries[dalembert_band_place(&in->W, c, c)] += 1 / (length * dalembert_rodas5p_gamma);
    }
    return is_finite;
}

/* LU factors of W, with row exchanges if need be; false where it is not regular, or `must_be_finite` and entries are infinite. */
static inline int dalembert_rodas5p_solves(dalembert_inside* in, double length, int must_be_finite) {
    if (!dalembert_rodas5p_fill(in, length) && must_be_finite) return 0;
    if (dalembert_band_factor_straight(&in->W)) return 1;
    (void)dalembert_rodas5p_fill(in, length);
    return dalembert_band_factor(&in->W);
}

static inline int dalembert_rodas5p_factor(dalembert_run* run, const dalembert_point* from, double length) {
    dalembert_inside* const in = run->inside;
    dalembert_prepare_jacobian(run, from->x, from->t);
    if (dalembert_rodas5p_solves(in, length, 1)) return 1;
    /* A flow like a root at balance has an infinite slope: one a little further on serves, with short steps, or in very short ones none. */
    for (size_t i = 0; i < in->W.n; ++i) in->stage[i] = from->x[i] + length * from->dxdt[i];
    dalembert_prepare_jacobian(run, in->stage, from->t + length);
    return dalembert_rodas5p_solves(in, length, 0);
}

static inline void dalembert_rodas5p_take(dalembert_run* run, const dalembert_point* from, dalembert_candidate* c) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    c->has_derivative = 0;
    c->is_finite = 0;
    if (!dalembert_rodas5p_factor(run, from, c->length)) {
        for (size_t r = 0; r < n; ++r) c->y[r] = from->x[r], c->error[r] = 0, c->dydt[r] = 0;
        return;
    }
    dalembert_time_derivative(run, from->t, c->length, in->dfdt);
    const double rate = 1 / c->length;
    memcpy(c->y, from->x, n * sizeof(double));
    memcpy(c->dydt, from->dxdt, n * sizeof(double));
    for (int i = 0; i < 8; ++i) {
        double* const u = in->k[i];
        if (i > 5) {
            for (size_t r = 0; r < n; ++r) c->y[r] += in->k[i - 1][r];
        } else if (i > 0) {
            memcpy(c->y, from->x, n * sizeof(double));
            for (int j = 0; j < i; ++j)
                for (size_t r = 0; r < n; ++r) c->y[r] += dalembert_rodas5p_a[i][j] * in->k[j][r];
        }
        if (i > 0) dalembert_rate(run, c->y, i > 4 ? c->end : from->t + dalembert_rodas5p_times[i] * c->length, c->dydt);
        memcpy(u, c->dydt, n * sizeof(double));
        for (int j = 0; j < i; ++j)
            for (size_t r = 0; r < n; ++r) u[r] += rate * dalembert_rodas5p_c[i][j] * in->k[j][r];
        if (i < 5)
            for (size_t r = 0; r < n; ++r) u[r] += dalembert_rodas5p_gradient[i] * c->length * in->dfdt[r];
        dalembert_band_solve(&in->W, u);
    }
    for (size_t r = 0; r < n; ++r) c->y[r] += in->k[7][r];
    memcpy(c->error, in->k[7], n * sizeof(double));
    if (!dalembert_all_finite(n, c->y) || !dalembert_all_finite(n, c->error)) return;
    dalembert_rate(run, c->y, c->end, c->dydt);
    c->has_derivative = 1;
    c->is_finite = dalembert_all_finite(n, c->dydt);
}

/* The estimate of the error is that of the Jacobian at the start. Where that is much larger than at the end, as for a flow like a root
 * that leaves balance, every increment is small, and so is the estimate. There the rate at the end does not fit the step, by more than
 * the Jacobian at the end allows for. */
static inline void dalembert_rodas5p_check(dalembert_run* run, const dalembert_point* from, dalembert_candidate* c) {
    dalembert_inside* const in = run->inside;
    dalembert_prepare_jacobian(run, c->y, c->end);
    const double rate = 1 / c->length;
    for (size_t r = 0; r < in->J.n; ++r) {
        double slope = c->y[r] - from->x[r];
        for (int j = 0; j < 8; ++j)
            slope -= (dalembert_rodas5p_dense[0][j] + dalembert_rodas5p_dense[1][j] + dalembert_rodas5p_dense[2][j]) * in->k[j][r];
        const double diagonal = in->J.entries[dalembert_band_place(&in->J, r, r)];
        const double unfit = fabs(c->dydt[r] - rate * slope) / (rate / dalembert_rodas5p_gamma + fabs(diagonal));
        if (unfit > 20 * fabs(c->error[r])) c->error[r] = unfit / 20;
    }
}

static inline void dalembert_rodas5p_between(dalembert_run* run, const dalembert_point* from, const dalembert_candidate* c, double t,
                                             double* x) {
    const dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    const double s = (t - from->t) / c->length;
    for (size_t r = 0; r < n; ++r) x[r] = from->x[r] + s * (c->y[r] - from->x[r]);
    for (int j = 0; j < 8; ++j) {
        const double d = dalembert_rodas5p_dense[0][j] + s * (dalembert_rodas5p_dense[1][j] + s * dalembert_rodas5p_dense[2][j]);
        const double factor = s * (1 - s) * d;
        for (size_t r = 0; r < n; ++r) x[r] += factor * in->k[j][r];
    }
}

#endif
