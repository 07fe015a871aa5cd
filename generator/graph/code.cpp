// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/code.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "form/constrained_motion.hpp"
#include "graph/chain_code.hpp"
#include "graph/derived_values.hpp"
#include "graph/hessian_code.hpp"
#include "graph/motion_code.hpp"
#include "graph/reset_code.hpp"

namespace dalembert {

namespace {

class CodeMaker {
public:
    CodeMaker(const System& system, const CodeWish& wish)
        : code_(std::make_unique<Code>(system)),
          system_(system),
          lowered_(lower_system(system, code_->partials, code_->atoms, wish.passes.rewriting,
                                wish.passes.chain ? wish.chain : ChainUse::never, wish.functions)),
          n_(system.motion.unknowns()),
          degrees_(system.symbols.degrees()),
          multipliers_(system.motion.multipliers.size()),
          motion_(*code_, lowered_) {
        code_->passes = wish.passes;
        code_->trig = wish.trig;
    }

    std::unique_ptr<Code> run(const CodeWish& wish) {
        order_definitions();
        choose_solve();
        code_->has_long_chain = lowered_.has_long_chain;
        for (const HeaderFunction* row : in_order_of_making())
            if (is_made(*row, system_, wish.functions)) make(*row);
        if (wish.series) series();
        if (wish.functions.contains(Function::together)) together();
        if (wish.functions.contains(Function::hessian) && code_->solve.unrolled) make_hessian(*code_, lowered_, motion_);
        update();
        code_->rewritten = std::move(lowered_.rewritten);
        return std::move(code_);
    }

private:
    using Kind = HeaderFunction::Kind;
    using MotionRoots = MotionCode::MotionRoots;
    using ColumnRoots = MotionCode::ColumnRoots;

    /// Of neighbours of one kind first those that add to the cache.
    static std::vector<const HeaderFunction*> in_order_of_making() {
        std::vector<const HeaderFunction*> rows;
        for (const HeaderFunction& row : header_functions()) rows.push_back(&row);
        for (auto first = rows.begin(); first != rows.end();) {
            const auto end = std::find_if(first, rows.end(), [&](const HeaderFunction* row) { return row->kind != (*first)->kind; });
            std::stable_sort(first, end, [](const HeaderFunction* a, const HeaderFunction* b) { return a->parts < b->parts; });
            first = end;
        }
        return rows;
    }

    void make(const HeaderFunction& row) {
        switch (row.kind) {
            case Kind::motion: return motion_function(row.function, row.by);
            case Kind::jacobian: return jacobian(row);
            case Kind::output_jacobian: return output_jacobian(row);
            case Kind::sample: return motion_function(row.function, {}, lowered_[Function::output]);
            case Kind::resets:
                return make_resets(*code_, lowered_,
                                   [this](Program& program, const std::vector<NodeId>& mass) { return motion_.factors(program, mass); });
            case Kind::correction: return correction(row);
            case Kind::conditions:
                if (lowered_[row.function].empty()) return;
                for (const ModeCondition& condition : conditions(system_)) code_->condition_places.push_back(condition.place);
                return values(row);
            case Kind::start:
            case Kind::symmetric:
            case Kind::values:
            case Kind::number:
            case Kind::matrix:
            case Kind::event_values: return values(row);
            case Kind::together:
            case Kind::hessian:  // behind the others
            case Kind::update: return;  // last
        }
    }

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
        s.multipliers = multipliers_;
        s.left_out = left_out_at_start(system_);
        if (s.left_out > 0) s.first_chosen = code_->cache.reserve(multipliers_);
        s.is_constant = s.left_out == 0;
        for (const Polynomial& p : lowered_.solve_mass) {
            s.is_zero.push_back(p.is_zero());
            s.is_constant = s.is_constant && !code_->atoms.is_dynamic(p);
        }
        if (lowered_.has_long_chain) {  // what is solved with M at all, as series, does so on the spot
            s.is_constant = s.unrolled = false;
            return;
        }
        s.unrolled = !code_->passes.loops || should_unroll(n_, s.is_zero) || !lowered_.held.empty() || multipliers_ > 0 ||
                     !system_.scene.modes.empty();
        if (s.unrolled && s.is_constant) s.first_cached = code_->cache.reserve(lowered_.solve_mass.size());
    }

