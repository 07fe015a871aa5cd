/* SPDX-License-Identifier: BSL-1.0 */
/* Events that accumulate: a ball bounces infinitely often before it rests, at intervals that shrink like a geometric sequence. The time
 * at which they vanish is the sum of the series. It is used when what is left of that sum is less than the root of a rounding of the
 * whole: then whatever makes the sequence only nearly geometric does no harm, and the rounding of times not yet. */
#ifndef DALEMBERT_ACCUMULATION_H
#define DALEMBERT_ACCUMULATION_H

#include <float.h>
#include <math.h>
#include <string.h>

/* Intervals that are taken together; times that are kept; and intervals in a row that are too short to be seen. */
enum { dalembert_most_intervals = 8, dalembert_kept_times = 3 * dalembert_most_intervals + 1, dalembert_enough_stalls = 3 };

/* The times of one event. */
typedef struct dalembert_accumulation_of {
    double times[dalembert_kept_times];
    int newest, count; /* `count` events in a row whose intervals do not grow */
    int stalls;        /* in a row */
    int has_sum;       /* the end was near, and known: */
    double sum;        /* where it was, */
    double origin;     /* and where the sequence began */
    double begin;
} dalembert_times;

static inline double dalembert_time_ago(const dalembert_times* a, int ago) {
    return a->times[(a->newest + dalembert_kept_times - ago) % dalembert_kept_times];
}

/* The length of a block of intervals, of which `size` are taken together. */
static inline double dalembert_time_block(const dalembert_times* a, int ago, int size) {
    return dalembert_time_ago(a, ago * size) - dalembert_time_ago(a, (ago + 1) * size);
}

/* How many intervals make a block that is at most half of the one before: with ratios next to one the sum would be known badly. */
static inline int dalembert_block_size(const dalembert_times* a) {
    int size = 1;
    while (2 * size <= dalembert_most_intervals && a->count > 6 * size &&
           2 * dalembert_time_block(a, 0, size) > dalembert_time_block(a, 1, size))
        size *= 2;
    return size;
}

static inline int dalembert_is_steady(const dalembert_times* a) {
    if (a->count < 4) return 0;
    const int size = dalembert_block_size(a);
    const double last = dalembert_time_block(a, 0, size), before = dalembert_time_block(a, 1, size),
                 first = dalembert_time_block(a, 2, size);
    if (!(last > 0 && last < before && before < first)) return 0;
    const double ratio = last / before;
    return fabs(ratio - before / first) <= fmin(ratio, 1 - ratio) / 8;
}

static inline double dalembert_time_remaining(const dalembert_times* a) {
    const int size = dalembert_block_size(a);
    const double last = dalembert_time_block(a, 0, size);
    return last * last / (dalembert_time_block(a, 1, size) - last);
}

/* The event happens at t; `again`: the last event was the same one. `instant` is the time that counts as none. */
static inline void dalembert_add_time(dalembert_times* a, double t, double instant, int again) {
    const double interval = t - dalembert_time_ago(a, 0);
    /* Where a place has roundings, the last bounces are no shorter than these allow. Longer ones begin anew. */
    if (a->count > 0 && interval > (t - a->origin) / 10000) a->has_sum = 0;
    a->stalls = again && a->count > 0 && interval <= instant ? a->stalls + 1 : 0;
    /* Two of the same length, but for rounding, may belong to a ratio next to one. */
    if (a->count > 1 && interval > dalembert_time_ago(a, 0) - dalembert_time_ago(a, 1) + instant) {
        a->begin = dalembert_time_ago(a, 0);
        a->count = 1;
    }
    if (a->count == 0) a->begin = t;
    a->newest = (a->newest + 1) % dalembert_kept_times;
    a->times[a->newest] = t;
    if (a->count < 1000) ++a->count; /* more say nothing new */
    if (dalembert_is_steady(a) && dalembert_time_remaining(a) <= (t - a->begin) / 1000) {
        if (!a->has_sum) a->origin = a->begin;
        a->has_sum = 1;
        a->sum = t + dalembert_time_remaining(a);
    }
}

static inline void dalembert_forget_times(dalembert_times* a) { a->count = a->stalls = a->has_sum = 0; }

/* Too close together to be told apart, or beyond the sum that they had while they shrank steadily. */
static inline int dalembert_is_stalled(const dalembert_times* a) {
    return a->stalls >= dalembert_enough_stalls || (a->has_sum && !dalembert_is_steady(a) && dalembert_time_ago(a, 0) >= a->sum);
}

/* Whether the end is near enough to be believed. */
static inline int dalembert_is_certain(const dalembert_times* a) {
    return dalembert_is_stalled(a) ||
           (dalembert_is_steady(a) && dalembert_time_remaining(a) <= sqrt(DBL_EPSILON) * (dalembert_time_ago(a, 0) - a->begin));
}

static inline double dalembert_last_interval(const dalembert_times* a) { return dalembert_time_ago(a, 0) - dalembert_time_ago(a, 1); }
/* Whether the last two are no further apart than `longest`. */
static inline int dalembert_is_repeated(const dalembert_times* a, double longest) {
    return a->count > 1 && dalembert_last_interval(a) <= longest;
}

/* Whether it has happened between the last two times of the other one. */
static inline int dalembert_is_between(const dalembert_times* a, const dalembert_times* other) {
    return a->count > 1 && other->count > 1 && dalembert_time_ago(a, 0) >= dalembert_time_ago(other, 1) &&
           dalembert_time_ago(a, 0) <= dalembert_time_ago(other, 0);
}

/* The time at which the intervals vanish, in s. */
static inline double dalembert_end_of_times(const dalembert_times* a) {
    return dalembert_is_steady(a) ? dalembert_time_ago(a, 0) + dalembert_time_remaining(a) : dalembert_time_ago(a, 0);
}

#endif
