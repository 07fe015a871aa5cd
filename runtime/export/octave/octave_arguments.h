/* SPDX-License-Identifier: BSL-1.0 */
/* Arguments from Octave and MATLAB: points, parameters, modes. What is wrong ends the call with an error that says what would be right.
 * Memory is that of mxMalloc(), which an error gives back. */
#ifndef OCTAVE_ARGUMENTS_H
#define OCTAVE_ARGUMENTS_H

#include "many_points.h"
#include "octave_names.h"

static void mex_refuse(const char* id, const char* format, const char* a, const char* b) {
    char text[512], whole[64];
    snprintf(text, sizeof text, format, a, b);
    snprintf(whole, sizeof whole, "dalembert:%s", id);
    mexErrMsgIdAndTxt(whole, "%s", text);
}

static int mex_is_real(const mxArray* a) { return mxIsDouble(a) && !mxIsComplex(a) && !mxIsSparse(a); }

/* The values of a struct with a field for each quantity, or of a vector; null: nothing is given. */
static const double* mex_numbers(const mxArray* given, const dalembert_quantity* table, size_t count, const char* what) {
    double* values;
    size_t i;
    if (given == NULL || mxIsEmpty(given)) return NULL;
    values = (double*)mxMalloc((count + 1) * sizeof(double));
    if (mxIsStruct(given) && mxGetNumberOfElements(given) == 1) {
        mxArray* const names = mex_struct_of(table, count);
        for (i = 0; i < (size_t)mxGetNumberOfFields(given); ++i)
            if (mxGetFieldNumber(names, mxGetFieldNameByNumber(given, (int)i)) < 0)
                mex_refuse("name", "there is no %s '%s'", what, mxGetFieldNameByNumber(given, (int)i));
        for (i = 0; i < count; ++i) {
            const mxArray* const value = mxGetField(given, 0, mxGetFieldNameByNumber(names, (int)i));
            if (value == NULL) mex_refuse("name", "the %s '%s' is missing", what, table[i].name);
            if (!mex_is_real(value) || mxGetNumberOfElements(value) != 1)
                mex_refuse("number", "the %s '%s' must be one real number", what, table[i].name);
            values[i] = mxGetScalar(value);
        }
        mxDestroyArray(names);
    } else {
        char number[32];
        snprintf(number, sizeof number, "%lu", (unsigned long)count);
        if (!mex_is_real(given) || mxGetNumberOfElements(given) != count)
            mex_refuse("size", "%s must be a struct or %s real numbers", what, number);
        memcpy(values, mxGetPr(given), count * sizeof(double));
    }
    return values;
}

/* Columns of `rows` numbers: how many there are, and their step. */
static const double* mex_columns(const mxArray* given, size_t rows, size_t* count, size_t* step, const char* what) {
    char number[32];
    size_t columns;
    snprintf(number, sizeof number, "%lu", (unsigned long)rows);
    if (given == NULL || mxIsEmpty(given)) { /* zeros, shared by all points */
        *step = 0;
        return (const double*)mxCalloc(rows + 1, sizeof(double));
    }
    if (!mex_is_real(given)) mex_refuse("number", "%s must be real numbers, with %s rows", what, number);
    columns = mxGetN(given);
    if (what[0] == 't' && mxGetN(given) == 1)
        columns = mxGetM(given); /* a column of times */
    else if (mxGetM(given) != rows || mxGetNumberOfElements(given) != rows * columns) {
        if (mxGetNumberOfElements(given) != rows) mex_refuse("size", "%s must have %s rows, and a column for each point", what, number);
        columns = 1; /* a row for a column */
    }
    *step = columns == 1 ? 0 : rows;
    if (columns != 1) {
        if (*count != 1 && *count != columns) mex_refuse("size", "%s has another number of points than what stands before it%s", what, "");
        *count = columns;
    }
    return mxGetPr(given);
}

/* A mode by its name, or by its number, which begins with 1. */
static unsigned mex_mode_of(const dalembert_plant* plant, const mxArray* given) {
    const size_t modes = plant->modes > 0 ? plant->modes : 1;
    double number = 0;
    size_t i;
    if (given == NULL || mxIsEmpty(given)) return 0;
    if (mxIsChar(given)) {
        char* const name = mxArrayToString(given);
        for (i = 0; i < plant->modes; ++i)
            if (strcmp(plant->mode_names[i], name) == 0) {
                mxFree(name);
                return (unsigned)i;
            }
        mex_refuse("mode", "there is no mode '%s'%s", name, "");
    }
    if (mex_is_real(given) && mxGetNumberOfElements(given) == 1) number = mxGetScalar(given);
    if (!(number >= 1 && number <= (double)modes) || number != floor(number))
        mex_refuse("mode", "a mode is a name or a number that begins with 1%s%s", "", "");
    return (unsigned)number - 1;
}

/* t, x, u and the mode of each point. */
static dalembert_points mex_points_of(const dalembert_plant* plant, const mxArray* t, const mxArray* x, const mxArray* u,
                                      const mxArray* mode) {
    dalembert_points at;
    size_t ignored = 1, i;
    unsigned* modes;
    memset(&at, 0, sizeof at);
    at.count = 1;
    if (x == NULL || (mxIsEmpty(x) && plant->states > 0))
        mex_refuse("size", "x is missing: the state, a column for each point%s%s", "", "");
    at.x = mex_columns(x, plant->states, &at.count, &at.x_step, "x");
    at.u = plant->inputs > 0 ? mex_columns(u, plant->inputs, &at.count, &at.u_step, "u") : mex_columns(NULL, 0, &ignored, &at.u_step, "u");
    at.t = mex_columns(t, 1, &at.count, &at.t_step, "t");
    if (mode != NULL && !mxIsChar(mode) && mxGetNumberOfElements(mode) > 1) {
        const double* const numbers = mxGetPr(mode);
        if (!mex_is_real(mode) || (at.count != 1 && at.count != mxGetNumberOfElements(mode)))
            mex_refuse("size", "the mode must be one, or one for each point%s%s", "", "");
        at.count = mxGetNumberOfElements(mode);
        modes = (unsigned*)mxMalloc(at.count * sizeof(unsigned));
        for (i = 0; i < at.count; ++i) {
            if (!(numbers[i] >= 1 && numbers[i] <= (double)(plant->modes > 0 ? plant->modes : 1)))
                mex_refuse("mode", "a mode is a name or a number that begins with 1%s%s", "", "");
            modes[i] = (unsigned)numbers[i] - 1;
        }
        at.mode_step = 1;
    } else {
        modes = (unsigned*)mxMalloc(sizeof(unsigned));
        modes[0] = mex_mode_of(plant, mode);
    }
    at.mode = modes;
    return at;
}

/* An instance with parameters; null or [] are the defaults. It lives as long as the call. */
static void* mex_instance(const dalembert_plant* plant, const mxArray* p) {
    const double* const values = mex_numbers(p, plant->parameter_table, plant->parameters, "parameter");
    void* const self = plant->create();
    if (self == NULL) mex_refuse("memory", "there is no memory for the plant%s%s", "", "");
    if (values != NULL) plant->set_parameters(self, values);
    return self;
}

#endif
