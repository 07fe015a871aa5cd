/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of the functions of a compiled plant at its start and at points around, a line of JSON each: values PLANT.so */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <dalembert/plant.h>

enum { points = 20 };

static double random_number(void) { /* from -1 to 1, the same on every machine */
    static unsigned long long state = 88172645463325252ull;
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return (double)(state >> 11) / 4503599627370496.0 - 1;
}

static void print_numbers(const char* name, size_t count, const double* values) {
    printf(", \"%s\": [", name);
    for (size_t i = 0; i < count; ++i) {
        if (isfinite(values[i])) printf("%s%.17g", i > 0 ? ", " : "", values[i]);
        else printf("%snull", i > 0 ? ", " : "");
    }
    printf("]");
}

static void print_indices(const char* name, size_t count, const size_t* values) {
    printf(", \"%s\": [", name);
    for (size_t i = 0; values != NULL && i < count; ++i) printf("%s%zu", i > 0 ? ", " : "", values[i]);
    printf("]");
}

typedef void (*function_of_input)(const void*, unsigned, const double*, const double*, double, double*);
typedef void (*function_of_state)(const void*, unsigned, const double*, double, double*);
typedef double (*number_of_state)(const void*, unsigned, const double*, double);
typedef double (*number_of_input)(const void*, unsigned, const double*, const double*, double);

static const dalembert_plant* p;
static void* self;
static double *x, *u, *out, t;
static unsigned mode;

static void of_input(const char* name, function_of_input f, size_t count) {
    if (f == NULL) return;
    memset(out, 0, count * sizeof(double));
    f(self, mode, x, u, t, out);
    print_numbers(name, count, out);
}
static void of_state(const char* name, function_of_state f, size_t count) {
    if (f == NULL) return;
    memset(out, 0, count * sizeof(double));
    f(self, mode, x, t, out);
    print_numbers(name, count, out);
}
static void number_of_x(const char* name, number_of_state f) {
    if (f == NULL) return;
    const double value = f(self, mode, x, t);
    print_numbers(name, 1, &value);
}
static void number_of_u(const char* name, number_of_input f) {
    if (f == NULL) return;
    const double value = f(self, mode, x, u, t);
    print_numbers(name, 1, &value);
}

int main(int argc, char** argv) {
    void* const library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : NULL;
    dalembert_plant_function function = NULL;
    if (library == NULL) return 1;
    *(void**)&function = dlsym(library, DALEMBERT_PLANT_FUNCTION);
    p = function();
    self = p->create();
    const size_t n = p->states, stored = p->pattern_x.column_starts != NULL ? p->pattern_x.column_starts[n] : n * n;
    const size_t room = n * n + n * (p->inputs + p->outputs + p->parameters) + p->outputs * (n + p->inputs) + p->guards +
                        p->events + p->kinks + p->constraints * (p->degrees + 1) + p->degrees * p->degrees + 1;
    double* const start = calloc(n + 1, sizeof(double));
    x = calloc(n + 1, sizeof(double));
    u = calloc(p->inputs + 1, sizeof(double));
    out = calloc(room, sizeof(double));
    p->start_state(self, start);
    for (int i = 0; i < points; ++i) {
        mode = p->modes > 0 ? (unsigned)i % (unsigned)p->modes : 0;
        t = i == 0 ? 0 : fabs(random_number());
        for (size_t k = 0; k < n; ++k) x[k] = i == 0 ? start[k] : start[k] * (1 + random_number() / 100) + random_number() / 100;
        for (size_t k = 0; k < p->inputs; ++k) u[k] = 1 + random_number();
        printf("{\"mode\": %u, \"t\": %.17g", mode, t);
        print_numbers("x", n, x);
        print_numbers("u", p->inputs, u);
        print_indices("column_starts", p->pattern_x.column_starts != NULL ? n + 1 : 0, p->pattern_x.column_starts);
        print_indices("row_indices", p->pattern_x.column_starts != NULL ? stored : 0, p->pattern_x.row_indices);
        of_input("rhs", p->rhs, n);
        of_input("output", p->output, p->outputs);
        of_input("jacobian_t", p->jacobian_t, n);
        of_input("output_jacobian_x", p->output_jacobian_x, p->outputs * n);
        of_input("guards", p->guard_values, p->modes > 0 ? p->events : p->guards);
        of_input("guard_rates", p->guard_rates, p->events);
        of_input("kinks", p->kinks > 0 ? p->kink_values : NULL, p->kinks);
        of_state("mass_matrix", p->mass_matrix, p->degrees * p->degrees);
        of_state("constraint_positions", p->constraint_positions, p->constraints);
        of_state("constraint_rates", p->constraint_rates, p->constraints);
        of_state("constraint_jacobian", p->constraint_jacobian, p->constraints * p->degrees);
        number_of_x("kinetic_energy", p->kinetic_energy);
        number_of_x("potential_energy", p->potential_energy);
        number_of_x("internal_energy", p->internal_energy);
        number_of_u("supplied_power", p->supplied_power);
        number_of_u("dissipated_power", p->dissipated_power);
        number_of_u("exchanged_power", p->exchanged_power);
        memset(out, 0, stored * sizeof(double));
        p->rhs_and_jacobian(self, mode, x, u, t, out, out + n);
        print_numbers("jacobian_x", stored, out + n);
        if (i == 0) print_numbers("start", n, start);
        printf("}\n");
    }
    return 0;
}
