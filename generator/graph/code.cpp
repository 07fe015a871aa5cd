// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/code.hpp"

#include <algorithm>
#include <optional>

#include "graph/lowered_system.hpp"
#include "graph/reset_code.hpp"
#include "graph/roots.hpp"

namespace dalembert {

namespace {

class CodeMaker {
public:
    explicit CodeMaker(const System& system)
        : code_(std::make_unique<Code>(system)), system_(system), lowered_(lower_system(system, code_->atoms)), n_(system.motion.free.size()), degrees_(system.symbols.degrees()) {}

    std::unique_ptr<Code> run() {
        order_definitions();
        choose_solve();
        motion_function(Function::rhs, nullptr);
        motion_function(Function::rhs_and_jacobian, &lowered_.partial(By::state));
        jacobian(Function::jacobian_u, By::input, ParameterParts::cached);
        jacobian(Function::jacobian_t, By::time, ParameterParts::cached);
        jacobian(Function::jacobian_p, By::parameter, ParameterParts::if_cached);
        values(Function::mass_matrix, lowered_.mass, ParameterParts::cached);
        values(Function::bias, lowered_.bias, ParameterParts::cached);
        values(Function::generalised_force, lowered_.generalised_force, ParameterParts::cached);
        values(Function::output, lowered_.output, ParameterParts::cached);
        output_jacobian(Function::output_jacobian_x, By::state);
        output_jacobian(Function::output_jacobian_u, By::input);
        constexpr std::array scalars{Function::kinetic_energy, Function::potential_energy, Function::supplied_power, Function::dissipated_power,
                                     Function::prescribed_power, Function::internal_energy, Function::exchanged_power};
        values(Function::guards, lowered_.guards, ParameterParts::if_cached);
        for (std::size_t i = 0; i < scalars.size(); ++i) values(scalars[i], {lowered_.scalars[i]}, ParameterParts::if_cached);
        values(Function::start_state, lowered_.start, ParameterParts::in_place);
        switching();
        update();
        return std::move(code_);
    }

private:
    void order_definitions() {
        std::vector<bool> done(lowered_.definitions.size(), false);
        const auto visit = [&](const auto& self, std::size_t i) -> void {
            if (done[i]) return;
            done[i] = true;
            for (const auto& [monomial, coefficient] : lowered_.definitions[i].terms())
                for (const LetterPower& power : monomial) need(self, power.letter);
            code_->definition_order.push_back(i);
        };
        for (std::size_t i = 0; i < done.size(); ++i) visit(visit, i);
    }

    /// Definitions that an atom of a definition mentions come first too.
    template <class Visit>
    void need(const Visit& visit, Letter letter) {
        const Atom& atom = code_->atoms[letter];
        if (atom.variable != nullptr && atom.variable->kind == SymbolKind::definition) visit(visit, atom.variable->position);
        for (const Polynomial& argument : atom.arguments)
            for (const auto& [monomial, coefficient] : argument.terms())
                for (const LetterPower& power : monomial) need(visit, power.letter);
    }

    void choose_solve() {
        Solve& s = code_->solve;
        s.n = n_;
        s.is_constant = true;
        for (const Polynomial& p : lowered_.solve_mass) {
            s.is_zero.push_back(p.is_zero());
            s.is_constant = s.is_constant && !code_->atoms.is_dynamic(p);
        }
        s.unrolled = should_unroll(n_, s.is_zero) || !lowered_.held.empty() || !system_.scene.modes.empty();
        if (s.unrolled && s.is_constant) s.first_cached = code_->cache.reserve(lowered_.solve_mass.size());
    }