    /// What Taylor series are made of: dx/dt, and the power behind it.
    void series() {
        FunctionCode& f = code_->series_of.emplace();
        f.by_loops = !code_->solve.unrolled;
        ProgramBuilder builder(code_->atoms, code_->cache, ParameterParts::cached, f.program, code_->passes);
        Roots roots;
        const MotionRoots motion = motion_.add_motion(roots);
        const std::size_t rates = roots.add(lowered_.state_rate);
        std::vector<std::pair<bool, std::size_t>> powers;
        for (const Function power :
             {Function::supplied_power, Function::dissipated_power, Function::prescribed_power, Function::exchanged_power})
            powers.emplace_back(power == Function::dissipated_power, roots.add(lowered_[power]));
        builder.prepare(roots.polynomials());
        motion_.take_motion(f, builder, motion);
        for (std::size_t i = 0; i < lowered_.state_rate.size(); ++i) f.results.push_back(builder.root(rates + i));
        std::vector<std::pair<bool, NodeId>> power;
        for (const auto& [is_lost, root] : powers) power.emplace_back(is_lost, builder.root(root));
        f.results.push_back(f.program.sum(std::move(power)));
    }

    /// What a recorder or an observer asks for at one point.
    void together() {
        code_->wished.insert(Function::together);
        std::vector<Polynomial> more = lowered_[Function::output];
        for (const HeaderFunction& row : header_functions())
            if (row.energy != nullptr) more.push_back(lowered_[row.function].front());
        motion_function(Function::together, By::state, more);
    }

    /// rhs, alone or together with its Jacobian: in the way that takes fewer operations. `more`: values of the motion, behind the rates.
    void motion_function(Function which, std::optional<By> by, const std::vector<Polynomial>& more = {}) {
        FunctionCode& f = (*code_)[which];
        if (code_->has_long_chain) return make_chain_function(*code_, lowered_, f, by, ChainFunction::solved, ParameterParts::cached, more);
        const ParameterCache before = code_->cache;
        f = motion_code(by, ParameterParts::cached, more);
        const auto instead_if_cheaper = [&](int sixteenths, const auto& make) {
            const ParameterCache with_these = std::exchange(code_->cache, before);
            FunctionCode other = make();
            if (16 * cost(other, n_) < sixteenths * cost(f, n_)) f = std::move(other);
            else code_->cache = with_these;
        };
        if (code_->passes.constants) instead_if_cheaper(16, [&] { return motion_code(by, ParameterParts::cached_last, more); });
        if (!lowered_.chain || code_->solve.is_constant) return;
        // Where both cost the same, the loop over columns is half as long.
        instead_if_cheaper(by ? 17 : 16, [&] {
            FunctionCode from_body_to_body;
            make_chain_function(*code_, lowered_, from_body_to_body, by, ChainFunction::solved, ParameterParts::cached, more);
            return from_body_to_body;
        });
    }

    FunctionCode motion_code(std::optional<By> by, ParameterParts kind, const std::vector<Polynomial>& more) {
        FunctionCode f;
        const LoweredSystem::Columns* columns = by ? &lowered_.partial(*by) : nullptr;
        f.by_loops = !code_->solve.unrolled;
        ProgramBuilder builder(code_->atoms, code_->cache, kind, f.program, code_->passes);
        Roots roots;
        const MotionRoots motion = motion_.add_motion(roots);
        const std::size_t rates = roots.add(lowered_.state_rate);
        const std::size_t values = roots.add(more);
        const ColumnRoots parts = columns != nullptr ? motion_.add_columns(roots, *columns) : ColumnRoots{};
        builder.prepare(roots.polynomials());

        motion_.take_motion(f, builder, motion);
        for (std::size_t i = 0; i < lowered_.state_rate.size(); ++i) f.results.push_back(builder.root(rates + i));
        for (std::size_t i = 0; i < more.size(); ++i) f.results.push_back(builder.root(values + i));
        if (columns != nullptr) motion_.take_columns(f, builder, *columns, parts);
        return f;
    }

    /// With multipliers the motion is solved for first, since their values are known nowhere else.
    void jacobian(const HeaderFunction& row) {
        FunctionCode& f = (*code_)[row.function];
        if (code_->has_long_chain) return make_chain_function(*code_, lowered_, f, row.by, ChainFunction::of_known_motion, row.parts);
        const Solve& s = code_->solve;
        const LoweredSystem::Columns& columns = lowered_.partial(*row.by);
        ProgramBuilder builder(code_->atoms, code_->cache, row.parts, f.program, code_->passes);
        Roots roots;
        const bool has_multipliers = multipliers_ > 0;
        MotionRoots motion;
        if (has_multipliers) motion = motion_.add_motion(roots);
        else if (!s.is_constant) motion.mass = roots.add(lowered_.solve_mass);
        const ColumnRoots parts = motion_.add_columns(roots, columns);
        builder.prepare(roots.polynomials());
        if (has_multipliers) {
            f.solved_for = motion_.solve_motion(f, builder, motion);
        } else {
            for (std::size_t i = 0; !s.is_constant && i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(motion.mass + i));
            if (s.unrolled) f.factors = motion_.factors(f.program, f.mass);
        }
        motion_.take_columns(f, builder, columns, parts);
        f.note_letters(code_->atoms);
    }

