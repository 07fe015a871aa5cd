/* SPDX-License-Identifier: GPL-3.0-or-later
   Compares two plants of one model: every text and number of their tables, and every function at random points in every mode, bit by bit.
   tables A.so B.so */
#include <dlfcn.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dalembert/plant.h"

static size_t values = 0, finite_values = 0;

static void fail(const char* what, const char* of) {
    printf("different: %s%s%s\n", what, of[0] != '\0' ? " of " : "", of);
    exit(1);
}

static void same_text(const char* what, const char* a, const char* b) {
    if (strcmp(a, b) != 0) fail(what, a);
}

static void same(const char* what, const double* a, const double* b, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        ++values;
        finite_values += isfinite(a[i]) != 0;
        if (memcmp(a + i, b + i, sizeof *a) != 0 && !(isnan(a[i]) && isnan(b[i])) && a[i] != b[i]) {
            printf("%s[%zu]: %.17g and %.17g\n", what, i, a[i], b[i]);
            fail(what, "");
        }
    }
}

/* One is rounded once, the other is computed. */
static void nearly_same(const char* what, const double* a, const double* b, size_t count) {
    for (size_t i = 0; i < count; ++i)
        if (!(fabs(a[i] - b[i]) <= 1e-15 * fabs(a[i]))) fail(what, "");
}

static const dalembert_plant* load(const char* file) {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    dalembert_plant_function table;
    if (library == NULL) fail(dlerror(), file);
    *(void**)&table = dlsym(library, DALEMBERT_PLANT_FUNCTION);
    if (table == NULL) fail(dlerror(), file);
    return table();
}

static double random_number(void) {
    static uint64_t state = 88172645463325252U;
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return (double)(state >> 11) / 9007199254740992.0;
}

static void same_quantities(const char* what, const dalembert_quantity* a, const dalembert_quantity* b, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        same_text(what, a[i].name, b[i].name);
        same_text(what, a[i].unit, b[i].unit);
        same_text(what, a[i].description, b[i].description);
        same(what, &a[i].low, &b[i].low, 1);
        same(what, &a[i].high, &b[i].high, 1);
    }
}

/* A matrix with all entries, column by column; what is not stored is zero. */
static void spread(const dalembert_pattern* p, const double* stored, size_t rows, size_t columns, double* all) {
    for (size_t i = 0; i < rows * columns; ++i) all[i] = p->column_starts == NULL ? stored[i] : 0;
    for (size_t c = 0; p->column_starts != NULL && c < columns; ++c)
        for (size_t i = p->column_starts[c]; i < p->column_starts[c + 1]; ++i) all[c * rows + p->row_indices[i]] = stored[i];
}

static double* room(size_t count) {
    double* const place = calloc(count + 1, sizeof(double));
    if (place == NULL) fail("no memory", "");
    return place;
}

