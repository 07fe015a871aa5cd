// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/articulated.hpp"

namespace dalembert {

NodeId NodeAlgebra::plus(NodeId a, const Pairs& products, bool is_minus) const {
    std::vector<std::pair<bool, NodeId>> terms;
    const auto add = [&](bool negative, NodeId id) {
        const Node& node = program_[id];
        const bool is_negated = node.kind == Node::Kind::sum && node.arguments.size() == 1;
        terms.emplace_back(negative != is_negated, is_negated ? node.arguments[0] : id);
    };
    add(false, a);
    for (const auto& [b, c] : products) {
        bool negative = is_minus;
        std::vector<NodeId> factors;
        for (const NodeId factor : {b, c}) {
            const Node& node = program_[factor];
            const bool is_negated = node.kind == Node::Kind::sum && node.arguments.size() == 1;
            const bool is_negative_number = node.kind == Node::Kind::constant && is_negative(node.value);
            negative = negative != (is_negated || is_negative_number);
            factors.push_back(is_negated ? node.arguments[0] : is_negative_number ? program_.constant(-node.value) : factor);
        }
        add(negative, program_.product(std::move(factors)));
    }
    return program_.sum(std::move(terms));
}

NodeId NodeAlgebra::dot(const SixNodes& a, const SixNodes& b) const {
    Pairs pairs;
    for (std::size_t i = 0; i < 6; ++i) pairs.emplace_back(a[i], b[i]);
    return plus(program_.constant(0), pairs);
}

SixNodes NodeAlgebra::times(const SixBySix& matrix, const SixNodes& vector) const {
    SixNodes result;
    for (std::size_t r = 0; r < 6; ++r) result[r] = dot(matrix[r], vector);
    return result;
}

SixNodes NodeAlgebra::times_transposed(const SixBySix& matrix, const SixNodes& vector) const {
    SixNodes result;
    for (std::size_t c = 0; c < 6; ++c) {
        Pairs pairs;
        for (std::size_t r = 0; r < 6; ++r) pairs.emplace_back(matrix[r][c], vector[r]);
        result[c] = plus(program_.constant(0), pairs);
    }
    return result;
}

SixNodes NodeAlgebra::sum(const SixNodes& a, const SixNodes& b) const {
    SixNodes result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = plus(a[i], {{program_.constant(1), b[i]}});
    return result;
}

SixNodes NodeAlgebra::none() const {
    SixNodes result;
    result.fill(program_.constant(0));
    return result;
}

EliminatedCoordinate eliminate(const NodeAlgebra& of, const SixNodes& direction, SixBySix& inertia, const Reciprocal& reciprocal) {
    EliminatedCoordinate e;
    e.image = of.times(inertia, direction);
    const NodeId pivot = of.dot(direction, e.image);
    e.inverse = reciprocal ? reciprocal(pivot) : of.program().reciprocal(pivot);
    for (std::size_t r = 0; r < 6; ++r) e.scaled[r] = of.plus(of.program().constant(0), {{e.image[r], e.inverse}});
    for (std::size_t r = 0; r < 6; ++r)
        for (std::size_t c = 0; c <= r; ++c) inertia[r][c] = inertia[c][r] = of.plus(inertia[r][c], {{e.image[r], e.scaled[c]}}, true);
    return e;
}

NodeId load(const NodeAlgebra& of, const SixNodes& direction, const EliminatedCoordinate& eliminated, NodeId rest, SixNodes& force) {
    NodeAlgebra::Pairs pairs;
    for (std::size_t r = 0; r < 6; ++r) pairs.emplace_back(direction[r], force[r]);
    const NodeId result = of.plus(rest, pairs, true);
    for (std::size_t r = 0; r < 6; ++r) force[r] = of.plus(force[r], {{eliminated.scaled[r], result}});
    return result;
}

NodeId accelerate(const NodeAlgebra& of, const SixNodes& direction, const EliminatedCoordinate& eliminated, NodeId load,
                  SixNodes& acceleration) {
    NodeAlgebra::Pairs pairs;
    for (std::size_t r = 0; r < 6; ++r) pairs.emplace_back(eliminated.scaled[r], acceleration[r]);
    const NodeId result = of.plus(of.plus(of.program().constant(0), {{load, eliminated.inverse}}), pairs, true);
    for (std::size_t r = 0; r < 6; ++r) acceleration[r] = of.plus(acceleration[r], {{direction[r], result}});
    return result;
}

SixBySix handed_on(const NodeAlgebra& of, const SixBySix& transfer, const SixBySix& inertia) {
    SixBySix columns;  // of inertia*transfer
    for (std::size_t c = 0; c < 6; ++c) {
        SixNodes column;
        for (std::size_t r = 0; r < 6; ++r) column[r] = transfer[r][c];
        columns[c] = of.times(inertia, column);
    }
    SixBySix result;
    for (std::size_t r = 0; r < 6; ++r) {
        SixNodes column;
        for (std::size_t k = 0; k < 6; ++k) column[k] = transfer[k][r];
        for (std::size_t c = 0; c <= r; ++c) result[r][c] = result[c][r] = of.dot(column, columns[c]);
    }
    return result;
}

SixNodes handed_on(const NodeAlgebra& of, const SixBySix& transfer, const SixBySix& inertia, const SixNodes& remainder,
                   const SixNodes& force) {
    return of.times_transposed(transfer, of.sum(force, of.times(inertia, remainder)));
}

Articulated::Articulated(Program& program, std::vector<LinkNodes> links, const Reciprocal& reciprocal)
    : of_(program), links_(std::move(links)), eliminated_(links_.size()) {
    for (const LinkNodes& link : links_) whole_.push_back(link.inertia);
    left_ = whole_;
    for (std::size_t b = links_.size(); b-- > 0;) {
        const LinkNodes& link = links_[b];
        left_[b] = whole_[b];
        eliminated_[b].resize(link.directions.size());
        for (std::size_t j = link.directions.size(); j-- > 0;) eliminated_[b][j] = eliminate(of_, link.directions[j], left_[b], reciprocal);
        if (!link.base) continue;
        const SixBySix more = handed_on(of_, link.transfer, left_[b]);
        SixBySix& base = whole_[*link.base];
        for (std::size_t r = 0; r < 6; ++r) base[r] = of_.sum(base[r], more[r]);
    }
}

SixNodes Articulated::carried(std::size_t b, const ChainLoads& loads, const ChainMotion& motion) const {
    const LinkNodes& link = links_[b];
    return of_.sum(of_.times(link.transfer, link.base ? motion.twists[*link.base] : loads.ground), loads.remainder[b]);
}

ChainMotion Articulated::solve(const ChainLoads& loads) const {
    ChainMotion motion{loads.rest, {}};
    std::vector<SixNodes> force = loads.force;
    for (std::size_t b = links_.size(); b-- > 0;) {
        const LinkNodes& link = links_[b];
        for (std::size_t j = link.directions.size(); j-- > 0;) {
            NodeId& taken = motion.accelerations[link.coordinates[j]];  // a load first
            taken = load(of_, link.directions[j], eliminated_[b][j], taken, force[b]);
        }
        if (link.base)
            force[*link.base] = of_.sum(force[*link.base], handed_on(of_, link.transfer, left_[b], loads.remainder[b], force[b]));
    }
    for (std::size_t b = 0; b < links_.size(); ++b) {
        const LinkNodes& link = links_[b];
        SixNodes acceleration = carried(b, loads, motion);
        for (std::size_t j = 0; j < link.directions.size(); ++j) {
            NodeId& own = motion.accelerations[link.coordinates[j]];
            own = accelerate(of_, link.directions[j], eliminated_[b][j], own, acceleration);
        }
        motion.twists.push_back(acceleration);
    }
    return motion;
}

ChainMotion Articulated::moved(const ChainLoads& loads, std::vector<NodeId> accelerations) const {
    ChainMotion motion{std::move(accelerations), {}};
    for (std::size_t b = 0; b < links_.size(); ++b) {
        const LinkNodes& link = links_[b];
        SixNodes acceleration = carried(b, loads, motion);
        for (std::size_t j = 0; j < link.coordinates.size(); ++j)
            for (std::size_t r = 0; r < 6; ++r)
                acceleration[r] = of_.plus(acceleration[r], {{link.directions[j][r], motion.accelerations[link.coordinates[j]]}});
        motion.twists.push_back(acceleration);
    }
    return motion;
}

}  // namespace dalembert
