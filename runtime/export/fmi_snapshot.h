/* SPDX-License-Identifier: BSL-1.0 */
/* The whole state of an instance in one block without pointers: to return to, and to store. */
#ifndef DALEMBERT_FMI_SNAPSHOT_H
#define DALEMBERT_FMI_SNAPSHOT_H

#include "fmi_machine.h"

typedef struct fmi_snapshot {
    uint64_t kind;  /* of the FMU and its type */
    uint64_t check; /* of all that follows */
    uint64_t phase, mode, flags;
    double start, stop, tolerance, t;
} fmi_snapshot; /* then x, given, u, p, what indicators count from, is_given; then the modes or the run */

/* FNV-1a (Fowler, Noll, Vo), 64 bits. */
static uint64_t fmi_hash(uint64_t hash, const void* bytes, size_t count) {
    for (size_t i = 0; i < count; ++i) hash = (hash ^ ((const unsigned char*)bytes)[i]) * UINT64_C(1099511628211);
    return hash;
}
#define FMI_HASH_START UINT64_C(14695981039346656037)

static uint64_t fmi_snapshot_kind(const fmi_machine* m) {
    const uint64_t token = fmi_hash(FMI_HASH_START, FMI_TOKEN, sizeof FMI_TOKEN);
    return fmi_hash(token, m->run ? "step" : "exchange", 4);
}

static size_t fmi_snapshot_numbers(const fmi_machine* m) {
    return 2 * m->plant->states + m->plant->inputs + m->plant->parameters + dalembert_event_values(m->plant);
}
/* Flags of states fill whole numbers, so that what lies behind them is aligned. */
static size_t fmi_snapshot_flags(const fmi_machine* m) { return (m->plant->states + 7) / 8 * 8; }

static size_t fmi_snapshot_size(const fmi_machine* m) {
    const size_t inside = m->run ? dalembert_run_saved_size(m->run) : dalembert_modes_saved_size(m->modes);
    return sizeof(fmi_snapshot) + fmi_snapshot_numbers(m) * sizeof(double) + fmi_snapshot_flags(m) + inside;
}

static uint64_t fmi_snapshot_check(const fmi_machine* m, const void* block) {
    const size_t skipped = offsetof(fmi_snapshot, phase);
    return fmi_hash(FMI_HASH_START, (const char*)block + skipped, fmi_snapshot_size(m) - skipped);
}

static char* fmi_copy_out(char* to, const void* from, size_t bytes) {
    if (bytes > 0) memcpy(to, from, bytes);
    return to + bytes;
}
static const char* fmi_copy_in(void* to, const char* from, size_t bytes) {
    if (bytes > 0) memcpy(to, from, bytes);
    return from + bytes;
}

static void fmi_save(const fmi_machine* m, void* block) {
    const dalembert_plant* plant = m->plant;
    fmi_snapshot head;
    memset(block, 0, fmi_snapshot_size(m));
    memset(&head, 0, sizeof head);
    head.kind = fmi_snapshot_kind(m);
    head.phase = (uint64_t)m->phase;
    head.mode = m->mode;
    head.flags = (m->is_consistent ? 1u : 0u) | (m->is_disturbed ? 2u : 0u) | (m->is_over ? 4u : 0u);
    head.start = m->start, head.stop = m->stop, head.tolerance = m->tolerance, head.t = m->t;
    char* to = (char*)block + sizeof head;
    to = fmi_copy_out(to, m->x, plant->states * sizeof(double));
    to = fmi_copy_out(to, m->given, plant->states * sizeof(double));
    to = fmi_copy_out(to, m->u, plant->inputs * sizeof(double));
    to = fmi_copy_out(to, m->p, plant->parameters * sizeof(double));
    to = fmi_copy_out(to, m->behind, dalembert_event_values(plant) * sizeof(double));
    fmi_copy_out(to, m->is_given, plant->states);
    to += fmi_snapshot_flags(m);
    if (m->run) dalembert_run_save(m->run, to);
    else dalembert_modes_save(m->modes, to);
    memcpy(block, &head, sizeof head);
    head.check = fmi_snapshot_check(m, block);
    memcpy(block, &head, sizeof head);
}

