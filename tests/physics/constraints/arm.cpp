// SPDX-License-Identifier: GPL-3.0-or-later
// Mass matrix and bias of the arm with six joints against Orocos KDL, which knows nothing of how they were derived.
#include <doctest/doctest.h>

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <random>

#include "mechanics/arm_6r_plain.hpp"

namespace {

using Parameters = arm_6r::plain::Parameters<double>;
using System = arm_6r::plain::System<double>;

/// A fixed frame, and behind it a joint about z with the link that turns on it; its moments are about the centre of mass.
void add(KDL::Chain& chain, const KDL::Vector& origin, double about_x, double mass, const KDL::Vector& centre, double J_x, double J_y, double J_z) {
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), KDL::Frame(KDL::Rotation::RotX(about_x), origin)));
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::Identity(), KDL::RigidBodyInertia(mass, centre, KDL::RotationalInertia(J_x, J_y, J_z))));
}

KDL::Chain arm(const Parameters& p) {
    using KDL::Vector;
    const double quarter = std::acos(0.0);
    KDL::Chain chain;
    const double a = p.a_2 * p.a_2, d = p.d_4 * p.d_4;
    add(chain, Vector::Zero(), 0, 0, Vector::Zero(), p.J_1, p.J_1, p.J_1);
    add(chain, Vector::Zero(), -quarter, p.m_2, Vector(p.a_2 / 3, 0, p.d_3 / 2), p.m_2 * a / 100, p.m_2 * a / 10, p.m_2 * a / 10);
    add(chain, Vector(p.a_2, 0, p.d_3), 0, p.m_3, Vector(p.a_3, -p.d_4 / 6, 0), p.m_3 * d / 12, p.m_3 * d / 100, p.m_3 * d / 12);
    add(chain, Vector(p.a_3, p.d_4, 0), -quarter, p.m_4, Vector(0, 0, -p.d_4 / 5), p.m_4 * d / 50, p.m_4 * d / 50, p.m_4 * d / 100);
    add(chain, Vector::Zero(), quarter, 0, Vector::Zero(), p.J_5, p.J_5, p.J_5);
    add(chain, Vector::Zero(), -quarter, p.m_6, Vector(p.c_x, 0, p.c_z), p.J_5, 2 * p.J_5, p.J_5);
    return chain;
}

}  // namespace

TEST_CASE("the arm has the mass matrix and the bias of an independent implementation") {
    const System system;
    const Parameters p = system.parameters();
    const KDL::Chain chain = arm(p);  // which the other one only refers to
    KDL::ChainDynParam other(chain, KDL::Vector(0, 0, -p.g));
    std::mt19937 engine(2311);
    std::uniform_real_distribution<double> angle(-3, 3);
    double worst = 0;
    for (int repetition = 0; repetition < 100; ++repetition) {
        System::State x{};
        KDL::JntArray q(6), qd(6), coriolis(6), gravity(6);
        for (unsigned i = 0; i < 6; ++i) {
            q(i) = x[i] = angle(engine);
            qd(i) = x[6 + i] = angle(engine);
        }
        KDL::JntSpaceInertiaMatrix inertia(6);
        REQUIRE(other.JntToMass(q, inertia) == 0);
        REQUIRE(other.JntToCoriolis(q, qd, coriolis) == 0);
        REQUIRE(other.JntToGravity(q, gravity) == 0);
        System::MassMatrix M{};
        System::Generalised bias{};
        system.mass_matrix(x, 0, M);
        system.bias(x, {}, 0, bias);
        double size = 0, largest_bias = 0;
        for (const double entry : M) size = std::max(size, std::abs(entry));
        for (const double entry : bias) largest_bias = std::max(largest_bias, std::abs(entry));
        for (unsigned i = 0; i < 6; ++i) {
            for (unsigned j = 0; j < 6; ++j) worst = std::max(worst, std::abs(M[6 * j + i] - inertia(i, j)) / size);
            worst = std::max(worst, std::abs(bias[i] - coriolis(i) - gravity(i)) / largest_bias);
        }
    }
    MESSAGE("largest difference, relative to the largest entry: ", worst);
    CHECK(worst < 1e-12);
}