static void same_tables(const dalembert_plant* a, const dalembert_plant* b) {
    same_text("name", a->name, b->name);
    same_text("scene", a->scene, b->scene);
    same_text("title", a->title, b->title);
#define SAME(member) \
    if (a->member != b->member) fail(#member, "")
    SAME(version); SAME(size); SAME(states); SAME(inputs); SAME(outputs); SAME(parameters); SAME(degrees); SAME(velocity_place); SAME(guards);
    SAME(kinks); SAME(constraints); SAME(modes); SAME(events); SAME(is_separable); SAME(is_projected); SAME(constraint_rank);
    SAME(most_transitions);
#define BOTH(member) \
    if ((a->member == NULL) != (b->member == NULL)) fail(#member, "")
    BOTH(guard_rates); BOTH(kink_values); BOTH(holds); BOTH(is_watched); BOTH(happens_at_once); BOTH(happens_at_start); BOTH(reset); BOTH(settle);
    BOTH(transitions); BOTH(constraint_positions); BOTH(correction); BOTH(move_back); BOTH(solve_for); BOTH(mass_matrix);
    same_quantities("state", a->state_table, b->state_table, a->states);
    same_quantities("input", a->input_table, b->input_table, a->inputs);
    same_quantities("output", a->output_table, b->output_table, a->outputs);
    same_quantities("parameter", a->parameter_table, b->parameter_table, a->parameters);
    nearly_same("default", a->parameter_defaults, b->parameter_defaults, a->parameters);
    nearly_same("start value", a->start_values, b->start_values, a->states);
    for (size_t i = 0; i < a->guards; ++i) {
        same_text("guard", a->guard_table[i].name, b->guard_table[i].name);
        same_text("guard", a->guard_table[i].doc, b->guard_table[i].doc);
        if (a->guard_table[i].ends != b->guard_table[i].ends) fail("guard", a->guard_table[i].name);
    }
    for (size_t i = 0; i < a->constraints; ++i) {
        const dalembert_constraint *const c = a->constraint_table + i, *const d = b->constraint_table + i;
        same_text("constraint", c->name, d->name);
        same_text("constraint", c->unit, d->unit);
        same_text("constraint", c->description, d->description);
        if (c->has_position != d->has_position || c->can_be_left_out != d->can_be_left_out || c->solved_for_at_start != d->solved_for_at_start)
            fail("constraint", c->name);
    }
    for (size_t i = 0; i < a->modes; ++i) same_text("mode", a->mode_names[i], b->mode_names[i]);
    for (size_t i = 0; i < a->events; ++i) same_text("event", a->event_names[i], b->event_names[i]);
}

static void same_transitions(const dalembert_plant* a, const dalembert_plant* b) {
    unsigned* const to = calloc(2 * a->most_transitions + 1, sizeof *to);
    for (size_t event = 0; event < a->events; ++event) {
        if (a->happens_at_once != NULL && (a->happens_at_once(event) != b->happens_at_once(event) || a->happens_at_start(event) != b->happens_at_start(event)))
            fail("event", a->event_names[event]);
        for (unsigned mode = 0; mode < a->modes; ++mode) {
            if (a->is_watched(mode, event) != b->is_watched(mode, event)) fail("watched event", a->event_names[event]);
            for (int kind = 0; kind < 3; ++kind) {
                const size_t count = a->transitions(event, mode, (enum dalembert_transition)kind, to);
                if (count != b->transitions(event, mode, (enum dalembert_transition)kind, to + count)) fail("transitions", a->event_names[event]);
                if (count > 0 && memcmp(to, to + count, count * sizeof *to) != 0) fail("transitions", a->event_names[event]);
                if (count > a->most_transitions) fail("most_transitions", a->event_names[event]);
            }
        }
    }
    free(to);
}

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const dalembert_plant *const a = load(argv[1]), *const b = load(argv[2]);
    same_tables(a, b);
    same_transitions(a, b);
    void *const one = a->create(), *const other = b->create();
    const size_t n = a->states, m = a->inputs, widest = n > a->parameters ? n : a->parameters,
                 all = n * (widest > m ? widest : m) + a->outputs * (n + m) + a->degrees * (a->degrees + a->constraints) + a->guards + a->events + a->kinks;
    double *const x = room(n), *const u = room(m), *const p = room(a->parameters), *const stored = room(all), *const stored_b = room(all), *const ra = room(all),
                  *const rb = room(all), *const start = room(n), *const xa = room(n), *const xb = room(n);
    for (int point = 0; point < 20; ++point) {
        for (size_t i = 0; i < a->parameters; ++i) p[i] = a->parameter_defaults[i] * (point == 0 ? 1 : 1 + 0.01 * random_number());
        a->set_parameters(one, p), b->set_parameters(other, p);
        a->start_state(one, start), b->start_state(other, xb);
        same("start", start, xb, n);
        for (size_t i = 0; i < n; ++i) x[i] = start[i] * (1 + 0.1 * random_number()) + 0.01 * (random_number() - 0.5);
        for (size_t i = 0; i < m; ++i) u[i] = isfinite(a->input_table[i].low) ? a->input_table[i].low : random_number();
        const double t = random_number();
        for (unsigned mode = 0; mode < (a->modes > 0 ? a->modes : 1); ++mode) {
#define VECTOR(function, count) (a->function(one, mode, x, u, t, ra), b->function(other, mode, x, u, t, rb), same(#function, ra, rb, count))
#define OF_STATE(function, count) (a->function(one, mode, x, t, ra), b->function(other, mode, x, t, rb), same(#function, ra, rb, count))
#define NUMBER(function) (ra[0] = a->function(one, mode, x, u, t), rb[0] = b->function(other, mode, x, u, t), same(#function, ra, rb, 1))
#define NUMBER_OF_STATE(function) (ra[0] = a->function(one, mode, x, t), rb[0] = b->function(other, mode, x, t), same(#function, ra, rb, 1))
#define MATRIX(function, pattern, columns)                                                                                     \
    (a->function(one, mode, x, u, t, stored), b->function(other, mode, x, u, t, stored_b), spread(&a->pattern, stored, n, columns, ra), \
     spread(&b->pattern, stored_b, n, columns, rb), same(#function, ra, rb, n*(columns)))
            VECTOR(rhs, n);
            VECTOR(jacobian_t, n);
            VECTOR(output, a->outputs);
            VECTOR(output_jacobian_x, a->outputs * n);
            VECTOR(output_jacobian_u, a->outputs * m);
            VECTOR(guard_values, a->modes > 0 ? 0 : a->guards);
            OF_STATE(mass_matrix, a->degrees * a->degrees);
            NUMBER(supplied_power); NUMBER(dissipated_power); NUMBER(prescribed_power); NUMBER(exchanged_power);
            NUMBER_OF_STATE(kinetic_energy); NUMBER_OF_STATE(potential_energy); NUMBER_OF_STATE(internal_energy);
            a->rhs_and_jacobian(one, mode, x, u, t, xa, stored), b->rhs_and_jacobian(other, mode, x, u, t, xb, stored_b);
            same("rhs of both", xa, xb, n);
            spread(&a->pattern_x, stored, n, n, ra), spread(&b->pattern_x, stored_b, n, n, rb);
            same("jacobian_x", ra, rb, n * n);
            MATRIX(jacobian_u, pattern_u, m);
            MATRIX(jacobian_p, pattern_p, a->parameters);
            if (a->modes > 0) {
                for (size_t i = 0; i < a->events; ++i) ra[i] = rb[i] = 1;
                VECTOR(guard_values, a->events);
                VECTOR(guard_rates, a->events);
                VECTOR(kink_values, a->kinks);
                if (a->holds != NULL && a->holds(one, mode, x, u, t) != b->holds(other, mode, x, u, t)) fail("holds", a->mode_names[mode]);
                for (size_t event = 0; event < a->events; ++event)
                    for (int settles = 0; settles < 2; ++settles) {
                        memcpy(xa, x, n * sizeof *x), memcpy(xb, x, n * sizeof *x);
                        (settles ? a->settle : a->reset)(one, event, mode, xa, u, t), (settles ? b->settle : b->reset)(other, event, mode, xb, u, t);
                        same("reset", xa, xb, n);
                    }
            }
            if (a->constraints > 0) {
                OF_STATE(constraint_positions, a->constraints);
                OF_STATE(constraint_rates, a->constraints);
                OF_STATE(constraint_jacobian, a->constraints * a->degrees);
                a->constraint_rates(one, mode, x, t, stored);
                a->correction(one, mode, x, t, stored, ra), b->correction(other, mode, x, t, stored, rb);
                same("correction", ra, rb, a->degrees);
            }
            if (a->is_projected) {
                for (size_t i = 0; i < a->degrees; ++i) stored[i] = 0.01 * random_number();
                memcpy(xa, x, n * sizeof *x), memcpy(xb, x, n * sizeof *x);
                a->move_back(one, xa, stored), b->move_back(other, xb, stored);
                same("move_back", xa, xb, n);
            }
        }
    }
    if (2 * finite_values < values) fail("most values are not finite", "");
    printf("%zu values\n", values);
    a->destroy(one), b->destroy(other);
    return 0;
}