    /// Values that contain multipliers, or their rates, bring the solve for them along.
    void values(const HeaderFunction& row) {
        FunctionCode& f = (*code_)[row.function];
        const std::vector<Polynomial>& polynomials = lowered_[row.function];
        ProgramBuilder builder(code_->atoms, code_->cache, row.parts, f.program, code_->passes);
        Roots roots;
        const std::size_t first = roots.add(polynomials);
        const bool has_multipliers = contain(polynomials, SymbolKind::multiplier),
                   has_rates = contain(polynomials, SymbolKind::multiplier_rate);
        const bool has_motion = has_multipliers || has_rates;
        const MotionRoots motion = has_motion ? motion_.add_motion(roots) : MotionRoots{};
        const std::size_t rates = has_rates ? roots.add(lowered_.motion_rate) : 0;
        const std::size_t jerks = has_rates ? roots.add(lowered_.held_jerks) : 0;
        builder.prepare(roots.polynomials());
        if (has_motion) f.solved_for = motion_.solve_motion(f, builder, motion);
        if (has_rates) {
            f.right = {n_, 1, {}};
            for (std::size_t i = 0; i < n_; ++i) f.right.entries.push_back(builder.root(rates + i));
            f.rates_solved_for = solve(f.program, n_, f.factors, f.right.entries);
            for (std::size_t i = 0; i < n_; ++i) builder.define(motion_.unknown(i, true), f.rates_solved_for[i]);
            for (std::size_t i = 0; i < lowered_.held_jerks.size(); ++i)
                builder.define(motion_.letter(SymbolKind::jerk, system_.motion.accelerations[i].first), builder.root(jerks + i));
        }
        for (std::size_t i = 0; i < polynomials.size(); ++i) f.results.push_back(builder.root(first + i));
        f.note_letters(code_->atoms);
    }

    bool contain(const std::vector<Polynomial>& polynomials, SymbolKind kind) const {
        const auto is_there = [&](const auto& self, const Polynomial& p) -> bool {
            for (const auto& [monomial, coefficient] : p.terms())
                for (const LetterPower& power : monomial) {
                    const Atom& atom = code_->atoms[power.letter];
                    if (atom.variable != nullptr && atom.variable->kind == kind) return true;
                    if (std::any_of(atom.arguments.begin(), atom.arguments.end(),
                                    [&](const Polynomial& argument) { return self(self, argument); }))
                        return true;
                }
            return false;
        };
        return multipliers_ > 0 &&
               std::any_of(polynomials.begin(), polynomials.end(), [&](const Polynomial& p) { return is_there(is_there, p); });
    }

    void output_jacobian(const HeaderFunction& row) {
        if (row.in == HeaderFunction::In::wished) code_->wished.insert(row.function);
        FunctionCode& f = (*code_)[row.function];
        ProgramBuilder builder(code_->atoms, code_->cache, row.parts, f.program, code_->passes);
        const LoweredSystem::Columns& by = lowered_.partial(*row.by);
        const auto& columns = by.output;
        const std::size_t outputs = lowered_[Function::output].size();
        const bool has_multipliers = contain(lowered_[Function::output], SymbolKind::multiplier);
        Roots roots;
        const std::size_t first = roots.add(columns);
        const std::size_t second = roots.add(lowered_.output_by_acceleration);
        const MotionRoots motion = has_multipliers ? motion_.add_motion(roots) : MotionRoots{};
        const ColumnRoots parts = has_multipliers ? motion_.add_columns(roots, by) : ColumnRoots{};
        builder.prepare(roots.polynomials());
        f.by_output = {outputs, columns.size(), {}};
        f.by_acceleration = {outputs, degrees_ + multipliers_, {}};
        if (has_multipliers) {
            f.solved_for = motion_.solve_motion(f, builder, motion);
            motion_.take_columns(f, builder, by, parts);
        }
        for (std::size_t i = 0; i < columns.size() * outputs; ++i) f.by_output.entries.push_back(builder.root(first + i));
        for (std::size_t i = 0; i < (degrees_ + multipliers_) * outputs; ++i) f.by_acceleration.entries.push_back(builder.root(second + i));
        if (has_multipliers) chain_outputs(f);
        f.note_letters(code_->atoms);
    }

