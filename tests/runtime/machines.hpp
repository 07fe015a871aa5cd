// SPDX-License-Identifier: GPL-3.0-or-later
// Machines with modes, written by hand as generated headers will have them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "dalembert/methods/rosenbrock.hpp"

/// Modes in order of preference.
template <class Mode, std::size_t most>
struct Candidates {
    std::array<Mode, most> modes{};
    std::size_t count = 0;
    constexpr const Mode* begin() const { return modes.data(); }
    constexpr const Mode* end() const { return modes.data() + count; }
};

/// A ball that bounces with the restitution e on a table that is still, and rolls on with what speed it has. x = [height; speed; way].
template <class Scalar>
struct Ball {
    enum class Mode : unsigned { flight, rest };
    using scalar_type = Scalar;
    using State = std::array<Scalar, 3>;
    using Input = std::array<Scalar, 0>;
    using Events = std::array<Scalar, 1>;
    static constexpr std::array<const char*, 2> mode_table() { return {"flight", "rest"}; }
    static constexpr std::array<const char*, 1> event_table() { return {"bounce"}; }
    Scalar g = Scalar(981) / Scalar(100), e = Scalar(8) / Scalar(10);

    void rhs(Mode mode, const State& x, const Input&, Scalar, State& dxdt) const {
        if (mode == Mode::flight) dxdt = {x[1], -g, Scalar(1)};
        else dxdt = {Scalar(0), Scalar(0), Scalar(1)};
    }
    void guards(Mode, const State& x, const Input&, Scalar, Events& at) const { at = {x[0]}; }
    void guard_rates(Mode, const State& x, const Input&, Scalar, Events& rates) const { rates = {x[1]}; }
    bool holds(Mode mode, const State& x, const Input&, Scalar) const { return mode == Mode::flight || (x[0] == Scalar(0) && x[1] == Scalar(0)); }
    static constexpr bool is_watched(Mode mode, std::size_t) { return mode == Mode::flight; }
    void reset(std::size_t, Mode, State& x, const Input&, Scalar) const { x[0] = Scalar(0), x[1] = -e * x[1]; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode) { return {{Mode::flight}, 1}; }
    void settle(std::size_t, Mode, State& x, const Input&, Scalar) const { x[0] = x[1] = Scalar(0); }
    static constexpr Candidates<Mode, 1> after_accumulation(std::size_t, Mode) { return {{Mode::rest}, 1}; }
};

/// Two balls that know nothing of each other. x = [height, height, speed, speed].
struct TwoBalls {
    enum class Mode : unsigned { both_fly, second_flies, first_flies, both_rest };
    using scalar_type = double;
    using State = std::array<double, 4>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 2>;
    static constexpr std::array<const char*, 4> mode_table() { return {"both fly", "second flies", "first flies", "both rest"}; }
    static constexpr std::array<const char*, 2> event_table() { return {"first bounces", "second bounces"}; }
    double g = 9.81;
    std::array<double, 2> e{0.8, 0.8};

    static constexpr unsigned bit(std::size_t ball) { return 1u << ball; }
    static constexpr bool rests(Mode mode, std::size_t ball) { return (static_cast<unsigned>(mode) & bit(ball)) != 0; }
    void rhs(Mode mode, const State& x, const Input&, double, State& dxdt) const {
        for (std::size_t i = 0; i < 2; ++i) dxdt[i] = rests(mode, i) ? 0 : x[2 + i], dxdt[2 + i] = rests(mode, i) ? 0 : -g;
    }
    void guards(Mode, const State& x, const Input&, double, Events& at) const { at = {x[0], x[1]}; }
    void guard_rates(Mode, const State& x, const Input&, double, Events& rates) const { rates = {x[2], x[3]}; }
    static constexpr bool is_watched(Mode mode, std::size_t event) { return !rests(mode, event); }
    void reset(std::size_t event, Mode, State& x, const Input&, double) const { x[event] = 0, x[2 + event] *= -e[event]; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode mode) { return {{mode}, 1}; }
    void settle(std::size_t event, Mode, State& x, const Input&, double) const { x[event] = x[2 + event] = 0; }
    static constexpr Candidates<Mode, 1> after_accumulation(std::size_t event, Mode mode) { return {{static_cast<Mode>(static_cast<unsigned>(mode) | bit(event))}, 1}; }
};

/// A point in a round room; x = [position; velocity]. Where it bounces, its place is only as near to the wall as roundings allow.
struct Round {
    enum class Mode : unsigned { free };
    using scalar_type = double;
    using State = std::array<double, 4>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 1>;
    static constexpr std::array<const char*, 1> mode_table() { return {"free"}; }
    static constexpr std::array<const char*, 1> event_table() { return {"wall"}; }

