/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run_in_c.h"

#include "dalembert_run.h"

/* A run with its own instance of the plant, and where its events go. */
typedef struct one_run {
    const dalembert_plant* plant;
    void* self;
    dalembert_run* run;
    made_run* made;
} one_run;

static void inputs_of_run(void* context, double t, const double* x, double* u) {
    const one_run* const one = (const one_run*)context;
    one->plant->inputs_of_run(one->self, x, t, u);
}

static void note_event(void* context, dalembert_run* run, double t, size_t event, unsigned before, unsigned after) {
    made_run* const made = ((one_run*)context)->made;
    if (made == NULL || event >= run->plant->events || made->event_count >= most_events_in_c) return;
    const event_in_c noted = {t, event, before, after};
    made->events[made->event_count++] = noted;
}

static void open_run(one_run* one, const wished_run* wish, made_run* made) {
    one->plant = wish->plant;
    one->made = made;
    one->self = wish->plant->create();
    wish->plant->set_parameters(one->self, wish->parameters);
    one->run = dalembert_run_new(wish->plant, one->self);
    if (one->run == NULL) abort();
    one->run->options.method = (enum dalembert_method)wish->method;
    one->run->options.tolerance = wish->tolerance;
    one->run->options.longest_step = wish->longest_step;
    one->run->options.stops = wish->stops;
    one->run->options.stop_count = wish->stop_count;
    one->run->context = one;
    one->run->on_event = note_event;
    if (wish->plant->inputs_of_run != NULL) {
        one->run->inputs.function = inputs_of_run;
        one->run->inputs.context = one;
    }
}

static void close_run(one_run* one) {
    dalembert_run_free(one->run);
    one->plant->destroy(one->self);
}

static double end_of_part(const wished_run* wish, int part) {
    return part + 1 == wish->parts ? wish->until : wish->until * (part + 1) / wish->parts;
}

void make_run(const wished_run* wish, made_run* made, double* x) {
    one_run one;
    memset(made, 0, sizeof(*made));
    open_run(&one, wish, made);
    enum dalembert_status status = dalembert_run_start(one.run, 0, wish->until, wish->start);
    for (int part = 0; part < wish->parts && status == dalembert_good; ++part) {
        status = dalembert_run_to(one.run, end_of_part(wish, part));
        if (!wish->reloads || status != dalembert_good) continue;
        one_run other;
        open_run(&other, wish, made);
        const size_t size = dalembert_run_saved_size(one.run);
        void* const block = malloc(size);
        if (block == NULL) abort();
        dalembert_run_save(one.run, block);
        dalembert_run_load(other.run, block);
        free(block);
        close_run(&one);
        one = other;
        one.run->context = one.run->inputs.context = NULL;
        one.run->context = &one;
        one.run->inputs.context = &one;
    }
    made->status = (int)status;
    made->t = one.run->t;
    made->mode = one.run->mode;
    made->steps = one.run->steps;
    made->rejected = one.run->rejected;
    made->rhs_calls = one.run->rhs_calls;
    made->implicit_steps = one.run->implicit_steps;
    made->last_event = one.run->last_event;
    dalembert_run_message(one.run, status, made->message, sizeof(made->message));
    memcpy(x, one.run->x, wish->plant->states * sizeof(double));
    close_run(&one);
}

int make_two_runs(const wished_run* wish, const double* x) {
    one_run runs[2];
    int is_same = 1;
    enum dalembert_status status[2];
    for (int i = 0; i < 2; ++i) {
        open_run(&runs[i], wish, NULL);
        status[i] = dalembert_run_start(runs[i].run, 0, wish->until, wish->start);
    }
    for (int part = 0; part < wish->parts; ++part)
        for (int i = 0; i < 2; ++i)
            if (status[i] == dalembert_good) status[i] = dalembert_run_to(runs[i].run, end_of_part(wish, part));
    for (int i = 0; i < 2; ++i) {
        is_same = is_same && memcmp(runs[i].run->x, x, wish->plant->states * sizeof(double)) == 0;
        close_run(&runs[i]);
    }
    return is_same;
}

/* States within steps, beside those of a run that ends there. */
typedef struct looks {
    const dalembert_plant* plant;
    one_run other;
    double *x, largest, before;
    int count;
} looks;

static int look_within(void* context, dalembert_run* run) {
    looks* const l = (looks*)context;
    const double before = l->before, t = before + 0.6 * (run->t - before);
    l->before = run->t;
    if (++l->count % 10 != 5) return 0;
    dalembert_run_between(run, t, l->x);
    if (dalembert_run_to(l->other.run, t) != dalembert_good) return 1;
    for (size_t i = 0; i < run->plant->states; ++i) {
        const double size = fmax(run->scale[i], fabs(l->x[i]));
        l->largest = fmax(l->largest, fabs(l->x[i] - l->other.run->x[i]) / size);
    }
    return 0;
}

double difference_within(const wished_run* wish) {
    one_run one;
    looks l;
    memset(&l, 0, sizeof(l));
    open_run(&one, wish, NULL);
    open_run(&l.other, wish, NULL);
    l.plant = wish->plant;
    l.x = (double*)malloc(wish->plant->states * sizeof(double));
    if (l.x == NULL) abort();
    one.run->on_event = NULL;
    one.run->on_step = look_within;
    one.run->inputs.context = &one;
    l.other.run->inputs.context = &l.other;
    one.run->context = &l;
    l.other.run->context = &l.other;
    if (dalembert_run_start(l.other.run, 0, wish->until, wish->start) == dalembert_good &&
        dalembert_run_start(one.run, 0, wish->until, wish->start) == dalembert_good)
        (void)dalembert_run_to(one.run, wish->until);
    free(l.x);
    close_run(&one);
    close_run(&l.other);
    return l.largest;
}

