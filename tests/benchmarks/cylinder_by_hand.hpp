// SPDX-License-Identifier: GPL-3.0-or-later
// The hydraulic cylinder with everything in it, as a careful engineer writes it: a chamber is one function, balances are solved for dT/dt
// first, slopes of the oil by its identities (dh/dT = c_v + alpha^2 beta T v, dh/dp = v (1 - alpha T)).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace by_hand {

/// x = [s, ds, p_1, p_2, T_1, T_2], u = [q_1, q_2, f].
template <class Parameters>
class HydraulicCylinder {
public:
    using State = std::array<double, 6>;
    using Input = std::array<double, 3>;
    using Jacobian = std::array<double, 36>;

    explicit HydraulicCylinder(const Parameters& p)
        : p_(p), stroke_(p.l - p.d), per_mass_(1 / (p.m_k + p.m_l)), per_rho_(1 / p.rho_0), per_beta_(1 / p.beta), per_c_(1 / p.c_v), ab_(p.alpha * p.beta),
          supply_(enthalpy(p.p_s, p.T_0)), tank_(enthalpy(p.p_t, p.T_0)) {}

    void rhs(const State& x, const Input& u, double, State& f) const {
        const Oil o1 = oil(x[2], x[4]), o2 = oil(x[3], x[5]);
        const double difference = x[2] - x[3];
        const double leak = p_.k_l * difference / (difference >= 0 ? o1.v : o2.v);
        f[0] = x[1];
        f[1] = (p_.A_1 * x[2] - p_.A_2 * x[3] - p_.d_k * x[1] - p_.c_l * (x[0] - p_.s_l) - u[2]) * per_mass_;
        const Rates r1 = chamber(o1, p_.A_1 * x[0], p_.A_1 * x[1], x[4], u[0], supply_, -leak, o2.h);
        const Rates r2 = chamber(o2, p_.A_2 * (stroke_ - x[0]), -p_.A_2 * x[1], x[5], u[1], tank_, leak, o1.h);
        f[2] = r1.p;
        f[3] = r2.p;
        f[4] = r1.T;
        f[5] = r2.T;
    }

    void rhs_and_jacobian(const State& x, const Input& u, double, State& f, Jacobian& J) const {
        const Oil o1 = oil(x[2], x[4]), o2 = oil(x[3], x[5]);
        const double difference = x[2] - x[3];
        const bool from_1 = difference >= 0;
        const double rho = 1 / (from_1 ? o1.v : o2.v);
        const double leak = p_.k_l * difference * rho;
        // By p and T of each chamber.
        const double by_pressure = p_.k_l * rho, by_density = leak;
        const std::array<double, 4> slopes{by_pressure + (from_1 ? by_density * per_beta_ : 0), -by_pressure + (from_1 ? 0 : by_density * per_beta_),
                                           from_1 ? -by_density * p_.alpha : 0, from_1 ? 0 : -by_density * p_.alpha};
        J.fill(0);
        f[0] = x[1];
        f[1] = (p_.A_1 * x[2] - p_.A_2 * x[3] - p_.d_k * x[1] - p_.c_l * (x[0] - p_.s_l) - u[2]) * per_mass_;
        J[1] = -p_.c_l * per_mass_;
        J[6] = 1;
        J[7] = -p_.d_k * per_mass_;
        J[13] = p_.A_1 * per_mass_;
        J[19] = -p_.A_2 * per_mass_;
        slopes_of_chamber<0>(o1, o2, p_.A_1 * x[0], p_.A_1, x[1], x[4], u[0], supply_, -leak, -1, slopes, f, J);
        slopes_of_chamber<1>(o2, o1, p_.A_2 * (stroke_ - x[0]), -p_.A_2, x[1], x[5], u[1], tank_, leak, 1, slopes, f, J);
    }

private:
    struct Oil {
        double v, h, T, h_p, h_T;
    };
    struct Rates {
        double p, T;
    };

    double enthalpy(double p, double T) const { return oil(p, T).h; }

    Oil oil(double p, double T) const {
        const double e = (p_.p_0 - p) * per_beta_ - p_.alpha * (p_.T_0 - T);
        const double E = std::exp(e);
        const double v = E * per_rho_;
        const double h = p * v + p_.c_v * (T - p_.T_0) + (p_.beta * (1 - (1 - e) * E) + (ab_ * p_.T_0 - p_.p_0) * (E - 1)) * per_rho_;
        return {v, h, T, v * (1 - p_.alpha * T), p_.c_v + p_.alpha * ab_ * T * v};
    }

    /// A volume into which q flows from a line, and a leakage from the other chamber: m c_v dT = sum of m_j (h_j - h) + alpha beta T (v sum of m_j - dV).
    Rates chamber(const Oil& o, double V, double dV, double T, double q, double h_line, double leak, double h_other) const {
        const double per_V = 1 / V;
        const double w = q + o.v * leak - dV;
        const double heat = std::max(0.0, q / o.v) * (h_line - o.h) + std::max(0.0, leak) * (h_other - o.h) + ab_ * T * w;
        const double dT = heat * o.v * per_V * per_c_;
        return {p_.beta * (p_.alpha * dT + w * per_V), dT};
    }

    /// The same with its columns; `side` is the chamber, the volume changes by A ds.
    template <int side>
    void slopes_of_chamber(const Oil& o, const Oil& other, double V, double A, double ds, double T, double q, double h_line, double leak, double sign,
                           const std::array<double, 4>& leak_slopes, State& f, Jacobian& J) const {
        const double per_V = 1 / V;
        const double w = q + o.v * leak - A * ds;
        const double line = std::max(0.0, q / o.v);
        const double in = std::max(0.0, leak), is_in = leak > 0 ? 1 : 0;
        const double heat = line * (h_line - o.h) + in * (other.h - o.h) + ab_ * T * w;
        const double K = o.v * per_V * per_c_;
        const double dT = heat * K;
        constexpr int p_row = 2 + side, T_row = 4 + side;
        f[p_row] = p_.beta * (p_.alpha * dT + w * per_V);
        f[T_row] = dT;
        const auto put = [&](int column, double T_slope, double w_slope, double V_slope) {
            J[6 * column + T_row] = T_slope;
            J[6 * column + p_row] = p_.beta * (p_.alpha * T_slope + (w_slope - w * V_slope * per_V) * per_V);
        };
        put(0, -dT * A * per_V, 0, A);
        put(1, ab_ * T * -A * K, -A, 0);
        const double own_line = h_line - o.h;
        for (int k = 0; k < 4; ++k) {
            const bool is_own = k % 2 == side, is_pressure = k < 2;
            const double m = sign * leak_slopes[static_cast<std::size_t>(k)];
            const double v_slope = is_own ? (is_pressure ? -o.v * per_beta_ : p_.alpha * o.v) : 0;
            const double h_slope = is_own ? (is_pressure ? o.h_p : o.h_T) : 0;
            const double h_other = is_own ? 0 : (is_pressure ? other.h_p : other.h_T);
            const double w_slope = v_slope * leak + o.v * m;
            const double line_slope = -line * v_slope / o.v;
            const double heat_slope = line_slope * own_line - line * h_slope + is_in * m * (other.h - o.h) + in * (h_other - h_slope) +
                                      ab_ * ((is_own && !is_pressure ? w : 0) + T * w_slope);
            put(2 + k, heat_slope * K + dT * v_slope / o.v, w_slope, 0);
        }
    }

    Parameters p_;
    double stroke_, per_mass_, per_rho_, per_beta_, per_c_, ab_, supply_, tank_;
};

}  // namespace by_hand
