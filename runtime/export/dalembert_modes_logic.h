/* SPDX-License-Identifier: BSL-1.0 */
/* What follows an event; see dalembert_modes.h.
 *
 * note [acceptance]: A mode accepts a state when each guard that is watched in it is positive, or is zero and rises, or is zero with a
 * rate that is exactly zero, as at rest. Zero is exact: resets put guards there. A mode does not accept a state with a positive guard
 * that falls to zero within an instant (1024 roundings of the time), in which inputs move on. Such a guard, or one that is zero and
 * falls, is an event that happens at once. If no candidate accepts the state,
 *  1. the event is passed an instant later, behind the zero: there an input has jumped, or a rate is no longer zero, for example of a
 *     body that leaves a belt with the same friction that held it;
 *  2. else the first candidate is taken in which nothing is worse than events that happen at once, and of these the first in order of
 *     declaration is passed there, and so on: events of independent parts of a machine may fall together, and an impact may cause
 *     another. Modes that only lead to each other that way, as where sliding friction is larger than what holds, are an event storm. */
#ifndef DALEMBERT_MODES_LOGIC_H
#define DALEMBERT_MODES_LOGIC_H

#include "dalembert_modes.h"

static inline int dalembert_all_finite(size_t n, const double* x) {
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(x[i])) return 0;
    return 1;
}

static inline void dalembert_inputs_at(const dalembert_modes* m, double t, const double* x, double* u) {
    const size_t size = m->plant->inputs * sizeof(double);
    if (m->inputs.function != NULL)
        m->inputs.function(m->inputs.context, t, x, u);
    else if (m->inputs.held != NULL)
        memcpy(u, m->inputs.held, size);
    else
        memset(u, 0, size);
}

/* A step that changes nothing any more at t, in s; and one so short that it does no harm when its stages lie on both sides of a jump. */
static inline double dalembert_smallest(double span, double t) { return 16 * DBL_EPSILON * fmax(fabs(t), span * DBL_EPSILON); }
static inline double dalembert_tiny(const dalembert_modes* m, double t) { return 64 * dalembert_smallest(m->kept->span, t); }

/* How much a guard changes within an instant because inputs move, as its rate is that with inputs held. Of a jump, which is found where it
 * is, nothing. */
static inline double dalembert_by_moving_inputs(double now, double half, double whole) {
    const double change = whole - now;
    return fabs(2 * (half - now) - change) <= fabs(change) / 2 ? change : 0;
}

/* Whether a mode can take a state; *event: the first event that happens there at once. What falls through zero within an instant does;
 * where `is_late`, so does what fell within the last two. */
static inline int dalembert_accepts(const dalembert_modes* m, unsigned mode, double t, const double* x, int is_late, size_t* event) {
    const dalembert_plant* const p = m->plant;
    const double instant = dalembert_tiny(m, t);
    *event = DALEMBERT_NONE;
    if (p->holds != NULL && !p->holds(m->self, mode, x, m->u, t)) return 0;
    p->guard_values(m->self, mode, x, m->u, t, m->g);
    p->guard_values(m->self, mode, x, m->u_half, t, m->g_half);
    p->guard_values(m->self, mode, x, m->u_whole, t, m->g_whole);
    p->guard_rates(m->self, mode, x, m->u, t, m->rates);
    for (size_t e = 0; e < p->events; ++e) {
        if (!p->is_watched(mode, e)) continue;
        const double g = m->g[e], moved = dalembert_by_moving_inputs(g, m->g_half[e], m->g_whole[e]);
        const double change = instant * m->rates[e] + moved;
        const double slope = moved == 0 ? m->rates[e] : change; /* small numbers times an instant may be zero */
        const int fell = is_late && g < 0 && g >= 2 * change;
        const int is_driven = g < 0 && p->happens_at_once != NULL && p->happens_at_once(e);
        if (!(g >= 0) && !fell && !is_driven) return 0;
        const int falls = is_driven || (g > 0 || g < 0 ? g + change <= 0 : !(slope >= 0));
        if (falls && *event == DALEMBERT_NONE) *event = e;
    }
    return 1;
}

