// SPDX-License-Identifier: BSL-1.0
// On the desk: gains of feedback and observer from the generated linearisation about the rod standing upright, written as C++.
#include <cstdio>
#include <unsupported/Eigen/MatrixFunctions>

#include "cart_pendulum_lab.hpp"
#include "dalembert/equilibrium.hpp"
#include "dalembert/linearise.hpp"

using System = cart_pendulum::lab::System<double>;
using Eigen::MatrixXd;

namespace {

/// The stationary solution of P = A'P A - A'P B (R + B'P B)^-1 B'P A + Q gives the gain (R + B'P B)^-1 B'P A, which minimises the sum
/// of x'Q x + u'R u for x+ = A x + B u.
MatrixXd optimal_gain(const MatrixXd& A, const MatrixXd& B, const MatrixXd& Q, const MatrixXd& R) {
    MatrixXd P = Q, gain;
    for (int k = 0; k < 100000; ++k) {
        gain = (R + B.transpose() * P * B).ldlt().solve(B.transpose() * P * A);
        const MatrixXd next = A.transpose() * P * (A - B * gain) + Q;
        const double change = (next - P).norm() / next.norm();
        P = next;
        if (change < 1e-13) break;
    }
    return gain;
}

double largest_pole(const MatrixXd& A) { return A.eigenvalues().cwiseAbs().maxCoeff(); }

template <class Values>
void print(const char* name, const Values& values) {
    std::printf("    static constexpr std::array<float, %zu> %s{", static_cast<std::size_t>(values.size()), name);
    for (const double value : values) std::printf("%#.9gF, ", value);
    std::printf("};\n");
}

}  // namespace

int main() {
    constexpr double sample_time = 0.005;  // s
    const System system;
    System::State guess{};
    guess[cart_pendulum::lab::state::phi] = 3;  // 0 is hanging
    const auto upright = dalembert::find_equilibrium(system, guess, System::Input{}, {true, true, true, true}, {false});
    if (upright.status != dalembert::Status::success) return std::fprintf(stderr, "no equilibrium upright was found\n"), 1;
    const auto linear = dalembert::linearise(system, upright.x, upright.u, 0.0);

    // Held over a sample: exp([A B; 0 0] T).
    MatrixXd both = MatrixXd::Zero(5, 5);
    both.topLeftCorner(4, 4) = linear.A * sample_time;
    both.topRightCorner(4, 1) = linear.B * sample_time;
    const MatrixXd held = both.exp();
    const MatrixXd A = held.topLeftCorner(4, 4), B = held.topRightCorner(4, 1);
    MatrixXd C(2, 4);  // what is measured: the position of the cart, and the output of the model
    C << 1, 0, 0, 0, linear.C;

    // Weights: 0.1 m, 0.1 rad, 1 m/s, 1 rad/s are as bad as 3 N; measurements are good to a millimetre, forces to 0.3 N.
    const Eigen::Vector4d bad(100, 100, 1, 1);
    const MatrixXd K = optimal_gain(A, B, bad.asDiagonal(), MatrixXd::Constant(1, 1, 1.0 / 9));
    const MatrixXd noise = B * B.transpose() * 0.09 + MatrixXd::Identity(4, 4) * 1e-8;
    const MatrixXd predicted = optimal_gain(A.transpose(), C.transpose(), noise, MatrixXd::Identity(2, 2) * 1e-6).transpose();  // A L
    const MatrixXd L = A.partialPivLu().solve(predicted);
    const double feedback = largest_pole(A - B * K), observer = largest_pole(A - predicted * C);
    if (!(feedback < 1 && observer < 1)) return std::fprintf(stderr, "the gains do not stabilise\n"), 1;

    std::printf("// Written by design.cpp; largest poles a sample: open %.4f, with feedback %.4f, of the observer %.4f\n", largest_pole(A), feedback, observer);
    std::printf("#pragma once\n#include <array>\n\nstruct Gains {\n    static constexpr float sample_time = %.9gF;  // s\n", sample_time);
    std::printf("    static constexpr int samples = 1000;\n    static constexpr float first_angle = 0.2F;  // rad\n    static constexpr float largest_force = 40.0F;  // N\n");
    print("upright", upright.x);
    print("feedback", K.reshaped());
    print("observer", L.reshaped());
    std::printf("};\n");
    return 0;
}
