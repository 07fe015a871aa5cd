/* SPDX-License-Identifier: BSL-1.0 */
/* One instance of an FMU over a plant: memory, phases, messages. The adapters fmi2.c and fmi3.c give it the functions of their standard. */
#ifndef DALEMBERT_FMI_MACHINE_H
#define DALEMBERT_FMI_MACHINE_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dalembert_modes.h"
#include "dalembert_plant.h"
#include "dalembert_run.h"
#include "fmi_identity.h"
#include "fmi_values.h"

/* As both standards number them. */
typedef enum fmi_status { fmi_ok, fmi_warning, fmi_discard, fmi_error, fmi_fatal } fmi_status;

/* Where an instance stands. Each function is allowed in some of them. */
enum fmi_phase {
    fmi_instantiated = 1,
    fmi_initialising = 2,
    fmi_event_mode = 4,
    fmi_continuous = 8, /* model exchange */
    fmi_stepping = 16,  /* co-simulation */
    fmi_terminated = 32,
    fmi_failed = 64,    /* a step could not be made: only reset, an earlier state or the end help */
    fmi_any_phase = 127
};

enum fmi_category { fmi_log_events, fmi_log_discard, fmi_log_error, fmi_categories };
static const char* const fmi_category_names[fmi_categories] = {"logEvents", "logStatusDiscard", "logStatusError"};

/* Values that are known for the present time, state, inputs, parameters and mode. */
enum fmi_known {
    fmi_has_rates = 1,
    fmi_has_outputs = 2,
    fmi_has_by_state = 4,
    fmi_has_by_input = 8,
    fmi_has_by_parameter = 16,
    fmi_has_by_time = 32,
    fmi_has_outputs_by_parameter = 64,
    fmi_has_outputs_by_time = 128
};

typedef struct fmi_machine {
    const dalembert_plant* plant;
    void* self;
    fmi_layout layout;
    dalembert_modes* modes; /* of model exchange; null in co-simulation */
    dalembert_run* run;     /* of co-simulation; null in model exchange */

    char* name;
    void* environment;
    void (*tell)(const struct fmi_machine*, fmi_status, const char* category, const char* message);
    void (*logger)(void); /* of the importer; tell() knows its type */
    unsigned logged;      /* a bit for each category */

    enum fmi_phase phase;
    int is_consistent;    /* x and the mode follow from what was set at the start */
    int is_disturbed;     /* an event, or new inputs or parameters, wait to be handled */
    int is_over;          /* the model holds no further */
    double start, stop, tolerance; /* stop and tolerance: 0 where not defined */
    double t;
    unsigned mode;
    unsigned known;       /* of enum fmi_known */

    double *x, *u, *p;
    double* given;            /* start values of states that the importer has set */
    unsigned char* is_given;
    int* solved_for;          /* by constraint, what the plant solves for at the start */
    double *rates, *outputs, *indicators;
    double* behind;           /* by indicator of an event: where it stood, at or below zero, when the last event was handled */
    double *by_state, *by_input, *by_parameter, *by_time;     /* of the rates, in the pattern of the plant */
    double *outputs_by_state, *outputs_by_input, *outputs_by_parameter, *outputs_by_time;
    double* work;
} fmi_machine;



static size_t fmi_entries(const dalembert_pattern* pattern, size_t rows, size_t columns) {
    return pattern->column_starts ? pattern->column_starts[columns] : rows * columns;
}

/* --- messages ------------------------------------------------------------------------------------------------------------------- */

static fmi_status fmi_say(const fmi_machine* m, fmi_status status, const char* message) {
    const enum fmi_category category = status == fmi_ok ? fmi_log_events : status <= fmi_discard ? fmi_log_discard : fmi_log_error;
    if (m->logger && (m->logged & (1u << category))) m->tell(m, status, fmi_category_names[category], message);
    return status;
}

static fmi_status fmi_say_of(const fmi_machine* m, fmi_status status, const char* function, const char* what) {
    char text[300];
    snprintf(text, sizeof text, "%s: %s.", function, what);
    return fmi_say(m, status, text);
}

/* Whether a function may be called now. If not, the answer is an error, and the instance stays as it is. */
static int fmi_is_allowed(const fmi_machine* m, unsigned phases, const char* function) {
    if (m->phase & phases) return 1;
    const char* now = m->phase == fmi_instantiated   ? "has not entered initialization mode"
                      : m->phase == fmi_initialising ? "is in initialization mode"
                      : m->phase == fmi_event_mode   ? "is in event mode"
                      : m->phase == fmi_continuous   ? "is in continuous-time mode"
                      : m->phase == fmi_stepping     ? "is between steps"
                      : m->phase == fmi_terminated   ? "is terminated"
                                                     : "has failed in a step";
    char text[300];
    snprintf(text, sizeof text, "%s cannot be called now: the instance %s.", function, now);
    fmi_say(m, fmi_error, text);
    return 0;
}

