// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify_chain.hpp"

#include <algorithm>
#include <set>

#include "elements/verdict.hpp"
#include "form/chain_motion.hpp"
#include "prove/normal_form.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

Twist raised_six(const SixNodes& nodes, Raiser& raise) {
    Twist result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = raise(nodes[i]);
    return result;
}

TwistMatrix raised_matrix(const SixBySix& nodes, Raiser& raise) {
    TwistMatrix result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = raised_six(nodes[i], raise);
    return result;
}

/// Letters where a node is not a number.
class FreshLetters {
public:
    FreshLetters(const Program& of, Program& program) : of_(of), program_(program) {}
    NodeId letter() {
        meaning.push_back(GiNaC::realsymbol("x" + std::to_string(meaning.size())));
        return program_.cached(static_cast<std::uint32_t>(meaning.size() - 1));
    }
    NodeId like(NodeId id) { return of_[id].kind == Node::Kind::constant ? program_.constant(of_[id].value) : letter(); }
    SixNodes like(const SixNodes& nodes) {
        SixNodes result;
        for (std::size_t i = 0; i < 6; ++i) result[i] = like(nodes[i]);
        return result;
    }
    SixBySix like(const SixBySix& nodes, bool is_symmetric) {
        SixBySix result;
        for (std::size_t r = 0; r < 6; ++r)
            for (std::size_t c = 0; c < 6; ++c) result[r][c] = is_symmetric && c < r ? result[c][r] : like(nodes[r][c]);
        return result;
    }
    SixNodes six_letters() {
        SixNodes result;
        for (NodeId& id : result) id = letter();
        return result;
    }
    std::vector<ex> meaning;

private:
    const Program& of_;
    Program& program_;
};

/// What of a pattern decides about the proof.
std::string pattern(const Program& program, const std::vector<NodeId>& nodes) {
    std::string result;
    for (const NodeId id : nodes) result += program[id].kind == Node::Kind::constant ? to_string(program[id].value) + "," : "x,";
    return result;
}

class StepProofs {
public:
    StepProofs(const Program& of, const Atoms& atoms) : of_(of), atoms_(atoms) {}
    Comparison worst{Verdict::proven};

    /// s'*(I*(a + s*qdd) + p) = rest, and I*(a + s*qdd) + p = (what is left of I)*a + (what is left of p).
    void elimination(const SixNodes& direction, const SixBySix& inertia) {
        std::vector<NodeId> all(direction.begin(), direction.end());
        for (const SixNodes& row : inertia) all.insert(all.end(), row.begin(), row.end());
        if (!seen_.insert("e" + pattern(of_, all)).second) return;
        Program program;
        const NodeAlgebra nodes(program);
        FreshLetters letters(of_, program);
        const SixNodes s = letters.like(direction), a = letters.six_letters(), p = letters.six_letters();
        const SixBySix whole = letters.like(inertia, true);
        const NodeId rest = letters.letter();
        SixBySix left = whole;
        const EliminatedCoordinate e = eliminate(nodes, s, left, nullptr);
        SixNodes p_left = p, with = a;
        const NodeId taken = load(nodes, s, e, rest, p_left);
        const NodeId qdd = accelerate(nodes, s, e, taken, with);
        Raiser raise(program, atoms_, [&](std::uint32_t i) { return letters.meaning[i]; });
        for (std::size_t r = 0; r < 6; ++r) is_zero(raise(e.image[r]) - inner_product(raised_six(whole[r], raise), raised_six(s, raise)));
        const ex pivot = 1 / raise(e.inverse);
        is_zero(pivot - inner_product(raised_six(s, raise), raised_six(e.image, raise)));
        const Twist force = twist_sum(image_under(raised_matrix(whole, raise), raised_six(with, raise)), raised_six(p, raise));
        is_zero(inner_product(raised_six(s, raise), force) - raise(rest));
        const Twist passed = twist_sum(image_under(raised_matrix(left, raise), raised_six(a, raise)), raised_six(p_left, raise));
        for (std::size_t r = 0; r < 6; ++r) is_zero(force[r] - passed[r]);
        for (std::size_t r = 0; r < 6; ++r) is_zero(raise(with[r]) - raise(a[r]) - raise(s[r]) * raise(qdd));
    }

