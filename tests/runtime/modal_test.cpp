// SPDX-License-Identifier: GPL-3.0-or-later
// The modal form of linear mechanical systems: the printed solution of Aufgabe 2.15, the laws (2.127) to (2.144), and motions against the
// matrix exponential in long double, also where the book's formulas end.
#include "dalembert/modal_motion.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "mechanics/coupled_springs_full.hpp"
#include "mechanics/drive_train_damped.hpp"
#include "mechanics/drive_train_undamped.hpp"
#include "mechanics/n_pendulum_N5_full.hpp"
#include "mechanics/spring_mass_damper_damped.hpp"

using namespace dalembert;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

namespace {

MatrixXd diagonal(std::initializer_list<double> values) {
    MatrixXd A = MatrixXd::Zero(static_cast<Index>(values.size()), static_cast<Index>(values.size()));
    Index i = 0;
    for (const double value : values) {
        A(i, i) = value;
        ++i;
    }
    return A;
}

MatrixXd square(Index n, std::initializer_list<double> values) {
    MatrixXd A(n, n);
    Index i = 0;
    for (const double value : values) {
        A(i / n, i % n) = value;
        ++i;
    }
    return A;
}

LinearSystem pushed(const MatrixXd& M, const MatrixXd& D, const MatrixXd& C) { return {M, D, C, MatrixXd::Identity(M.rows(), M.rows())}; }

/// x(t) from x0 with constant forces f: the exponential of [A, b; 0, 0] t in long double.
VectorXd exact_motion(const LinearSystem& s, const VectorXd& x0, const VectorXd& f, double t) {
    using Long = Eigen::Matrix<long double, -1, -1>;
    const Index n = s.M.rows();
    const Long inverse = s.M.cast<long double>().inverse();
    Long A = Long::Zero(2 * n + 1, 2 * n + 1);
    A.block(0, n, n, n).setIdentity();
    A.block(n, 0, n, n) = -inverse * s.C.cast<long double>();
    A.block(n, n, n, n) = -inverse * s.D.cast<long double>();
    A.block(n, 2 * n, n, 1) = inverse * (s.B * f).cast<long double>();
    A *= static_cast<long double>(t);
    Eigen::Matrix<long double, -1, 1> x(2 * n + 1);
    x << x0.cast<long double>(), 1;
    return (A.exp() * x).head(2 * n).cast<double>();
}

/// What (2.122) to (2.144) say of any system.
void check_laws(const LinearSystem& s) {
    const Modes m = modes(s);
    REQUIRE(m.status == ModalStatus::success);
    const Index n = s.M.rows();
    const RealModalForm form = real_form(m);
    REQUIRE(form.A.rows() == 2 * n);
    const double size = form.basis.norm() * form.inverse.norm();
    CHECK((form.inverse * form.basis - MatrixXd::Identity(2 * n, 2 * n)).norm() < 1e-13 * size);
    // dx/dt = F x + G f in modal coordinates.
    MatrixXd F = MatrixXd::Zero(2 * n, 2 * n), G = MatrixXd::Zero(2 * n, s.B.cols());
    const MatrixXd inverse = s.M.inverse();
    F.topRightCorner(n, n).setIdentity();
    F.bottomLeftCorner(n, n) = -inverse * s.C;
    F.bottomRightCorner(n, n) = -inverse * s.D;
    G.bottomRows(n) = inverse * s.B;
    CHECK((F * form.basis - form.basis * form.A).norm() < 1e-12 * F.norm() * form.basis.norm());
    CHECK((form.basis * form.input - G).norm() < 1e-12 * size * G.norm());
    for (const ModalBlock& block : m.blocks) {
        if (block.size > 1) continue;
        const Index k = block.first;
        const Complex lambda = m.eigenvalues[k];
        CHECK(block.is_real == (lambda.imag() == 0));
        const VectorXcd psi = m.vectors.col(k).head(n), phi = m.left.col(k);
        const MatrixXcd Q = lambda * lambda * s.M.cast<Complex>() + lambda * s.D.cast<Complex>() + s.C.cast<Complex>();
        const double sizes = std::norm(lambda) * s.M.norm() + std::abs(lambda) * s.D.norm() + s.C.norm();
        CHECK((Q * psi).norm() <= 1e-12 * sizes * psi.norm());                                         // (2.127)
        CHECK((phi.transpose() * Q).norm() <= 1e-12 * sizes * phi.norm());
        CHECK((m.vectors.col(k).tail(n) - lambda * psi).norm() < 1e-14);                               // (2.126)
        CHECK(m.vectors.col(k).norm() == doctest::Approx(1).epsilon(1e-14));
        CHECK(m.inverse.row(k).tail(n).isApprox(phi.transpose() * s.M.cast<Complex>() / m.alpha[k], 1e-12));
        CHECK((m.input.row(k) - phi.transpose() * s.B.cast<Complex>() / m.alpha[k]).norm() <= 1e-12 * m.input.row(k).norm());  // (2.138)
    }
    // (2.139), with start values and constant forces.
    const VectorXd x0 = VectorXd::LinSpaced(2 * n, 1, 2), f = VectorXd::LinSpaced(s.B.cols(), 0.5, -1);
    for (const double t : {0.3, 2.0, 20.0}) {
        const VectorXd exact = exact_motion(s, x0, f, t);
        CAPTURE(t);
        CHECK((form.motion(x0, f, t) - exact).norm() <= (1e-10 + 1e-15 * size * size) * (1 + exact.norm()));
    }
}

/// (2.130) and (2.136): psi_k' A psi_j and psi_k' H psi_j, also within repeated eigenvalues; of what is symmetric.
void check_orthogonality(const LinearSystem& s) {
    const Modes m = modes(s);
    REQUIRE(m.is_decoupled());
    const Index n = s.M.rows();
    MatrixXcd A = MatrixXcd::Zero(2 * n, 2 * n), H = A, Psi(2 * n, 0);
    A << s.D.cast<Complex>(), s.M.cast<Complex>(), s.M.cast<Complex>(), MatrixXcd::Zero(n, n);
    H.topLeftCorner(n, n) = s.C.cast<Complex>();
    H.bottomRightCorner(n, n) = -s.M.cast<Complex>();
    std::vector<Complex> lambda, alpha;
    for (const ModalBlock& block : m.blocks)
        for (int conjugate = 0; conjugate < (block.is_real ? 1 : 2); ++conjugate) {
            Psi.conservativeResize(2 * n, Psi.cols() + 1);
            const Index k = block.first;
            Psi.rightCols(1) = conjugate == 1 ? m.vectors.col(k).conjugate().eval() : m.vectors.col(k).eval();
            lambda.push_back(conjugate == 1 ? std::conj(m.eigenvalues[k]) : m.eigenvalues[k]);
            alpha.push_back(conjugate == 1 ? std::conj(m.alpha[k]) : m.alpha[k]);
        }
    REQUIRE(Psi.cols() == 2 * n);
    MatrixXcd of_A = Psi.transpose() * A * Psi, of_H = Psi.transpose() * H * Psi;
    for (Index k = 0; k < 2 * n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        CHECK(std::abs(of_A(k, k) - alpha[i]) < 1e-13 * A.norm());
        CHECK(std::abs(of_H(k, k) + lambda[i] * alpha[i]) < 1e-13 * (H.norm() + A.norm()));
        of_A(k, k) = of_H(k, k) = 0;
    }
    CHECK(of_A.norm() < 1e-12 * A.norm());
    CHECK(of_H.norm() < 1e-12 * (H.norm() + A.norm()));
}

template <class System>
LinearSystem at_start(const System& system) {
    return linear_system(system, system.start_state(), typename System::Input{}, 0.0);
}

std::vector<Index> sizes(const Modes& m) {
    std::vector<Index> result;
    for (const ModalBlock& block : m.blocks) result.push_back(block.size);
    return result;
}

}  // namespace