    /// Multipliers are no part of dx/dt, through which other outputs get their slopes: the whole slope is made here.
    void chain_outputs(FunctionCode& f) {
        f.whole_output = f.by_output;
        for (std::size_t c = 0; c < f.by_output.columns; ++c)
            for (std::size_t r = 0; r < f.by_output.rows; ++r) {
                std::vector<std::pair<bool, NodeId>> terms{{false, f.by_output.at(r, c)}};
                for (std::size_t k = 0; k < f.solved.rows; ++k)
                    terms.emplace_back(false, f.program.product({f.by_acceleration.at(r, k), f.solved.at(k, c)}));
                f.whole_output.entries[c * f.by_output.rows + r] = f.program.sum(std::move(terms));
            }
    }

    /// What brings runs back to constraints.
    void correction(const HeaderFunction& row) {
        const LoweredSystem::Projection& p = lowered_.projection;
        if (p.bordered.empty()) return;
        FunctionCode& f = (*code_)[row.function];
        ProgramBuilder builder(code_->atoms, code_->cache, row.parts, f.program, code_->passes);
        builder.prepare(p.bordered);
        for (std::size_t i = 0; i < p.bordered.size(); ++i) f.mass.push_back(builder.root(i));
        const std::size_t constraints = p.holding.size(), size = degrees_ + constraints;
        f.factors = factorise(f.program, size, constraints, f.mass, nullptr, chosen_of_held(f.program, *code_, p.holding));
        f.force.assign(degrees_, f.program.constant(0));
        for (const std::size_t i : p.holding)
            f.force.push_back(f.program.negated(f.program.symbol(motion_.letter(SymbolKind::residual, i))));
        f.solved_for = solve(f.program, size, f.factors, f.force);
        f.results.assign(f.solved_for.begin(), f.solved_for.begin() + static_cast<std::ptrdiff_t>(degrees_));
    }

    /// Definitions and cached values; last, because the other functions decide what is cached.
    void update() {
        FunctionCode& f = (*code_)[Function::update];
        const Solve& s = code_->solve;
        ProgramBuilder builder(code_->atoms, code_->cache, ParameterParts::in_place, f.program, code_->passes);
        Roots roots;
        const std::size_t definitions = roots.add(lowered_.definitions);
        const std::size_t cached = roots.add(code_->cache.values());
        const std::size_t mass = s.is_constant ? roots.add(lowered_.solve_mass) : 0;
        builder.prepare(roots.polynomials());
        for (const std::size_t i : code_->definition_order) f.results.push_back(builder.root(definitions + i));
        for (std::size_t i = 0; i < code_->cache.values().size(); ++i) f.results.push_back(builder.root(cached + i));
        for (std::size_t i = 0; s.left_out > 0 && i < multipliers_; ++i)
            f.results[code_->definition_order.size() + s.first_chosen + i] = f.program.constant(i + s.left_out < multipliers_ ? 1 : 0);
        f.by_loops = !s.unrolled && s.is_constant;
        if (!s.is_constant) return;
        for (std::size_t i = 0; i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
        if (f.by_loops) return;
        const std::vector<NodeId> lower = factorise(f.program, n_, multipliers_, f.mass);
        for (std::size_t i = 0; i < lower.size(); ++i) f.results[code_->definition_order.size() + s.first_cached + i] = lower[i];
    }

    std::unique_ptr<Code> code_;
    const System& system_;
    LoweredSystem lowered_;
    std::size_t n_;  ///< accelerations and multipliers that are solved for
    std::size_t degrees_;
    std::size_t multipliers_;
    MotionCode motion_;
};

}  // namespace

std::vector<NodeId> chosen(Program& program, const Solve& solve) {
    std::vector<NodeId> result;
    for (std::size_t i = 0; solve.left_out > 0 && i < solve.multipliers; ++i)
        result.push_back(program.cached(solve.first_chosen + static_cast<std::uint32_t>(i)));
    return result;
}

std::vector<NodeId> chosen_of_held(Program& program, const Code& code, const std::vector<std::size_t>& held) {
    std::vector<NodeId> result;
    if (code.solve.left_out == 0) return result;
    const std::vector<std::size_t>& multipliers = code.system.motion.multipliers;
    const std::vector<NodeId> of_multipliers = chosen(program, code.solve);
    for (const std::size_t constraint : held) {
        const auto place = std::find(multipliers.begin(), multipliers.end(), constraint);
        result.push_back(place == multipliers.end() ? program.constant(1)
                                                    : of_multipliers[static_cast<std::size_t>(place - multipliers.begin())]);
    }
    return result;
}

std::unique_ptr<Code> make_code(const System& system, const CodeWish& wish) { return CodeMaker(system, wish).run(wish); }

}  // namespace dalembert
