/* SPDX-License-Identifier: BSL-1.0
   A step of Heun's method in float, with the C header of the cart. */
#include <stdio.h>

#define cart_pendulum_lab_real float
#include "c_cart.h"

int main(void) {
    cart_pendulum_lab plant;
    cart_pendulum_lab_parameters p = cart_pendulum_lab_default_parameters();
    float x[cart_pendulum_lab_state_count], next[cart_pendulum_lab_state_count], f[cart_pendulum_lab_state_count], g[cart_pendulum_lab_state_count];
    float u[cart_pendulum_lab_input_count] = {0.0F};
    const float h = 0.01F;
    int i;
    p.m_W = 2.0F;
    cart_pendulum_lab_update(&plant, &p);
    cart_pendulum_lab_start_state(&plant, x);
    x[cart_pendulum_lab_x_phi] = 0.3F;
    cart_pendulum_lab_rhs(&plant, x, u, 0.0F, f);
    for (i = 0; i < cart_pendulum_lab_state_count; ++i) next[i] = x[i] + h * f[i];
    cart_pendulum_lab_rhs(&plant, next, u, h, g);
    for (i = 0; i < cart_pendulum_lab_state_count; ++i) x[i] += h / 2.0F * (f[i] + g[i]);
    printf("in C: %s = %.5f %s\n", cart_pendulum_lab_state_table()[cart_pendulum_lab_x_phi].name, (double)x[cart_pendulum_lab_x_phi],
           cart_pendulum_lab_state_table()[cart_pendulum_lab_x_phi].unit);
    return 0;
}