TEST_CASE("Aufgabe 2.15: eigenvalues, eigenvectors and modal constants to the printed digits") {
    const LinearSystem s = at_start(spring_mass_damper::damped::System<double>{});
    CHECK(s.M == MatrixXd::Identity(3, 3));
    CHECK(s.D.isApprox(square(3, {0.4, 0, -0.3, 0, 0.2, 0, -0.3, 0, 0.3}), 1e-15));
    CHECK(s.C.isApprox(square(3, {2.5, 0, -0.5, 0, 2, -1, -0.5, -1, 1.5}), 1e-15));
    CHECK(s.B == (MatrixXd(3, 1) << 0, 0, -1).finished());
    const Modes m = modes(s);
    REQUIRE(m.is_decoupled());
    REQUIRE(m.eigenvalues.size() == 3);
    const Complex I(0, 1);
    // Here by rising frequency, in the script by falling.
    const VectorXcd printed_lambda = (VectorXcd(3) << -0.0863 + 0.7994 * I, -0.0983 + 1.5569 * I, -0.2654 + 1.6702 * I).finished();
    const VectorXcd printed_alpha = (VectorXcd(3) << -0.0246 + 0.9393 * I, -0.4164 - 0.5839 * I, -0.4837 - 0.4811 * I).finished();
    MatrixXcd printed(6, 3);
    printed << 0.1641 + 0.0636 * I, 0.2261 + 0.2584 * I, -0.0603 - 0.3793 * I,    //
        0.4516 - 0.0073 * I, -0.0241 - 0.3812 * I, -0.2113 - 0.1185 * I,          //
        0.6103, 0.0125 + 0.1653 * I, 0.0977 + 0.2082 * I,                         //
        -0.0649 + 0.1257 * I, -0.4245 + 0.3266 * I, 0.6494,                       //
        -0.03312 + 0.3616 * I, 0.5958, 0.2539 - 0.3215 * I,                       //
        -0.0527 + 0.4879 * I, -0.2586 + 0.0032 * I, -0.3737 + 0.1079 * I;
    const auto digits = [](Complex value, Complex print) { return std::max(std::abs(value.real() - print.real()), std::abs(value.imag() - print.imag())); };
    int off = 0;
    for (Index k = 0; k < 3; ++k) {
        CHECK(digits(m.eigenvalues[k], printed_lambda[k]) < 0.51e-4);
        // The modal constants belong to eigenvectors as they are printed: of length 1, with a real largest component.
        CHECK(digits(m.alpha[k], printed_alpha[k]) < 1e-4);
        for (Index i = 0; i < 6; ++i) {
            CHECK(digits(m.vectors(i, k), printed(i, k)) < 1e-4);
            off += digits(m.vectors(i, k), printed(i, k)) > 0.51e-4 ? 1 : 0;
        }
    }
    CHECK(m.alpha[1].imag() == doctest::Approx(-0.583994).epsilon(1e-5));  // printed 0.5839
    // Three components are printed one unit of the last digit away from what they round to.
    CHECK(off == 3);
    CHECK(m.vectors(0, 0).imag() == doctest::Approx(0.063545).epsilon(1e-5));   // printed 0.0636
    CHECK(m.vectors(3, 0).real() == doctest::Approx(-0.064960).epsilon(1e-5));  // printed -0.0649
    CHECK(m.vectors(5, 2).imag() == doctest::Approx(0.107951).epsilon(1e-5));   // printed 0.1079
    check_laws(s);
    check_orthogonality(s);
}