/* Whether a block is the state of an instance of this FMU and type: only then it has the size of one. */
static int fmi_has_kind(const fmi_machine* m, const void* block) {
    fmi_snapshot head;
    memcpy(&head, block, sizeof head);
    return head.kind == fmi_snapshot_kind(m);
}

/* And was not damaged. */
static int fmi_is_snapshot(const fmi_machine* m, const void* block) {
    fmi_snapshot head;
    memcpy(&head, block, sizeof head);
    return fmi_has_kind(m, block) && head.check == fmi_snapshot_check(m, block);
}

static void fmi_load(fmi_machine* m, const void* block) {
    const dalembert_plant* plant = m->plant;
    fmi_snapshot head;
    memcpy(&head, block, sizeof head);
    m->phase = (enum fmi_phase)head.phase;
    m->mode = (unsigned)head.mode;
    m->is_consistent = (head.flags & 1u) != 0;
    m->is_disturbed = (head.flags & 2u) != 0;
    m->is_over = (head.flags & 4u) != 0;
    m->start = head.start, m->stop = head.stop, m->tolerance = head.tolerance, m->t = head.t;
    m->known = 0;
    const char* from = (const char*)block + sizeof head;
    from = fmi_copy_in(m->x, from, plant->states * sizeof(double));
    from = fmi_copy_in(m->given, from, plant->states * sizeof(double));
    from = fmi_copy_in(m->u, from, plant->inputs * sizeof(double));
    from = fmi_copy_in(m->p, from, plant->parameters * sizeof(double));
    from = fmi_copy_in(m->behind, from, dalembert_event_values(plant) * sizeof(double));
    fmi_copy_in(m->is_given, from, plant->states);
    from += fmi_snapshot_flags(m);
    plant->set_parameters(m->self, m->p);
    if (m->run) {
        if (m->tolerance > 0.0) m->run->options.tolerance = m->tolerance;
        dalembert_run_load(m->run, from);
    } else {
        dalembert_modes_load(m->modes, from);
    }
}

/* The functions of both standards. */
static fmi_status fmi_get_snapshot(const fmi_machine* m, void** place, const char* function) {
    if (!place) return fmi_say_of(m, fmi_error, function, "no place for the state is given");
    if (*place && !fmi_has_kind(m, *place)) return fmi_say_of(m, fmi_error, function, "the state to be replaced is that of another type");
    if (!*place) *place = malloc(fmi_snapshot_size(m));
    if (!*place) return fmi_say_of(m, fmi_error, function, "there is no memory");
    fmi_save(m, *place);
    return fmi_ok;
}

static fmi_status fmi_set_snapshot(fmi_machine* m, const void* block, const char* function) {
    if (!block || !fmi_is_snapshot(m, block)) return fmi_say_of(m, fmi_error, function, "this is not a state of such an instance");
    fmi_load(m, block);
    return fmi_ok;
}

static fmi_status fmi_serialise(const fmi_machine* m, const void* block, void* bytes, size_t count, const char* function) {
    if (!block || !fmi_has_kind(m, block) || !bytes || count < fmi_snapshot_size(m))
        return fmi_say_of(m, fmi_error, function, "the state or enough room for it is missing");
    memcpy(bytes, block, fmi_snapshot_size(m));
    return fmi_ok;
}

static fmi_status fmi_deserialise(const fmi_machine* m, const void* bytes, size_t count, void** place, const char* function) {
    if (!place || !bytes || count != fmi_snapshot_size(m)) return fmi_say_of(m, fmi_error, function, "the bytes are not those of a state");
    void* block = malloc(count);
    if (!block) return fmi_say_of(m, fmi_error, function, "there is no memory");
    memcpy(block, bytes, count);
    if (!fmi_is_snapshot(m, block)) {
        free(block);
        return fmi_say_of(m, fmi_error, function, "the bytes are not those of a state");
    }
    *place = block; /* what stood there belongs to the importer, or is nothing */
    return fmi_ok;
}

#endif
