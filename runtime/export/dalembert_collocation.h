/* SPDX-License-Identifier: BSL-1.0 */
/* One long step of Gauss's collocation: x(s) = x(0) + h times the integral from 0 to s of the polynomial that has given slopes at some
 * points; s = 1 is a time h behind s = 0. */
#ifndef DALEMBERT_COLLOCATION_H
#define DALEMBERT_COLLOCATION_H

#include "dalembert_run.h"

/* Points and weights of Gauss's quadrature on [0, 1]. */
static inline void dalembert_gauss_points(size_t count, double* points, double* weights) {
    const double order = (double)count;
    for (size_t i = 0; i < count; ++i) {
        double x = cos(3.14159265358979323846 * ((double)(count - i) - 0.25) / (order + 0.5)), slope = 0;
        for (int k = 0; k < 8; ++k) { /* Newton's method on Legendre's polynomial */
            double before = 1, value = x;
            for (size_t d = 2; d <= count; ++d) {
                const double next = ((2 * (double)d - 1) * x * value - ((double)d - 1) * before) / (double)d;
                before = value;
                value = next;
            }
            slope = order * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        points[i] = (x + 1) / 2;
        weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

static inline void dalembert_start_polynomial(dalembert_polynomial* p, const double* x, double h, size_t count) {
    p->x = x;
    p->h = h;
    p->count = count;
    dalembert_gauss_points(count, p->nodes, p->weights);
    memcpy(p->points, p->nodes, sizeof(p->points));
}

static inline double dalembert_lagrange(const dalembert_polynomial* p, size_t j, double s) {
    double product = 1;
    for (size_t k = 0; k < p->count; ++k)
        if (k != j) product *= (s - p->points[k]) / (p->points[j] - p->points[k]);
    return product;
}

static inline void dalembert_polynomial_at(const dalembert_polynomial* p, size_t n, double s, double* x) {
    if (x != p->x) memcpy(x, p->x, n * sizeof(double));
    for (size_t j = 0; j < p->count; ++j) {
        double sum = 0;
        for (size_t k = 0; k < p->count; ++k) sum += p->weights[k] * dalembert_lagrange(p, j, s * p->nodes[k]);
        for (size_t i = 0; i < n; ++i) x[i] += p->h * s * sum * p->slopes[j][i];
    }
}

static inline void dalembert_polynomial_slope(const dalembert_polynomial* p, size_t n, double s, double* slope) {
    memset(slope, 0, n * sizeof(double));
    for (size_t j = 0; j < p->count; ++j) {
        const double factor = dalembert_lagrange(p, j, s);
        for (size_t i = 0; i < n; ++i) slope[i] += factor * p->slopes[j][i];
    }
}

#endif