TEST_CASE("the drive train (2.189): det C = 0, and the whole train turns freely") {
    for (const bool is_damped : {true, false}) {
        const LinearSystem s = is_damped ? at_start(drive_train::damped::System<double>{}) : at_start(drive_train::undamped::System<double>{});
        CHECK(definiteness(s.M) == Definiteness::positive_definite);
        CHECK(definiteness(s.C) == Definiteness::positive_semidefinite);
        CHECK(definiteness(s.D) == (is_damped ? Definiteness::positive_semidefinite : Definiteness::zero));
        const Modes m = modes(s);
        CHECK(sizes(m) == std::vector<Index>{2, 1});
        CHECK(m.eigenvalues[0] == 0.0);
        CHECK(m.eigenvalues[1] == 0.0);
        CHECK(m.vectors.col(0).isApprox((VectorXcd(4) << 1, 1, 0, 0).finished() / std::sqrt(2), 1e-13));
        CHECK(m.matrix(0, 1).real() == doctest::Approx(1));  // the angle grows with the velocity
        // The other mode has the frequency of its reduced inertia.
        const double inertia = s.M(0, 0) * s.M(1, 1) / (s.M(0, 0) + s.M(1, 1)), c = s.C(0, 0), d = s.D(0, 0);
        CHECK(std::norm(m.eigenvalues[2]) == doctest::Approx(c / inertia).epsilon(1e-13));
        CHECK(-2 * m.eigenvalues[2].real() == doctest::Approx(d / inertia).epsilon(1e-13));
        check_laws(s);
    }
}

