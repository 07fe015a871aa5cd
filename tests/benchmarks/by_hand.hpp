// SPDX-License-Identifier: GPL-3.0-or-later
// The same systems as a careful engineer writes them: closed forms on paper, what depends on parameters computed once, Jacobians by
// implicit differentiation, loops over links. The rows against which generated code is measured.
#pragma once

#include <array>
#include <cmath>

#include "dalembert/ldlt.hpp"

namespace by_hand {

/// Modellbildung 2013, eq. (2.234): x = [s, phi, ds, dphi], u = [f_e].
template <class Parameters>
class CartPendulum {
public:
    using State = std::array<double, 4>;
    using Input = std::array<double, 1>;
    using Jacobian = std::array<double, 16>;

    explicit CartPendulum(const Parameters& p) : c_(p.c_W), s0_(p.s_W0), d_(p.d_R) {
        const double m = p.rho_S * p.l_S * p.b_S * p.h_S;
        a_ = p.m_W + m;
        b_ = m * p.l_S / 2;
        i_ = m * (p.l_S * p.l_S + p.b_S * p.b_S) / 12 + m * p.l_S * p.l_S / 4;
        k_ = m * p.g * p.l_S / 2;
    }

    void rhs(const State& x, const Input& u, double, State& f) const {
        const double s = std::sin(x[1]), c = std::cos(x[1]);
        const double r1 = u[0] - d_ * x[2] - c_ * (x[0] - s0_) + b_ * s * x[3] * x[3];
        const double r2 = -k_ * s;
        const double m12 = b_ * c;
        const double inverse = 1 / (a_ * i_ - m12 * m12);
        f = {x[2], x[3], (i_ * r1 - m12 * r2) * inverse, (a_ * r2 - m12 * r1) * inverse};
    }

    void rhs_and_jacobian(const State& x, const Input& u, double, State& f, Jacobian& J) const {
        const double s = std::sin(x[1]), c = std::cos(x[1]);
        const double bs = b_ * s, w2 = x[3] * x[3];
        const double r1 = u[0] - d_ * x[2] - c_ * (x[0] - s0_) + bs * w2;
        const double r2 = -k_ * s;
        const double m12 = b_ * c;
        const double inverse = 1 / (a_ * i_ - m12 * m12);
        const double i11 = i_ * inverse, i12 = -m12 * inverse, i22 = a_ * inverse;
        const double s_dd = i11 * r1 + i12 * r2, phi_dd = i12 * r1 + i22 * r2;
        f = {x[2], x[3], s_dd, phi_dd};
        const double g1 = m12 * w2 + bs * phi_dd, g2 = -k_ * c + bs * s_dd;
        const double w = 2 * bs * x[3];
        J = {0, 0, -i11 * c_, -i12 * c_, 0, 0, i11 * g1 + i12 * g2, i12 * g1 + i22 * g2, 1, 0, -i11 * d_, -i12 * d_, 0, 1, i11 * w, i12 * w};
    }

private:
    double c_, s0_, d_, a_, b_, i_, k_;
};

/// Modellbildung 2013, eq. (2.223): x = [theta, phi, dtheta, dphi], u = [f_ex].
template <class Parameters>
class SphericalPendulum {
public:
    using State = std::array<double, 4>;
    using Input = std::array<double, 1>;
    using Jacobian = std::array<double, 16>;

    explicit SphericalPendulum(const Parameters& p) : g_l_(p.g / p.l), per_ml_(1 / (p.m * p.l)) {}

    void rhs(const State& x, const Input& u, double, State& f) const {
        const double s = std::sin(x[0]), c = std::cos(x[0]), sp = std::sin(x[1]), cp = std::cos(x[1]);
        const double v = u[0] * per_ml_;
        f = {x[2], x[3], c * (s * x[3] * x[3] - v * cp) - g_l_ * s, (v * sp - 2 * x[2] * x[3] * c) / s};
    }

