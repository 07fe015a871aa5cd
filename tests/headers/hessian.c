/* SPDX-License-Identifier: GPL-3.0-or-later
   The function `hessian` of a C header beside differences of its Jacobians, at random points near the start, in every mode. HEADER: the file; NAME: its
   prefix; MODES: it has these. Jacobians of up to 16 states, all of whose entries are stored. */
#include HEADER

#include <stdio.h>
#include <stdlib.h>

#define PASTE_(a, b) a##_##b
#define PASTE(a, b) PASTE_(a, b)
#define N(x) PASTE(NAME, x)
#ifdef MODES
#define IN_MODE (N(mode))mode,
enum { modes = N(mode_count) };
#else
#define IN_MODE
enum { modes = 1 };
#endif
enum { n = N(state_count), m = N(input_count), all = n + m };

static NAME plant;

static double about(double size) { return size * (rand() / (double)RAND_MAX - 0.5); }

/* lambda' df/dy of y = (x, u). */
static void gradient(int mode, const double* y, double t, const double* lambda, double* g) {
    double dxdt[n], by_x[n * n], by_u[n * m + 1];
    (void)mode;
    N(rhs_and_jacobian)(&plant, IN_MODE y, y + n, t, dxdt, by_x);
    N(jacobian_u)(&plant, IN_MODE y, y + n, t, by_u);
    for (int c = 0; c < all; ++c) {
        g[c] = 0;
        for (int r = 0; r < n; ++r) g[c] += lambda[r] * (c < n ? by_x[c * n + r] : by_u[(c - n) * n + r]);
    }
}

int main(void) {
    double start[n], y[all], lambda[n], H[all * all], near[2][all], far[2][all], largest = 0;
    const N(parameters) defaults = N(default_parameters)();
    int entries = 0;
    N(update)(&plant, &defaults);
    N(start_state)(&plant, start);
    for (int point = 0; point < 20; ++point)
        for (int mode = 0; mode < modes; ++mode) {
            for (int i = 0; i < n; ++i) y[i] = start[i] * (1 + about(0.1)) + (start[i] == 0 ? about(0.1) : 0), lambda[i] = about(2);
            for (int i = 0; i < m; ++i) y[n + i] = 0.5 + about(0.1);
            N(hessian)(&plant, IN_MODE y, y + n, 0.3, lambda, H);
            for (int d = 0; d < all; ++d) {
                const double middle = y[d], step = 1e-5 * (fabs(middle) + 1e-2);
                for (int side = 0; side < 2; ++side) {
                    const double way = side == 0 ? -step : step;
                    y[d] = middle + way, gradient(mode, y, 0.3, lambda, near[side]);
                    y[d] = middle + 2 * way, gradient(mode, y, 0.3, lambda, far[side]);
                }
                y[d] = middle;
                for (int c = 0; c < all; ++c, ++entries) {
                    /* Of fourth order, as pressures bend flows within small parts of themselves. */
                    const double difference = (8 * (near[1][c] - near[0][c]) - (far[1][c] - far[0][c])) / (12 * step);
                    const double rounding = 1e-10 * (fabs(near[1][c]) + 1e-6) / step;
                    if (fabs(H[d * all + c]) > largest) largest = fabs(H[d * all + c]);
                    if (H[d * all + c] != H[c * all + d] || !(fabs(difference - H[d * all + c]) <= 1e-5 * fabs(difference) + rounding)) {
                        printf("H[%d, %d] = %g, by differences %g, in mode %d\n", c, d, H[d * all + c], difference, mode);
                        return 1;
                    }
                }
            }
        }
    if (largest == 0) return 3; /* linear */
    printf("%d entries\n", entries);
    return 0;
}
