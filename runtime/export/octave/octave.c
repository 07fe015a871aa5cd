/* SPDX-License-Identifier: BSL-1.0 */
/* A plant as a MEX function of Octave and MATLAB:
 *     about = NAME_mex('about')
 *     x     = NAME_mex('start', p)
 *     value = NAME_mex(VALUE, t, x, u, p, mode)     VALUE: see mex_commands; columns of x, u, t and mode are points
 *     run   = NAME_mex('simulate', options)
 * Parameters p are a struct or a vector; [] means the defaults, and for u zeros. The text of the plant is included before this one, and
 * DALEMBERT_PLANT is its constant table. */
#include "octave_arguments.h"
#include "octave_run.h"

/* In the order of dalembert_value. */
static const char* const mex_commands[dalembert_values] = {"rhs",
                                                           "jacobian_x",
                                                           "jacobian_u",
                                                           "jacobian_p",
                                                           "jacobian_t",
                                                           "output",
                                                           "output_jacobian_x",
                                                           "output_jacobian_u",
                                                           "output_jacobian_p",
                                                           "output_jacobian_t",
                                                           "mass_matrix",
                                                           "energies",
                                                           "powers",
                                                           "guard_values",
                                                           "guard_rates",
                                                           "kink_values",
                                                           "holds",
                                                           "constraint_positions",
                                                           "constraint_rates",
                                                           "constraint_jacobian"};

/* Rows, columns and stored entries; vectors have one column. Whether it is a matrix. */
static int mex_shape(const dalembert_plant* plant, enum dalembert_value value, size_t* rows, size_t* columns, dalembert_pattern* pattern) {
    *rows = dalembert_value_size(plant, value);
    *columns = 1;
    memset(pattern, 0, sizeof *pattern);
    switch (value) {
        case dalembert_value_jacobian_x:
            *pattern = plant->pattern_x;
            *columns = plant->states;
            break;
        case dalembert_value_jacobian_u:
            *pattern = plant->pattern_u;
            *columns = plant->inputs;
            break;
        case dalembert_value_jacobian_p:
            *pattern = plant->pattern_p;
            *columns = plant->parameters;
            break;
        case dalembert_value_output_jacobian_x:
            *columns = plant->states;
            break;
        case dalembert_value_output_jacobian_u:
            *columns = plant->inputs;
            break;
        case dalembert_value_output_jacobian_p:
            *columns = plant->parameters;
            break;
        case dalembert_value_mass_matrix:
            *columns = plant->degrees;
            break;
        case dalembert_value_constraint_jacobian:
            *columns = plant->degrees;
            break;
        default:
            return 0;
    }
    if (value == dalembert_value_jacobian_x || value == dalembert_value_jacobian_u || value == dalembert_value_jacobian_p)
        *rows = plant->states;
    else if (value == dalembert_value_mass_matrix)
        *rows = plant->degrees;
    else if (value == dalembert_value_constraint_jacobian)
        *rows = plant->constraints;
    else
        *rows = plant->outputs;
    return 1;
}

static mxArray* mex_sparse(const dalembert_pattern* pattern, size_t rows, size_t columns, const double* values) {
    const size_t count = pattern->column_starts[columns];
    mxArray* const made = mxCreateSparse((mwSize)rows, (mwSize)columns, (mwSize)(count > 0 ? count : 1), mxREAL);
    size_t i;
    for (i = 0; i <= columns; ++i) mxGetJc(made)[i] = (mwIndex)pattern->column_starts[i];
    for (i = 0; i < count; ++i) mxGetIr(made)[i] = (mwIndex)pattern->row_indices[i];
    memcpy(mxGetPr(made), values, count * sizeof(double));
    return made;
}