    /// X'*(I*(X*a + remainder) + p) = (what is handed on of I)*a + (of p).
    void handing_on(const SixBySix& transfer, const SixBySix& inertia, const SixNodes& remainder) {
        std::vector<NodeId> all(remainder.begin(), remainder.end());
        for (const SixBySix* m : {&transfer, &inertia})
            for (const SixNodes& row : *m) all.insert(all.end(), row.begin(), row.end());
        if (!seen_.insert("h" + pattern(of_, all)).second) return;
        Program program;
        const NodeAlgebra nodes(program);
        FreshLetters letters(of_, program);
        const SixBySix x = letters.like(transfer, false), i = letters.like(inertia, true);
        const SixNodes g = letters.like(remainder), a = letters.six_letters(), p = letters.six_letters();
        const SixBySix i_on = handed_on(nodes, x, i);
        const SixNodes p_on = handed_on(nodes, x, i, g, p);
        Raiser raise(program, atoms_, [&](std::uint32_t k) { return letters.meaning[k]; });
        const TwistMatrix X = raised_matrix(x, raise);
        const Twist own = twist_sum(image_under(X, raised_six(a, raise)), raised_six(g, raise));
        const Twist there = image_under_transposed(X, twist_sum(image_under(raised_matrix(i, raise), own), raised_six(p, raise)));
        const Twist here = twist_sum(image_under(raised_matrix(i_on, raise), raised_six(a, raise)), raised_six(p_on, raise));
        for (std::size_t r = 0; r < 6; ++r) is_zero(there[r] - here[r]);
    }

private:
    void is_zero(const ex& difference) {
        if (worst.verdict != Verdict::proven || difference.expand().is_zero()) return;
        try {
            if (!NormalForm().is_zero(difference)) worst = {Verdict::wrong};
        } catch (const NoNormalForm& reason) {
            worst = {Verdict::not_checkable, reason.what()};
        }
    }

    const Program& of_;
    const Atoms& atoms_;
    std::set<std::string> seen_;
};

}  // namespace

Comparison chain_solve_is_right(const FunctionCode& f, const Atoms& atoms) {
    Program program = f.program;
    std::size_t next = 0;
    const Articulated solver(program, f.chain->links, [&](NodeId) { return f.chain->inverses[next++]; });
    StepProofs proofs(program, atoms);
    for (std::size_t b = 0; b < f.chain->links.size(); ++b) {
        const LinkNodes& link = f.chain->links[b];
        SixBySix inertia = solver.inertia_with(b);
        const NodeAlgebra nodes(program);
        for (std::size_t j = link.directions.size(); j-- > 0;) {
            proofs.elimination(link.directions[j], inertia);
            eliminate(nodes, link.directions[j], inertia, nullptr);
        }
        if (!link.base) continue;
        proofs.handing_on(link.transfer, solver.inertia_left(b), f.chain->loads.remainder[b]);
        if (f.loop) proofs.handing_on(link.transfer, solver.inertia_left(b), f.loop->loads.remainder[b]);
    }
    return proofs.worst;
}

bool chain_is_solved_so(const FunctionCode& f, const std::function<bool(NodeId, NodeId)>& is_reciprocal) {
    Program program = f.program;
    std::size_t next = 0;
    bool holds = true;
    const Articulated solver(program, f.chain->links, [&](NodeId pivot) {
        const NodeId emitted = f.chain->inverses[next++];
        holds = holds && (program.reciprocal(pivot) == emitted || is_reciprocal(emitted, pivot));
        return emitted;
    });
    if (!f.accelerations.empty()) holds = holds && solver.solve(f.chain->loads).accelerations == f.accelerations;
    if (f.loop) holds = holds && solver.solve(f.loop->loads).accelerations == f.loop->results;
    return holds;
}

}  // namespace dalembert
