/* SPDX-License-Identifier: BSL-1.0 */
/* What Python calls by ctypes, in one library with a plant. The text of the plant is included before this one, and DALEMBERT_PLANT is its
 * constant table: so the compiler knows which functions are called, and can put them into loops. */
#include "many_points.h"
#include "recorded_run.h"

#if defined(_WIN32)
#define DALEMBERT_SHOWN __declspec(dllexport)
#elif defined(__GNUC__)
#define DALEMBERT_SHOWN __attribute__((visibility("default")))
#else
#define DALEMBERT_SHOWN
#endif

/* A checksum of the C texts: whether the library was made from those beside it. */
#ifndef DALEMBERT_TEXTS
#define DALEMBERT_TEXTS 0
#endif
DALEMBERT_SHOWN unsigned dalembert_python_texts(void) { return (unsigned)DALEMBERT_TEXTS; }

DALEMBERT_SHOWN size_t dalembert_python_size(int value) { return dalembert_value_size(DALEMBERT_PLANT, (enum dalembert_value)value); }

DALEMBERT_SHOWN int dalembert_python_has(int value) { return dalembert_has_value(DALEMBERT_PLANT, (enum dalembert_value)value); }

DALEMBERT_SHOWN void dalembert_python_many(const void* self, int value, const dalembert_points* at, double* result) {
    dalembert_many(DALEMBERT_PLANT, self, (enum dalembert_value)value, at, result);
}

/* What a run is asked for, and how it ended. Zeros: as dalembert_run_new() sets them. */
typedef struct dalembert_python_call {
    const double* parameters;
    const double* x;     /* null: the start state */
    const double* scale; /* null: the run finds it */
    int method;
    double tolerance, longest_step, first_step;
    size_t most_steps;
    const double* stops;
    size_t stop_count;
    void (*input)(void* context, double t, const double* x, double* u);
    const double* held;

    double t;
    double* end; /* room for a state */
    unsigned mode;
    size_t steps, rejected, rhs_calls, jacobians, implicit_steps;
    char message[512];
} dalembert_python_call;

static void dalembert_python_ask(dalembert_run* run, const dalembert_python_call* call) {
    dalembert_options* const options = &run->options;
    options->method = (enum dalembert_method)call->method;
    options->tolerance = call->tolerance;
    options->longest_step = call->longest_step;
    options->first_step = call->first_step;
    options->finds_scales = call->scale == NULL;
    if (call->scale != NULL) memcpy(run->scale, call->scale, run->plant->states * sizeof(double));
    if (call->most_steps > 0) options->most_steps = call->most_steps;
    options->stops = call->stops;
    options->stop_count = call->stop_count;
    run->inputs.function = call->input;
    run->inputs.held = call->held;
}

static void dalembert_python_tell(const dalembert_run* run, enum dalembert_status status, dalembert_python_call* call) {
    call->t = run->t;
    memcpy(call->end, run->x, run->plant->states * sizeof(double));
    call->mode = run->mode;
    call->steps = run->steps;
    call->rejected = run->rejected;
    call->rhs_calls = run->rhs_calls;
    call->jacobians = run->jacobians;
    call->implicit_steps = run->implicit_steps;
    dalembert_run_message(run, status, call->message, sizeof call->message);
}

/* Returns a dalembert_status. The run gets an instance of the plant for itself: the one of Python stays as it is. */
DALEMBERT_SHOWN int dalembert_python_run(dalembert_python_call* call, dalembert_record* record) {
    const dalembert_plant* const plant = DALEMBERT_PLANT;
    void* const self = plant->create();
    dalembert_run* const run = self != NULL ? dalembert_run_new(plant, self) : NULL;
    enum dalembert_status status = dalembert_no_memory;
    if (run != NULL) {
        plant->set_parameters(self, call->parameters);
        dalembert_python_ask(run, call);
        status = dalembert_record_run(record, run, call->x);
        dalembert_python_tell(run, status, call);
        dalembert_run_free(run);
    }
    if (self != NULL) plant->destroy(self);
    return (int)status;
}

DALEMBERT_SHOWN void dalembert_python_free(dalembert_record* record) { dalembert_record_free(record); }
