/* SPDX-License-Identifier: BSL-1.0 */
/* The Runge-Kutta method of Dormand and Prince of order 8 with error estimates of orders 5 and 3 and dense output of order 7: Hairer,
 * Norsett, Wanner: Solving Ordinary Differential Equations I, 2nd edition, sections II.5, II.6 and II.10. A step costs twelve calls of
 * the right-hand side, its dense output three more, made when something asks for a state within it. */
#ifndef DALEMBERT_DOP853_H
#define DALEMBERT_DOP853_H

#include "dalembert_control.h"

/* A term of a weighted sum of the derivatives of stages, which count from 0. */
typedef struct dalembert_dop853_term {
    int stage;
    double factor;
} dalembert_dop853_term;

/* Rows 2 to 16 give the stages, where row 13 is the step itself; 17 is a result of order 3, 18 the result less one of order 5, and 19 to
 * 22 are the terms of the dense output behind those of Hermite's cubic. */
enum { dalembert_dop853_result = 13, dalembert_dop853_third = 17, dalembert_dop853_fifth = 18, dalembert_dop853_dense = 19 };

static const dalembert_dop853_term dalembert_dop853_terms[] = {
    {0, 0.05260015195876773},      {0, 0.0197250569845379},       {1, 0.0591751709536137},
    {0, 0.02958758547680685},      {2, 0.08876275643042054},      {0, 0.2413651341592667},
    {2, -0.8845494793282861},      {3, 0.924834003261792},        {0, 0.037037037037037035},
    {3, 0.17082860872947386},      {4, 0.12546768756682242},      {0, 0.037109375},
    {3, 0.17025221101954405},      {4, 0.06021653898045596},      {5, -0.017578125},
    {0, 0.03709200011850479},      {3, 0.17038392571223998},      {4, 0.10726203044637328},
    {5, -0.015319437748624402},    {6, 0.008273789163814023},     {0, 0.6241109587160757},
    {3, -3.3608926294469414},      {4, -0.868219346841726},       {5, 27.59209969944671},
    {6, 20.154067550477894},       {7, -43.48988418106996},       {0, 0.47766253643826434},
    {3, -2.4881146199716677},      {4, -0.590290826836843},       {5, 21.230051448181193},
    {6, 15.279233632882423},       {7, -33.28821096898486},       {8, -0.020331201708508627},
    {0, -0.9371424300859873},      {3, 5.186372428844064},        {4, 1.0914373489967295},
    {5, -8.149787010746927},       {6, -18.52006565999696},       {7, 22.739487099350505},
    {8, 2.4936055526796523},       {9, -3.0467644718982196},      {0, 2.273310147516538},
    {3, -10.53449546673725},       {4, -2.0008720582248625},      {5, -17.9589318631188},
    {6, 27.94888452941996},        {7, -2.8589982771350235},      {8, -8.87285693353063},
    {9, 12.360567175794303},       {10, 0.6433927460157636},      {0, 0.054293734116568765},
    {5, 4.450312892752409},        {6, 1.8915178993145003},       {7, -5.801203960010585},
    {8, 0.3111643669578199},       {9, -0.1521609496625161},      {10, 0.20136540080403034},
    {11, 0.04471061572777259},     {0, 0.056167502283047954},     {6, 0.25350021021662483},
    {7, -0.2462390374708025},      {8, -0.12419142326381637},     {9, 0.15329179827876568},
    {10, 0.00820105229563469},     {11, 0.007567897660545699},    {12, -0.008298},
    {0, 0.03183464816350214},      {5, 0.028300909672366776},     {6, 0.053541988307438566},
    {7, -0.05492374857139099},     {10, -0.00010834732869724932}, {11, 0.0003825710908356584},
    {12, -0.00034046500868740456}, {13, 0.1413124436746325},      {0, -0.42889630158379194},
    {5, -4.697621415361164},       {6, 7.683421196062599},        {7, 4.06898981839711},
    {8, 0.3567271874552811},       {12, -0.0013990241651590145},  {13, 2.9475147891527724},
    {14, -9.15095847217987},       {0, 0.2440944881889764},       {8, 0.7338466882816118},
    {11, 0.022058823529411766},    {0, 0.01312004499419488},      {5, -1.2251564463762044},
    {6, -0.4957589496572502},      {7, 1.6643771824549864},       {8, -0.35032884874997366},
    {9, 0.3341791187130175},       {10, 0.08192320648511571},     {11, -0.022355307863886294},
    {0, -8.428938276109013},       {5, 0.5667149535193777},       {6, -3.0689499459498917},
    {7, 2.38466765651207},         {8, 2.117034582445028},        {9, -0.871391583777973},
    {10, 2.2404374302607883},      {11, 0.6315787787694688},      {12, -0.08899033645133331},
    {13, 18.148505520854727},      {14, -9.194632392478356},      {15, -4.436036387594894},
    {0, 10.427508642579134},       {5, 242.28349177525817},       {6, 165.20045171727028},
    {7, -374.5467547226902},       {8, -22.113666853125306},      {9, 7.733432668472264},
    {10, -30.674084731089398},     {11, -9.332130526430229},      {12, 15.697238121770845},
    {13, -31.139403219565178},     {14, -9.35292435884448},       {15, 35.81684148639408},
    {0, 19.985053242002433},       {5, -387.0373087493518},       {6, -189.17813819516758},
    {7, 527.8081592054236},        {8, -11.57390253995963},       {9, 6.8812326946963},
    {10, -1.0006050966910838},     {11, 0.7777137798053443},      {12, -2.778205752353508},
    {13, -60.19669523126412},      {14, 84.32040550667716},       {15, 11.99229113618279},
    {0, -25.69393346270375},       {5, -154.18974869023643},      {6, -231.5293791760455},
    {7, 357.6391179106141},        {8, 93.40532418362432},        {9, -37.45832313645163},
    {10, 104.0996495089623},       {11, 29.8402934266605},        {12, -43.53345659001114},
    {13, 96.32455395918828},       {14, -39.17726167561544},      {15, -149.72683625798564},
};
/* The first term of each row; that of the row behind is the end. */
static const int dalembert_dop853_rows[] = {0, 0, 0, 1, 3, 5, 8, 11, 15, 20, 26, 33, 41, 50, 58, 66, 74, 82, 85, 93, 105, 117, 129, 141};
static const double dalembert_dop853_times[] = {0.0,
                                                0.05260015195876773,
                                                0.0789002279381516,
                                                0.1183503419072274,
                                                0.2816496580927726,
                                                0.3333333333333333,
                                                0.25,
                                                0.3076923076923077,
                                                0.6512820512820513,
                                                0.6,
                                                0.8571428571428571,
                                                1.0,
                                                1.0,
                                                0.1,
                                                0.2,
                                                0.7777777777777778};

