/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run of a plant by the C99 integrators alone: loads a shared library of `dalembert compile`, runs it to a time with each method, in
 * parts and with its state saved between, and by its modes. For sanitizers and valgrind; what it prints must be the same with every
 * compiler, but for roundings. */
#include <dlfcn.h>
#include <stdio.h>

#include "export/run_in_c.h"

static void show(const char* what, const made_run* made, const double* x, size_t n) {
    printf("%s: status %d, t = %.6g, mode %u, %zu events\n", what, made->status, made->t, made->mode, made->event_count);
    for (size_t i = 0; i < n; ++i) printf("  x[%zu] = %.6e\n", i, x[i]);
}

static made_run made; /* too large for the stack */

int main(int count, char** arguments) {
    if (count != 3) return 2;
    void* const library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) return 2;
    dalembert_plant_function table;
    *(void**)&table = dlsym(library, DALEMBERT_PLANT_FUNCTION);
    const dalembert_plant* const plant = table();
    double until, x[64];
    if (sscanf(arguments[2], "%lf", &until) != 1 || plant->states > 64) return 2;
    wished_run wish = {0};
    wish.plant = plant;
    wish.parameters = plant->parameter_defaults;
    wish.start = plant->start_values;
    wish.until = until;
    wish.tolerance = 1e-9;
    wish.longest_step = until / 100;
    for (int method = 0; method < 3; ++method) {
        wish.method = method;
        wish.parts = 5;
        wish.reloads = 1;
        make_run(&wish, &made, x);
        show(method == 0 ? "automatic" : method == 1 ? "explicit" : "Rosenbrock", &made, x, plant->states);
        if (!make_two_runs(&wish, x)) return 1;
    }
    printf("dense output: %s\n", difference_within(&wish) < 1e-5 ? "good" : "wrong");
    make_exchange(&wish, 2000, &made, x);
    printf("exchange: status %d, mode %u, %zu events\n", made.status, made.mode, made.event_count);
    dlclose(library);
    return 0;
}