TEST_CASE("equal masses on equal springs: repeated eigenvalues have orthogonal eigenvectors") {
    const MatrixXd E = MatrixXd::Identity(3, 3), ring = square(3, {2, -1, -1, -1, 2, -1, -1, -1, 2});
    for (const LinearSystem& s : {pushed(2 * E, 0 * E, 8 * E), pushed(E, 0.3 * E, 4 * E), pushed(E, 0.1 * ring + 0.2 * E, ring + E), pushed(E, 5 * E, 4 * E), pushed(E, 3 * ring + E, ring + E)}) {
        CHECK(modes(s).is_decoupled());
        check_laws(s);
        check_orthogonality(s);
    }
    // A ring that nothing holds: both.
    CHECK(sizes(modes(pushed(E, 0.1 * ring, ring))) == std::vector<Index>{2, 1, 1});
    check_laws(pushed(E, 0.1 * ring, ring));
    // From a header, with equal masses and springs and no leaf spring.
    coupled_springs::full::Parameters<double> p;
    p.m_1 = p.m_2 = 1.3;
    p.c_1 = p.c_2 = 7;
    p.c_12 = 0;
    const LinearSystem s = at_start(coupled_springs::full::System<double>(p));
    const Modes m = modes(s);
    CHECK(m.eigenvalues[0].imag() == doctest::Approx(std::sqrt(7 / 1.3)).epsilon(1e-14));
    CHECK(m.eigenvalues[1].imag() == doctest::Approx(std::sqrt(7 / 1.3)).epsilon(1e-14));
    check_orthogonality({s.M, s.D, s.C, MatrixXd(2, 0)});
}

TEST_CASE("critical damping stays together, next to it too") {
    const MatrixXd E = MatrixXd::Identity(3, 3);
    const Modes critical = modes(pushed(E, 4 * E, 4 * E));
    CHECK(sizes(critical) == std::vector<Index>{2, 2, 2});
    for (Index k = 0; k < 6; ++k) CHECK(std::abs(critical.eigenvalues[k] + 2.0) < 1e-14);
    CHECK(real_form(critical).inverse.norm() < 10);  // well conditioned
    check_laws(pushed(E, 4 * E, 4 * E));
    for (const double off : {1e-14, 1e-10, 1e-7, 1e-5, 1e-3, -1e-12, -1e-8, -1e-6, -1e-3}) check_laws(pushed(E, 2 * (1 + off) * E, E));
    check_laws(pushed(diagonal({1, 2, 3}), diagonal({2, 1, 6}), diagonal({1, 1, 3})));  // two of three
    // A pair of conjugate eigenvalues that is defective: springs that are not symmetric.
    const LinearSystem chained = pushed(MatrixXd::Identity(2, 2), MatrixXd::Zero(2, 2), square(2, {4, 1, 0, 4}));
    CHECK(sizes(modes(chained)) == std::vector<Index>{2});
    CHECK_FALSE(modes(chained).blocks[0].is_real);
    check_laws(chained);
    // Three in a chain.
    check_laws(pushed(E, 2 * E, square(3, {1, 1, 0, 0, 1, 1, 0, 0, 1})));
}

