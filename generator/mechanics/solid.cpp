// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/solid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/statics.hpp"
#include "mechanics/solid_shape.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/integrate.hpp"
#include "symbolic/quotient.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Written out where that stays short.
ex short_form(const ex& e) {
    constexpr std::size_t most_terms = 8;
    const ex expanded = e.expand();
    return GiNaC::is_a<GiNaC::add>(expanded) && expanded.nops() > most_terms ? e : expanded;
}

/// Whether a sum stands in a denominator.
bool divides_by_sum(const ex& e) {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::power>(*part) && GiNaC::is_a<GiNaC::add>(part->op(0)) && part->op(1).info(GiNaC::info_flags::negative))
            return true;
    return false;
}

/// Quotients by sums stay letters in what is made of them: products of them would be multiplied out without end.
SpaceVector without_quotients(const SpaceVector& v) {
    const auto one = [](const ex& e) { return divides_by_sum(e) ? ex(whole(e)) : e; };
    return {one(v[0]), one(v[1]), one(v[2])};
}

template <class Entry>
SpaceMatrix symmetric(const Entry& entry) {
    SpaceMatrix result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) result[i][j] = result[j][i] = entry(i, j);
    return result;
}

SpaceMatrix sum_of(const SpaceMatrix& a, const SpaceMatrix& b) {
    return symmetric([&](std::size_t i, std::size_t j) { return a[i][j] + b[i][j]; });
}

/// (2.167) from integrals of density*x_i*x_j.
SpaceMatrix inertia_from(const SpaceMatrix& second) {
    const ex trace = second[0][0] + second[1][1] + second[2][2];
    return symmetric([&](std::size_t i, std::size_t j) { return (i == j ? trace : ex(0)) - second[i][j]; });
}

/// A tensor in turned axes, R J R'. A diagonal one as J_k + sum of (J_l - J_k) e_l e_l', which leaves out what is round.
SpaceMatrix turned(const SpaceMatrix& J, const SpaceMatrix& R) {
    const bool is_diagonal = J[0][1].is_zero() && J[0][2].is_zero() && J[1][2].is_zero();
    if (!is_diagonal) {
        const auto along = [&](std::size_t i, std::size_t j) {
            ex sum = 0;
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t l = 0; l < 3; ++l) sum += R[i][k] * J[k][l] * R[j][l];
            return sum;
        };
        return symmetric(along);
    }
    const std::size_t reference = J[1][1].is_equal(J[2][2]) ? 1 : 0;
    return symmetric([&](std::size_t i, std::size_t j) {
        ex sum = i == j ? J[reference][reference] : ex(0);
        for (std::size_t l = 0; l < 3; ++l) sum += (J[l][l] - J[reference][reference]) * R[i][l] * R[j][l];
        return sum;
    });
}

/// What a solid made of one shape gives in its own axes, and how it is placed.
class ShapeIntegrals {
public:
    ShapeIntegrals(const Solid& solid, const Translator& translate, const SpaceMatrix& axes, const SpaceVector& origin)
        : solid_(solid), translate_(translate), axes_(axes), origin_(origin), shape_(shape_of(solid, translate)) {}