/* Takes the first of `count` modes (null: all) that accepts the state, or else the first one in which an event happens at once. */
static inline int dalembert_choose(dalembert_modes* m, const unsigned* modes, size_t count, double t, const double* x, int is_late,
                                   size_t* event) {
    const double instant = dalembert_tiny(m, t);
    int is_found = 0;
    dalembert_inputs_at(m, t, x, m->u);
    dalembert_inputs_at(m, t + instant / 2, x, m->u_half);
    dalembert_inputs_at(m, t + instant, x, m->u_whole);
    for (size_t i = 0; i < count; ++i) {
        const unsigned mode = modes != NULL ? modes[i] : (unsigned)i;
        size_t first;
        if (!dalembert_accepts(m, mode, t, x, is_late, &first) || (is_found && first != DALEMBERT_NONE)) continue;
        m->mode = mode;
        *event = first;
        is_found = 1;
        if (first == DALEMBERT_NONE) break;
    }
    return is_found;
}

/* What an event does to x: its reset, or after accumulation that of all in is_over. */
typedef struct dalembert_effect {
    size_t event;
    unsigned from;
    int is_end, settles;
} dalembert_effect;

static inline void dalembert_apply(const dalembert_modes* m, const dalembert_effect* effect, double t, double* x) {
    dalembert_inputs_at(m, t, x, m->u);
    if (!effect->is_end) m->plant->reset(m->self, effect->event, effect->from, x, m->u, t);
    for (size_t e = 0; effect->settles && e < m->plant->events; ++e)
        if (m->is_over[e]) m->plant->settle(m->self, e, effect->from, x, m->u, t);
}

/* x = start + (t - before) f(start) in a mode. */
static inline void dalembert_go_on(const dalembert_modes* m, unsigned mode, const double* start, double at, double before, double t,
                                   double* x) {
    dalembert_inputs_at(m, at, start, m->u);
    m->plant->rhs(m->self, mode, start, m->u, at, m->dxdt);
    for (size_t i = 0; i < m->plant->states; ++i) x[i] = start[i] + (t - before) * m->dxdt[i];
}

/* The run is in front of the zero, with m->before. Where an input jumps, or a guard leaves zero with a rate that is zero itself but
 * grows, as with friction that is the same at rest, a mode only accepts what is behind: the motion goes on for an instant before the
 * reset. Where `is_late`, another event may have happened in that instant: it is the next. */
static inline int dalembert_change_behind(dalembert_modes* m, const dalembert_effect* effect, const unsigned* modes, size_t count,
                                          int is_late, double instant, double* t, double* x, size_t* event) {
    const size_t n = m->plant->states;
    const unsigned to = m->mode;
    const double here = *t, ahead = here + instant;
    size_t next = DALEMBERT_NONE;
    memcpy(m->after, x, n * sizeof(double));
    dalembert_go_on(m, effect->from, m->before, here, here, ahead, x);
    dalembert_apply(m, effect, ahead, x);
    if (ahead > here && dalembert_all_finite(n, x) && dalembert_choose(m, modes, count, ahead, x, is_late, &next) &&
        (next == DALEMBERT_NONE || is_late)) {
        *t = ahead;
        *event = next;
        return 1;
    }
    m->mode = to;
    memcpy(x, m->after, n * sizeof(double));
    return 0;
}

/* The same, first a few roundings of the time behind where the guard jumps over its zero. */
static inline int dalembert_change_behind_zero(dalembert_modes* m, const dalembert_effect* effect, const unsigned* modes, size_t count,
                                               int is_late, int is_jump, double* t, double* x, size_t* event) {
    return (is_jump &&
            dalembert_change_behind(m, effect, modes, count, is_late, dalembert_smallest(m->kept->span, *t) / 4, t, x, event)) ||
           dalembert_change_behind(m, effect, modes, count, is_late, dalembert_tiny(m, *t), t, x, event);
}

/* Whether the guard jumps over its zero. Then a few roundings of the time lie between both sides, and no more. */
static inline int dalembert_jumps(dalembert_modes* m, size_t event, double t, const double* x) {
    dalembert_inputs_at(m, t, x, m->u);
    m->plant->guard_values(m->self, m->mode, x, m->u, t, m->g);
    m->plant->guard_rates(m->self, m->mode, x, m->u, t, m->rates);
    return m->g[event] > 2 * dalembert_tiny(m, t) * fabs(m->rates[event]);
}