    void rhs(Mode, const State& x, const Input&, double, State& dxdt) const { dxdt = {x[2], x[3], 0, 0}; }
    void guards(Mode, const State& x, const Input&, double, Events& g) const { g = {1 - std::hypot(x[0], x[1])}; }
    void guard_rates(Mode, const State& x, const Input&, double, Events& r) const { r = {-(x[0] * x[2] + x[1] * x[3]) / std::hypot(x[0], x[1])}; }
    static constexpr bool is_watched(Mode, std::size_t) { return true; }
    void reset(std::size_t, Mode, State& x, const Input&, double) const {
        const double outwards = 2 * (x[0] * x[2] + x[1] * x[3]) / (x[0] * x[0] + x[1] * x[1]);
        x[2] -= outwards * x[0], x[3] -= outwards * x[1];
    }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode) { return {{Mode::free}, 1}; }
};

/// A ball of which nothing is said about where its bounces lead.
struct BallWithoutRest : Ball<double> {
    void settle(std::size_t, Mode, State&, const Input&, double) const {}
    static constexpr Candidates<Mode, 1> after_accumulation(std::size_t, Mode) { return {}; }
};

/// Coulomb friction against something that moves with the speed V, and a spring and a constant force along it.
/// x = [position; speed; work of the belt].
struct Friction {
    enum class Mode : unsigned { stick, behind, ahead };
    enum Event : std::size_t { tears_ahead, tears_behind, catches_up, falls_back };
    using scalar_type = double;
    using State = std::array<double, 3>;
    using Input = std::array<double, 1>;  ///< by what part the normal force is less than N
    using Events = std::array<double, 4>;
    using PatternX = dalembert::DensePattern;
    using PatternU = dalembert::DensePattern;
    using JacobianX = std::array<double, 9>;
    using JacobianU = std::array<double, 3>;
    static constexpr std::array<const char*, 3> mode_table() { return {"stick", "behind", "ahead"}; }
    static constexpr std::array<const char*, 4> event_table() { return {"tears ahead", "tears behind", "catches up", "falls back"}; }
    double m = 2, k = 50, V = 0.3, N = 20, mu0 = 0.6, mu = 0.35, force = 0;

    double driving(const State& x) const { return force - k * x[0]; }
    /// On the body.
    static double sign(Mode mode) { return mode == Mode::behind ? 1 : -1; }
    double friction(Mode mode, const State& x, const Input& u) const { return mode == Mode::stick ? -driving(x) : sign(mode) * mu * N * (1 - u[0]); }
    double acceleration(Mode mode, const State& x, const Input& u) const { return mode == Mode::stick ? 0 : (driving(x) + friction(mode, x, u)) / m; }
    double energy(const State& x) const { return m * x[1] * x[1] / 2 + k * x[0] * x[0] / 2 - force * x[0]; }

    void rhs(Mode mode, const State& x, const Input& u, double, State& dxdt) const { dxdt = {x[1], acceleration(mode, x, u), friction(mode, x, u) * V}; }
    void jacobian_x(Mode mode, const State&, const Input&, double, JacobianX& J) const {
        J = {0, mode == Mode::stick ? 0 : -k / m, mode == Mode::stick ? k * V : 0, 1, 0, 0, 0, 0, 0};
    }
    void jacobian_u(Mode mode, const State&, const Input&, double, JacobianU& J) const {
        const double slope = mode == Mode::stick ? 0 : -sign(mode) * mu * N;
        J = {0, slope / m, slope * V};
    }
    void jacobian_t(Mode, const State&, const Input&, double, State& rate) const { rate = {0, 0, 0}; }
    void guards(Mode, const State& x, const Input& u, double, Events& g) const {
        const double most = mu0 * N * (1 - u[0]);
        g = {most - driving(x), most + driving(x), V - x[1], x[1] - V};
    }
    void guard_rates(Mode mode, const State& x, const Input& u, double, Events& r) const {
        r = {k * x[1], -k * x[1], -acceleration(mode, x, u), acceleration(mode, x, u)};
    }
    bool holds(Mode mode, const State& x, const Input&, double) const { return mode != Mode::stick || x[1] == V; }
    static constexpr bool is_watched(Mode mode, std::size_t event) {
        return mode == Mode::stick ? event == tears_ahead || event == tears_behind : event == (mode == Mode::behind ? catches_up : falls_back);
    }
    void reset(std::size_t, Mode, State& x, const Input&, double) const { x[1] = V; }
    static constexpr Candidates<Mode, 3> next_modes(std::size_t event, Mode) {
        if (event == tears_ahead) return {{Mode::ahead}, 1};
        if (event == tears_behind) return {{Mode::behind}, 1};
        return {{Mode::stick, Mode::behind, Mode::ahead}, 3};
    }
};

/// A ball between two stops, without weight. x = [position; speed].
struct Stops {
    enum class Mode : unsigned { free };
    using scalar_type = double;
    using State = std::array<double, 2>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 2>;
    static constexpr std::array<const char*, 1> mode_table() { return {"free"}; }
    static constexpr std::array<const char*, 2> event_table() { return {"left stop", "right stop"}; }
    double length = 1, e = 1;

