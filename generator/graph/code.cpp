// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/code.hpp"

#include <algorithm>

#include "graph/lowered_system.hpp"

namespace dalembert {

namespace {

/// Roots for one call of the builder, and which of them is what.
class Roots {
public:
    std::size_t add(const std::vector<Polynomial>& polynomials) {
        const std::size_t first = polynomials_.size();
        polynomials_.insert(polynomials_.end(), polynomials.begin(), polynomials.end());
        return first;
    }
    std::size_t add(const std::vector<std::vector<Polynomial>>& columns, const Rational& factor = 1) {
        const std::size_t first = polynomials_.size();
        for (const auto& column : columns)
            for (Polynomial p : column) polynomials_.push_back(std::move(p *= factor));
        return first;
    }
    const std::vector<Polynomial>& polynomials() const { return polynomials_; }

private:
    std::vector<Polynomial> polynomials_;
};

class CodeMaker {
public:
    explicit CodeMaker(const System& system)
        : code_(std::make_unique<Code>(system)), system_(system), lowered_(lower_system(system, code_->atoms)), n_(system.symbols.degrees()) {}

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
        for (const Polynomial& p : lowered_.mass) {
            s.is_zero.push_back(p.is_zero());
            s.is_constant = s.is_constant && !code_->atoms.is_dynamic(p);
        }
        s.unrolled = should_unroll(n_, s.is_zero);
        if (s.unrolled && s.is_constant) s.first_cached = code_->cache.reserve(lowered_.mass.size());
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

    Letter acceleration_letter(std::size_t j) const { return code_->atoms.symbol(system_.symbols.all(SymbolKind::acceleration)[j]); }

    /// rhs, alone or together with its Jacobian.
    void motion_function(Function which, const LoweredSystem::Columns* columns) {
        FunctionCode& f = (*code_)[which];
        const Solve& s = code_->solve;
        f.by_loops = !s.unrolled;
        ProgramBuilder builder(code_->atoms, code_->cache, ParameterParts::cached, f.program);
        Roots roots;
        const bool needs_mass = !s.is_constant;
        const std::size_t mass = needs_mass ? roots.add(lowered_.mass) : 0;
        const std::size_t force = roots.add(lowered_.force);
        const std::size_t rates = roots.add(lowered_.state_rate);
        const std::size_t residual = columns != nullptr ? roots.add(columns->residual, -1) : 0;
        const std::size_t below = columns != nullptr ? roots.add(columns->state_rate) : 0;
        builder.prepare(roots.polynomials());

        for (std::size_t i = 0; needs_mass && i < lowered_.mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        for (std::size_t j = 0; j < n_; ++j) f.force.push_back(builder.root(force + j));
        if (s.unrolled) {
            f.factors = factors(f.program, f.mass);
            f.accelerations = solve(f.program, n_, f.factors, f.force);
            for (std::size_t j = 0; j < n_; ++j) builder.define(acceleration_letter(j), f.accelerations[j]);
        } else {
            for (std::size_t j = 0; j < n_; ++j) f.accelerations.push_back(f.program.symbol(acceleration_letter(j)));
        }
        for (std::size_t i = 0; i < lowered_.state_rate.size(); ++i) f.results.push_back(builder.root(rates + i));
        if (columns != nullptr) take_columns(f, builder, *columns, residual, below);
    }

    /// d(qdd)/d(column) = M^-1 (-dR/d(column)) and d(zd)/d(column).
    void take_columns(FunctionCode& f, ProgramBuilder& builder, const LoweredSystem::Columns& columns, std::size_t residual, std::size_t below) {
        const std::size_t m = lowered_.state_rate.size();
        f.by_loops = !code_->solve.unrolled;
        f.right = {n_, columns.residual.size(), {}};
        f.solved = {n_, f.by_loops ? 0 : columns.residual.size(), {}};
        f.below = {m, columns.residual.size(), {}};
        for (std::size_t c = 0; c < columns.residual.size(); ++c) {
            std::vector<NodeId> right;
            for (std::size_t j = 0; j < n_; ++j) right.push_back(builder.root(residual + c * n_ + j));
            f.right.entries.insert(f.right.entries.end(), right.begin(), right.end());
            if (!f.by_loops) right = solve(f.program, n_, f.factors, right);
            if (!f.by_loops) f.solved.entries.insert(f.solved.entries.end(), right.begin(), right.end());
            for (std::size_t i = 0; i < m; ++i) f.below.entries.push_back(builder.root(below + c * m + i));
        }
    }

    void jacobian(Function which, By by, ParameterParts parts) {
        FunctionCode& f = (*code_)[which];
        const Solve& s = code_->solve;
        const LoweredSystem::Columns& columns = lowered_.partial(by);
        ProgramBuilder builder(code_->atoms, code_->cache, parts, f.program);
        Roots roots;
        const std::size_t mass = s.is_constant ? 0 : roots.add(lowered_.mass);
        const std::size_t residual = roots.add(columns.residual, -1);
        const std::size_t below = roots.add(columns.state_rate);
        builder.prepare(roots.polynomials());
        for (std::size_t i = 0; !s.is_constant && i < lowered_.mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        if (s.unrolled) f.factors = factors(f.program, f.mass);
        take_columns(f, builder, columns, residual, below);
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
        f.by_acceleration = {outputs, n_, {}};
        for (std::size_t i = 0; i < n_ * outputs; ++i) f.by_acceleration.entries.push_back(builder.root(second + i));
        note_accelerations(f);
    }

    void note_accelerations(FunctionCode& f) {
        for (const NodeId id : f.program.in_order(f.roots())) {
            const Node& node = f.program[id];
            if (node.kind != Node::Kind::symbol) continue;
            const Variable* variable = code_->atoms[node.index].variable;
            f.uses_accelerations = f.uses_accelerations || (variable != nullptr && variable->kind == SymbolKind::acceleration);
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
        const std::size_t mass = s.is_constant ? roots.add(lowered_.mass) : 0;
        builder.prepare(roots.polynomials());
        for (const std::size_t i : code_->definition_order) f.results.push_back(builder.root(definitions + i));
        for (std::size_t i = 0; i < code_->cache.values().size(); ++i) f.results.push_back(builder.root(cached + i));
        f.by_loops = !s.unrolled;
        if (!s.is_constant) return;
        for (std::size_t i = 0; i < lowered_.mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        if (f.by_loops) return;
        const std::vector<NodeId> lower = factorise(f.program, n_, f.mass);
        for (std::size_t i = 0; i < lower.size(); ++i) f.results[code_->definition_order.size() + s.first_cached + i] = lower[i];
    }

    std::unique_ptr<Code> code_;
    const System& system_;
    LoweredSystem lowered_;
    std::size_t n_;
};

}  // namespace

const char* name_of(Function function) {
    static constexpr std::array<const char*, function_count> names{
        "update",            "rhs",          "rhs_and_jacobian",  "jacobian_u",        "jacobian_p",     "jacobian_t",
        "mass_matrix",       "bias",         "generalised_force", "output",            "output_jacobian_x", "output_jacobian_u",
        "kinetic_energy",    "potential_energy", "supplied_power", "dissipated_power", "prescribed_power", "internal_energy",
        "exchanged_power",   "guards",       "start_state"};
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