    /// Factors of M in a function: computed there, or taken from the cache.
    std::vector<NodeId> factors(Program& program, const std::vector<NodeId>& mass) {
        const Solve& s = code_->solve;
        if (!s.is_constant) return factorise(program, n_, mass, [&](NodeId pivot) { return reciprocal(program, pivot); });
        // What the factors are is decided in update(); zero factors are known from the pattern there as here.
        std::vector<NodeId> result;
        Program pattern;
        std::vector<NodeId> symbolic;
        for (std::size_t i = 0; i < s.is_zero.size(); ++i) symbolic.push_back(s.is_zero[i] ? pattern.constant(0) : pattern.cached(static_cast<std::uint32_t>(i)));
        const std::vector<NodeId> computed = factorise(pattern, n_, symbolic);
        for (std::size_t i = 0; i < computed.size(); ++i)
            result.push_back(pattern.is_constant(computed[i], 0) ? program.constant(0) : program.cached(s.first_cached + static_cast<std::uint32_t>(i)));
        return result;
    }

    /// 1/x, from the cache where x depends on parameters alone.
    NodeId reciprocal(Program& program, NodeId x) {
        const Node& node = program[x];
        std::optional<Polynomial> value;
        if (node.kind == Node::Kind::cached) value = code_->cache.values()[node.index];
        if (node.kind == Node::Kind::symbol && !code_->atoms[node.index].is_dynamic) value = Polynomial::letter(node.index);
        if (!value || value->is_zero()) return program.reciprocal(x);
        Polynomial inverse;
        if (value->is_monomial()) {
            const auto& [monomial, coefficient] = *value->terms().begin();
            inverse.add(raised(monomial, -1), Rational(1) / coefficient);
        } else {
            inverse = Polynomial::letter(code_->atoms.letter(Op::sum, {*value}), -1);
        }
        return program.cached(code_->cache.add(inverse));
    }

    /// Of a free coordinate, or of one that constraints determine.
    Letter free_acceleration(std::size_t i) const { return acceleration_letter(system_.motion.free[i]); }
    Letter acceleration_letter(std::size_t j) const { return code_->atoms.symbol(system_.symbols.all(SymbolKind::acceleration)[j]); }