/* A guard that is zero but for a rounding, on the wrong side, and rises: a mode accepts it an instant later, or a few, where the guard
 * rises from a rate that is zero itself. False, and nothing has changed, if none does without further events. */
static inline int dalembert_change_ahead(dalembert_modes* m, const unsigned* modes, size_t count, double* t, double* x, size_t* event) {
    const size_t n = m->plant->states;
    const unsigned as_before = m->mode;
    const double here = *t;
    double instant = dalembert_tiny(m, here);
    memcpy(m->after, x, n * sizeof(double));
    for (int tries = 0; tries < 7; ++tries, instant *= 8)
        for (size_t i = 0; i < count; ++i) {
            size_t next = DALEMBERT_NONE;
            const double ahead = here + instant;
            dalembert_go_on(m, modes[i], m->after, here + instant / 2, here, ahead, x);
            if (ahead > here && dalembert_all_finite(n, x) && dalembert_choose(m, modes + i, 1, ahead, x, 0, &next) &&
                next == DALEMBERT_NONE) {
                *t = ahead;
                *event = DALEMBERT_NONE;
                return 1;
            }
        }
    m->mode = as_before;
    memcpy(x, m->after, n * sizeof(double));
    return 0;
}

/* The effect on x, and a mode for it among `count` candidates; m->before is in front of it. */
static inline enum dalembert_status dalembert_change_once(dalembert_modes* m, const dalembert_effect* effect, size_t count, double* t,
                                                          double* x, size_t* next) {
    const dalembert_plant* const p = m->plant;
    const size_t n = p->states;
    const int is_jump = dalembert_jumps(m, effect->event, *t, x);
    memcpy(m->before, x, n * sizeof(double));
    dalembert_apply(m, effect, *t, x);
    const int is_finite = dalembert_all_finite(n, x);
    int is_found = is_finite && dalembert_choose(m, m->candidates, count, *t, x, 0, next);
    if (is_finite && (!is_found || *next != DALEMBERT_NONE))
        is_found = dalembert_change_behind_zero(m, effect, m->candidates, count, 0, is_jump, t, x, next) || is_found;
    if (is_finite && (is_found ? *next != DALEMBERT_NONE && m->kept->is_circle : !effect->is_end)) {
        const size_t others = p->transitions(effect->event, effect->from, dalembert_beside, m->others);
        /* Two frictions on one rate: where one lets go, the other holds. */
        if (is_found)
            (void)dalembert_change_ahead(m, m->others, others, t, x, next);
        else
            is_found = dalembert_choose(m, m->others, others, *t, x, 0, next);
    }
    if (!is_found && is_finite) is_found = dalembert_change_ahead(m, m->candidates, count, t, x, next);
    /* Two springs that meet a body at one position: between the two events stands a mode that only that position allows. */
    if (!is_found && is_finite) is_found = dalembert_change_behind_zero(m, effect, m->candidates, count, 1, is_jump, t, x, next);
    /* A switch opens, and the diode beside it takes its current over: it does so behind the zero. */
    if (!is_found && is_finite && !effect->is_end)
        is_found = dalembert_change_behind_zero(
            m, effect, m->others, p->transitions(effect->event, effect->from, dalembert_beside, m->others), 0, is_jump, t, x, next);
    if (!is_found) {
        memcpy(x, m->before, n * sizeof(double));
        m->mode = effect->from;
        return is_finite ? dalembert_no_mode : dalembert_not_finite;
    }
    if (m->on_change != NULL) m->on_change(m->context, *t, x, effect->event, effect->from, m->mode, effect->is_end);
    dalembert_inputs_at(m, *t, x, m->u);
    p->guard_rates(m->self, m->mode, x, m->u, *t, m->rates);
    m->departures[effect->event] = p->is_watched(m->mode, effect->event) ? m->rates[effect->event] : 0;
    return dalembert_good;
}

/* Within a step constraints hold as well as the step is exact. No mode may take what is left of them where a loop comes to rest, or where
 * the tolerance is large. */
static inline enum dalembert_status dalembert_change(dalembert_modes* m, const dalembert_effect* effect, size_t count, double* t, double* x,
                                                     size_t* next) {
    const enum dalembert_status status = dalembert_change_once(m, effect, count, t, x, next);
    if (status != dalembert_no_mode || !m->plant->is_projected) return status;
    (void)dalembert_project(m->plant, m->self, effect->from, *t, x, m->projection);
    return dalembert_change_once(m, effect, count, t, x, next);
}

