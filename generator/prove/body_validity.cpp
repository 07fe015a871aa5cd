// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/body_validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/model.hpp"
#include "form/signs.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

namespace {

/// By Jacobi's rotations, from the smallest on.
std::array<double, 3> eigenvalues(std::array<std::array<double, 3>, 3> m) {
    for (int sweep = 0; sweep < 50; ++sweep)
        for (std::size_t p = 0; p < 3; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0) continue;
                const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]), c = std::cos(angle), s = std::sin(angle);
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = m[k][p], b = m[k][q];
                    m[k][p] = c * a - s * b;
                    m[k][q] = s * a + c * b;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = m[p][k], b = m[q][k];
                    m[p][k] = c * a - s * b;
                    m[q][k] = s * a + c * b;
                }
            }
    std::array<double, 3> result{m[0][0], m[1][1], m[2][2]};
    std::sort(result.begin(), result.end());
    return result;
}

void check_tensor(const BodyMotion& body, const System& system, const GiNaC::exmap& at) {
    std::array<std::array<double, 3>, 3> tensor{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const auto value = value_at(system.symbols.without_definitions(body.tensor[i][j]), at, 20);
            if (!value) return;
            tensor[i][j] = cln::double_approx(*value);
        }
    const auto [small, middle, large] = eigenvalues(tensor);
    const double rounding = 1e-9 * large;
    const Body& item = *body.member.item;
    const Span& place = item.tensor[0][0]->span;
    if (small < -rounding)
        throw Failure(Diagnostic{
            Id::wrong_inertia, place,
            fmt::format("the inertia of body '{}' has the principal moments {:.6g}, {:.6g} and {:.6g} kg*m^2; none can be negative",
                        item.name, small, middle, large)});
    if (large > small + middle + rounding)
        throw Failure(Diagnostic{Id::wrong_inertia, place,
                                 fmt::format("the inertia of body '{}' has the principal moments {:.6g}, {:.6g} and {:.6g} kg*m^2; no body "
                                             "has one larger than the sum of the others",
                                             item.name, small, middle, large)});
}

}  // namespace

std::optional<UnbalancedMass> unbalanced_mass(const System& system) {
    Prover prover(system);
    for (const BodyMotion& body : system.bodies) {
        const Body& item = *body.member.item;
        UnbalancedMass one{&body, system.rate()(body.mass), 0, {}};
        for (const Ejection& ejection : system.ejections) {
            if (ejection.body != &body) continue;
            one.lost += ejection.mass_flow;
            one.jets.push_back({ejection.member.item->span, "a jet stands here"});
        }
        const auto check_moment = [&](const ExpressionPtr& moment) {
            if (one.jets.empty() && moment && (dependence(*moment, system.names) & on_states) != 0)
                throw Failure(Diagnostic{Id::mass_not_balanced, moment->span,
                                         fmt::format("the inertia of body '{}' changes with a state, but no jet takes mass away; make a "
                                                     "part that moves inside it a body of its own",
                                                     item.name)});
        };
        check_moment(item.inertia);
        for (const auto& row : item.tensor) std::for_each(row.begin(), row.end(), check_moment);
        if (!prover.proven_equal(one.change, -one.lost)) return one;
    }
    return std::nullopt;
}

void check_body_values(const System& system, const Values& values, ValueConditions* conditions) {
    const GiNaC::exmap at = values.substitution();
    const StartValues value(system, values, conditions);
    using Rule = ValueCondition::Rule;
    for (const auto& member : system.scene.bodies) check_signs(*member.item, member.name(), Translator::indices_of(member), system, value);
    for (const BodyMotion& body : system.bodies) {
        if (!body.has_tensor()) continue;
        ValueCondition inertia{Rule::inertia,
                               {},
                               fmt::format("the inertia of body '{}' has the principal moments {{}}, {{}} and {{}} kg*m^2; none can be "
                                           "negative, and none larger than the sum of the others",
                                           body.member.item->name)};
        for (const auto& row : body.tensor) inertia.values.insert(inertia.values.end(), row.begin(), row.end());
        value.note(std::move(inertia));
        check_tensor(body, system, at);
    }
    std::vector<Member<Cut>> cuts;
    for (const Cut& cut : system.scene.model->cuts) {
        const auto [from, to] = cut.family ? bounds(*cut.family, system.scene) : std::pair(0, 0);
        for (int index = from; index <= to && system.scene.holds(cut.when); ++index) cuts.push_back({&cut, index});
    }
    for (const Member<Cut>& member : cuts) {
        const Cut& cut = *member.item;
        const SpaceVector direction = system.translate(cut.direction, Translator::indices_of(member));
        value.note({Rule::square_of_one,
                    {dot(direction, direction)},
                    fmt::format("the direction of cut '{}' has the length {{}} at the start; a direction has the length 1",
                                member.name())});
        const auto square = value_at(system.symbols.without_definitions(dot(direction, direction)), at, 20);
        const double length = square ? std::sqrt(cln::double_approx(*square)) : 1;
        if (std::fabs(length - 1) > 1e-6)
            throw Failure(
                Diagnostic{Id::value_out_of_range, cut.direction[0]->span,
                           fmt::format("the direction of cut '{}' has the length {:.6g} at the start; a direction has the length 1",
                                       member.name(), length)});
    }
    for (const Symbols::AttitudeSymbols& attitude : system.symbols.attitudes()) {
        cln::cl_R square = 0;
        GiNaC::ex norm_square = 0;
        for (const std::size_t part : attitude.parts) {
            norm_square += GiNaC::pow(system.symbols.get(SymbolKind::state, part), 2);
            const auto number = value_at(at.at(system.symbols.get(SymbolKind::state, part)), at, 20);
            if (number) square = square + *number * *number;
        }
        const double norm = std::sqrt(cln::double_approx(square));
        const State& item = *system.scene.states[attitude.parts[0]].item;
        value.note({Rule::square_of_one,
                    {norm_square},
                    fmt::format("the quaternion '{}' has the norm {{}} at the start; that of an orientation has the norm 1",
                                item.name.substr(0, item.name.size() - 2))});
        if (std::fabs(norm - 1) <= 1e-6) continue;
        throw Failure(Diagnostic{Id::value_out_of_range, item.span,
                                 fmt::format("the quaternion '{}' has the norm {:.6g} at the start; that of an orientation has the norm 1",
                                             item.name.substr(0, item.name.size() - 2), norm)});
    }
}

}  // namespace dalembert
