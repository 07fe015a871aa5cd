// SPDX-License-Identifier: GPL-3.0-or-later
// Mass matrix, bias and forces of a tree of bodies on one that flies against Orocos KDL, which knows nothing of how they were derived.
#include <doctest/doctest.h>

#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <map>
#include <random>
#include <string>

#include "leg.hpp"

namespace {

using Parameters = leg::full::Parameters<double>;
using System = leg::full::System<double>;
constexpr std::size_t n = leg::full::degrees_of_freedom;

/// Joints are named as coordinates are; of the body that flies there is one to each of them.
KDL::Tree tree(const Parameters& p) {
    using KDL::Joint;
    using KDL::RotationalInertia;
    using KDL::Segment;
    using KDL::Vector;
    KDL::Tree result("ground");
    std::string last = "ground";
    const auto add = [&](const std::string& name, Joint::JointType type,
                         const KDL::RigidBodyInertia& inertia = KDL::RigidBodyInertia::Zero()) {
        REQUIRE(result.addSegment(Segment(name, Joint(name, type), KDL::Frame::Identity(), inertia), last));
        last = name;
    };
    const auto place = [&](const std::string& on, const KDL::Frame& frame) {
        const std::string name = "place of " + std::to_string(result.getNrOfSegments());
        REQUIRE(result.addSegment(Segment(name, Joint(name, Joint::None), frame), on));
        last = name;
    };
    const double J = p.J, l = p.l, m = p.m;
    add("x", Joint::TransX);
    add("y", Joint::TransY);
    add("z", Joint::TransZ);
    add("psi", Joint::RotZ);
    add("the", Joint::RotY);
    add("phi", Joint::RotX,
        KDL::RigidBodyInertia(3 * m, Vector(0, l / 5, l / 7), RotationalInertia(1.2 * J, 2 * J, 1.3 * J, J / 9, 0, J / 7)));
    place("phi", KDL::Frame(Vector(0, l / 4, -l / 6)));
    add("a", Joint::RotX, KDL::RigidBodyInertia(0, Vector::Zero(), RotationalInertia(J, J / 2, J / 1.5)));
    place("a", KDL::Frame(Vector(0, 0, -l / 5)));
    add("b", Joint::RotY, KDL::RigidBodyInertia(m, Vector(l / 9, 0, -l / 2), RotationalInertia(J, J, J / 10)));
    place("b", KDL::Frame(Vector(l / 8, 0, -l)));
    const Joint foot("s", Vector::Zero(), Vector(0, 0, -1), Joint::TransAxis);
    REQUIRE(result.addSegment(Segment("s", foot, KDL::Frame(KDL::Rotation::RotY(0.3)),
                                      KDL::RigidBodyInertia(m / 2, Vector::Zero(), RotationalInertia(J / 5, J / 5, J / 9))),
                              last));
    place("phi", KDL::Frame(Vector(0, -l / 3, l / 2)));
    add("w", Joint::RotZ, KDL::RigidBodyInertia(m / 3, Vector(l / 2, 0, 0), RotationalInertia(J / 9, J, J)));
    return result;
}

/// Of a segment, in the ground.
KDL::Rotation orientation(const KDL::Tree& tree, const KDL::JntArray& q, const char* name) {
    KDL::Frame turned = KDL::Frame::Identity();
    for (auto segment = tree.getSegment(name);; segment = segment->second.parent) {
        turned = segment->second.segment.pose(q(segment->second.q_nr)) * turned;
        if (segment->second.parent->first == "ground") return turned.M;
    }
}

/// What holds the tree at rest needs the opposite of what moves it. Wrenches are at the origin and in the axes of their segment.
std::map<std::string, KDL::Wrench> balancing(std::map<std::string, KDL::Wrench> acting) {
    for (auto& [name, wrench] : acting) wrench = -wrench;
    return acting;
}

}  // namespace

TEST_CASE("a tree of bodies has the mass matrix, the bias and the forces of an independent implementation") {
    Parameters p;
    p.c = p.d = 0;  // the other one knows neither springs nor dampers
    const System system(p);
    const KDL::Tree other = tree(p);
    REQUIRE(other.getNrOfJoints() == n);
    const std::array<const char*, n> names{"x", "y", "z", "psi", "the", "phi", "s", "a", "w", "b"};
    std::array<unsigned, n> place{};
    for (const auto& [name, element] : other.getSegments())
        for (std::size_t i = 0; i < n; ++i)
            if (element.segment.getJoint().getName() == names[i] && element.segment.getJoint().getType() != KDL::Joint::None)
                place[i] = element.q_nr;
    KDL::TreeIdSolver_RNE falling(other, KDL::Vector(0, 0, -p.g)), weightless(other, KDL::Vector::Zero());
    std::mt19937 engine(2311);
    std::uniform_real_distribution<double> any(-3, 3);
    double worst = 0;
    for (int repetition = 0; repetition < 100; ++repetition) {
        System::State x{};
        KDL::JntArray q(n), qd(n), still(n), none(n), torque(n);
        for (std::size_t i = 0; i < n; ++i) {
            q(place[i]) = x[i] = any(engine);
            qd(place[i]) = x[n + i] = any(engine);
        }
        System::MassMatrix M{};
        System::Generalised bias{}, force{};
        const System::Input u{0, any(engine), any(engine), any(engine)};
        system.mass_matrix(x, 0, M);
        system.bias(x, u, 0, bias);
        system.generalised_force(x, u, 0, force);
        const auto compare = [&](const auto& own) {
            double size = 0;
            for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(torque(static_cast<unsigned>(i))));
            for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(own(i) - torque(place[i])) / size);
        };
        for (std::size_t j = 0; j < n; ++j) {
            KDL::JntArray one(n);
            one(place[j]) = 1;
            REQUIRE(weightless.CartToJnt(q, still, one, {}, torque) == 0);
            compare([&](std::size_t i) { return M[n * j + i]; });
        }
        REQUIRE(falling.CartToJnt(q, qd, none, {}, torque) == 0);
        compare([&](std::size_t i) { return bias[i]; });
        const auto [F, P, drive] = std::array{u[1], u[2], u[3]};
        const auto axes = [&](const char* name) { return orientation(other, q, name); };
        const KDL::Vector jet(P, 0, P / 2), turning(drive, drive / 2, drive / 3), upward(0, drive, drive / 4), none_at_all;
        const std::map<std::string, KDL::Wrench> acting{
            {"s", {axes("s").Inverse() * KDL::Vector(0, 0, F), none_at_all}},
            {"w", {jet, KDL::Vector(p.l / 2, 0, 0) * jet + axes("w").Inverse() * upward}},
            {"b", {none_at_all, turning}},
            {"phi", {none_at_all, axes("phi").Inverse() * axes("b") * (-turning)}}};
        REQUIRE(weightless.CartToJnt(q, still, none, balancing(acting), torque) == 0);
        compare([&](std::size_t i) { return force[i]; });
    }
    MESSAGE("largest difference, relative to the largest entry: ", worst);
    CHECK(worst < 1e-12);
}
