// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/chain_code.hpp"

#include <set>

namespace dalembert {

namespace {

using PartNodes = LinkParts<NodeId>;

class ChainCode {
public:
    /// Adds to the roots what a function needs: the motion, and the columns of a Jacobian.
    ChainCode(const System& system, const LoweredChain& chain, std::optional<By> by, Roots& roots);

    /// When the builder has been prepared. Letters of links get their values.
    ChainNodes nodes(ProgramBuilder& builder, const Atoms& atoms) const;
    /// From accelerations and rates of twists. The results are for the caller to solve for.
    ChainColumn column(ProgramBuilder& builder, Program& program, const ChainNodes& nodes, const ChainMotion& motion) const;

private:
    struct SlopeRoots {
        std::size_t of, letters, parts;
    };
    struct LinkRoots {
        std::size_t letters, parts;
        std::vector<SlopeRoots> by_base, by_own, by_column;
    };
    struct ColumnRoots {
        std::size_t of, ground, rest;
    };
    const Chain& chain_;
    std::vector<LinkRoots> links_;
    std::size_t ground_, rest_;
    std::vector<ColumnRoots> columns_;
};

ChainCode::ChainCode(const System& system, const LoweredChain& chain, std::optional<By> by, Roots& roots) : chain_(*system.chain) {
    const auto slopes = [&](const std::vector<ChainSlope<Polynomial>>& of) {
        std::vector<SlopeRoots> result;
        for (const ChainSlope<Polynomial>& slope : of) result.push_back({slope.of, roots.add(slope.letters), roots.add(slope.parts)});
        return result;
    };
    for (const LinkSlopes<Polynomial>& link : chain.links) {
        LinkRoots& r = links_.emplace_back(LinkRoots{roots.add(link.letters), roots.add(link.parts), {}, {}, {}});
        if (!by) continue;
        r.by_base = slopes(link.by_base);
        r.by_own = slopes(link.by_own);
        r.by_column = slopes(link.by[static_cast<std::size_t>(*by)]);
    }
    ground_ = roots.add(chain.ground);
    rest_ = roots.add(chain.rest);
    if (!by) return;
    for (const LoweredChain::Column& column : chain.by[static_cast<std::size_t>(*by)])
        columns_.push_back({column.of, roots.add(column.ground), roots.add(column.rest)});
}

ChainNodes ChainCode::nodes(ProgramBuilder& builder, const Atoms& atoms) const {
    ChainNodes result;
    for (std::size_t b = 0; b < links_.size(); ++b) {
        const ChainLink& link = chain_.links[b];
        std::vector<NodeId>& letters = result.letters.emplace_back();
        for (std::size_t k = 0; k < link.letters.size(); ++k) {
            const Variable* letter = atoms.symbols().find(link.letters[k].first);
            letters.push_back(builder.root(links_[b].letters + k));
            builder.define(atoms.symbol(*letter), letters.back());
        }
        const PartNodes parts(link.coordinates.size(), [&](std::size_t i) { return builder.root(links_[b].parts + i); });
        result.links.push_back({link.base, link.coordinates, parts.transfer, parts.inertia, parts.directions});
        result.loads.remainder.push_back(parts.remainder);
        result.loads.force.push_back(parts.force);
    }
    for (std::size_t r = 0; r < 6; ++r) result.loads.ground[r] = builder.root(ground_ + r);
    for (std::size_t j = 0; j < chain_.rest.size(); ++j) result.loads.rest.push_back(builder.root(rest_ + j));
    return result;
}

/// Of a = transfer*a_base + directions*qdd + remainder and f = inertia*a + force + sum of transfer'*f what changes with the column at fixed
/// accelerations is a remainder and a force of the same equations; directions'*f = rest changes by its directions, too.
ChainColumn ChainCode::column(ProgramBuilder& builder, Program& program, const ChainNodes& nodes, const ChainMotion& motion) const {
    const NodeAlgebra of(program);
    const std::size_t count = links_.size();
    const NodeId zero = program.constant(0);
    // The moment and force that each link needs.
    std::vector<SixNodes> needed(count);
    for (std::size_t b = 0; b < count; ++b) needed[b] = of.sum(of.times(nodes.links[b].inertia, motion.twists[b]), nodes.loads.force[b]);
    for (std::size_t b = count; b-- > 0;)
        if (nodes.links[b].base)
            needed[*nodes.links[b].base] = of.sum(needed[*nodes.links[b].base], of.times_transposed(nodes.links[b].transfer, needed[b]));

    ChainColumn result{{},
                       {},
                       motion.twists,
                       needed,
                       {std::vector<SixNodes>(count, of.none()), std::vector<SixNodes>(count, of.none()),
                        std::vector<NodeId>(chain_.rest.size(), zero), of.none()},
                       {}};
    std::set<std::size_t> columns;
    const auto in_column = [&](std::size_t c) {
        columns.insert(c);
        return program.function(Op::in_column, {program.constant(static_cast<long>(c))});
    };
    std::vector<std::vector<NodeId>> letters(count);  // how they change
    for (std::size_t b = 0; b < count; ++b) {
        const ChainLink& link = chain_.links[b];
        letters[b].assign(link.letters.size(), zero);
        const auto add = [&](const SlopeRoots& slope, NodeId change) {
            if (program.is_constant(change, 0)) return;
            for (std::size_t k = 0; k < letters[b].size(); ++k)
                letters[b][k] = of.plus(letters[b][k], {{builder.root(slope.letters + k), change}});
        };
        for (const SlopeRoots& slope : links_[b].by_base) add(slope, letters[*link.base][slope.of]);
        for (const SlopeRoots& slope : links_[b].by_column) add(slope, in_column(slope.of));
    }
    for (std::size_t b = 0; b < count; ++b) {
        const ChainLink& link = chain_.links[b];
        const SixNodes& base_twist = link.base ? motion.twists[*link.base] : nodes.loads.ground;
        const auto add = [&](const SlopeRoots& slope, NodeId change) {
            if (program.is_constant(change, 0)) return;
            const PartNodes parts(link.coordinates.size(), [&](std::size_t i) { return builder.root(slope.parts + i); });
            SixNodes remainder = of.sum(parts.remainder, of.times(parts.transfer, base_twist));
            for (std::size_t j = 0; j < link.coordinates.size(); ++j)
                for (std::size_t r = 0; r < 6; ++r)
                    remainder[r] = of.plus(remainder[r], {{parts.directions[j][r], motion.accelerations[link.coordinates[j]]}});
            const SixNodes force = of.sum(parts.force, of.times(parts.inertia, motion.twists[b]));
            const SixNodes to_base = of.times_transposed(parts.transfer, needed[b]);
            ChainLoads& loads = result.loads;
            for (std::size_t r = 0; r < 6; ++r) {
                loads.remainder[b][r] = of.plus(loads.remainder[b][r], {{remainder[r], change}});
                loads.force[b][r] = of.plus(loads.force[b][r], {{force[r], change}});
                if (link.base) loads.force[*link.base][r] = of.plus(loads.force[*link.base][r], {{to_base[r], change}});
            }
            for (std::size_t j = 0; j < link.coordinates.size(); ++j) {
                NodeId& rest = loads.rest[link.coordinates[j]];
                rest = of.plus(rest, {{of.dot(parts.directions[j], needed[b]), change}}, true);
            }
        };
        for (const SlopeRoots& slope : links_[b].by_base) add(slope, letters[*link.base][slope.of]);
        for (const SlopeRoots& slope : links_[b].by_own) add(slope, letters[b][slope.of]);
        for (const SlopeRoots& slope : links_[b].by_column) add(slope, in_column(slope.of));
    }
    for (const ColumnRoots& column : columns_) {
        const NodeId change = in_column(column.of);
        for (std::size_t r = 0; r < 6; ++r)
            result.loads.ground[r] = of.plus(result.loads.ground[r], {{builder.root(column.ground + r), change}});
        for (std::size_t j = 0; j < chain_.rest.size(); ++j)
            result.loads.rest[j] = of.plus(result.loads.rest[j], {{builder.root(column.rest + j), change}});
    }
    result.columns.assign(columns.begin(), columns.end());
    result.changes = std::move(letters);
    return result;
}

}  // namespace

void make_chain_function(Code& code, const LoweredSystem& lowered, FunctionCode& f, std::optional<By> by, ChainFunction kind,
                         ParameterParts parts, const std::vector<Polynomial>& more) {
    const bool is_solved = kind == ChainFunction::solved;
    const auto& letters = code.system.symbols.all(SymbolKind::acceleration);
    ProgramBuilder builder(code.atoms, code.cache, parts, f.program, code.passes);
    Roots roots;
    const ChainCode chain(code.system, *lowered.chain, by, roots);
    const std::size_t rates = is_solved ? roots.add(lowered.state_rate) : 0;
    const std::size_t values = roots.add(more);
    const std::size_t below = by ? roots.add(lowered.partial(*by).state_rate) : 0;
    builder.prepare(roots.polynomials());

    f.chain = chain.nodes(builder, code.atoms);
    const Articulated solver(f.program, f.chain->links, [&](NodeId pivot) {
        return f.chain->inverses.emplace_back(reciprocal(code.atoms, code.cache, f.program, pivot, code.passes));
    });
    ChainMotion motion;
    if (is_solved) {
        motion = solver.solve(f.chain->loads);
        f.accelerations = motion.accelerations;
        for (std::size_t j = 0; j < letters.size(); ++j) builder.define(code.atoms.symbol(letters[j]), motion.accelerations[j]);
        for (std::size_t i = 0; i < lowered.state_rate.size(); ++i) f.results.push_back(builder.root(rates + i));
        for (std::size_t i = 0; i < more.size(); ++i) f.results.push_back(builder.root(values + i));
    } else {
        std::vector<NodeId> known;
        for (const Variable& letter : letters) known.push_back(f.program.symbol(code.atoms.symbol(letter)));
        motion = solver.moved(f.chain->loads, std::move(known));
    }
    if (!by) return;
    f.loop = chain.column(builder, f.program, *f.chain, motion);
    f.loop->results = solver.solve(f.loop->loads).accelerations;
    const std::size_t columns = lowered.partial(*by).state_rate.size(), rows = lowered.state_rate.size();
    f.right = {0, columns, {}};
    f.below = {rows, columns, {}};
    for (std::size_t i = 0; i < columns * rows; ++i) f.below.entries.push_back(builder.root(below + i));
    if (!is_solved) f.note_letters(code.atoms);
}

int cost(const FunctionCode& f, std::size_t order) {
    constexpr int side_by_side = 4, putting = 6, division = 10;
    const int n = static_cast<int>(order);
    const OperationCount count = f.program.count(f.roots());
    int result = count.total() + division * count.divisions;
    if (f.loop) {
        std::vector<bool> same = f.varying();
        same.flip();
        const int columns = static_cast<int>(f.loop->columns.size());
        const int passes = (columns + side_by_side - 1) / side_by_side;
        result += f.program.count(f.roots(), same).total() * (passes - 1) + putting * n * columns;
    }
    if (f.by_loops) result += n * n * n / 3 + 2 * n * n + static_cast<int>(f.right.columns) * 2 * n * n;
    return result;
}

}  // namespace dalembert