static fmi_status fmi_set_logging(fmi_machine* m, int is_on, size_t count, const char* const names[], const char* function) {
    unsigned chosen = count == 0 ? (1u << fmi_categories) - 1u : 0u;
    if (count > 0 && !names) return fmi_say_of(m, fmi_error, function, "no array of categories is given");
    for (size_t i = 0; i < count; ++i) {
        unsigned category = 0;
        while (category < fmi_categories && (!names[i] || strcmp(names[i], fmi_category_names[category]) != 0)) ++category;
        if (category == fmi_categories)
            return fmi_say_of(m, fmi_error, function, "a category is not one of logEvents, logStatusDiscard, logStatusError");
        chosen |= 1u << category;
    }
    if (count == 0) m->logged = is_on ? chosen : 0u;
    else m->logged = is_on ? m->logged | chosen : m->logged & ~chosen;
    return fmi_ok;
}

/* --- birth, reset, death ---------------------------------------------------------------------------------------------------------- */

static void fmi_free(fmi_machine* m) {
    if (!m) return;
    if (m->run) dalembert_run_free(m->run);
    if (m->modes) dalembert_modes_free(m->modes);
    if (m->self) m->plant->destroy(m->self);
    free(m->x);
    free(m->is_given);
    free(m->solved_for);
    free(m->name);
    free(m);
}

/* As after instantiation: default parameters, start values, inputs at rest. */
static void fmi_begin_anew(fmi_machine* m) {
    const dalembert_plant* plant = m->plant;
    m->phase = fmi_instantiated;
    m->is_consistent = m->is_disturbed = m->is_over = 0;
    m->start = m->stop = m->tolerance = m->t = 0.0;
    m->mode = 0;
    m->known = 0;
    for (size_t i = 0; i < plant->parameters; ++i) m->p[i] = plant->parameter_defaults[i];
    for (size_t i = 0; i < plant->inputs; ++i) m->u[i] = fmi_input_start(plant->input_table[i].low, plant->input_table[i].high);
    for (size_t i = 0; i < dalembert_event_values(plant); ++i) m->behind[i] = 1.0;
    memset(m->is_given, 0, plant->states);
    plant->set_parameters(m->self, m->p);
    if (plant->solve_for) plant->solve_for(m->self, m->solved_for);
}

/* All memory of an instance; null if there is none. Nothing grows later. */
static fmi_machine* fmi_new(int is_co_simulation, const char* name) {
    const dalembert_plant* plant = FMI_PLANT;
    fmi_machine* m = (fmi_machine*)calloc(1, sizeof(fmi_machine));
    if (!m) return NULL;
    const size_t n = plant->states, inputs = plant->inputs, outputs = plant->outputs, parameters = plant->parameters;
    const size_t indicators = dalembert_event_values(plant);
    m->plant = plant;
    m->layout = fmi_layout_of(n, inputs, outputs, parameters, indicators, plant->modes);
    double** const vectors[] = {
        &m->x,      &m->u,        &m->p,        &m->given,        &m->rates,   &m->outputs,          &m->indicators,
        &m->behind, &m->by_state, &m->by_input, &m->by_parameter, &m->by_time, &m->outputs_by_state, &m->outputs_by_input,
        &m->outputs_by_parameter, &m->outputs_by_time, &m->work};
    const size_t sizes[] = {n,
                            inputs,
                            parameters,
                            n,
                            n,
                            outputs,
                            indicators,
                            indicators,
                            fmi_entries(&plant->pattern_x, n, n),
                            fmi_entries(&plant->pattern_u, n, inputs),
                            fmi_entries(&plant->pattern_p, n, parameters),
                            n,
                            outputs * n,
                            outputs * inputs,
                            plant->output_jacobian_p ? outputs * parameters : 0,
                            outputs,
                            n + dalembert_projection_room(plant) + 2 * outputs + parameters};
    const size_t count = sizeof sizes / sizeof sizes[0];
    size_t all = 1; /* an array of nothing has a place, too */
    for (size_t i = 0; i < count; ++i) all += sizes[i];
    double* block = (double*)calloc(all, sizeof(double));
    m->x = block;
    m->is_given = (unsigned char*)calloc(n + 1, 1);
    m->solved_for = (int*)calloc(plant->constraints + 1, sizeof(int));
    m->name = (char*)calloc(strlen(name) + 1, 1);
    m->self = plant->create();
    if (is_co_simulation && m->self) m->run = dalembert_run_new(plant, m->self);
    if (!is_co_simulation && m->self) m->modes = dalembert_modes_new(plant, m->self);
    if (!block || !m->is_given || !m->solved_for || !m->name || !(m->run || m->modes)) {
        fmi_free(m);
        return NULL;
    }
    for (size_t i = 0, at = 0; i < count; at += sizes[i++]) *vectors[i] = block + at;
    for (size_t i = 0; i < plant->constraints; ++i) m->solved_for[i] = plant->constraint_table[i].solved_for_at_start;
    memcpy(m->name, name, strlen(name));
    if (m->run) m->run->inputs.held = m->u;
    if (m->modes) m->modes->inputs.held = m->u;
    fmi_begin_anew(m);
    return m;
}

#endif
