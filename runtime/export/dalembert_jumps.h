/* SPDX-License-Identifier: BSL-1.0 */
/* Kinks and jumps that come at times of their own, as those of a pattern of pulses: the plant has functions of time that change their signs
 * there. Steps that watch values at their ends alone would go across two of them without a word. */
#ifndef DALEMBERT_JUMPS_H
#define DALEMBERT_JUMPS_H

#include "dalembert_modes_calls.h"

/* The sign of a function of time; of what is no number, 0. Leaves the values of all in m->s. */
static inline int dalembert_time_sign(dalembert_modes* m, size_t k, double t, const double* x) {
    dalembert_inputs_at(m, t, x, m->u);
    m->plant->time_switch_values(m->self, m->mode, x, m->u, t, m->s);
    return m->s[k] > 0 ? 1 : m->s[k] < 0 ? -1 : 0;
}

/* The last time between the two with the sign, to a part of `room`. */
static inline double dalembert_last_with_sign(dalembert_modes* m, size_t k, const double* x, int sign, double with, double without,
                                              double room) {
    while (without - with > room / 4) {
        const double middle = with + (without - with) / 2;
        if (!(middle > with && middle < without)) break;
        if (dalembert_time_sign(m, k, middle, x) == sign)
            with = middle;
        else
            without = middle;
    }
    return with;
}

/* The first change of a function's sign further than `room` behind t; where there is none, the end of the search: `limit`, or what comes
 * before after a million looks. */
static inline double dalembert_next_of_function(dalembert_modes* m, size_t k, double t, const double* x, double limit, double room) {
    const double most_looks = 1e6, half_turn = 3.141592653589793;
    int sign = dalembert_time_sign(m, k, t, x);
    const double turns = m->s[m->plant->time_switches + k] * (limit - t) / half_turn;
    /* At least four looks in each half turn. A rate that is no number says nothing. */
    const double wanted = turns > 1 ? ceil(4 * turns) : 4, looks = fmin(wanted, most_looks);
    const double end = looks < wanted ? fmax(t + (limit - t) * (looks / wanted), t + 2 * room) : limit;
    double last = t;
    for (double i = 1; i <= looks; ++i) {
        const double look = i < looks ? t + (end - t) * (i / looks) : end;
        const int now = dalembert_time_sign(m, k, look, x);
        if (now != sign && sign != 0) {
            const double change = dalembert_last_with_sign(m, k, x, sign, last, look, room);
            if (change - t > room) return change;
        }
        sign = now;
        last = look;
    }
    return end;
}

/* The next time behind t at which a function of time changes its sign, with x and the inputs as they are; `limit` where there is none
 * before that. A time at which a long search ends counts as one, so that the next one begins there. `room`: how far two times must be apart. From just before a change one goes on `room` behind it: there others that depend on it
 * have their new signs. Plants without such functions: limit. */
static inline double dalembert_next_jump(dalembert_modes* m, double t, const double* x, double limit, double room) {
    /* What stands inside another comes first: up to its next change the other is smooth. */
    for (size_t k = 0; k < m->plant->time_switches && limit - t > room; ++k)
        limit = dalembert_next_of_function(m, k, t, x, limit, room);
    return limit;
}

#endif
