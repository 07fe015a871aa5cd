/* SPDX-License-Identifier: BSL-1.0 */
/* Runs of a plant for Octave and MATLAB. */
#ifndef OCTAVE_RUN_H
#define OCTAVE_RUN_H

#include "octave_arguments.h"
#include "recorded_run.h"

/* Inputs as a function of (t, x), and the error that it made: it returns a text instead of numbers. (A trap of mexCallMATLAB tells no words
 * in Octave.) */
typedef struct mex_called_inputs {
    const dalembert_plant* plant;
    mxArray* function;
    int has_failed;
    mxArray* error; /* may be null */
} mex_called_inputs;

static void mex_call_inputs(void* context, double t, const double* x, double* u) {
    mex_called_inputs* const call = (mex_called_inputs*)context;
    const size_t n = call->plant->states, m = call->plant->inputs;
    mxArray *arguments[3], *result = NULL;
    size_t i;
    for (i = 0; i < m; ++i) u[i] = (double)NAN;
    if (call->has_failed) return;
    arguments[0] = call->function;
    arguments[1] = mxCreateDoubleScalar(t);
    arguments[2] = mxCreateDoubleMatrix((mwSize)n, 1, mxREAL);
    memcpy(mxGetPr(arguments[2]), x, n * sizeof(double));
    call->has_failed = mexCallMATLABWithTrap(1, &result, 3, arguments, "feval") != NULL || result == NULL || !mex_is_real(result) ||
                       mxGetNumberOfElements(result) != m;
    if (!call->has_failed) memcpy(u, mxGetPr(result), m * sizeof(double));
    if (result != NULL && mxIsChar(result))
        call->error = result;
    else if (result != NULL)
        mxDestroyArray(result);
    mxDestroyArray(arguments[1]);
    mxDestroyArray(arguments[2]);
}

static int mex_ask_inputs(void* context) { return ((mex_called_inputs*)context)->has_failed; }

static const mxArray* mex_option(const mxArray* options, const char* name) {
    const mxArray* const value = mxGetField(options, 0, name);
    return value == NULL || mxIsEmpty(value) ? NULL : value;
}

static double mex_number_option(const mxArray* options, const char* name, double otherwise) {
    const mxArray* const value = mex_option(options, name);
    if (value == NULL) return otherwise;
    if (!mex_is_real(value) || mxGetNumberOfElements(value) != 1)
        mex_refuse("option", "the option '%s' must be one real number%s", name, "");
    return mxGetScalar(value);
}

static enum dalembert_method mex_method_option(const mxArray* options) {
    const mxArray* const value = mex_option(options, "method");
    char* name;
    enum dalembert_method method = dalembert_automatic;
    if (value == NULL) return method;
    name = mxIsChar(value) ? mxArrayToString(value) : NULL;
    if (name != NULL && strcmp(name, "explicit") == 0)
        method = dalembert_explicit;
    else if (name != NULL && strcmp(name, "rosenbrock") == 0)
        method = dalembert_rosenbrock;
    else if (name == NULL || strcmp(name, "automatic") != 0)
        mex_refuse("option", "there is no method '%s'; there are automatic, explicit and rosenbrock%s", name != NULL ? name : "", "");
    mxFree(name);
    return method;
}

/* Rising times of the rows. */
static const double* mex_times_option(const mxArray* options, size_t* count) {
    const mxArray* const value = mex_option(options, "times");
    const double* times;
    size_t i;
    if (value == NULL || !mex_is_real(value)) {
        mex_refuse("option", "the times of the run are missing%s%s", "", "");
        return NULL;
    }
    *count = mxGetNumberOfElements(value);
    times = mxGetPr(value);
    for (i = 0; i < *count; ++i)
        if (!(fabs(times[i]) < HUGE_VAL) || (i > 0 && !(times[i] > times[i - 1])))
            mex_refuse("option", "the times of a run must rise%s%s", "", "");
    if (*count < 2) mex_refuse("option", "a run ends after it begins%s%s", "", "");
    return times;
}