    SolidProperties take() {
        density_ = density();
        volume_ = integral(1);
        if (solid_.mass) {
            mass_ = GiNaC::possymbol("solid.m");
            shape_.lengths[mass_] = translate_(solid_.mass, {});
        } else {
            mass_ = volume_;
        }
        // Of the whole: mass, first and second moments in own axes; then about the centre, and placed.
        const SpaceVector& own = shape_.place;
        const ex& mass = mass_;
        SpaceVector first;
        for (std::size_t i = 0; i < 3; ++i) first[i] = scaled(integral(own[i]));
        const SpaceMatrix second = symmetric([&](std::size_t i, std::size_t j) { return scaled(integral(own[i] * own[j])); });
        SpaceVector centre;
        for (std::size_t i = 0; i < 3; ++i) centre[i] = quotient(first[i], mass);
        const SpaceMatrix about_centre = inertia_from(
            symmetric([&](std::size_t i, std::size_t j) { return quotient((second[i][j] * mass - first[i] * first[j]).expand(), mass); }));

        SolidProperties result;
        result.mass = by_lengths(mass);
        result.centre = origin_ + axes_ * by_lengths(centre);
        for (ex& e : result.centre) e = short_form(e);
        result.about_centre = turned(by_lengths(about_centre), axes_);
        for (SpaceVector& row : result.about_centre)
            for (ex& e : row) e = short_form(e);

        const SpaceVector placed = origin_ + axes_ * own;
        result.direct.mass = result.mass;
        for (std::size_t i = 0; i < 3; ++i) result.direct.first[i] = by_lengths(scaled(integral(placed[i])));
        result.direct.second = symmetric([&](std::size_t i, std::size_t j) { return by_lengths(scaled(integral(placed[i] * placed[j]))); });
        result.primitives = std::move(primitives_);
        return result;
    }

private:
    /// By the variables of the shape; 1 where the mass is given.
    ex density() {
        if (solid_.mass) return 1;
        const GiNaC::realsymbol place[]{GiNaC::realsymbol("solid.x"), GiNaC::realsymbol("solid.y"), GiNaC::realsymbol("solid.z")};
        const ex given = translate_(*solid_.density, {}, Letters{{"x", place[0]}, {"y", place[1]}, {"z", place[2]}});
        const bool is_even = std::none_of(std::begin(place), std::end(place), [&](const auto& x) { return given.has(x); });
        if (is_even && !GiNaC::is_exactly_a<GiNaC::numeric>(given)) {
            const GiNaC::possymbol rho("solid.rho");
            shape_.lengths[rho] = given;
            return rho;
        }
        GiNaC::exmap at;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!given.is_polynomial(place[i]))
                throw Failure(
                    Diagnostic{Id::cannot_integrate, solid_.density->span,
                               fmt::format("the density of solid '{}' is not a polynomial in {}, so it cannot be integrated exactly",
                                           solid_.name, "xyz"[i])});
            at[place[i]] = shape_.place[i];
        }
        return given.subs(at, GiNaC::subs_options::no_pattern);
    }

    /// Of density times a function of the place over the volume.
    ex integral(const ex& function) {
        ex rest = (function * density_ * shape_.volume_element).expand();
        for (const ShapeIntegral& one : shape_.integrals) {
            const auto primitive = integrate(rest, one.variable);
            if (!primitive)
                throw Failure(Diagnostic{Id::cannot_integrate, solid_.span,
                                         fmt::format("the program cannot find the integrals over solid '{}'", solid_.name)});
            if (!rest.is_zero()) primitives_.push_back({rest, *primitive, one.variable});
            const auto at = [&](const ex& limit) { return primitive->subs(one.variable == limit, GiNaC::subs_options::no_pattern); };
            rest = (at(one.to) - at(one.from)).expand();
        }
        return rest;
    }

    ex scaled(const ex& moment) const { return solid_.mass ? quotient((moment * mass_).expand(), volume_) : moment; }

    ex by_lengths(const ex& e) const { return e.subs(shape_.lengths, GiNaC::subs_options::no_pattern); }
    SpaceVector by_lengths(const SpaceVector& v) const { return {by_lengths(v[0]), by_lengths(v[1]), by_lengths(v[2])}; }
    SpaceMatrix by_lengths(const SpaceMatrix& m) const { return {by_lengths(m[0]), by_lengths(m[1]), by_lengths(m[2])}; }

    const Solid& solid_;
    const Translator& translate_;
    SpaceMatrix axes_;
    SpaceVector origin_;
    SolidShape shape_;
    ex density_;
    ex volume_;  ///< integral of the density: the mass, or where that is given the volume
    ex mass_;
    std::vector<Primitive> primitives_;
};

/// All the mass at one place.
SolidProperties point_properties(const Solid& solid, const Translator& translate, const SpaceVector& origin) {
    SolidProperties result;
    result.mass = translate(solid.mass, {});
    result.centre = origin;
    result.direct = {result.mass, result.mass * origin,
                     symmetric([&](std::size_t i, std::size_t j) { return result.mass * origin[i] * origin[j]; })};
    return result;
}

