/* SPDX-License-Identifier: BSL-1.0 */
/* The tables of a plant as structs of Octave and MATLAB. */
#ifndef OCTAVE_NAMES_H
#define OCTAVE_NAMES_H

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "dalembert_plant.h"
#include "mex.h"

enum { mex_longest_name = 64 }; /* of a field, with the final zero */

/* A name that fields can have: "dot(phi)" becomes phi_dot, "l[1]" l_1. Names of the language get a '_' behind. */
static void mex_field_name(const char* name, char* field) {
    static const char* const taken[] = {"break",  "case", "catch",    "classdef", "continue", "do",        "else",   "elseif",
                                        "end",    "for",  "function", "global",   "if",       "otherwise", "parfor", "persistent",
                                        "return", "spmd", "switch",   "try",      "until",    "while"};
    size_t length = 0, dots = 0, i, end = strlen(name);
    while (strncmp(name, "dot(", 4) == 0 && end > 5 && name[end - 1] == ')' && dots < 4) {
        name += 4;
        end -= 5;
        ++dots;
    }
    if (end > 0 && !isalpha((unsigned char)name[0])) field[length++] = 'x';
    for (i = 0; i < end && length < mex_longest_name - 18; ++i) {
        if (isalnum((unsigned char)name[i]) || name[i] == '_')
            field[length++] = name[i];
        else if (length > 0 && field[length - 1] != '_')
            field[length++] = '_';
    }
    while (length > 0 && field[length - 1] == '_' && name[end - 1] != '_') --length;
    for (i = 0; i < dots; ++i, length += 4) memcpy(field + length, "_dot", 4);
    field[length] = '\0';
    for (i = 0; i < sizeof taken / sizeof *taken; ++i)
        if (strcmp(field, taken[i]) == 0) strcat(field, "_");
}

/* A struct with a field for each quantity, in their order. */
static mxArray* mex_struct_of(const dalembert_quantity* table, size_t count) {
    mxArray* const made = mxCreateStructMatrix(1, 1, 0, NULL);
    size_t i;
    for (i = 0; i < count; ++i) {
        char field[mex_longest_name];
        mex_field_name(table[i].name, field);
        while (mxGetFieldNumber(made, field) >= 0) strcat(field, "_");
        mxAddField(made, field);
    }
    return made;
}

static mxArray* mex_named_numbers(const dalembert_quantity* table, const double* values, size_t count) {
    mxArray* const made = mex_struct_of(table, count);
    size_t i;
    for (i = 0; i < count; ++i) mxSetFieldByNumber(made, 0, (int)i, mxCreateDoubleScalar(values[i]));
    return made;
}

/* A struct array with name, unit, description, low, high and field. */
static mxArray* mex_quantities_as_struct(const dalembert_quantity* table, size_t count) {
    static const char* fields[] = {"name", "unit", "description", "low", "high", "field"};
    mxArray* const made = mxCreateStructMatrix((mwSize)count, 1, 6, fields);
    mxArray* const names = mex_struct_of(table, count);
    size_t i;
    for (i = 0; i < count; ++i) {
        mxSetFieldByNumber(made, (mwIndex)i, 0, mxCreateString(table[i].name));
        mxSetFieldByNumber(made, (mwIndex)i, 1, mxCreateString(table[i].unit));
        mxSetFieldByNumber(made, (mwIndex)i, 2, mxCreateString(table[i].description));
        mxSetFieldByNumber(made, (mwIndex)i, 3, mxCreateDoubleScalar(table[i].low));
        mxSetFieldByNumber(made, (mwIndex)i, 4, mxCreateDoubleScalar(table[i].high));
        mxSetFieldByNumber(made, (mwIndex)i, 5, mxCreateString(mxGetFieldNameByNumber(names, (int)i)));
    }
    mxDestroyArray(names);
    return made;
}

static mxArray* mex_texts(const char* const* texts, size_t count) {
    mxArray* const made = mxCreateCellMatrix((mwSize)count, 1);
    size_t i;
    for (i = 0; i < count; ++i) mxSetCell(made, (mwIndex)i, mxCreateString(texts[i]));
    return made;
}

static mxArray* mex_guards_as_struct(const dalembert_plant* plant) {
    static const char* fields[] = {"name", "description", "ends"};
    mxArray* const made = mxCreateStructMatrix((mwSize)plant->guards, 1, 3, fields);
    size_t i;
    for (i = 0; i < plant->guards; ++i) {
        mxSetFieldByNumber(made, (mwIndex)i, 0, mxCreateString(plant->guard_table[i].name));
        mxSetFieldByNumber(made, (mwIndex)i, 1, mxCreateString(plant->guard_table[i].doc));
        mxSetFieldByNumber(made, (mwIndex)i, 2, mxCreateDoubleScalar(plant->guard_table[i].ends));
    }
    return made;
}

/* All that the table tells. `p` holds the default parameters. */
static mxArray* mex_about(const dalembert_plant* plant) {
    static const char* fields[] = {"name",       "scene",  "title", "states", "inputs",  "outputs",
                                   "parameters", "guards", "modes", "events", "degrees", "p"};
    mxArray* const made = mxCreateStructMatrix(1, 1, 12, fields);
    mxSetFieldByNumber(made, 0, 0, mxCreateString(plant->name));
    mxSetFieldByNumber(made, 0, 1, mxCreateString(plant->scene));
    mxSetFieldByNumber(made, 0, 2, mxCreateString(plant->title));
    mxSetFieldByNumber(made, 0, 3, mex_quantities_as_struct(plant->state_table, plant->states));
    mxSetFieldByNumber(made, 0, 4, mex_quantities_as_struct(plant->input_table, plant->inputs));
    mxSetFieldByNumber(made, 0, 5, mex_quantities_as_struct(plant->output_table, plant->outputs));
    mxSetFieldByNumber(made, 0, 6, mex_quantities_as_struct(plant->parameter_table, plant->parameters));
    mxSetFieldByNumber(made, 0, 7, mex_guards_as_struct(plant));
    mxSetFieldByNumber(made, 0, 8, mex_texts(plant->mode_names, plant->modes));
    mxSetFieldByNumber(made, 0, 9, mex_texts(plant->event_names, plant->events));
    mxSetFieldByNumber(made, 0, 10, mxCreateDoubleScalar((double)plant->degrees));
    mxSetFieldByNumber(made, 0, 11, mex_named_numbers(plant->parameter_table, plant->parameter_defaults, plant->parameters));
    return made;
}

#endif