TEST_CASE("overdamped, damped without springs, and free") {
    const MatrixXd E = MatrixXd::Identity(3, 3);
    const LinearSystem over = pushed(E, diagonal({4, 5.5, 7}), 2 * E);
    const Modes m = modes(over);
    CHECK(m.eigenvalues.size() == 6);
    for (Index k = 0; k < 6; ++k) CHECK(m.eigenvalues[k].imag() == 0);
    check_laws(over);
    check_orthogonality(over);
    const LinearSystem braked = pushed(E, diagonal({1e-3, 5, 7}), 0 * E);
    CHECK(modes(braked).is_decoupled());
    CHECK((modes(braked).eigenvalues.head(3).array() == 0.0).all());
    check_laws(braked);
    // A soft brake beside stiff springs: -d/m keeps its digits.
    const Modes soft = modes(pushed(MatrixXd::Identity(2, 2), diagonal({1e-6, 1}), diagonal({0, 1e4})));
    CHECK(soft.eigenvalues[1].real() == doctest::Approx(-1e-6).epsilon(1e-12));
    // And a slow creep behind fast damping.
    CHECK(modes(pushed(MatrixXd::Identity(1, 1), diagonal({1e6}), diagonal({1}))).eigenvalues[0].real() == doctest::Approx(-1e-6 - 1e-18).epsilon(1e-15));
    const LinearSystem free = pushed(diagonal({0.1, 2, 30}), 0 * E, 0 * E);
    CHECK(sizes(modes(free)) == std::vector<Index>{2, 2, 2});
    CHECK((modes(free).eigenvalues.array() == 0.0).all());
    check_laws(free);
    // Both at once, one direction free and one braked: zero three times, with two eigenvectors.
    const LinearSystem half = pushed(diagonal({1, 3}), square(2, {2, 2, 2, 2}), MatrixXd::Zero(2, 2));
    CHECK(sizes(modes(half)).size() == 3);
    check_laws(half);
    // Frequencies far apart.
    const Modes graded = modes(pushed(E, 0 * E, diagonal({1, 1e8, 1e-4})));
    CHECK(graded.eigenvalues[0].imag() == doctest::Approx(1e-2).epsilon(1e-12));
    CHECK(graded.eigenvalues[2].imag() == doctest::Approx(1e4).epsilon(1e-14));
    CHECK((graded.eigenvalues.real().array() == 0).all());
}

TEST_CASE("matrices that are not symmetric: gyroscopes, circulatory forces, negative springs and dampers") {
    const MatrixXd E = MatrixXd::Identity(2, 2), G = square(2, {0, -3, 3, 0});
    for (const LinearSystem& s : {pushed(E, G, 2 * E), pushed(E, G, -2 * E), pushed(E, G, 0 * E), pushed(E, 0 * E, square(2, {1, 0.5, -0.5, 1})), pushed(E, -0.2 * E, E),
                                  pushed(E, 0 * E, -E), pushed(diagonal({1, 3}), G + 0.1 * E, square(2, {2, 0.3, -0.7, 5}))})
        check_laws(s);
    // M ydd + G yd = 0 with a regular G: turns on circles, lambda = +-3i, and rests anywhere.
    CHECK(modes(pushed(E, G, 0 * E)).is_decoupled());
    CHECK(modes(pushed(E, G, -2 * E)).eigenvalues.real().isZero(1e-14));  // held by its gyroscope alone
}

