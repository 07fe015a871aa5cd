// SPDX-License-Identifier: GPL-3.0-or-later
// The arm with six joints as a careful engineer writes it: loops over the links in one frame. Forces by the recursive Newton-Euler algorithm, M by
// composite bodies, L D L', and slopes of the forces in closed form (Singh, Russell and Wensing, "Efficient analytical derivatives of rigid-body
// dynamics using spatial vector algebra", 2022).
#pragma once

#include <array>
#include <cmath>

#include "benchmarks/by_hand.hpp"

namespace by_hand {

struct Vector {
    double x = 0, y = 0, z = 0;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(double k, Vector a) { return {k * a.x, k * a.y, k * a.z}; }
    friend double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend Vector cross(Vector a, Vector b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
};

/// By its columns.
struct Matrix {
    Vector a, b, c;
    friend Vector operator*(const Matrix& m, Vector v) { return v.x * m.a + v.y * m.b + v.z * m.c; }
    friend Matrix operator+(const Matrix& m, const Matrix& n) { return {m.a + n.a, m.b + n.b, m.c + n.c}; }
};

/// Of motion: how fast a body turns, and how fast its point at the origin of the frame moves. Of force: moment about that origin, and force.
struct Screw {
    Vector turn, move;
    friend Screw operator+(const Screw& a, const Screw& b) { return {a.turn + b.turn, a.move + b.move}; }
    friend Screw operator*(double k, const Screw& a) { return {k * a.turn, k * a.move}; }
    friend double dot(const Screw& a, const Screw& b) { return dot(a.turn, b.turn) + dot(a.move, b.move); }
    /// How a motion that is carried along with another changes.
    friend Screw carried(const Screw& by, const Screw& m) { return {cross(by.turn, m.turn), cross(by.move, m.turn) + cross(by.turn, m.move)}; }
    /// How a force that is carried along with a motion changes.
    friend Screw force_carried(const Screw& by, const Screw& f) { return {cross(by.turn, f.turn) + cross(by.move, f.move), cross(by.turn, f.move)}; }
};

/// Mass, first moment and inertia about the origin of the frame.
struct Inertia {
    double mass = 0;
    Vector moment;
    Matrix about;
    friend Inertia operator+(const Inertia& a, const Inertia& b) { return {a.mass + b.mass, a.moment + b.moment, a.about + b.about}; }
    Screw operator*(const Screw& m) const { return {about * m.turn + cross(moment, m.move), mass * m.move - cross(moment, m.turn)}; }
};

/// Twice the Coriolis matrix: of a motion it sees the turning alone.
struct Coriolis {
    Matrix turn;
    Vector momentum;
    friend Coriolis operator+(const Coriolis& a, const Coriolis& b) { return {a.turn + b.turn, a.momentum + b.momentum}; }
    Screw operator*(const Screw& m) const { return {turn * m.turn, -2 * cross(momentum, m.turn)}; }
};

/// x = [q; dq], u = torques.
template <class Parameters>
class Arm {
public:
    static constexpr std::size_t n = 6;
    using State = std::array<double, 2 * n>;
    using Input = std::array<double, n>;
    using Jacobian = std::array<double, 4 * n * n>;

    explicit Arm(const Parameters& p) : g_(p.g) {
        const double m2 = p.m_2 * p.a_2 * p.a_2, m3 = p.m_3 * p.d_4 * p.d_4, m4 = p.m_4 * p.d_4 * p.d_4;
        links_ = {Link{0, {}, 0, {}, {p.J_1, p.J_1, p.J_1}},
                  Link{-1, {}, p.m_2, {p.a_2 / 3, 0, p.d_3 / 2}, {m2 / 100, m2 / 10, m2 / 10}},
                  Link{0, {p.a_2, 0, p.d_3}, p.m_3, {p.a_3, -p.d_4 / 6, 0}, {m3 / 12, m3 / 100, m3 / 12}},
                  Link{-1, {p.a_3, p.d_4, 0}, p.m_4, {0, 0, -p.d_4 / 5}, {m4 / 50, m4 / 50, m4 / 100}},
                  Link{1, {}, 0, {}, {p.J_5, p.J_5, p.J_5}},
                  Link{-1, {}, p.m_6, {p.c_x, 0, p.c_z}, {p.J_5, 2 * p.J_5, p.J_5}}};
    }

    void rhs(const State& x, const Input& u, double, State& f) const {
        Work w;
        solve(x, u, f, w);
    }