static mxArray* mex_events_as_struct(const dalembert_plant* plant, const dalembert_record* record) {
    static const char* fields[] = {"t", "name", "from", "to"};
    mxArray* const made = mxCreateStructMatrix((mwSize)record->event_count, 1, 4, fields);
    size_t i;
    for (i = 0; i < record->event_count; ++i) {
        const dalembert_recorded_event* const e = record->events + i;
        char kink[32];
        snprintf(kink, sizeof kink, "kink %lu", (unsigned long)(e->event - plant->events + 1));
        mxSetFieldByNumber(made, (mwIndex)i, 0, mxCreateDoubleScalar(e->t));
        mxSetFieldByNumber(made, (mwIndex)i, 1,
                           mxCreateString(plant->modes == 0          ? plant->guard_table[e->event].name
                                          : e->event < plant->events ? plant->event_names[e->event]
                                                                     : kink));
        mxSetFieldByNumber(made, (mwIndex)i, 2, mxCreateString(plant->modes > 0 ? plant->mode_names[e->before] : ""));
        mxSetFieldByNumber(made, (mwIndex)i, 3, mxCreateString(plant->modes > 0 ? plant->mode_names[e->after] : ""));
    }
    return made;
}

/* One row a time, as ode45 has them. */
static mxArray* mex_rows(const double* columns, size_t rows, size_t count) {
    mxArray* const made = mxCreateDoubleMatrix((mwSize)count, (mwSize)rows, mxREAL);
    double* const to = mxGetPr(made);
    size_t i, k;
    for (i = 0; i < count; ++i)
        for (k = 0; k < rows; ++k) to[k * count + i] = columns[i * rows + k];
    return made;
}

static mxArray* mex_run_as_struct(const dalembert_run* run, const dalembert_record* record, enum dalembert_status status, const double* u,
                                  const double* y) {
    static const char* fields[] = {"t",       "x",     "u",     "y",     "mode",     "events",    "success",
                                   "message", "t_end", "x_end", "steps", "rejected", "rhs_calls", "implicit_steps"};
    const dalembert_plant* const plant = run->plant;
    mxArray* const made = mxCreateStructMatrix(1, 1, 14, fields);
    const size_t count = record->filled;
    mxArray* const modes = mxCreateDoubleMatrix((mwSize)count, 1, mxREAL);
    char message[512];
    size_t i;
    for (i = 0; i < count; ++i) mxGetPr(modes)[i] = record->mode[i] + 1.0;
    dalembert_run_message(run, status, message, sizeof message);
    mxSetFieldByNumber(made, 0, 0, mex_rows(record->times, 1, count));
    mxSetFieldByNumber(made, 0, 1, mex_rows(record->x, plant->states, count));
    mxSetFieldByNumber(made, 0, 2, mex_rows(u, plant->inputs, count));
    mxSetFieldByNumber(made, 0, 3, mex_rows(y, plant->outputs, count));
    mxSetFieldByNumber(made, 0, 4, modes);
    mxSetFieldByNumber(made, 0, 5, mex_events_as_struct(plant, record));
    mxSetFieldByNumber(made, 0, 6, mxCreateLogicalScalar(status == dalembert_good));
    mxSetFieldByNumber(made, 0, 7, mxCreateString(message));
    mxSetFieldByNumber(made, 0, 8, mxCreateDoubleScalar(run->t));
    mxSetFieldByNumber(made, 0, 9, mex_rows(run->x, 1, plant->states));
    mxSetFieldByNumber(made, 0, 10, mxCreateDoubleScalar((double)run->steps));
    mxSetFieldByNumber(made, 0, 11, mxCreateDoubleScalar((double)run->rejected));
    mxSetFieldByNumber(made, 0, 12, mxCreateDoubleScalar((double)run->rhs_calls));
    mxSetFieldByNumber(made, 0, 13, mxCreateDoubleScalar((double)run->implicit_steps));
    return made;
}

