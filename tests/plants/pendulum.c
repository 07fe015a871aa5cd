/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plant that is written by hand: a pendulum of length l in m with damping d in 1/s. What each energy and power is for follows from
 * ddot(phi) + d*dot(phi) + g/l*sin(phi) = u/l, per unit of mass times length^2. With -DCRASH its rates crash, with -DHANG they do not come back. */
#include "dalembert/plant.h"

#include <math.h>
#include <stdlib.h>

typedef struct parameters {
    double g, l, d;
} parameters;

static const dalembert_quantity states[] = {{"phi", "rad", "angle from hanging", -10, 10}, {"dot(phi)", "rad/s", "its rate", -100, 100}};
static const dalembert_quantity inputs[] = {{"a", "m/s^2", "acceleration along the circle", -10, 10}};
static const dalembert_quantity outputs[] = {{"height", "m", "above the lowest point", 0, 10}};
static const dalembert_quantity parameter_table[] = {{"g", "m/s^2", "gravity", 0, 30}, {"l", "m", "length", 0.01, 100}, {"d", "1/s", "damping", 0, 10}};
static const double defaults[] = {9.81, 0.5, 0.0};
static const double start[] = {1.0, 0.0};
static const size_t column_starts[] = {0, 1, 3}, row_indices[] = {1, 0, 1};

static void* create(void) {
    parameters* p = malloc(sizeof *p);
    if (p != NULL) *p = (parameters){9.81, 0.5, 0.0};
    return p;
}
static void set_parameters(void* self, const double* numbers) {
    *(parameters*)self = (parameters){numbers[0], numbers[1], numbers[2]};
}
static void start_state(const void* self, double* x) {
    (void)self;
    x[0] = start[0];
    x[1] = start[1];
}
static void rhs(const void* self, unsigned mode, const double* x, const double* u, double t, double* dxdt) {
    const parameters* p = self;
    (void)mode, (void)t;
#ifdef CRASH
    if (t > 1) abort();
#endif
#ifdef HANG
    while (t > 1) {}
#endif
    dxdt[0] = x[1];
    dxdt[1] = (u[0] - p->g * sin(x[0])) / p->l - p->d * x[1];
}
static void rhs_and_jacobian(const void* self, unsigned mode, const double* x, const double* u, double t, double* dxdt, double* J) {
    const parameters* p = self;
    rhs(self, mode, x, u, t, dxdt);
    J[0] = -p->g * cos(x[0]) / p->l; /* (1, 0) */
    J[1] = 1;                        /* (0, 1) */
    J[2] = -p->d;                    /* (1, 1) */
}
static void jacobian_u(const void* self, unsigned mode, const double* x, const double* u, double t, double* J) {
    (void)mode, (void)x, (void)u, (void)t;
    J[0] = 0;
    J[1] = 1 / ((const parameters*)self)->l;
}
static void output(const void* self, unsigned mode, const double* x, const double* u, double t, double* y) {
    (void)mode, (void)u, (void)t;
    y[0] = ((const parameters*)self)->l * (1 - cos(x[0]));
}
static double kinetic_energy(const void* self, unsigned mode, const double* x, double t) {
    (void)self, (void)mode, (void)t;
    return x[1] * x[1] / 2;
}
static double potential_energy(const void* self, unsigned mode, const double* x, double t) {
    const parameters* p = self;
    (void)mode, (void)t;
    return p->g / p->l * (1 - cos(x[0]));
}
static double supplied_power(const void* self, unsigned mode, const double* x, const double* u, double t) {
    (void)mode, (void)t;
    return u[0] / ((const parameters*)self)->l * x[1];
}
static double dissipated_power(const void* self, unsigned mode, const double* x, const double* u, double t) {
    (void)mode, (void)u, (void)t;
    return ((const parameters*)self)->d * x[1] * x[1];
}

const dalembert_plant* dalembert_plant_table(void) {
    static dalembert_plant plant;
    plant.version = DALEMBERT_PLANT_VERSION;
    plant.size = sizeof plant;
    plant.name = "pendulum";
    plant.scene = "by_hand";
    plant.title = "A pendulum, written by hand";
    plant.states = 2;
    plant.inputs = 1;
    plant.outputs = 1;
    plant.parameters = 3;
    plant.degrees = 1;
    plant.velocity_place = 1;
    plant.state_table = states;
    plant.input_table = inputs;
    plant.output_table = outputs;
    plant.parameter_table = parameter_table;
    plant.parameter_defaults = defaults;
    plant.start_values = start;
    plant.pattern_x.column_starts = column_starts;
    plant.pattern_x.row_indices = row_indices;
    plant.create = create;
    plant.destroy = free;
    plant.set_parameters = set_parameters;
    plant.start_state = start_state;
    plant.rhs = rhs;
    plant.rhs_and_jacobian = rhs_and_jacobian;
    plant.jacobian_u = jacobian_u;
    plant.output = output;
    plant.kinetic_energy = kinetic_energy;
    plant.potential_energy = potential_energy;
    plant.supplied_power = supplied_power;
    plant.dissipated_power = dissipated_power;
    return &plant;
}