    void rhs_and_jacobian(const State& x, const Input& u, double, State& f, Jacobian& J) const {
        Work w;
        solve(x, u, f, w);
        // Accelerations, forces and the Coriolis matrix with what the links do in fact.
        std::array<Coriolis, n> coriolis;
        std::array<Screw, n> force;
        Screw gained;
        for (std::size_t i = 0; i < n; ++i) {
            gained = gained + f[n + i] * w.axis[i];
            w.acceleration[i] = w.acceleration[i] + gained;
            force[i] = w.force[i] + w.inertia[i] * gained;
            const Vector spin = w.velocity[i].turn, turn = w.turned[i] * spin;  // the angular momentum about the centre
            const Matrix& T = w.turned[i];
            const Vector v = w.velocity[i].move + cross(spin, w.centre[i]), c = w.centre[i];
            const double m = links_[i].mass;
            // Columns of w x T - T w x - (T w) x - 2 m c x (v x
            const auto column = [&](Vector unit, Vector t) { return cross(spin, t) - T * cross(spin, unit) - cross(turn, unit) - (2 * m * dot(c, unit)) * v + (2 * m * dot(c, v)) * unit; };
            coriolis[i] = {{column({1, 0, 0}, T.a), column({0, 1, 0}, T.b), column({0, 0, 1}, T.c)}, m * v};
        }
        for (std::size_t i = n - 1; i-- > 0;) {
            coriolis[i] = coriolis[i] + coriolis[i + 1];
            force[i] = force[i] + force[i + 1];
        }
        const Screw rest{{}, {0, 0, g_}};
        std::array<Screw, n> rate, second, moving;  // of the axes: carried by the link before, the same once more, and by both links
        for (std::size_t j = 0; j < n; ++j) {
            const Screw velocity = j == 0 ? Screw{} : w.velocity[j - 1];
            rate[j] = carried(velocity, w.axis[j]);
            second[j] = carried(j == 0 ? rest : w.acceleration[j - 1], w.axis[j]) + carried(velocity, rate[j]);
            moving[j] = rate[j] + carried(w.velocity[j], w.axis[j]);
        }
        J.fill(0);
        for (std::size_t i = 0; i < n; ++i) {
            J[2 * n * (n + i) + i] = 1;
            const Screw by_angle = coriolis[i] * rate[i] + w.composite[i] * second[i] + force_carried(w.axis[i], force[i]);
            const Screw by_rate = coriolis[i] * w.axis[i] + w.composite[i] * moving[i];
            // The rows above: what a joint does to the forces of those before it.
            for (std::size_t j = 0; j <= i; ++j) {
                J[2 * n * i + n + j] = -dot(w.axis[j], by_angle);
                J[2 * n * (n + i) + n + j] = -dot(w.axis[j], by_rate);
            }
            // The row: what joints before do to its force, through the same matrices from the other side.
            const Vector turn = coriolis_from_left(coriolis[i], w.axis[i]);
            for (std::size_t j = 0; j < i; ++j) {
                J[2 * n * j + n + i] = -(dot(turn, rate[j].turn) + dot(w.weighted[i], second[j]));
                J[2 * n * (n + j) + n + i] = -(dot(turn, w.axis[j].turn) + dot(w.weighted[i], moving[j]));
            }
        }
        std::array<std::size_t, 2 * n> starts;
        for (std::size_t k = 0; k < starts.size(); ++k) starts[k] = 2 * n * k + n;
        dalembert::detail::ldlt_solve_columns<double, n>(w.factor, J.data(), starts);
    }

private:
    struct Link {
        int quarter;  ///< turns about x before the joint turns about z
        Vector origin;
        double mass;
        Vector centre, inertia;
    };
    struct Work {
        std::array<Screw, n> axis, velocity, acceleration, force, weighted;  ///< `acceleration` is the opposite of gravity at rest; `weighted` is composite * axis
        std::array<Inertia, n> inertia, composite;
        std::array<Matrix, n> turned;  ///< inertia about the centre
        std::array<Vector, n> centre;
        std::array<double, n*(n + 1) / 2> factor;
    };

    static Vector coriolis_from_left(const Coriolis& c, const Screw& s) {
        const Vector own{dot(c.turn.a, s.turn), dot(c.turn.b, s.turn), dot(c.turn.c, s.turn)};
        return own - 2 * cross(s.move, c.momentum);
    }

    void solve(const State& x, const Input& u, State& f, Work& w) const {
        Matrix R{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        Vector p;
        Screw velocity, acceleration{{}, {0, 0, g_}};
        for (std::size_t i = 0; i < n; ++i) {
            const Link& link = links_[i];
            p = p + R * link.origin;
            if (link.quarter != 0) R = {R.a, link.quarter * R.c, -link.quarter * R.b};
            const double s = std::sin(x[i]), c = std::cos(x[i]);
            R = {c * R.a + s * R.b, c * R.b - s * R.a, R.c};
            w.axis[i] = {R.c, cross(p, R.c)};
            const Screw own = x[n + i] * w.axis[i];
            acceleration = acceleration + carried(velocity, own);
            velocity = velocity + own;
            w.velocity[i] = velocity;
            w.acceleration[i] = acceleration;
            const Vector centre = p + R * link.centre;
            const auto turned = [&](double e_a, double e_b, double e_c) { return (link.inertia.x * e_a) * R.a + (link.inertia.y * e_b) * R.b + (link.inertia.z * e_c) * R.c; };
            const Matrix T{turned(R.a.x, R.b.x, R.c.x), turned(R.a.y, R.b.y, R.c.y), turned(R.a.z, R.b.z, R.c.z)};
            const Vector h = link.mass * centre;
            const double square = dot(h, centre);
            w.turned[i] = T;
            w.centre[i] = centre;
            w.inertia[i] = {link.mass, h, T + Matrix{Vector{square, 0, 0} - centre.x * h, Vector{0, square, 0} - centre.y * h, Vector{0, 0, square} - centre.z * h}};
            w.force[i] = w.inertia[i] * acceleration + force_carried(velocity, w.inertia[i] * velocity);
            f[i] = x[n + i];
        }
        Screw force;
        for (std::size_t i = n; i-- > 0;) {
            w.composite[i] = i + 1 == n ? w.inertia[i] : w.inertia[i] + w.composite[i + 1];
            force = force + w.force[i];
            f[n + i] = u[i] - dot(w.axis[i], force);
            w.weighted[i] = w.composite[i] * w.axis[i];
            for (std::size_t j = 0; j <= i; ++j) w.factor[i * (i + 1) / 2 + j] = dot(w.axis[j], w.weighted[i]);
        }
        factor<n>(w.factor);
        substitute<n>(w.factor, f.data() + n);
    }

    double g_;
    std::array<Link, n> links_;
};

}  // namespace by_hand