    /// rhs, alone or together with its Jacobian.
    void motion_function(Function which, const LoweredSystem::Columns* columns) {
        FunctionCode& f = (*code_)[which];
        const Solve& s = code_->solve;
        f.by_loops = !s.unrolled;
        ProgramBuilder builder(code_->atoms, code_->cache, ParameterParts::cached, f.program);
        Roots roots;
        const bool needs_mass = !s.is_constant;
        const std::size_t mass = needs_mass ? roots.add(lowered_.solve_mass) : 0;
        const std::size_t force = roots.add(lowered_.force);
        const std::size_t rates = roots.add(lowered_.state_rate);
        const std::size_t held = roots.add(lowered_.held);
        const ColumnRoots parts = columns != nullptr ? add_columns(roots, *columns) : ColumnRoots{};
        builder.prepare(roots.polynomials());

        for (std::size_t i = 0; needs_mass && i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        for (std::size_t j = 0; j < n_; ++j) f.force.push_back(builder.root(force + j));
        f.accelerations.resize(degrees_);
        if (s.unrolled) {
            f.factors = factors(f.program, f.mass);
            const std::vector<NodeId> solved = solve(f.program, n_, f.factors, f.force);
            for (std::size_t i = 0; i < n_; ++i) f.accelerations[system_.motion.free[i]] = solved[i];
            for (std::size_t i = 0; i < n_; ++i) builder.define(free_acceleration(i), solved[i]);
            for (std::size_t i = 0; i < lowered_.held.size(); ++i) {
                const std::size_t j = system_.motion.accelerations[i].first;
                f.accelerations[j] = builder.root(held + i);
                builder.define(acceleration_letter(j), f.accelerations[j]);
            }
        } else {
            for (std::size_t j = 0; j < degrees_; ++j) f.accelerations[j] = f.program.symbol(acceleration_letter(j));
        }
        for (std::size_t i = 0; i < lowered_.state_rate.size(); ++i) f.results.push_back(builder.root(rates + i));
        if (columns != nullptr) take_columns(f, builder, *columns, parts);
    }

    /// Where the parts of a Jacobian begin among the roots.
    struct ColumnRoots {
        std::size_t residual = 0, below = 0, held = 0, held_by_free = 0;
    };

    ColumnRoots add_columns(Roots& roots, const LoweredSystem::Columns& columns) const {
        ColumnRoots parts;
        parts.residual = roots.add(columns.residual, -1);
        parts.below = roots.add(columns.state_rate);
        parts.held = roots.add(columns.held);
        parts.held_by_free = roots.add(lowered_.held_by_free);
        return parts;
    }

    /// d(qdd)/d(column) = M^-1 (-dR/d(column)) and d(zd)/d(column). What constraints determine follows by the chain rule.
    void take_columns(FunctionCode& f, ProgramBuilder& builder, const LoweredSystem::Columns& columns, const ColumnRoots& parts) {
        const std::size_t m = lowered_.state_rate.size();
        const std::size_t held = lowered_.held.size();
        f.by_loops = !code_->solve.unrolled;
        f.right = {n_, columns.residual.size(), {}};
        f.solved = {degrees_, f.by_loops ? 0 : columns.residual.size(), {}};
        f.below = {m, columns.residual.size(), {}};
        for (std::size_t c = 0; c < columns.residual.size(); ++c) {
            std::vector<NodeId> right;
            for (std::size_t j = 0; j < n_; ++j) right.push_back(builder.root(parts.residual + c * n_ + j));
            f.right.entries.insert(f.right.entries.end(), right.begin(), right.end());
            if (!f.by_loops) {
                const std::vector<NodeId> solved = solve(f.program, n_, f.factors, right);
                std::vector<NodeId> column(degrees_);
                for (std::size_t i = 0; i < n_; ++i) column[system_.motion.free[i]] = solved[i];
                for (std::size_t i = 0; i < held; ++i) {
                    std::vector<std::pair<bool, NodeId>> terms{{false, builder.root(parts.held + c * held + i)}};
                    for (std::size_t k = 0; k < n_; ++k) terms.emplace_back(false, f.program.product({builder.root(parts.held_by_free + i * n_ + k), solved[k]}));
                    column[system_.motion.accelerations[i].first] = f.program.sum(std::move(terms));
                }
                f.solved.entries.insert(f.solved.entries.end(), column.begin(), column.end());
            }
            for (std::size_t i = 0; i < m; ++i) f.below.entries.push_back(builder.root(parts.below + c * m + i));
        }
    }

    void jacobian(Function which, By by, ParameterParts kind) {
        FunctionCode& f = (*code_)[which];
        const Solve& s = code_->solve;
        const LoweredSystem::Columns& columns = lowered_.partial(by);
        ProgramBuilder builder(code_->atoms, code_->cache, kind, f.program);
        Roots roots;
        const std::size_t mass = s.is_constant ? 0 : roots.add(lowered_.solve_mass);
        const ColumnRoots parts = add_columns(roots, columns);
        builder.prepare(roots.polynomials());
        for (std::size_t i = 0; !s.is_constant && i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        if (s.unrolled) f.factors = factors(f.program, f.mass);
        take_columns(f, builder, columns, parts);
        note_accelerations(f);
    }

    void values(Function which, const std::vector<Polynomial>& polynomials, ParameterParts parts) {
        FunctionCode& f = (*code_)[which];
        ProgramBuilder builder(code_->atoms, code_->cache, parts, f.program);
        builder.prepare(polynomials);
        for (std::size_t i = 0; i < polynomials.size(); ++i) f.results.push_back(builder.root(i));
        note_accelerations(f);
    }

    void output_jacobian(Function which, By by) {
        FunctionCode& f = (*code_)[which];
        ProgramBuilder builder(code_->atoms, code_->cache, ParameterParts::cached, f.program);
        const auto& columns = lowered_.partial(by).output;
        Roots roots;
        const std::size_t first = roots.add(columns);
        const std::size_t second = roots.add(lowered_.output_by_acceleration);
        builder.prepare(roots.polynomials());
        const std::size_t outputs = lowered_.output.size();
        f.by_output = {outputs, columns.size(), {}};
        for (std::size_t i = 0; i < columns.size() * outputs; ++i) f.by_output.entries.push_back(builder.root(first + i));
        f.by_acceleration = {outputs, degrees_, {}};
        for (std::size_t i = 0; i < degrees_ * outputs; ++i) f.by_acceleration.entries.push_back(builder.root(second + i));
        note_accelerations(f);
    }

    /// Guards of events, their rates, what a mode asks for, and what events reset. The rates of guards are for the moments in which a mode
    /// begins; the values of accelerations and of their rates are taken from other functions.
    void switching() {
        values(Function::events, lowered_.events, ParameterParts::if_cached);
        values(Function::event_rates, lowered_.event_rates, ParameterParts::if_cached);
        values(Function::conditions, lowered_.conditions, ParameterParts::if_cached);
        if (!lowered_.conditions.empty())
            for (const auto& [place, value] : conditions(system_)) code_->condition_places.push_back(place);
        make_resets(*code_, lowered_, [this](Program& program, const std::vector<NodeId>& mass) { return factors(program, mass); });
    }

    void note_accelerations(FunctionCode& f) {
        for (const NodeId id : f.program.in_order(f.roots())) {
            const Node& node = f.program[id];
            if (node.kind != Node::Kind::symbol) continue;
            const Variable* variable = code_->atoms[node.index].variable;
            f.uses_accelerations = f.uses_accelerations || (variable != nullptr && variable->kind == SymbolKind::acceleration);
            f.uses_jerks = f.uses_jerks || (variable != nullptr && variable->kind == SymbolKind::jerk);
        }
    }

    /// Definitions and cached values; last, because the other functions decide what is cached.
    void update() {
        FunctionCode& f = (*code_)[Function::update];
        const Solve& s = code_->solve;
        ProgramBuilder builder(code_->atoms, code_->cache, ParameterParts::in_place, f.program);
        Roots roots;
        const std::size_t definitions = roots.add(lowered_.definitions);
        const std::size_t cached = roots.add(code_->cache.values());
        const std::size_t mass = s.is_constant ? roots.add(lowered_.solve_mass) : 0;
        builder.prepare(roots.polynomials());
        for (const std::size_t i : code_->definition_order) f.results.push_back(builder.root(definitions + i));
        for (std::size_t i = 0; i < code_->cache.values().size(); ++i) f.results.push_back(builder.root(cached + i));
        f.by_loops = !s.unrolled;
        if (!s.is_constant) return;
        for (std::size_t i = 0; i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        if (f.by_loops) return;
        const std::vector<NodeId> lower = factorise(f.program, n_, f.mass);
        for (std::size_t i = 0; i < lower.size(); ++i) f.results[code_->definition_order.size() + s.first_cached + i] = lower[i];
    }

    std::unique_ptr<Code> code_;
    const System& system_;
    LoweredSystem lowered_;
    std::size_t n_;        ///< accelerations that are solved for
    std::size_t degrees_;
};

}  // namespace

const char* name_of(Function function) {
    static constexpr std::array<const char*, function_count> names{
        "update",            "rhs",          "rhs_and_jacobian",  "jacobian_u",        "jacobian_p",     "jacobian_t",
        "mass_matrix",       "bias",         "generalised_force", "output",            "output_jacobian_x", "output_jacobian_u",
        "kinetic_energy",    "potential_energy", "supplied_power", "dissipated_power", "prescribed_power", "internal_energy",
        "exchanged_power",   "guards",       "start_state",       "events",            "event_rates",    "conditions",
        "resets"};
    return names[static_cast<std::size_t>(function)];
}

std::vector<NodeId> FunctionCode::roots() const {
    std::vector<NodeId> all;
    const auto take = [&](const std::vector<NodeId>& part) { all.insert(all.end(), part.begin(), part.end()); };
    if (by_loops) {
        take(mass);
        take(force);
        take(right.entries);
    } else {
        take(accelerations);
        take(solved.entries);
    }
    take(results);
    take(below.entries);
    take(by_output.entries);
    take(by_acceleration.entries);
    return all;
}

OperationCount Code::count(Function f) const { return (*this)[f].program.count((*this)[f].roots()); }

std::unique_ptr<Code> make_code(const System& system) { return CodeMaker(system).run(); }

}  // namespace dalembert