/* Options that are wrong end the call before anything is made that must be freed. */
static mxArray* mex_simulate(const dalembert_plant* plant, const mxArray* options) {
    const size_t n = plant->states;
    const mxArray *const given = mex_option(options, "u"), *const start = mex_option(options, "x0"),
                         *const stops = mex_option(options, "stops");
    mex_called_inputs call;
    dalembert_record record;
    dalembert_points at;
    dalembert_run* run;
    void* self;
    enum dalembert_status status;
    mxArray* result = NULL;
    double *u, *y, *held = (double*)mxCalloc(plant->inputs + 1, sizeof(double));
    const double* const x0 = mex_numbers(start, plant->state_table, n, "x0");
    const double tolerance = mex_number_option(options, "tolerance", 1e-9), longest = mex_number_option(options, "longest_step", 0),
                 first = mex_number_option(options, "first_step", 0);
    const enum dalembert_method method = mex_method_option(options);
    size_t i;
    memset(&record, 0, sizeof record);
    memset(&call, 0, sizeof call);
    call.plant = plant;
    record.times = mex_times_option(options, &record.count);
    record.x = (double*)mxMalloc(record.count * (n + 1) * sizeof(double));
    record.mode = (unsigned*)mxMalloc(record.count * sizeof(unsigned));
    record.ask = mex_ask_inputs;
    record.ask_context = &call;
    if (!(tolerance > 0 && tolerance < 1)) mex_refuse("option", "the tolerance is a number between 0 and 1%s%s", "", "");
    if (stops != NULL && !mex_is_real(stops)) mex_refuse("option", "stops are rising times%s%s", "", "");
    if (given != NULL && mxIsClass(given, "function_handle"))
        call.function = mxDuplicateArray(given);
    else if (given != NULL)
        memcpy(held, mex_numbers(given, plant->input_table, plant->inputs, "input"), plant->inputs * sizeof(double));
    self = mex_instance(plant, mxGetField(options, 0, "p"));
    run = dalembert_run_new(plant, self);
    if (run == NULL) {
        plant->destroy(self);
        mex_refuse("memory", "there is no memory for the run%s%s", "", "");
        return NULL;
    }
    run->options.tolerance = tolerance;
    run->options.longest_step = longest;
    run->options.first_step = first;
    run->options.method = method;
    run->options.stops = stops != NULL ? mxGetPr(stops) : NULL;
    run->options.stop_count = stops != NULL ? mxGetNumberOfElements(stops) : 0;
    run->inputs.held = held;
    run->inputs.function = call.function != NULL ? mex_call_inputs : NULL;
    run->inputs.context = &call;
    status = dalembert_record_run(&record, run, x0);

    u = (double*)mxCalloc(record.count * plant->inputs + 1, sizeof(double));
    y = (double*)mxCalloc(record.count * plant->outputs + 1, sizeof(double));
    for (i = 0; i < record.filled && !call.has_failed; ++i) {
        if (call.function != NULL)
            mex_call_inputs(&call, record.times[i], record.x + i * n, u + i * plant->inputs);
        else
            memcpy(u + i * plant->inputs, held, plant->inputs * sizeof(double));
    }
    memset(&at, 0, sizeof at);
    at.count = record.filled;
    at.mode = record.mode;
    at.mode_step = 1;
    at.x = record.x;
    at.x_step = n;
    at.u = u;
    at.u_step = plant->inputs;
    at.t = record.times;
    at.t_step = 1;
    if (!call.has_failed) {
        dalembert_many(plant, self, dalembert_value_output, &at, y);
        result = mex_run_as_struct(run, &record, status, u, y);
    }
    dalembert_record_free(&record);
    dalembert_run_free(run);
    plant->destroy(self);
    if (call.has_failed && call.error != NULL)
        mex_refuse("input", "the function of the inputs ended with an error: %s%s", mxArrayToString(call.error), "");
    if (call.has_failed) mex_refuse("input", "the function of the inputs must return one real number for each of them%s%s", "", "");
    return result;
}

#endif
