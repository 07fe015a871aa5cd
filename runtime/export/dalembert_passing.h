/* SPDX-License-Identifier: BSL-1.0 */
/* How a run passes events and times at which inputs jump. */
#ifndef DALEMBERT_PASSING_H
#define DALEMBERT_PASSING_H

#include "dalembert_jumps.h"
#include "dalembert_steps.h"

/* On its zero a jump may have a value that holds on neither side: a run that starts there starts just behind it. */
static inline void dalembert_leave_zero(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    const double ahead = 16 * DBL_EPSILON * fmax(fabs(run->t), in->kept->span);
    int is_on_zero = 0;
    for (size_t i = 0; i < in->guards; ++i) is_on_zero = is_on_zero || in->watches[i].settled == 0;
    if (!is_on_zero || !(run->t + ahead < in->to)) return;
    for (size_t i = 0; i < n; ++i) in->other[i] = run->x[i] + ahead * in->dxdt[i];
    dalembert_rate(run, in->other, run->t + ahead, in->difference);
    if (!dalembert_all_finite(n, in->other) || !dalembert_all_finite(n, in->difference) ||
        !dalembert_leave_zero_at(run, in->other, run->t + ahead))
        return;
    dalembert_move(run, run->t + ahead, in->other);
    memcpy(in->dxdt, in->difference, n * sizeof(double));
}

/* The first point behind the event along dx/dt. What the longer step reached there may have used the right-hand side of the other side;
 * it is taken only where that makes no difference. If neither is there, the event is yet to come. */
static inline int dalembert_find_other_side(dalembert_run* run, double* t, double* x) {
    dalembert_inside* const in = run->inside;
    const dalembert_candidate* const behind = &in->behind;
    const size_t n = run->plant->states;
    const double tiny = dalembert_tiny(&in->modes, run->t);
    const int goes_on = dalembert_all_finite(n, in->dxdt);
    for (double ahead = behind->end - run->t; goes_on && ahead <= tiny && run->t + ahead <= in->to; ahead *= 2) {
        *t = run->t + ahead;
        for (size_t i = 0; i < n; ++i) x[i] = run->x[i] + ahead * in->dxdt[i];
        if (dalembert_has_changed_at(run, x, *t)) return 1;
        if (!(ahead > 0)) break;
    }
    int is_near = behind->is_finite;
    for (size_t i = 0; i < n; ++i)
        is_near = is_near && fabs(behind->y[i] - run->x[i]) <= 64 * DBL_EPSILON * fmax(run->scale[i], fabs(run->x[i]));
    *t = behind->end;
    memcpy(x, behind->y, n * sizeof(double));
    return behind->is_finite && dalembert_any_negative(in->guards, in->found) &&
           (is_near || behind->length <= tiny || in->kept->cuts >= dalembert_most_cuts);
}

/* At the end of a step that was cut for an event: ends there, or starts anew behind it. */
static inline enum dalembert_status dalembert_pass_event(dalembert_run* run, int* is_anew) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    *is_anew = 0;
    if (dalembert_is_broken(run)) return dalembert_constraint_broken;
    if (in->guards == 0 || !in->is_cut) return dalembert_good;
    double t = run->t;
    if (!dalembert_is_sure_of_end(run) && !dalembert_find_other_side(run, &t, in->next_x)) {
        k->may_touch = 1;
        ++k->cuts;
        return dalembert_good;
    }
    const size_t ending = dalembert_ending_guard(in);
    if (ending != DALEMBERT_NONE) return dalembert_end_at(run, dalembert_range_left, ending);
    *is_anew = 1;
    dalembert_move(run, t, in->next_x);
    size_t first = 0;
    while (first < in->guards && !(in->found[first] < 0)) ++first;
    const size_t changed = dalembert_pass_guards(run, t);
    k->part_events += changed;
    k->kinks_passed += changed;
    k->stalled = k->part_events > 1 && !(run->t - k->last_event > dalembert_smallest(k->span, run->t)) ? k->stalled + 1 : 0;
    k->last_event = run->t;
    k->last_error = 0;
    dalembert_rate(run, run->x, run->t, in->dxdt);
    if (!dalembert_all_finite(run->plant->states, run->x) || !dalembert_all_finite(run->plant->states, in->dxdt))
        return dalembert_not_finite;
    if (run->on_event != NULL && !in->is_trial) run->on_event(run->context, run, run->t, first, in->modes.mode, in->modes.mode);
    return k->part_events > run->options.most_events || k->stalled > 100 + in->guards ? dalembert_end_at(run, dalembert_event_storm, first)
                                                                                      : dalembert_good;
}

/* From just before a kink that is known to just behind it. An event that jumps with it happens there. */
static inline enum dalembert_status dalembert_pass_stop(dalembert_run* run, double behind) {
    dalembert_inside* const in = run->inside;
    for (size_t i = 0; i < run->plant->states; ++i) run->x[i] += (behind - run->t) * in->dxdt[i];
    run->t = behind;
    if (in->guards > 0) in->kept->kinks_passed += dalembert_pass_known(run);
    in->kept->last_error = 0;
    dalembert_rate(run, run->x, run->t, in->dxdt);
    const size_t jumped = in->guards > 0 ? dalembert_jumped_guard(run) : DALEMBERT_NONE;
    return jumped != DALEMBERT_NONE ? dalembert_end_at(run, dalembert_range_left, jumped) : dalembert_good;
}

/* The next jump of the plant at a time of its own; HUGE_VAL where there is none on the way. */
static inline double dalembert_jump_ahead(dalembert_run* run) {
    dalembert_run_memory* const k = run->inside->kept;
    const double to = run->inside->to, room = 2 * dalembert_smallest(k->span, run->t);
    if (run->plant->time_switches == 0) return HUGE_VAL;
    /* Nothing is searched twice: not before what was found, nor before the end of a search in vain. */
    const int is_known = k->has_jump && (k->jump < k->searched ? k->jump - room > run->t : to <= k->searched);
    if (!is_known) {
        k->searched = to;
        k->jump = dalembert_next_jump(&run->inside->modes, run->t, run->x, to, room);
        k->has_jump = 1;
    }
    return k->jump < k->searched ? k->jump : HUGE_VAL;
}

/* The next time of `stops`, or of a jump of the plant, with room before and behind it; `to` where there is none. */
static inline void dalembert_next_stop(dalembert_run* run, double* before, double* behind) {
    const double jump = dalembert_jump_ahead(run);
    size_t low = 0, high = run->options.stop_count; /* the first one behind t */
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (run->options.stops[middle] > run->t)
            high = middle;
        else
            low = middle + 1;
    }
    *before = *behind = run->inside->to;
    for (; low < run->options.stop_count; ++low) {
        const double stop = run->options.stops[low], room = dalembert_smallest(run->inside->kept->span, stop);
        if (!(stop - room > run->t) || !(stop - room < run->inside->to)) continue;
        *before = stop - room;
        *behind = stop + room;
        break;
    }
    if (jump < *before) {
        const double room = dalembert_smallest(run->inside->kept->span, jump);
        *before = jump - room;
        *behind = jump + room;
    }
}

#endif