/// (2.58), and Steiner's theorem (2.173) from the centre of each part to that of the whole.
SolidProperties composed(const Solid& solid, const std::function<const SolidProperties&(const Reference&)>& part, const SpaceMatrix& axes,
                         const SpaceVector& origin) {
    std::vector<std::pair<int, const SolidProperties*>> parts;
    for (const Reference& one : solid.of) parts.emplace_back(1, &part(one));
    for (const Reference& one : solid.without) parts.emplace_back(-1, &part(one));
    SolidProperties result;
    SpaceVector first{0, 0, 0};
    for (const auto& [sign, one] : parts) {
        result.mass += sign * one->mass;
        first = first + sign * one->mass * one->centre;
    }
    result.mass = short_form(result.mass);
    SpaceVector centre;
    for (std::size_t i = 0; i < 3; ++i) centre[i] = quotient(first[i].expand(), result.mass.expand());
    centre = without_quotients(centre);
    SpaceMatrix inertia = symmetric([](std::size_t, std::size_t) { return ex(0); });
    for (const auto& [sign, one] : parts) {
        const ex factor = sign;
        const SpaceMatrix about = sum_of(one->about_centre, inertia_of_point(one->mass, kept(one->centre - centre)));
        inertia = symmetric([&](std::size_t i, std::size_t j) { return inertia[i][j] + factor * about[i][j]; });
    }
    result.centre = origin + axes * centre;
    // Squares of distances from the centre stay such where that does not simplify: written out they would cancel.
    const bool is_simple = std::none_of(centre.begin(), centre.end(), divides_by_sum);
    result.about_centre = turned(
        symmetric([&](std::size_t i, std::size_t j) { return is_simple ? short_form(inertia[i][j]) : without_quotients(inertia[i])[j]; }),
        axes);
    // The integrals are sums over the parts.
    SolidMoments sum{0, {0, 0, 0}, symmetric([](std::size_t, std::size_t) { return ex(0); })};
    for (const auto& [sign, one] : parts) {
        const SolidMoments& direct = one->direct;
        const ex factor = sign;
        sum.mass += factor * direct.mass;
        sum.first = sum.first + factor * direct.first;
        sum.second = symmetric([&](std::size_t i, std::size_t j) { return sum.second[i][j] + factor * direct.second[i][j]; });
    }
    const SpaceVector moved = axes * sum.first;
    result.direct.mass = sum.mass;
    result.direct.first = sum.mass * origin + moved;
    result.direct.second = symmetric([&](std::size_t i, std::size_t j) {
        ex inner = 0;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l) inner += axes[i][k] * sum.second[k][l] * axes[j][l];
        return inner + sum.mass * origin[i] * origin[j] + origin[i] * moved[j] + moved[i] * origin[j];
    });
    return result;
}

}  // namespace

SpaceMatrix inertia_of_point(const ex& mass, const SpaceVector& r) {
    return symmetric([&](std::size_t i, std::size_t j) {
        if (i != j) return ex(-mass * r[i] * r[j]);
        const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
        return ex(mass * (GiNaC::pow(r[k], 2) + GiNaC::pow(r[l], 2)));
    });
}

SolidProperties solid_properties(const Solid& solid, const Translator& translate,
                                 const std::function<const SolidProperties&(const Reference&)>& part) {
    const SpaceVector origin = solid.at ? translate(*solid.at, {}) : SpaceVector{0, 0, 0};
    std::vector<std::pair<std::size_t, ex>> turns;
    for (const Turn& turn : solid.turns) turns.emplace_back(turn.axis, translate(turn.angle, {}));
    const SpaceMatrix axes = by_turns(turns, translate.symbols()).axes;
    SolidProperties result = solid.shape == Solid::Shape::composed ? composed(solid, part, axes, origin)
                             : solid.shape == Solid::Shape::point  ? point_properties(solid, translate, origin)
                                                                   : ShapeIntegrals(solid, translate, axes, origin).take();
    const SpaceMatrix moved = inertia_of_point(result.mass, without_quotients(result.centre));
    const bool is_simple = std::none_of(result.centre.begin(), result.centre.end(), divides_by_sum);
    result.about_origin = symmetric([&](std::size_t i, std::size_t j) {
        const ex sum = result.about_centre[i][j] + moved[i][j];
        return is_simple ? short_form(sum) : sum;
    });
    return result;
}

const SolidProperties& Solids::of(const std::string& name) const {
    if (const auto found = known_.find(name); found != known_.end()) return found->second;
    const Solid& solid = *translate_.names().find_element<Solid>(name);
    SolidProperties properties =
        solid_properties(solid, translate_, [this](const Reference& part) -> const SolidProperties& { return of(part.name); });
    return known_.emplace(name, std::move(properties)).first->second;
}

}  // namespace dalembert
