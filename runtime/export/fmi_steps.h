/* SPDX-License-Identifier: BSL-1.0 */
/* How an instance goes through time: initialization, events of model exchange, steps of co-simulation. */
#ifndef DALEMBERT_FMI_STEPS_H
#define DALEMBERT_FMI_STEPS_H

#include "dalembert_jumps.h"
#include "fmi_access.h"

/* What an importer must know after an event. */
typedef struct fmi_news {
    int states_changed, is_over, has_next;
    double next; /* s: where event mode must be entered again, at the latest */
} fmi_news;

/* Times of their own at which the right-hand side jumps are time events: just behind them. Where the end of the run is not known, a search
 * ends with a time event, too, and the next one begins there. */
static void fmi_find_next(fmi_machine* m, fmi_news* news) {
    const double limit = m->stop > m->t ? m->stop : m->t + fmax(1.0, fabs(m->t));
    const double room = 64 * DBL_EPSILON * fmax(fabs(m->t), DBL_EPSILON * (limit - m->t));
    news->has_next = 0;
    news->next = 0.0;
    if (!m->modes || m->plant->time_switches == 0 || news->is_over) return;
    const double jump = dalembert_next_jump(m->modes, m->t, m->x, limit, room);
    news->has_next = jump < limit || !(m->stop > m->t);
    if (news->has_next) news->next = jump < limit ? jump + room / 2 : limit;
}

static fmi_status fmi_set_experiment(fmi_machine* m, int has_tolerance, double tolerance, double start, int has_stop, double stop,
                                     const char* function) {
    if (!isfinite(start) || (has_stop && !(stop >= start)))
        return fmi_say_of(m, fmi_error, function, "the time of the start or of the end is wrong");
    if (has_tolerance && !(tolerance > 0.0 && tolerance < 1.0))
        return fmi_say_of(m, fmi_error, function, "the tolerance is not between 0 and 1");
    m->start = m->t = start;
    m->stop = has_stop && isfinite(stop) ? stop : start;
    m->tolerance = has_tolerance ? tolerance : 0.0;
    m->is_consistent = 0;
    m->known = 0;
    return fmi_ok;
}

static fmi_status fmi_leave_initialisation(fmi_machine* m, const char* function) {
    if (fmi_start(m, function) != fmi_ok) return fmi_error;
    m->phase = m->run ? fmi_stepping : fmi_event_mode;
    m->is_disturbed = 0;
    fmi_note_indicators(m);
    return fmi_ok;
}

/* How far a state is away from its constraints, relative to the size of its entries. The rest of a step that is as exact as asked for is
 * less. */
static int fmi_has_drifted(fmi_machine* m) {
    if (!m->plant->is_projected) return 0;
    const size_t n = m->plant->states;
    double* x = m->work;
    memcpy(x, m->x, n * sizeof(double));
    if (dalembert_project(m->plant, m->self, m->mode, m->t, x, m->work + n) != DALEMBERT_NONE) return 1;
    const double most = m->tolerance > 0.0 ? fmax(m->tolerance / 10.0, 1e-13) : 1e-9;
    for (size_t i = 0; i < n; ++i)
        if (!(fabs(x[i] - m->x[i]) <= most * fmax(fabs(x[i]), 1.0))) return 1;
    return 0;
}

static fmi_status fmi_complete_step(fmi_machine* m, int* wants_event_mode, int* is_over, const char* function) {
    *wants_event_mode = 0;
    *is_over = m->is_over;
    if (!fmi_are_finite(m->x, m->plant->states)) return fmi_say_of(m, fmi_error, function, "a state is infinite or not a number");
    *wants_event_mode = fmi_has_drifted(m);
    return fmi_ok;
}