/* The weighted sum of a row, added to `sum`, which begins as zero. */
static inline void dalembert_dop853_sum(const dalembert_inside* in, size_t n, int row, double* sum) {
    for (size_t i = 0; i < n; ++i) sum[i] = 0;
    for (int e = dalembert_dop853_rows[row]; e < dalembert_dop853_rows[row + 1]; ++e) {
        const double factor = dalembert_dop853_terms[e].factor;
        const double* const k = in->k[dalembert_dop853_terms[e].stage];
        for (size_t i = 0; i < n; ++i) sum[i] += factor * k[i];
    }
}

static inline void dalembert_dop853_stage(dalembert_run* run, const dalembert_point* from, const dalembert_candidate* c, int row) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    dalembert_dop853_sum(in, n, row, in->stage);
    for (size_t i = 0; i < n; ++i) in->stage[i] = from->x[i] + c->length * in->stage[i];
    dalembert_rate(run, in->stage, row == 12 ? c->end : from->t + dalembert_dop853_times[row - 1] * c->length, in->k[row - 1]);
}

/* Equation (10.17): of the estimates of orders 5 and 3 that which shrinks like h^8, here state by state. */
static inline double dalembert_dop853_error(double fifth, double third) {
    const double a = fabs(fifth), b = fabs(third) / 10;
    const double largest = fmax(a, b), unit = largest > 0 ? largest : 1; /* so that no square vanishes */
    const double p = a / unit, q = b / unit, root = sqrt(p * p + q * q);
    return a * p / (root < 1 ? 1 : root);
}

/* The last stage of a step is the first of the next. */
static inline void dalembert_dop853_take(dalembert_run* run, const dalembert_point* from, dalembert_candidate* c) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    in->is_dense = 0;
    memcpy(in->k[0], from->dxdt, n * sizeof(double));
    for (int row = 2; row <= 12; ++row) dalembert_dop853_stage(run, from, c, row);
    dalembert_dop853_sum(in, n, dalembert_dop853_result, in->stage);
    dalembert_dop853_sum(in, n, dalembert_dop853_fifth, c->error);
    dalembert_dop853_sum(in, n, dalembert_dop853_third, c->dydt);
    for (size_t i = 0; i < n; ++i) {
        c->y[i] = from->x[i] + c->length * in->stage[i];
        c->error[i] = dalembert_dop853_error(c->length * c->error[i], c->length * (in->stage[i] - c->dydt[i]));
    }
    dalembert_rate(run, c->y, c->end, c->dydt);
    c->has_derivative = 1;
    c->is_finite = dalembert_all_finite(n, c->y) && dalembert_all_finite(n, c->error) && dalembert_all_finite(n, c->dydt);
}

/* With s from 0 to 1 and r = 1 - s: x + s (a + r (b + s (c + r (d0 + s (d1 + r (d2 + s d3)))))); without d it is Hermite's cubic. */
static inline void dalembert_dop853_between(dalembert_run* run, const dalembert_point* from, const dalembert_candidate* c, double t,
                                            double* x) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    if (!in->is_dense) {
        memcpy(in->k[12], c->dydt, n * sizeof(double));
        for (int row = 14; row <= 16; ++row) dalembert_dop853_stage(run, from, c, row);
        int is_finite = 1;
        for (int d = 0; d < 4; ++d) {
            dalembert_dop853_sum(in, n, dalembert_dop853_dense + d, in->dense[d]);
            is_finite = is_finite && dalembert_all_finite(n, in->dense[d]);
        }
        /* A good step keeps its cubic, whatever lies on the way of these stages. */
        if (!is_finite)
            for (int d = 0; d < 4; ++d)
                for (size_t i = 0; i < n; ++i) in->dense[d][i] = 0;
        in->is_dense = 1;
    }
    const double s = (t - from->t) / c->length, r = 1 - s;
    for (size_t i = 0; i < n; ++i) {
        const double change = c->y[i] - from->x[i];
        const double begin = c->length * from->dxdt[i] - change;
        const double end = change - c->length * c->dydt[i] - begin;
        const double higher = c->length * (in->dense[0][i] + s * (in->dense[1][i] + r * (in->dense[2][i] + s * in->dense[3][i])));
        x[i] = from->x[i] + s * (change + r * (begin + s * (end + r * higher)));
    }
}

#endif
