// SPDX-License-Identifier: GPL-3.0-or-later
// Generated code beside code by hand and beside that of SymPy: right-hand side, and right-hand side with Jacobian. Throughput: independent calls. Latency:
// each call needs the result of the one before, as in an integrator. Nanoseconds a call; the ratio is what travels between machines.
//     benchmarks [FILE]     the throughput of the chains as CSV, too
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "arm_6r_plain.hpp"
#include "ball_on_beam_full.hpp"
#include "benchmarks/arm_by_hand.hpp"
#include "benchmarks/by_hand.hpp"
#include "benchmarks/cylinder_by_hand.hpp"
#include "benchmarks/packs.hpp"
#include "benchmarks/timing.hpp"
#include "cart_pendulum_lab.hpp"
#include "dalembert/matrices.hpp"
#include "hydraulic_cylinder_real.hpp"
#include "n_pendulum_N1.hpp"
#include "n_pendulum_N2.hpp"
#include "n_pendulum_N3.hpp"
#include "n_pendulum_N5.hpp"
#include "n_pendulum_N8.hpp"
#include "n_pendulum_N12.hpp"
#include "n_pendulum_N20.hpp"
#include "n_pendulum_N30.hpp"
#include "spherical_pendulum_forced.hpp"
#if __has_include("sympy_chain.hpp")
#include "sympy_chain.hpp"
#endif

namespace {

/// Throughput, ns a call.
struct Times {
    double generated, other;
};

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

    /// rhs alone, and with the Jacobian.
    template <class Hand>
    std::array<Times, 2> against(const Hand& hand) {
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
        return {row("rhs", rhs(system_), rhs(hand), 1), row("rhs and Jacobian", both(system_, Jacobian{}), both(hand, HandJacobian{}), 4)};
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
    Times row(const char* what, Generated generated, Hand hand, std::size_t weight) {
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
        return {throughput.first, throughput.second};
    }

    const char* name_;
    const System& system_;
    std::array<State, 64> points_;
    Input input_{};
};

template <template <class> class System, class Other>
std::array<Times, 2> compare(const char* name) {
    const System<double> system;
    const Other other(system.parameters());
    return Benchmark<System<double>>(name, system).against(other);
}

/// A line of the CSV for each.
struct ChainTimes {
    int links;
    const char* other;
    std::array<Times, 2> times;
};

template <template <class> class System, class Other>
void chain(int links, const char* name, std::vector<ChainTimes>& all) {
    all.push_back({links, name, compare<System, Other>(fmt::format("n_pendulum, N = {}", links).c_str())});
}

/// Returns false when the file cannot be written.
bool write_csv(const std::string& path, const std::vector<ChainTimes>& all) {
    std::ofstream out(path);
    out << "links,other,rhs generated [ns],rhs other [ns],both generated [ns],both other [ns]\n";
    for (const ChainTimes& row : all) out << fmt::format("{},{},{:.1f},{:.1f},{:.1f},{:.1f}\n", row.links, row.other, row.times[0].generated, row.times[0].other, row.times[1].generated, row.times[1].other);
    out.close();
    return static_cast<bool>(out);
}

void print_head(const char* other) {
    fmt::print("\n{:<46} {:^26}   {:^26}\n", "", "independent calls", "each needs the one before");
    fmt::print("{:<28} {:<17} {:>9} {:>9} {:>6}   {:>9} {:>9} {:>6}\n", "system", "function", "generated", other, "ratio", "generated", other, "ratio");
}

void beside_code_by_hand(std::vector<ChainTimes>& chains) {
    print_head("by hand");
    compare<cart_pendulum::lab::System, by_hand::CartPendulum<cart_pendulum::lab::Parameters<double>>>("cart_pendulum, lab");
    compare<spherical_pendulum::forced::System, by_hand::SphericalPendulum<spherical_pendulum::forced::Parameters<double>>>("spherical_pendulum, forced");
    compare<ball_on_beam::full::System, by_hand::BallOnBeam<ball_on_beam::full::Parameters<double>>>("ball_on_beam");
    compare<arm_6r::plain::System, by_hand::Arm<arm_6r::plain::Parameters<double>>>("arm_6r, plain");
    compare<hydraulic_cylinder::real::System, by_hand::HydraulicCylinder<hydraulic_cylinder::real::Parameters<double>>>("hydraulic_cylinder, real");
    chain<n_pendulum_N1::full::System, by_hand::Chain<1>>(1, "by hand", chains);
    chain<n_pendulum_N2::full::System, by_hand::Chain<2>>(2, "by hand", chains);
    chain<n_pendulum_N3::full::System, by_hand::Chain<3>>(3, "by hand", chains);
    chain<n_pendulum_N5::full::System, by_hand::Chain<5>>(5, "by hand", chains);
    chain<n_pendulum_N8::full::System, by_hand::Chain<8>>(8, "by hand", chains);
    chain<n_pendulum_N12::full::System, by_hand::Chain<12>>(12, "by hand", chains);
    chain<n_pendulum_N20::full::System, by_hand::Chain<20>>(20, "by hand", chains);
    chain<n_pendulum_N30::full::System, by_hand::Chain<30>>(30, "by hand", chains);
}

void beside_sympy([[maybe_unused]] std::vector<ChainTimes>& chains) {
#if __has_include("sympy_chain.hpp")
    print_head("SymPy");
    chain<n_pendulum_N1::full::System, by_sympy::Chain<1>>(1, "SymPy", chains);
    chain<n_pendulum_N2::full::System, by_sympy::Chain<2>>(2, "SymPy", chains);
    chain<n_pendulum_N3::full::System, by_sympy::Chain<3>>(3, "SymPy", chains);
    chain<n_pendulum_N5::full::System, by_sympy::Chain<5>>(5, "SymPy", chains);
    chain<n_pendulum_N8::full::System, by_sympy::Chain<8>>(8, "SymPy", chains);
    chain<n_pendulum_N12::full::System, by_sympy::Chain<12>>(12, "SymPy", chains);
#else
    fmt::print("\nWithout SymPy (on Debian python3-sympy) its code is not timed.\n");
#endif
}

}  // namespace

int main(int argc, char** argv) {
    fmt::print("ns a call; below 1 the generated code is faster\n");
    std::vector<ChainTimes> chains;
    beside_code_by_hand(chains);
    beside_sympy(chains);
    time_packs();
    if (argc < 2 || write_csv(argv[1], chains)) return 0;
    fmt::print(stderr, "cannot write {}\n", argv[1]);
    return 3;
}
