/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls the functions of an FMU in any order with any arguments: NaN, wrong value references, missing arrays, wrong lengths, states of
 * other instances, damaged bytes. Nothing may crash, and every status must be one of the standard. Compiled with the sources of an FMU,
 * under sanitizers: cc -DFMI_VERSION=3 -fsanitize=address,undefined -I sources -I . fmi_fuzz.c sources/fmi3.c -lm Arguments: number of
 * calls, seed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dalembert_plant.h"
#include "fmi_identity.h"
#include "fmi_values.h"

enum { instance_count = 3, state_count = 4, most = 24 };

static unsigned long long state_of_random;
static unsigned long long next_random(void) { /* SplitMix64 (Steele, Lea, Flood) */
    unsigned long long z = (state_of_random += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
}
static size_t below(size_t n) { return (size_t)(next_random() % n); }
static int rarely(void) { return below(15) == 0; }

static double any_number(void) {
    switch (below(16)) {
    case 0: return NAN;
    case 1: return INFINITY;
    case 2: return -1e300;
    case 3: return 1e-320;
    case 4: return 0.0;
    default: return ((double)below(2000001) - 1000000.0) * 1e-6 * (below(3) == 0 ? 100.0 : 1.0);
    }
}

/* The arguments of the next call. Arrays have the room that their counts say, so that a sanitizer sees what is read or written beyond. */
static const dalembert_plant* plant;
static fmi_layout layout;
static size_t indicators;
static void* instances[instance_count];
static void* states[state_count];
static void* c;                 /* an instance, or none */
static unsigned *references, *others; /* or none */
static double *values, *results;
static size_t n, m;             /* of references and values, of others */
static void** state;            /* a place of a state, or none */
static char* bytes;
static size_t byte_count;

static void* exact(void* old, size_t count, size_t size) {
    free(old);
    void* made = calloc(count > 0 ? count : 1, count > 0 ? size : 1);
    if (!made) exit(3);
    return made;
}

static void choose_arguments(void) {
    c = rarely() && rarely() ? NULL : instances[below(instance_count)];
    n = below(4) == 0 ? plant->states : below(4) == 0 ? indicators : below(most);
    m = below(most);
    references = (unsigned*)exact(references, n, sizeof(unsigned));
    others = (unsigned*)exact(others, m, sizeof(unsigned));
    values = (double*)exact(values, n > m ? n : m, sizeof(double));
    results = (double*)exact(results, n > m ? n : m, sizeof(double));
    const size_t kind = below(fmi_kinds); /* often all of one kind, so that the whole call succeeds */
    const size_t size = layout.first[kind + 1] - layout.first[kind];
    const int is_mixed = below(3) == 0 || size == 0;
    for (size_t i = 0; i < n; ++i)
        references[i] = (unsigned)(is_mixed ? below(layout.first[fmi_kinds] + 2) : layout.first[kind] + below(size));
    for (size_t i = 0; i < m; ++i) others[i] = (unsigned)(rarely() ? next_random() : below(layout.first[fmi_input + 1]));
    const int is_good = below(2) == 0; /* near what the plant starts with, so that runs get somewhere */
    for (size_t i = 0; i < (n > m ? n : m); ++i)
        values[i] = is_good && i < plant->states ? plant->start_values[i] * (1.0 + 1e-6 * ((double)below(2001) - 1000.0)) : any_number();
    state = rarely() && rarely() ? NULL : &states[below(state_count)];
}

static size_t calls, statuses[5];
static int counted(int status) {
    if (status < 0 || status > 4) {
        printf("the status is %d\n", status);
        exit(1);
    }
    ++statuses[status];
    ++calls;
    return status;
}

/* Each version has: instantiate(), release(c), any_call(), and advance(): what a run needs, in the order that the standard asks for. */
#if FMI_VERSION == 2
#include "fmi_fuzz2.h"
#else
#include "fmi_fuzz3.h"
#endif

int main(int argc, char** argv) {
    const size_t wanted = argc > 1 ? (size_t)strtoull(argv[1], NULL, 10) : 100000;
    state_of_random = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    plant = FMI_PLANT;
    indicators = plant->modes > 0 ? plant->events + plant->kinks : plant->guards;
    layout = fmi_layout_of(plant->states, plant->inputs, plant->outputs, plant->parameters, indicators, plant->modes);
    while (calls < wanted) {
        const size_t which = below(instance_count);
        if (!instances[which] || below(2000) == 0) {
            release(instances[which]);
            instances[which] = instantiate();
        }
        choose_arguments();
        if (below(8) == 0) advance();
        else any_call();
    }
    for (size_t i = 0; i < instance_count; ++i) release(instances[i]);
    for (size_t i = 0; i < state_count; ++i) free(states[i]);
    free(references), free(others), free(values), free(results), free(bytes);
    printf("FMI %d, %s: %zu calls; %zu good, %zu warnings, %zu discarded, %zu errors, %zu fatal\n", FMI_VERSION, plant->name, calls,
           statuses[0], statuses[1], statuses[2], statuses[3], statuses[4]);
    return statuses[0] > wanted / 20 && statuses[3] > wanted / 20 && statuses[4] == 0 ? 0 : 1;
}