    void rhs_and_jacobian(const State& x, const Input& u, double, State& f, Jacobian& J) const {
        const double s = std::sin(x[0]), c = std::cos(x[0]), sp = std::sin(x[1]), cp = std::cos(x[1]);
        const double v = u[0] * per_ml_, w2 = x[3] * x[3], inverse = 1 / s, cot = c * inverse;
        const double theta_dd = c * (s * w2 - v * cp) - g_l_ * s;
        const double phi_dd = (v * sp - 2 * x[2] * x[3] * c) * inverse;
        f = {x[2], x[3], theta_dd, phi_dd};
        J = {0, 0, (c * c - s * s) * w2 + s * v * cp - g_l_ * c, 2 * x[2] * x[3] - phi_dd * cot,
             0, 0, c * v * sp, v * cp * inverse,
             1, 0, 0, -2 * x[3] * cot,
             0, 1, 2 * s * c * x[3], -2 * x[2] * cot};
    }

private:
    double g_l_, per_ml_;
};

/// Modellbildung 2013, (2.236): x = [phi, r, dphi, dr], u = [tau].
template <class Parameters>
class BallOnBeam {
public:
    using State = std::array<double, 4>;
    using Input = std::array<double, 1>;
    using Jacobian = std::array<double, 16>;

    explicit BallOnBeam(const Parameters& p) : m_(p.m_K), g_(p.m_K * p.g), radius_(p.r_K) {
        const double theta = 0.4 * p.m_K * p.r_K * p.r_K;
        m11_ = m_ * p.r_K * p.r_K + p.theta_B + theta;
        m12_ = -(m_ * p.r_K + theta / p.r_K);
        m22_ = m_ + theta / (p.r_K * p.r_K);
    }

    void rhs(const State& x, const Input& u, double, State& f) const {
        const double s = std::sin(x[0]), c = std::cos(x[0]);
        const double mr = m_ * x[1];
        const double r1 = u[0] - 2 * mr * x[2] * x[3] - g_ * (x[1] * c - radius_ * s);
        const double r2 = mr * x[2] * x[2] - g_ * s;
        const double m11 = m11_ + mr * x[1];
        const double inverse = 1 / (m11 * m22_ - m12_ * m12_);
        f = {x[2], x[3], (m22_ * r1 - m12_ * r2) * inverse, (m11 * r2 - m12_ * r1) * inverse};
    }

    void rhs_and_jacobian(const State& x, const Input& u, double, State& f, Jacobian& J) const {
        const double s = std::sin(x[0]), c = std::cos(x[0]);
        const double mr = m_ * x[1];
        const double r1 = u[0] - 2 * mr * x[2] * x[3] - g_ * (x[1] * c - radius_ * s);
        const double r2 = mr * x[2] * x[2] - g_ * s;
        const double m11 = m11_ + mr * x[1];
        const double inverse = 1 / (m11 * m22_ - m12_ * m12_);
        const double i11 = m22_ * inverse, i12 = -m12_ * inverse, i22 = m11 * inverse;
        const double phi_dd = i11 * r1 + i12 * r2, r_dd = i12 * r1 + i22 * r2;
        f = {x[2], x[3], phi_dd, r_dd};
        const auto column = [&](int j, double g1, double g2) {
            J[4 * j + 2] = i11 * g1 + i12 * g2;
            J[4 * j + 3] = i12 * g1 + i22 * g2;
        };
        J = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
        column(0, g_ * (x[1] * s + radius_ * c), -g_ * c);
        column(1, -2 * m_ * x[2] * x[3] - g_ * c - 2 * mr * phi_dd, m_ * x[2] * x[2]);
        column(2, -2 * mr * x[3], 2 * mr * x[2]);
        column(3, -2 * mr * x[2], 0);
    }

private:
    double m_, g_, radius_, m11_, m12_, m22_;
};

/// M = L D L' in loops: the lower triangle of M, row by row, becomes L with 1/D on its diagonal.
template <std::size_t n>
void factor(std::array<double, n * (n + 1) / 2>& m) {
    for (std::size_t i = 0; i < n; ++i) {
        double* const row = m.data() + i * (i + 1) / 2;
        for (std::size_t j = 0; j < i; ++j) {
            const double* const other = m.data() + j * (j + 1) / 2;
            double v = row[j];
            for (std::size_t k = 0; k < j; ++k) v -= row[k] * other[k];
            row[j] = v;
        }
        double pivot = row[i];
        for (std::size_t j = 0; j < i; ++j) {
            const double l = row[j] * m[j * (j + 1) / 2 + j];
            pivot -= row[j] * l;
            row[j] = l;
        }
        row[i] = 1 / pivot;
    }
}

/// Solves M x = b in place.
template <std::size_t n>
void substitute(const std::array<double, n * (n + 1) / 2>& m, double* b) {
    for (std::size_t i = 1; i < n; ++i) {
        double value = b[i];
        for (std::size_t k = 0; k < i; ++k) value -= m[i * (i + 1) / 2 + k] * b[k];
        b[i] = value;
    }
    for (std::size_t i = 0; i < n; ++i) b[i] *= m[i * (i + 1) / 2 + i];
    for (std::size_t i = n; i-- > 1;)
        for (std::size_t k = 0; k < i; ++k) b[k] -= m[i * (i + 1) / 2 + k] * b[i];
}

/// In a file of its own, because GCC 12.2 makes these loops slower, and lets those of 20 links crash, when it vectorises them.
/// Chain of n links: M_ij = a_ij cos(phi_i - phi_j), bias_i = sum_j a_ij sin(phi_i - phi_j) w_j^2 + b_i sin(phi_i).
template <std::size_t n>
class Chain {
public:
    using State = std::array<double, 2 * n>;
    using Input = std::array<double, 0>;
    using Jacobian = std::array<double, 4 * n * n>;

