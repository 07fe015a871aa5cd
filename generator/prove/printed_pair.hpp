// SPDX-License-Identifier: GPL-3.0-or-later
// One pair of sides of a printed equation on the motion of a system.
#pragma once

#include "prove/printed.hpp"
#include "prove/printed_number.hpp"

namespace dalembert {

/// At the point that the entry names, if any.
class PairCheck {
public:
    PairCheck(const System& system, GiNaC::exmap at);
    PrintedResult run(const GiNaC::ex& left_side, const GiNaC::ex& right_side);
    /// A value against the number that is printed for it.
    PrintedResult run_number(const GiNaC::ex& value, const PrintedNumber& number);
    /// Whether the two sides are equal at a few random points: quick, and true of all that are equal.
    bool may_hold(const GiNaC::ex& left_side, const GiNaC::ex& right_side) const;

private:
    bool has_open_integral(const GiNaC::ex& e) const;
    /// Where an integral has no primitive that is found: by numbers of a quadrature.
    PrintedResult run_by_quadrature(const GiNaC::ex& left, const GiNaC::ex& right);
    PrintedResult number_by_quadrature(const GiNaC::ex& value, const PrintedNumber& number);
    /// The point with the integrals that occur; nothing where one has no value.
    std::optional<Point> with_integrals(const Point& point);
    /// Or a multiplier: what is solved for.
    bool contains_acceleration(const GiNaC::ex& e) const;
    const GiNaC::ex& acceleration(std::size_t k) const { return unknowns_[k]; }
    GiNaC::ex prepared(const GiNaC::ex& e) const { return at_point(system_.with_rates(on_constraints(e))); }
    /// On what constraints hold: each with a multiplier gives a velocity, where its factor is not zero, and its position a coordinate that
    /// it is linear in. What is equal there is so, by continuity, where a factor vanishes.
    GiNaC::ex on_constraints(GiNaC::ex e) const;
    void find_manifold();
    /// A coordinate that a position is linear in, with a factor that does not move, and where it is when the position is zero.
    std::optional<std::pair<std::size_t, GiNaC::ex>> coordinate_on(const GiNaC::ex& position);
    /// A point may set a parameter that definitions are made of.
    GiNaC::ex at_point(const GiNaC::ex& e) const {
        return at_.empty() ? e : system_.symbols.without_definitions(e).subs(at_, GiNaC::subs_options::no_pattern);
    }
    /// Of a printed equation that is linear: "holds to first order about x = 0, phi = 0" where that is proven; else empty.
    std::string order_hint(const GiNaC::ex& left, const GiNaC::ex& right);
    /// Coordinates, velocities, and what is solved for.
    std::vector<GiNaC::ex> small_quantities() const;
    GiNaC::ex at_rest(const GiNaC::ex& e) const;
    /// Of first order in the small quantities.
    GiNaC::ex linear_terms(const GiNaC::ex& e) const;
    bool holds_with_linear_motion(const GiNaC::ex& rest);
    GiNaC::ex mass(std::size_t j, std::size_t l) const;
    /// M qdd = force on the motion.
    GiNaC::ex force(std::size_t j) const { return prepared(system_.motion.force[j]); }
    /// Whether a.qdd + b vanishes when M qdd = force. Where it is a multiple of one row, the difference from that row is kept.
    bool holds_on_motion(const GiNaC::ex& rest, PrintedResult& result);
    /// Of one acceleration that does not stand alone, as in a magnitude: with what it is.
    std::optional<Comparison> with_single_acceleration(const GiNaC::ex& left, const GiNaC::ex& right);
    /// Where M is singular at the point, no acceleration follows and nothing can be said of it.
    bool has_inverse();
    /// The same as multiple_of_row finds, without squares of sines and cosines that add up to one: for people.
    GiNaC::ex shortened(const std::vector<GiNaC::ex>& a, std::size_t j) const;
    /// c with a = c*(row j of M), if there is one.
    std::optional<GiNaC::ex> multiple_of_row(const std::vector<GiNaC::ex>& a, std::size_t j);
    /// The point with numbers of three digits, if the sides differ there too.
    CounterExample counterexample(const GiNaC::ex& left, const GiNaC::ex& right, const Point& found) const;
    /// Whether a letter influences the value: directly, or through the accelerations.
    bool needed(const GiNaC::ex& e, const GiNaC::ex& letter) const;
    /// The value with the accelerations that the system has at the point.
    std::optional<cln::cl_R> value_on_motion(const GiNaC::ex& e, const Point& point, int digits) const;

    const System& system_;
    Prover prover_;
    GiNaC::exmap at_;
    GiNaC::exmap held_, velocities_, positions_;
    std::vector<GiNaC::ex> unknowns_;
    std::vector<std::optional<double>> fixed_integrals_;  ///< of the open ones those without letters
    std::size_t n_;  ///< accelerations that are solved for
};

}  // namespace dalembert
