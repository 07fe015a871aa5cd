/* SPDX-License-Identifier: BSL-1.0 */
/* A controller that samples, as a shared library behind plain C functions. The library exports one function,
 *     const dalembert_controller* dalembert_controller_table(void);
 * It returns a table that stays valid as long as the library is loaded. All numbers are doubles in SI. `self` is the result of create().
 * Functions may change only their results, and self if it is not const. Several threads may call them with different self. */
#ifndef DALEMBERT_CONTROLLER_H
#define DALEMBERT_CONTROLLER_H

#include "dalembert/plant.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this table. It grows with every change that matters to a program that reads it. */
#define DALEMBERT_CONTROLLER_VERSION 1

typedef struct dalembert_controller {
    int version; /* DALEMBERT_CONTROLLER_VERSION */
    size_t size; /* sizeof(dalembert_controller), in bytes */

    const char* name;
    size_t states, inputs, outputs, parameters; /* inputs are what it measures */
    const dalembert_quantity* state_table;
    const dalembert_quantity* input_table;
    const dalembert_quantity* output_table;
    const dalembert_quantity* parameter_table;

    /* One instance of the controller, with the default parameters; null if there is no memory. */
    void* (*create)(void);
    void (*destroy)(void* self);
    void (*set_parameters)(void* self, const double* parameters);
    void (*start_state)(const void* self, double* x);
    /* Takes a sample: outputs y from measured inputs u and states x; then x is that of the next sample. */
    void (*sample)(const void* self, const double* u, double* x, double* y);
} dalembert_controller;

/* The function that a library exports. Everything else may be hidden (-fvisibility=hidden). */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const dalembert_controller* dalembert_controller_table(void);
typedef const dalembert_controller* (*dalembert_controller_function)(void);
#define DALEMBERT_CONTROLLER_FUNCTION "dalembert_controller_table"

#ifdef __cplusplus
}
#endif
#endif