    template <class Parameters>
    explicit Chain(const Parameters& p) {
        std::array<double, n> behind;  // mass at and behind a joint
        double sum = 0;
        for (std::size_t k = n; k-- > 0;) behind[k] = sum += p.m[k];
        for (std::size_t i = 0; i < n; ++i) {
            b_[i] = p.g * behind[i] * p.l[i];
            for (std::size_t j = 0; j <= i; ++j) a_[i * n + j] = a_[j * n + i] = behind[i] * p.l[i] * p.l[j];
        }
    }

    [[gnu::noinline]] void rhs(const State& x, const Input&, double, State& f) const {
        Work work;
        solve(x, f, work);
    }

    /// J column by column.
    [[gnu::noinline]] void rhs_and_jacobian(const State& x, const Input&, double, State& f, Jacobian& J) const {
        Work work;
        solve(x, f, work);
        for (std::size_t k = 0; k < n; ++k) {
            // R_i = sum_j a_ij (cos_ij qdd_j + sin_ij w_j^2) + b_i sin_i. By phi_k only the terms with k change.
            double* const by_angle = J.data() + 2 * n * k;
            double* const by_rate = J.data() + 2 * n * (n + k);
            double own = -b_[k] * work.cos[k];
            const double qdd = f[n + k], w2 = x[n + k] * x[n + k];
            for (std::size_t i = 0; i < n; ++i) {
                by_angle[i] = 0;
                by_rate[i] = i == k ? 1 : 0;
                const double c = work.acos[k * n + i], s = work.asin[k * n + i];  // s: a_ki sin(phi_k - phi_i)
                by_angle[n + i] = c * w2 + s * qdd;
                own += s * f[n + i] - c * x[n + i] * x[n + i];
                by_rate[n + i] = 2 * s * x[n + k];
            }
            by_angle[n + k] = own + work.acos[k * n + k] * w2;
            by_rate[n + k] = 0;
        }
        std::array<std::size_t, 2 * n> starts;
        for (std::size_t k = 0; k < starts.size(); ++k) starts[k] = 2 * n * k + n;
        dalembert::detail::ldlt_solve_columns<double, n>(work.factor, J.data(), starts);
    }

private:
    struct Work {
        std::array<double, n> sin, cos;
        std::array<double, n * n> acos, asin;  // a_ij times cos, sin of phi_i - phi_j
        std::array<double, n*(n + 1) / 2> factor;
    };

    void solve(const State& x, State& f, Work& work) const {
        for (std::size_t i = 0; i < n; ++i) {
            work.sin[i] = std::sin(x[i]);
            work.cos[i] = std::cos(x[i]);
        }
        for (std::size_t i = 0; i < n; ++i) {
            f[i] = x[n + i];
            double r = -b_[i] * work.sin[i];
            for (std::size_t j = 0; j < n; ++j) {
                work.acos[i * n + j] = a_[i * n + j] * (work.cos[i] * work.cos[j] + work.sin[i] * work.sin[j]);
                work.asin[i * n + j] = a_[i * n + j] * (work.sin[i] * work.cos[j] - work.cos[i] * work.sin[j]);
                r -= work.asin[i * n + j] * x[n + j] * x[n + j];
            }
            f[n + i] = r;
            for (std::size_t j = 0; j <= i; ++j) work.factor[i * (i + 1) / 2 + j] = work.acos[i * n + j];
        }
        factor<n>(work.factor);
        substitute<n>(work.factor, f.data() + n);
    }

    std::array<double, n * n> a_{};
    std::array<double, n> b_{};
};

extern template class Chain<1>;
extern template class Chain<2>;
extern template class Chain<3>;
extern template class Chain<5>;
extern template class Chain<8>;
extern template class Chain<12>;
extern template class Chain<20>;
extern template class Chain<30>;

}  // namespace by_hand
