// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/quadrature.hpp"

#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr int quadrature_digits = 40;
constexpr double wanted_accuracy = 1e-6, good_accuracy = 1e-4, fine_accuracy = 1e-9;
constexpr double next_to_an_end = 1e-30;  ///< relative: what may be singular there adds nothing,
constexpr double far_away = 1e12;         ///< nor what vanishes there

/// The integrand has no value inside.
struct NoValue {};

struct Quadrature {
    double value = 0, error = 0, size = 0;  ///< size: integral of the magnitude

    Quadrature& operator+=(const Quadrature& other) {
        value += other.value;
        error += other.error;
        size += other.size;
        return *this;
    }
};

class At {
public:
    At(const System& system, const DefiniteIntegral& integral, const Point& point, double accuracy = wanted_accuracy)
        : symbols_(system.symbols), integral_(integral), point_(point), accuracy_(accuracy) {}

    std::optional<cln::cl_R> value(const ex& e) const { return value_at(e, symbols_, point_, quadrature_digits); }

    /// From where x is to where it is farther by `step`.
    Quadrature over(const cln::cl_R& from, const cln::cl_R& step) const {
        static boost::math::quadrature::tanh_sinh<double> whole, of_parts(6);  // parts are halved rather than refined
        auto& rule = accuracy_ < wanted_accuracy ? of_parts : whole;
        Quadrature q;
        const auto f = [&](double u) { return u < next_to_an_end ? 0 : integrand(from + step * exact(u)); };
        q.value = rule.integrate(f, 0.0, 1.0, accuracy_, &q.error, &q.size);
        return scaled(q, cln::double_approx(step));
    }
    /// From there to infinity.
    Quadrature beyond(const cln::cl_R& from, int sign) const {
        static boost::math::quadrature::exp_sinh<double> rule;
        Quadrature q;
        const auto f = [&](double u) { return u < next_to_an_end || u > far_away ? 0 : integrand(from + sign * exact(u)); };
        q.value = rule.integrate(f, accuracy_, &q.error, &q.size);
        return scaled(q, sign);
    }

private:
    static cln::cl_R exact(double u) { return cln::rational(cln::cl_DF(u)); }
    static Quadrature scaled(const Quadrature& q, double factor) {
        return {q.value * factor, q.error * std::fabs(factor), q.size * std::fabs(factor)};
    }

    double integrand(const cln::cl_R& x) const {
        Point point = point_;
        point.emplace_back(integral_.variable, cln::rational(x));
        const auto value = value_at(integral_.function, symbols_, point, quadrature_digits);
        if (!value) throw NoValue{};
        const double result = cln::double_approx(*value);
        if (!std::isfinite(result)) throw NoValue{};
        return result;
    }

    const Symbols& symbols_;
    const DefiniteIntegral& integral_;
    const Point& point_;
    double accuracy_;
};

/// Both ends are ends of a part of their own, where the places have as many digits as their distance from the end.
Quadrature between(const At& at, const cln::cl_R& from, const cln::cl_R& to) {
    const cln::cl_R middle = from + (to - from) * cln::cl_RA("463/1000");
    Quadrature q = at.over(from, middle - from);
    const Quadrature other = at.over(to, middle - to);
    q += {-other.value, other.error, other.size};
    return q;
}

/// Halved until each part is as accurate as wanted, or `halvings` times.
Quadrature in_parts(const At& at, const cln::cl_R& from, const cln::cl_R& to, int halvings) {
    const Quadrature q = between(at, from, to);
    if (halvings == 0 || q.error <= fine_accuracy * q.size) return q;
    const cln::cl_R middle = (from + to) / 2;
    Quadrature parts = in_parts(at, from, middle, halvings - 1);
    return parts += in_parts(at, middle, to, halvings - 1);
}

/// An end at infinity is zero in `from` and `to`.
Quadrature over_all(const At& at, const DefiniteIntegral& integral, const cln::cl_R& from, const cln::cl_R& to, int halvings) {
    const bool has_low = integral.infinite_from == 0, has_high = integral.infinite_to == 0;
    if (has_low && has_high) return in_parts(at, from, to, halvings);
    Quadrature q;
    if (has_low || has_high) {
        q = has_low ? at.beyond(from, integral.infinite_to) : at.beyond(to, integral.infinite_from);
        if (!has_low) q.value = -q.value;
        return q;
    }
    q = at.beyond(0, 1);
    const Quadrature other = at.beyond(0, -1);
    q += {-other.value, other.error, other.size};
    if (integral.infinite_from > 0) q.value = -q.value;
    return q;
}

}  // namespace

std::optional<double> value_by_quadrature(const System& system, const DefiniteIntegral& integral, const Point& point) {
    constexpr int halvings = 12;
    const At at(system, integral, point, fine_accuracy);
    const auto from = at.value(integral.from), to = at.value(integral.to);
    if (!from || !to) return std::nullopt;
    try {
        const Quadrature q = over_all(at, integral, *from, *to, halvings);
        if (!std::isfinite(q.value) || !(q.error <= 10 * fine_accuracy * q.size)) return std::nullopt;
        return q.value;
    } catch (const NoValue&) {
        return std::nullopt;
    } catch (const std::exception&) {  // of the rule: infinite, or too many steps
        return std::nullopt;
    }
}

bool agrees_with_quadrature(const System& system, const DefiniteIntegral& integral) {
    constexpr int points = 2;
    RandomPoints random(system);
    for (int i = 0; i < points; ++i) {
        const Point point = random.next();
        const At at(system, integral, point);
        const auto from = at.value(integral.from), to = at.value(integral.to), value = at.value(integral.value);
        if (!from || !to) continue;
        try {
            const Quadrature q = over_all(at, integral, *from, *to, 0);
            if (!value || !(q.error <= good_accuracy * q.size) ||
                !(std::fabs(q.value - cln::double_approx(*value)) <= good_accuracy * q.size))
                return false;
        } catch (const NoValue&) {
            if (value) return false;
        } catch (const std::exception&) {  // of the rule: infinite, or too many steps
            return false;
        }
    }
    return true;
}

}  // namespace dalembert