    void rhs(Mode, const State& x, const Input&, double, State& dxdt) const { dxdt = {x[1], 0}; }
    void guards(Mode, const State& x, const Input&, double, Events& g) const { g = {x[0], length - x[0]}; }
    void guard_rates(Mode, const State& x, const Input&, double, Events& r) const { r = {x[1], -x[1]}; }
    static constexpr bool is_watched(Mode, std::size_t) { return true; }
    void reset(std::size_t event, Mode, State& x, const Input&, double) const { x = {event == 0 ? 0 : length, -e * x[1]}; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode) { return {{Mode::free}, 1}; }
};

/// A basin with an opening. Its pump is broken up to the time u; then it fills the basin, with the opening shut, and later turns on when the
/// level is low and off when it is high. x = [root of the level; level while it fills]: the root has no rate where it is zero.
struct Basin {
    enum class Mode : unsigned { broken, dry, fills, drains, gains };
    enum Event : std::size_t { empty, repaired, full, low, high };
    using scalar_type = double;
    using State = std::array<double, 2>;
    using Input = std::array<double, 1>;
    using Events = std::array<double, 5>;
    static constexpr std::array<const char*, 5> mode_table() { return {"broken", "dry", "fills", "drains", "gains"}; }
    static constexpr std::array<const char*, 5> event_table() { return {"empty", "repaired", "full", "low", "high"}; }
    double k = 0.05, q = 0.2, h_full = 2, w_low = 0.5, w_high = 1.2;  // m^(1/2)/s, m/s, m, m^(1/2)

    void rhs(Mode mode, const State& x, const Input&, double, State& dxdt) const {
        dxdt = {0, 0};
        if (mode == Mode::broken || mode == Mode::drains) dxdt[0] = -k;
        if (mode == Mode::fills) dxdt[1] = q;
        if (mode == Mode::gains) dxdt[0] = q / (2 * x[0]) - k;
    }
    void guards(Mode, const State& x, const Input& u, double t, Events& g) const { g = {x[0], u[0] - t, h_full - x[1], x[0] - w_low, w_high - x[0]}; }
    void guard_rates(Mode mode, const State& x, const Input& u, double t, Events& r) const {
        State dxdt;
        rhs(mode, x, u, t, dxdt);
        r = {dxdt[0], -1, -dxdt[1], dxdt[0], -dxdt[0]};
    }
    static constexpr bool is_watched(Mode mode, std::size_t event) { return static_cast<std::size_t>(mode) == event; }
    void reset(std::size_t event, Mode, State& x, const Input&, double) const {
        if (event == empty) x = {0, 0};
        if (event == full) x[0] = std::sqrt(h_full);
    }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t event, Mode) {
        constexpr std::array<Mode, 5> next{Mode::dry, Mode::fills, Mode::drains, Mode::gains, Mode::drains};
        return {{next[event]}, 1};
    }
};

/// A state that goes up and down in a band.
struct Relay {
    enum class Mode : unsigned { up, down };
    using scalar_type = double;
    using State = std::array<double, 1>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 2>;
    static constexpr std::array<const char*, 2> mode_table() { return {"up", "down"}; }
    static constexpr std::array<const char*, 2> event_table() { return {"top", "bottom"}; }
    double band = 1;

    static double rate(Mode mode) { return mode == Mode::up ? 1 : -1; }
    void rhs(Mode mode, const State&, const Input&, double, State& dxdt) const { dxdt = {rate(mode)}; }
    void guards(Mode, const State& x, const Input&, double, Events& g) const { g = {band - x[0], x[0] + band}; }
    void guard_rates(Mode mode, const State&, const Input&, double, Events& r) const { r = {-rate(mode), rate(mode)}; }
    static constexpr bool is_watched(Mode mode, std::size_t event) { return static_cast<std::size_t>(mode) == event; }
    void reset(std::size_t event, Mode, State& x, const Input&, double) const { x[0] = event == 0 ? band : -band; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode mode) { return {{mode == Mode::up ? Mode::down : Mode::up}, 1}; }
};

/// Three equal elastic balls on a line: speeds are exchanged. x = [positions; speeds].
struct Row {
    enum class Mode : unsigned { free };
    using scalar_type = double;
    using State = std::array<double, 6>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 2>;
    static constexpr std::array<const char*, 1> mode_table() { return {"free"}; }
    static constexpr std::array<const char*, 2> event_table() { return {"first and second", "second and third"}; }

    void rhs(Mode, const State& x, const Input&, double, State& dxdt) const { dxdt = {x[3], x[4], x[5], 0, 0, 0}; }
    void guards(Mode, const State& x, const Input&, double, Events& g) const { g = {x[1] - x[0], x[2] - x[1]}; }
    void guard_rates(Mode, const State& x, const Input&, double, Events& r) const { r = {x[4] - x[3], x[5] - x[4]}; }
    static constexpr bool is_watched(Mode, std::size_t) { return true; }
    void reset(std::size_t event, Mode, State& x, const Input&, double) const {
        x[event + 1] = x[event];
        std::swap(x[event + 3], x[event + 4]);
    }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode) { return {{Mode::free}, 1}; }
};
