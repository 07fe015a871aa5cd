/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run by the C99 integrators of runtime/export, for tests in C++. */
#ifndef RUN_IN_C_H
#define RUN_IN_C_H

#include "dalembert_plant.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wished_run {
    const dalembert_plant* plant;
    void* self;
    const double* start;
    double until, tolerance, longest_step;
    int method;  /* as in dalembert_method */
    int parts;   /* calls of dalembert_run_to() */
    int reloads; /* 1: after each part the state goes to another run of another instance, which continues */
    const double* parameters;
    const double* stops;
    size_t stop_count;
} wished_run;

typedef struct event_in_c {
    double t;
    size_t event;
    unsigned before, after;
} event_in_c;

enum { most_events_in_c = 10000 };

typedef struct made_run {
    int status; /* as in dalembert_status */
    double t;
    unsigned mode;
    size_t steps, rejected, rhs_calls, implicit_steps, event_count, last_event;
    event_in_c events[most_events_in_c]; /* without kinks */
    char message[400];
} made_run;

/* x: the state at the end. */
void make_run(const wished_run* wish, made_run* made, double* x);
/* The same wish twice at a time, in turns; false unless both give the same bits as `x`. */
int make_two_runs(const wished_run* wish, const double* x);
/* The largest difference of states within steps, by the dense output, from those of a run that ends there; beside their scales. */
double difference_within(const wished_run* wish);
/* The same run by an importer that knows dalembert_modes.h alone: classical Runge-Kutta steps, of which `steps` make the run, and
 * bisection. */
void make_exchange(const wished_run* wish, int steps, made_run* made, double* x);
/* A coefficient of the tables of methods, by its number; not a number behind the last one. */
double dop853_coefficient(size_t i);
double rodas5p_coefficient(size_t i);

#ifdef __cplusplus
}
#endif
#endif
