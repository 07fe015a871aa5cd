// SPDX-License-Identifier: GPL-3.0-or-later
// Generated code beside code by hand: right-hand side, and right-hand side with Jacobian. Throughput: independent calls. Latency:
// each call needs the result of the one before, as in an integrator. Nanoseconds a call; the ratio is what travels between machines.
#include <fmt/format.h>

#include <cstdlib>

#include "benchmarks/by_hand.hpp"
#include "benchmarks/packs.hpp"
#include "benchmarks/timing.hpp"
#include "cart_pendulum_lab.hpp"
#include "dalembert/matrices.hpp"
#include "n_pendulum_N1.hpp"
#include "n_pendulum_N2.hpp"
#include "n_pendulum_N3.hpp"
#include "n_pendulum_N5.hpp"
#include "n_pendulum_N8.hpp"
#include "n_pendulum_N12.hpp"
#include "n_pendulum_N20.hpp"
#include "n_pendulum_N30.hpp"
#include "spherical_pendulum_forced.hpp"

namespace {

template <class System>
class Benchmark {
public:
    using State = typename System::State;
    using Input = typename System::Input;

    Benchmark(const char* name, const System& system) : name_(name), system_(system) {
        for (std::size_t k = 0; k < points_.size(); ++k) {
            points_[k] = system.start_state();
            for (std::size_t i = 0; i < points_[k].size(); ++i) points_[k][i] += 0.3 * std::sin(static_cast<double>(3 * i + 7 * k + 1));
        }
        for (double& u : input_) u = 0.7;
    }

    template <class Hand>
    void against(const Hand& hand) {
        check(hand);
        using HandJacobian = typename Hand::Jacobian;
        using Jacobian = typename System::JacobianX;
        const auto rhs = [this](const auto& model) {
            return [this, &model](const State& x, State& f) { model.rhs(x, input_, 0.0, f); };
        };
        const auto both = [this](const auto& model, auto J) {
            return [this, &model, J](const State& x, State& f) mutable {
                model.rhs_and_jacobian(x, input_, 0.0, f, J);
                timing::keep(J);
            };
        };
        row("rhs", rhs(system_), rhs(hand), 1);
        row("rhs and Jacobian", both(system_, Jacobian{}), both(hand, HandJacobian{}), 4);
    }

private:
    /// Both ways compute the same, or the times mean nothing.
    template <class Hand>
    void check(const Hand& hand) const {
        double worst = 0;
        for (const State& x : points_) {
            State f, g;
            typename Hand::Jacobian J;
            system_.rhs(x, input_, 0.0, f);
            hand.rhs_and_jacobian(x, input_, 0.0, g, J);
            const auto generated = dalembert::jacobian_x(system_, x, input_, 0.0);
            const auto by_hand = dalembert::detail::expanded<dalembert::detail::Dense>(J, x.size(), x.size());
            worst = std::max(worst, (generated - by_hand).cwiseAbs().maxCoeff() / by_hand.cwiseAbs().maxCoeff());
            double size = 0;
            double difference = 0;
            for (std::size_t i = 0; i < x.size(); ++i) {
                size = std::max(size, std::abs(g[i]));
                difference = std::max(difference, std::abs(f[i] - g[i]));
            }
            worst = std::max(worst, difference / size);
        }
        if (worst < 1e-10) return;
        fmt::print(stderr, "{}: the two ways differ by {:.1e}\n", name_, worst);
        std::exit(1);
    }

    template <class Generated, class Hand>
    void row(const char* what, Generated generated, Hand hand, std::size_t weight) {
        const std::size_t calls = 1 + 40000 / (weight * points_[0].size() * points_[0].size());
        const auto independent = [this](auto& function) {
            return [this, &function](std::size_t count) {
                for (std::size_t k = 0; k < count; ++k) {
                    State f;
                    function(points_[k % points_.size()], f);
                    timing::keep(f);
                }
            };
        };
        const auto chained = [this](auto& function) {
            return [this, &function](std::size_t count) {
                State x = points_[0];
                for (std::size_t k = 0; k < count; ++k) {
                    State f;
                    function(x, f);
                    for (std::size_t i = 0; i < x.size(); ++i) x[i] += 1e-9 * f[i];
                }
                timing::keep(x);
            };
        };
        const auto throughput = timing::in_turns(independent(generated), independent(hand), calls);
        const auto latency = timing::in_turns(chained(generated), chained(hand), calls);
        fmt::print("{:<28} {:<17} {:>9.1f} {:>9.1f} {:>6.2f}   {:>9.1f} {:>9.1f} {:>6.2f}\n", name_, what, throughput.first, throughput.second,
                   throughput.ratio, latency.first, latency.second, latency.ratio);
    }

    const char* name_;
    const System& system_;
    std::array<State, 64> points_;
    Input input_{};
};

template <template <class> class System, class Hand>
void compare(const char* name) {
    const System<double> system;
    const Hand hand(system.parameters());
    Benchmark<System<double>>(name, system).against(hand);
}

}  // namespace

int main() {
    fmt::print("ns a call; below 1 the generated code is faster\n\n{:<46} {:^26}   {:^26}\n", "", "independent calls", "each needs the one before");
    fmt::print("{:<28} {:<17} {:>9} {:>9} {:>6}   {:>9} {:>9} {:>6}\n", "system", "function", "generated", "by hand", "ratio", "generated", "by hand", "ratio");
    compare<cart_pendulum::lab::System, by_hand::CartPendulum<cart_pendulum::lab::Parameters<double>>>("cart_pendulum, lab");
    compare<spherical_pendulum::forced::System, by_hand::SphericalPendulum<spherical_pendulum::forced::Parameters<double>>>("spherical_pendulum, forced");
    compare<n_pendulum_N1::full::System, by_hand::Chain<1>>("n_pendulum, N = 1");
    compare<n_pendulum_N2::full::System, by_hand::Chain<2>>("n_pendulum, N = 2");
    compare<n_pendulum_N3::full::System, by_hand::Chain<3>>("n_pendulum, N = 3");
    compare<n_pendulum_N5::full::System, by_hand::Chain<5>>("n_pendulum, N = 5");
    compare<n_pendulum_N8::full::System, by_hand::Chain<8>>("n_pendulum, N = 8");
    compare<n_pendulum_N12::full::System, by_hand::Chain<12>>("n_pendulum, N = 12");
    compare<n_pendulum_N20::full::System, by_hand::Chain<20>>("n_pendulum, N = 20");
    compare<n_pendulum_N30::full::System, by_hand::Chain<30>>("n_pendulum, N = 30");
    time_packs();
    return 0;
}