/* One vector: a column. Vectors: columns. One matrix: sparse, if the plant stores it so. Matrices: behind each other in a third axis. */
static mxArray* mex_value_as_array(const dalembert_plant* plant, const void* self, enum dalembert_value value, const dalembert_points* at) {
    const size_t size = dalembert_value_size(plant, value), before = value == dalembert_value_jacobian_x ? plant->states : 0;
    double* const values = (double*)mxMalloc((at->count * size + 1) * sizeof(double));
    dalembert_pattern pattern;
    size_t rows, columns, i, j, k;
    mwSize axes[3];
    const int is_matrix = mex_shape(plant, value, &rows, &columns, &pattern);
    mxArray* made;
    dalembert_many(plant, self, value, at, values);
    if (at->count == 1 && pattern.column_starts != NULL) {
        made = mex_sparse(&pattern, rows, columns, values + before);
        mxFree(values);
        return made;
    }
    axes[0] = (mwSize)rows;
    axes[1] = (mwSize)columns;
    axes[2] = (mwSize)at->count;
    if (!is_matrix) {
        made = mxCreateDoubleMatrix((mwSize)rows, (mwSize)at->count, mxREAL);
    } else {
        made = mxCreateNumericArray(at->count == 1 ? 2 : 3, axes, mxDOUBLE_CLASS, mxREAL);
    }
    for (i = 0; i < at->count; ++i) {
        const double* const from = values + i * size + before;
        double* const to = mxGetPr(made) + i * rows * columns;
        if (pattern.column_starts == NULL)
            memcpy(to, from, rows * columns * sizeof(double));
        else
            for (j = 0; j < columns; ++j)
                for (k = pattern.column_starts[j]; k < pattern.column_starts[j + 1]; ++k) to[j * rows + pattern.row_indices[k]] = from[k];
    }
    mxFree(values);
    return made;
}

static mxArray* mex_value_command(const dalembert_plant* plant, int value, int nrhs, const mxArray* prhs[]) {
    const dalembert_points at =
        mex_points_of(plant, nrhs > 1 ? prhs[1] : NULL, nrhs > 2 ? prhs[2] : NULL, nrhs > 3 ? prhs[3] : NULL, nrhs > 5 ? prhs[5] : NULL);
    void* self;
    mxArray* made;
    if ((value == dalembert_value_output_jacobian_p || value == dalembert_value_output_jacobian_t) &&
        !dalembert_has_value(plant, (enum dalembert_value)value))
        mex_refuse("function", "'%s' has no %s", plant->name, mex_commands[value]);
    self = mex_instance(plant, nrhs > 4 ? prhs[4] : NULL);
    made = mex_value_as_array(plant, self, (enum dalembert_value)value, &at);
    plant->destroy(self);
    return made;
}

static mxArray* mex_start_command(const dalembert_plant* plant, const mxArray* p) {
    void* const self = mex_instance(plant, p);
    mxArray* const made = mxCreateDoubleMatrix((mwSize)plant->states, 1, mxREAL);
    plant->start_state(self, mxGetPr(made));
    plant->destroy(self);
    return made;
}

void mexFunction(int nlhs, mxArray* plhs[], int nrhs, const mxArray* prhs[]) {
    const dalembert_plant* const plant = DALEMBERT_PLANT;
    char* const command = nrhs > 0 && mxIsChar(prhs[0]) ? mxArrayToString(prhs[0]) : NULL;
    int value;
    (void)nlhs;
    if (command == NULL) {
        mex_refuse("command", "the first argument is a command, as 'rhs'%s%s", "", "");
        return;
    }
    for (value = 0; value < dalembert_values; ++value)
        if (strcmp(command, mex_commands[value]) == 0) {
            plhs[0] = mex_value_command(plant, value, nrhs, prhs);
            return;
        }
    if (strcmp(command, "about") == 0)
        plhs[0] = mex_about(plant);
    else if (strcmp(command, "start") == 0)
        plhs[0] = mex_start_command(plant, nrhs > 1 ? prhs[1] : NULL);
    else if (strcmp(command, "simulate") == 0 && nrhs > 1 && mxIsStruct(prhs[1]))
        plhs[0] = mex_simulate(plant, prhs[1]);
    else
        mex_refuse("command", "there is no command '%s'%s", command, "");
}