TEST_CASE("the linearisation of what is not linear: a hanging chain") {
    const n_pendulum_N5::full::System<double> system;
    const LinearSystem s = linear_system(system, {}, {}, 0.0);
    CHECK(s.C.isDiagonal(0));  // without what is only rounding
    CHECK(s.D.isZero(0));
    CHECK(definiteness(s.C) == Definiteness::positive_definite);
    check_laws({s.M, s.D, s.C, MatrixXd::Identity(5, 5)});
    check_orthogonality({s.M, s.D, s.C, MatrixXd(5, 0)});
}

TEST_CASE("random systems up to twelve degrees of freedom") {
    std::mt19937 generator(1);
    std::normal_distribution<> normal;
    for (const Index n : {1, 2, 3, 5, 8, 12})
        for (int kind = 0; kind < 4; ++kind) {
            CAPTURE(n);
            CAPTURE(kind);
            const auto random = [&]() -> MatrixXd { return MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); }); };
            const MatrixXd a = random(), b = random(), c = random();
            LinearSystem s{a * a.transpose() / static_cast<double>(n) + 0.2 * MatrixXd::Identity(n, n), 0.2 * b * b.transpose() / static_cast<double>(n), c * c.transpose(), random()};
            // Singular D and C; D, and C as well, that are not symmetric.
            if (kind == 1) {
                s.D = b.leftCols(n / 2) * b.leftCols(n / 2).transpose();
                s.C = c.leftCols((n + 1) / 2) * c.leftCols((n + 1) / 2).transpose();
            }
            if (kind >= 2) s.D = 0.3 * b;
            if (kind == 3) s.C = c;
            check_laws(s);
            if (kind == 0) check_orthogonality(s);
        }
}

TEST_CASE("what cannot be done is told by a status") {
    const MatrixXd E = MatrixXd::Identity(2, 2);
    CHECK(modes({}).status == ModalStatus::wrong_shape);
    CHECK(modes(pushed(E, MatrixXd::Zero(3, 3), E)).status == ModalStatus::wrong_shape);
    CHECK(modes({E, E, E, MatrixXd(3, 1)}).status == ModalStatus::wrong_shape);
    CHECK(modes(pushed(E, E, std::nan("") * E)).status == ModalStatus::not_finite);
    CHECK(modes(pushed(diagonal({1, 0}), E, E)).status == ModalStatus::mass_not_positive_definite);
    CHECK(modes(pushed(square(2, {1, 2, 2, 1}), E, E)).status == ModalStatus::mass_not_positive_definite);
    CHECK(modes(pushed(square(2, {1, 0.1, 0, 1}), E, E)).status == ModalStatus::mass_not_positive_definite);
    CHECK(modes({E, E, E, MatrixXd(2, 0)}).status == ModalStatus::success);
    CHECK(to_string(ModalStatus::mass_not_positive_definite) == std::string("mass matrix not positive definite"));
}

TEST_CASE("definiteness does not depend on units") {
    const MatrixXd spring = square(2, {1, -1, -1, 1});
    for (const double unit : {1.0, 1e-6, 1e7}) {
        const MatrixXd scale = diagonal({1, unit});
        CHECK(definiteness(scale * spring * scale) == Definiteness::positive_semidefinite);
        CHECK(definiteness(scale * (spring + 1e-3 * MatrixXd::Identity(2, 2)) * scale) == Definiteness::positive_definite);
        CHECK(definiteness(-scale * spring * scale) == Definiteness::negative_semidefinite);
        CHECK(definiteness(scale * square(2, {1, 2, 2, 1}) * scale) == Definiteness::indefinite);
    }
    CHECK(definiteness(square(2, {0, 1, 1, 0})) == Definiteness::indefinite);
    CHECK(definiteness(square(2, {0, 1, -1, 0})) == Definiteness::not_symmetric);
    CHECK(definiteness(MatrixXd::Zero(2, 2)) == Definiteness::zero);
    CHECK(definiteness(-MatrixXd::Identity(2, 2)) == Definiteness::negative_definite);
}