static inline int dalembert_goes_on_after(const dalembert_modes* m, size_t event) {
    return m->plant->settle != NULL && m->plant->transitions(event, m->mode, dalembert_after_accumulation, m->others) > 0;
}

/* The guard rises from zero, but is back there before the time has changed. A reset would take it the wrong way. */
static inline int dalembert_is_too_soon(dalembert_modes* m, size_t event, double t, const double* x) {
    if (!dalembert_is_repeated(&m->times[event], dalembert_smallest(m->kept->span, t))) return 0;
    dalembert_inputs_at(m, t, x, m->u);
    m->plant->guard_rates(m->self, m->mode, x, m->u, t, m->rates);
    return m->rates[event] > 0;
}

/* The guard has risen no higher than its roundings: what the event is about was at rest all the time. */
static inline int dalembert_is_too_low(dalembert_modes* m, size_t event, double t, const double* x) {
    const dalembert_plant* const p = m->plant;
    if (!dalembert_goes_on_after(m, event) || !(m->departures[event] > 0) || !dalembert_is_repeated(&m->times[event], HUGE_VAL)) return 0;
    dalembert_inputs_at(m, t, x, m->u);
    p->guard_values(m->self, m->mode, x, m->u, t, m->g);
    const double here = m->g[event];
    double roundings = 0;
    memcpy(m->after, x, p->states * sizeof(double));
    for (size_t i = 0; i < p->states; ++i) {
        m->after[i] = x[i] + DBL_EPSILON * x[i];
        p->guard_values(m->self, m->mode, m->after, m->u, t, m->g);
        roundings += fabs(m->g[event] - here);
        m->after[i] = x[i];
    }
    return m->departures[event] * dalembert_last_interval(&m->times[event]) <= 4 * roundings;
}

/* An event that says what follows, and happens between any two times of the one that does not. */
static inline size_t dalembert_leader_of(const dalembert_modes* m, size_t event) {
    for (size_t e = 0; e < m->plant->events; ++e)
        if (e != event && dalembert_goes_on_after(m, e) && dalembert_is_between(&m->times[e], &m->times[event])) return e;
    return DALEMBERT_NONE;
}

/* Where the event accumulates, the run goes on at the time at which its intervals vanish. What accumulates at the same time, as in parts
 * of a machine that are alike, goes with it; so does what happens between, as friction that turns round at the top of each bounce. */
static inline enum dalembert_status dalembert_pass_accumulation(dalembert_modes* m, size_t happened, double* t, double* x, size_t* event) {
    const dalembert_plant* const p = m->plant;
    const dalembert_times* const times = &m->times[happened];
    const int is_stalled = dalembert_is_stalled(times);
    if (!dalembert_is_certain(times) || (dalembert_end_of_times(times) > m->limit && !is_stalled)) return dalembert_good;
    const double end = fmin(dalembert_end_of_times(times), m->limit);
    const size_t leader = dalembert_goes_on_after(m, happened) ? happened : dalembert_leader_of(m, happened);
    if (leader == DALEMBERT_NONE) return dalembert_accumulation;
    if (leader != happened && !dalembert_is_certain(&m->times[leader]) && !is_stalled) return dalembert_good;
    for (size_t e = 0; e < p->events; ++e) {
        const int is_certain = dalembert_is_certain(&m->times[e]);
        const double apart = fabs(dalembert_end_of_times(&m->times[e]) - end);
        m->is_over[e] =
            e == leader || (p->is_watched(m->mode, e) && dalembert_goes_on_after(m, e) && is_certain && apart <= dalembert_tiny(m, *t));
        m->is_ignored[e] = m->is_over[e] || e == happened || (is_certain && apart <= (end - *t) / 8 + dalembert_tiny(m, *t));
    }
    if (end > *t && m->coast != NULL && !m->coast(m->context, m->is_ignored, end, t, x)) return dalembert_good;
    dalembert_effect effect = {leader, m->mode, 1, 1};
    for (size_t e = 0; e < p->events; ++e) {
        if (!m->is_over[e]) continue;
        dalembert_forget_times(&m->times[e]);
        effect.event = e;
        effect.from = m->mode;
        const size_t count = p->transitions(e, m->mode, dalembert_after_accumulation, m->candidates);
        const enum dalembert_status status = dalembert_change(m, &effect, count, t, x, event);
        if (status != dalembert_good) return status;
        effect.settles = 0; /* all have settled with the first */
    }
    return dalembert_good;
}