/* An importer of a model: states, time, and the values that it watches. */
typedef struct importer {
    one_run one;
    dalembert_modes* modes;
    size_t n, watched;
    double t, *x, *next, *z, *next_z, *k[4], *y, *u;
} importer;

static void note_change(void* context, double t, const double* x, size_t event, unsigned before, unsigned after, int is_end) {
    made_run* const made = ((importer*)context)->one.made;
    (void)x;
    (void)is_end;
    if (made->event_count >= most_events_in_c) return;
    const event_in_c noted = {t, event, before, after};
    made->events[made->event_count++] = noted;
}

static void rates_of(importer* m, double t, const double* x, double* dxdt) {
    dalembert_inputs_at(m->modes, t, x, m->u);
    m->one.plant->rhs(m->one.self, m->modes->mode, x, m->u, t, dxdt);
}

/* A step of h to m->next. */
static void runge_kutta(importer* m, double h) {
    static const double at[] = {0, 0.5, 0.5, 1};
    for (int s = 0; s < 4; ++s) {
        for (size_t i = 0; i < m->n; ++i) m->y[i] = m->x[i] + (s > 0 ? h * at[s] * m->k[s - 1][i] : 0);
        rates_of(m, m->t + at[s] * h, m->y, m->k[s]);
    }
    for (size_t i = 0; i < m->n; ++i) m->next[i] = m->x[i] + h / 6 * (m->k[0][i] + 2 * (m->k[1][i] + m->k[2][i]) + m->k[3][i]);
    dalembert_modes_values(m->modes, m->t + h, m->next, m->next_z);
}

static int has_crossed(const importer* m) {
    const size_t events = m->one.plant->modes > 0 ? m->one.plant->events : 0;
    for (size_t i = 0; i < m->watched; ++i)
        if (i < events ? m->next_z[i] < 0 : (m->z[i] > 0) != (m->next_z[i] > 0)) return 1;
    return 0;
}

/* To `end`, or a little behind the first change of a sign. */
static int step_to(importer* m, double end) {
    double near = 0, far = end - m->t;
    runge_kutta(m, far);
    const int crossed = has_crossed(m);
    while (crossed && far - near > 4 * DBL_EPSILON * fmax(1e-3, fabs(m->t))) {
        const double middle = near + (far - near) / 2;
        runge_kutta(m, middle);
        *(has_crossed(m) ? &far : &near) = middle;
    }
    if (crossed) runge_kutta(m, far);
    memcpy(m->x, m->next, m->n * sizeof(double));
    m->t = crossed ? m->t + far : end;
    return crossed;
}

void make_exchange(const wished_run* wish, int steps, made_run* made, double* x) {
    importer m;
    memset(&m, 0, sizeof(m));
    memset(made, 0, sizeof(*made));
    open_run(&m.one, wish, made);
    m.n = wish->plant->states;
    m.watched = dalembert_event_values(wish->plant);
    m.modes = dalembert_modes_new(wish->plant, m.one.self);
    double** const arrays[] = {&m.next, &m.y, &m.k[0], &m.k[1], &m.k[2], &m.k[3], &m.z, &m.next_z, &m.u};
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
        *arrays[i] = (double*)calloc(m.n + m.watched + wish->plant->inputs + 1, sizeof(double));
    if (m.modes == NULL) abort();
    m.x = x;
    memcpy(x, wish->start, m.n * sizeof(double));
    m.modes->inputs = m.one.run->inputs;
    m.modes->context = &m;
    m.modes->on_change = note_change;
    enum dalembert_status status = dalembert_modes_begin(m.modes, 0, wish->until, x);
    size_t stop = 0;
    for (int i = 0; i < steps && status == dalembert_good;) {
        double end = i + 1 == steps ? wish->until : wish->until * (i + 1) / steps;
        while (stop < wish->stop_count && wish->stops[stop] <= m.t) ++stop;
        const int is_stop = stop < wish->stop_count && wish->stops[stop] <= end;
        if (is_stop) end = wish->stops[stop];
        dalembert_modes_values(m.modes, m.t, x, m.z);
        const int crossed = step_to(&m, end);
        if (!crossed && !is_stop) ++i;
        if (is_stop && !crossed) m.t = end * (1 + DBL_EPSILON); /* inputs have jumped */
        double t = m.t;
        if (crossed || is_stop) status = dalembert_modes_event(m.modes, &t, x);
    }
    made->status = (int)status;
    made->t = m.t;
    made->mode = m.modes->mode;
    dalembert_modes_free(m.modes);
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i) free(*arrays[i]);
    close_run(&m.one);
}

double dop853_coefficient(size_t i) {
    const size_t count = sizeof(dalembert_dop853_terms) / sizeof(dalembert_dop853_terms[0]);
    return i < count ? dalembert_dop853_terms[i].factor : i < count + 16 ? dalembert_dop853_times[i - count] : sqrt(-1.0);
}

double rodas5p_coefficient(size_t i) {
    const double* const tables[] = {&dalembert_rodas5p_gamma, dalembert_rodas5p_a[0],     dalembert_rodas5p_c[0],
                                    dalembert_rodas5p_times,  dalembert_rodas5p_gradient, dalembert_rodas5p_dense[0]};
    static const size_t sizes[] = {1, 30, 56, 8, 8, 24};
    for (size_t k = 0; k < 6; i -= sizes[k++])
        if (i < sizes[k]) return tables[k][i];
    return sqrt(-1.0);
}
