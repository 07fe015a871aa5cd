// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/right_angles.hpp"

#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "mechanics/curvilinear.hpp"
#include "language/sum_terms.hpp"
#include "elements/verdict.hpp"
#include "prove/equivalence.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

using Kind = Expression::Kind;

class RightAngles {
public:
    explicit RightAngles(const System& system) : system_(system) {}

    void check(const Expression& e, const Indices& indices) {
        terms_ = {};
        visit(e, indices);
    }

private:
    void visit(const Expression& e, const Indices& indices) {
        if (e.kind == Kind::sum) {
            Indices inner = indices;
            const int from = index_value(*e.children[0], system_.scene, indices), to = index_value(*e.children[1], system_.scene, indices);
            terms_.add(e, from, to);
            for (int i = from; i <= to; ++i) {
                inner[e.name] = i;
                visit(*e.children[2], inner);
            }
            return;
        }
        if (e.kind == Kind::name && (e.name == "velocity_along" || e.name == "acceleration_along")) return component(e, indices);
        if (e.kind == Kind::name) definition(e, indices);
        for (const ExpressionPtr& child : e.children) visit(*child, indices);
    }

    Prover& prover() { return prover_ ? *prover_ : prover_.emplace(system_); }

    /// What a definition or output in it says.
    void definition(const Expression& e, const Indices& indices) {
        const Named* named = indices.contains(e.name) ? nullptr : system_.names.find(e.name);
        if (named == nullptr || (named->kind != Named::Kind::definition && named->kind != Named::Kind::output)) return;
        Indices inner;
        if (named->item->family && !e.children.empty())
            inner[named->item->family->index] = index_value(*e.children[0], system_.scene, indices);
        if (!seen_.emplace(named->item, inner).second) return;
        visit(named->kind == Named::Kind::definition ? *named->definition().value : *static_cast<const Output*>(named->item)->value, inner);
    }

    void component(const Expression& e, const Indices& indices) {
        const Expression& named = *e.children[0];
        const BodyMotion* body = find_motion(system_.bodies, {named.name, named.children.empty() ? nullptr : named.children[0], named.span},
                                             system_.scene, indices);
        if (body == nullptr) return;  // the translation tells
        const Expression& line = *e.children[1];
        const std::size_t q =
            system_.translate.coordinate(line.name, line.children.empty() ? nullptr : line.children[0].get(), line.span, indices);
        const CurvilinearCoordinates lines(*body, system_.translate, e.span);
        for (const std::size_t i : lines.lines())
            for (const std::size_t j : lines.lines())
                if (i < j) at_right_angles(e, *body, lines, i, j);
        const bool is_velocity = e.name == "velocity_along";
        const SpaceVector& v = body->velocity;
        const ex vector = dot(is_velocity ? v : time_derivative(v, system_.symbols), lines.tangent(q));
        const ex along = is_velocity ? lines.velocity_along(q) : lines.acceleration_along(q);
        if (prover().equal(along * lines.scale_factor(q), vector).verdict == Verdict::wrong)
            throw Failure(Diagnostic{
                Id::not_equal, e.span,
                fmt::format("'{}' is not the component of the vector. This is a defect of the program; please report it with the model",
                            e.written())});
    }

    void at_right_angles(const Expression& e, const BodyMotion& body, const CurvilinearCoordinates& lines, std::size_t i, std::size_t j) {
        if (!proven_.emplace(&body, std::pair(i, j)).second || prover().proven_equal(lines.metric(i, j), 0)) return;
        const auto& coordinates = system_.symbols.all(SymbolKind::coordinate);
        const bool is_seen = prover().equal(lines.metric(i, j), 0).verdict == Verdict::wrong;
        throw Failure(Diagnostic{
            Id::not_orthogonal,
            e.span,
            fmt::format("'{}' needs orthogonal coordinate lines, but the lines of '{}' and '{}' through body '{}' are not{}: dr/d({}) . "
                        "dr/d({}) is {}",
                        e.written(), coordinates[i].name, coordinates[j].name, body.member.name(), is_seen ? "" : " proven orthogonal",
                        coordinates[i].name, coordinates[j].name, is_seen ? "not zero" : "not seen to be zero"),
            {{body.member.item->span, "the body is defined here"}}});
    }

    const System& system_;
    SumTerms terms_;
    std::optional<Prover> prover_;  ///< most ask for none
    std::set<std::pair<const Item*, Indices>> seen_;
    std::set<std::pair<const BodyMotion*, std::pair<std::size_t, std::size_t>>> proven_;
};

}  // namespace

void check_right_angles(const System& system, const Expression& e, const Indices& indices) { RightAngles(system).check(e, indices); }

void check_right_angles(const System& system) {
    RightAngles check(system);
    for (const auto& member : system.scene.outputs) check.check(*member.item->value, Translator::indices_of(member));
}

}  // namespace dalembert