/* Event mode: events that happen at this state, one after the other, new inputs and parameters, and the way back to the constraints. */
static fmi_status fmi_pass_events(fmi_machine* m, fmi_news* news, const char* function) {
    const dalembert_plant* plant = m->plant;
    const size_t n = plant->states;
    news->states_changed = 0;
    news->is_over = m->is_over;
    if (!m->is_disturbed) return fmi_ok;
    m->is_disturbed = 0;
    m->known = 0;
    memcpy(m->work, m->x, n * sizeof(double));
    double t = m->t; /* may grow by roundings, which the importer does not follow */
    const unsigned before = m->mode;
    enum dalembert_status status = m->run ? dalembert_run_changed(m->run) : dalembert_modes_event(m->modes, &t, m->x);
    if (m->run) memcpy(m->x, m->run->x, n * sizeof(double));
    m->mode = m->run ? m->run->mode : m->modes->mode;
    for (size_t i = 0; i < n; ++i) news->states_changed = news->states_changed || m->x[i] != m->work[i];
    if (status == dalembert_good && !m->run && plant->is_projected) {
        memcpy(m->work, m->x, n * sizeof(double));
        if (dalembert_project(plant, m->self, m->mode, m->t, m->x, m->work + n) != DALEMBERT_NONE) status = dalembert_constraint_broken;
        for (size_t i = 0; i < n; ++i) news->states_changed = news->states_changed || m->x[i] != m->work[i];
    }
    fmi_note_indicators(m);
    if (m->mode != before && (m->logged & (1u << fmi_log_events))) {
        char text[300];
        snprintf(text, sizeof text, "At %.17g s: from mode %s to %s.", m->t, plant->mode_names[before], plant->mode_names[m->mode]);
        fmi_say(m, fmi_ok, text);
    }
    if (status == dalembert_good) return fmi_ok;
    if (status == dalembert_range_left || status == dalembert_accumulation) { /* nothing is wrong, but the model says no more */
        news->is_over = m->is_over = 1;
        fmi_say_of(m, fmi_ok, function, dalembert_status_text(status));
        return fmi_ok;
    }
    m->phase = fmi_failed;
    return fmi_say_of(m, fmi_error, function, dalembert_status_text(status));
}

/* The same, with the next time event. */
static fmi_status fmi_handle_events(fmi_machine* m, fmi_news* news, const char* function) {
    const fmi_status status = fmi_pass_events(m, news, function);
    fmi_find_next(m, news);
    return status;
}

/* A step of co-simulation from the present time. `reached` is where it ended; it is over if the model holds no further. */
static fmi_status fmi_step(fmi_machine* m, double from, double length, double* reached, int* is_over, const char* function) {
    *reached = m->t;
    *is_over = m->is_over;
    const double nearby = 1e-9 * fmax(fabs(m->t), fabs(length));
    if (!isfinite(from) || !isfinite(length) || !(length > 0.0) || !(fabs(from - m->t) <= nearby))
        return fmi_say_of(m, fmi_error, function, "the step is not positive, or does not begin where the last one ended");
    if (m->is_over) return fmi_say_of(m, fmi_discard, function, "the model holds no further");
    const double end = from + length;
    fmi_news news;
    if (!(end > m->t)) return fmi_ok; /* shorter than a rounding of the time */
    if (fmi_pass_events(m, &news, function) != fmi_ok) return fmi_error;
    const enum dalembert_status status = news.is_over ? dalembert_range_left : dalembert_run_to(m->run, end);
    m->known = 0;
    memcpy(m->x, m->run->x, m->plant->states * sizeof(double));
    m->mode = m->run->mode;
    *reached = m->t = status == dalembert_good ? end : m->run->t;
    if (status == dalembert_good) return fmi_ok;
    char text[300];
    dalembert_run_message(m->run, status, text, sizeof text);
    if (status == dalembert_range_left || status == dalembert_accumulation) {
        *is_over = m->is_over = 1;
        return fmi_say(m, fmi_discard, text);
    }
    m->phase = fmi_failed;
    return fmi_say(m, fmi_error, text);
}

#endif