/* Notes what happens. False if that is too much. */
static inline int dalembert_count_event(dalembert_modes* m, size_t event, double t) {
    dalembert_events_memory* const k = m->kept;
    k->stalled = k->last != DALEMBERT_NONE && !(t - k->last_time > 2 * dalembert_tiny(m, t)) ? k->stalled + 1 : 0;
    k->last_time = t;
    k->is_circle = k->stalled > 1 && k->before_last == event && k->before_last_mode == m->mode;
    k->before_last = k->last;
    k->before_last_mode = k->last_mode;
    m->last_event = k->last = event;
    k->last_mode = m->mode;
    dalembert_add_time(&m->times[event], t, dalembert_tiny(m, t), k->before_last == event);
    return m->changes++ < m->most_events && k->stalled <= 100 + m->plant->events;
}

/* Whether the run ends with the event. */
static inline int dalembert_is_last(const dalembert_modes* m, size_t event) {
    return m->plant->transitions(event, m->mode, dalembert_next, m->candidates) == 0;
}

/* An event at the same time as one that ends the run, with which the run goes on. A force that falls to zero just when its phase ends is
 * such a case: what counts is the phase that begins. */
static inline size_t dalembert_happens_too(dalembert_modes* m, size_t event, double t, const double* x) {
    const dalembert_plant* const p = m->plant;
    dalembert_inputs_at(m, t, x, m->u);
    p->guard_values(m->self, m->mode, x, m->u, t, m->g);
    p->guard_rates(m->self, m->mode, x, m->u, t, m->rates);
    for (size_t e = 0; e < p->events; ++e)
        if (e != event && p->is_watched(m->mode, e) && !dalembert_is_last(m, e) && m->rates[e] < 0 &&
            m->g[e] <= dalembert_tiny(m, t) * fabs(m->rates[e]))
            return e;
    return DALEMBERT_NONE;
}

static inline enum dalembert_status dalembert_pass_alone(dalembert_modes* m, double* t, double* x, size_t* event) {
    const size_t happened = *event;
    if (!dalembert_count_event(m, happened, *t)) return dalembert_event_storm;
    const size_t count = m->plant->transitions(happened, m->mode, dalembert_next, m->candidates);
    if (count == 0) return dalembert_range_left;
    *event = DALEMBERT_NONE;
    if (dalembert_is_too_soon(m, happened, *t, x) || dalembert_is_too_low(m, happened, *t, x)) {
        /* A friction in a loop turns round, and projection has left a rounding of its rate, on the wrong side. */
        if (!dalembert_goes_on_after(m, happened) && dalembert_leader_of(m, happened) == DALEMBERT_NONE) {
            m->others[0] = m->mode;
            if (dalembert_change_ahead(m, m->others, 1, t, x, event)) return dalembert_good;
        }
        m->times[happened].stalls = dalembert_enough_stalls; /* the interval that begins now is too short to be seen */
        return dalembert_pass_accumulation(m, happened, t, x, event);
    }
    const dalembert_effect effect = {happened, m->mode, 0, 0};
    const enum dalembert_status status = dalembert_change(m, &effect, count, t, x, event);
    return status == dalembert_good && *event == DALEMBERT_NONE ? dalembert_pass_accumulation(m, happened, t, x, event) : status;
}

/* An event happens now. Leaves the next one there, if that happens at once. */
static inline enum dalembert_status dalembert_pass(dalembert_modes* m, double* t, double* x, size_t* event) {
    size_t other = dalembert_is_last(m, *event) ? dalembert_happens_too(m, *event, *t, x) : DALEMBERT_NONE;
    if (other != DALEMBERT_NONE) {
        const enum dalembert_status status = dalembert_pass_alone(m, t, x, &other);
        if (status != dalembert_no_mode) {
            *event = other;
            return status;
        }
    }
    return dalembert_pass_alone(m, t, x, event);
}

#endif
