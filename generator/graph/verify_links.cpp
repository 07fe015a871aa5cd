// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "prove/motion_at.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Sum of products, most of which are zero.
class Products {
public:
    void add(const ex& a, const ex& b) {
        if (!a.is_zero() && !b.is_zero()) terms_.push_back(a * b);
    }
    ex sum() const { return GiNaC::add(terms_); }

private:
    GiNaC::exvector terms_;
};

}  // namespace

LinkProof::LinkProof(const FunctionCode& f, const Code& code, CachedMeaning cached, Prover& prover, SumBySum& by_sums,
                     ComparisonAtPoints compare)
    : f_(f),
      system_(code.system),
      chain_(*code.system.chain),
      raise_(f.program, code.atoms, cached),
      kept_(f.program, code.atoms, std::move(cached), Raiser::Sums::kept_whole),
      prover_(prover),
      by_sums_(by_sums),
      compare_(std::move(compare)),
      on_(chain_.links.size()) {
    for (std::size_t b = 0; b < chain_.links.size(); ++b)
        if (chain_.links[b].base) on_[*chain_.links[b].base].push_back(b);
}

std::optional<NodeId> LinkProof::negated_by(NodeId id) const {
    const Node& node = f_.program[id];
    const bool is_negated = node.kind == Node::Kind::sum && node.arguments.size() == 1;
    return is_negated ? std::optional(node.arguments[0]) : std::nullopt;
}

std::vector<NodeId> LinkProof::parts(std::size_t b) const {
    const LinkNodes& link = f_.chain->links[b];
    struct Emitted {
        const SixBySix &transfer, &inertia;
        const std::vector<SixNodes>& directions;
        const SixNodes &remainder, &force;
    };
    const Emitted emitted{link.transfer, link.inertia, link.directions, f_.chain->loads.remainder[b], f_.chain->loads.force[b]};
    std::vector<NodeId> all;
    each_part(emitted, [&](const SixNodes& six) { all.insert(all.end(), six.begin(), six.end()); });
    return all;
}

void LinkProof::define(NodeId id, const ex& letter) {
    raise_.define(id, letter);
    kept_.define(id, letter);
}

ex LinkProof::stand_in(NodeId id, const ex& letter) {
    if (const auto negated = negated_by(id)) {  // signs are taken out of factors
        const ex opposite = GiNaC::realsymbol("-" + GiNaC::ex_to<GiNaC::symbol>(letter).get_name());
        return stands_for_[letter] = -stand_in(*negated, opposite);
    }
    const ex value = raise_(id);
    if (value.info(GiNaC::info_flags::numeric) || value.info(GiNaC::info_flags::symbol)) {
        if (!value.is_equal(letter)) stands_for_[letter] = value;
        return value;
    }
    define(id, letter);
    meaning_.add(letter, value);
    return letter;
}

Twist LinkProof::stand_in(const SixNodes& nodes, const std::string& name) {
    Twist result;
    for (std::size_t r = 0; r < 6; ++r) result[r] = stand_in(nodes[r], GiNaC::realsymbol(fmt::format("{}[{}]", name, r)));
    return result;
}

void LinkProof::same(NodeId emitted, const ex& derived) {
    const ex meant = WithLetters(stands_for_)(derived);
    if (SumBySum::has_sums(meant) && by_sums_.proven_equal(kept_(emitted), meant)) return;
    const ex raised = raise_(emitted);
    if (is_same(raised, meant)) return;
    compare_([this](const ex& e, const Point& point, int digits) { return value(e, point, digits); }, raised, meant);
}

std::optional<cln::cl_R> LinkProof::value(const ex& e, const Point& point, int digits) {
    const auto is_known = [&] {
        return known_.digits == digits && std::equal(point.begin(), point.end(), known_.point.begin(), known_.point.end(),
                                                     [](const auto& a, const auto& b) { return a.second == b.second; });
    };
    if (!is_known()) known_ = {point, with_letters(point, digits), digits};
    return known_.with_letters ? value_at(e, system_.symbols, *known_.with_letters, digits) : std::nullopt;
}

std::optional<Point> LinkProof::with_letters(Point point, int digits) const {
    const auto take = [&](const ex& letter, const std::optional<cln::cl_R>& number) {
        if (number) point.emplace_back(letter, cln::rational(*number));
        return number.has_value();
    };
    if (!solved_.empty()) {
        GiNaC::exmap values;
        for (const auto& [letter, number] : point) values[letter] = GiNaC::numeric(number);
        for (const Variable& definition : system_.symbols.all(SymbolKind::definition)) {
            const auto number = value_at(definition.symbol, system_.symbols, point, digits);
            if (!number) return std::nullopt;
            values[definition.symbol] = GiNaC::numeric(*number);
        }
        try {
            const MotionAt motion(system_, std::move(values), digits);
            std::erase_if(point, [&](const auto& known) {
                return std::any_of(solved_.begin(), solved_.end(), [&](const ex& letter) { return letter.is_equal(known.first); });
            });
            for (const ex& letter : solved_) take(letter, motion(letter));
        } catch (const Failure&) {  // there is no motion at this point
            return std::nullopt;
        }
    }
    // Loads are linear in these: what is the same with any numbers is the same in each column.
    for (std::size_t c = 0; c < in_column_.size(); ++c) {
        const long place = static_cast<long>(c);
        point.emplace_back(in_column_[c], Rational(3 * place + 5) / (2 * place + 3));
    }
    for (const auto& [letter, meaning] : meaning_)
        if (!take(letter, value_at(meaning, system_.symbols, point, digits))) return std::nullopt;
    return point;
}

/// A letter that one side has alone may be what the other happens to be: the derivative of a vector by an angle is made of its components.
bool LinkProof::is_same(const ex& raised, const ex& meant) {
    if (raised.is_equal(meant) || prover_.have_same_form(raised, meant)) return true;
    ex one = raised, other = meant;
    bool have_same_form = false;
    meaning_.write_out(one, other, [&] { return have_same_form = prover_.have_same_form(one, other); });
    if (have_same_form) return true;
    return prover_.proven_equal(one, other) || prover_.proven_equal(raised, meant);
}

void LinkProof::same(const SixNodes& emitted, const Twist& derived) {
    for (std::size_t r = 0; r < 6; ++r) same(emitted[r], derived[r]);
}

void LinkProof::links() {
    const ChainNodes& nodes = *f_.chain;
    for (std::size_t r = 0; r < 6; ++r) same(nodes.loads.ground[r], chain_.ground[r]);
    for (std::size_t j = 0; j < chain_.rest.size(); ++j) same(nodes.loads.rest[j], chain_.rest[j]);
    for (std::size_t b = 0; b < chain_.links.size(); ++b) {
        const ChainLink& link = chain_.links[b];
        for (std::size_t k = 0; k < link.letters.size(); ++k) same(nodes.letters[b][k], link.letters[k].second);
        for (std::size_t k = 0; k < link.letters.size(); ++k) stand_in(nodes.letters[b][k], link.letters[k].first);
        const std::vector<NodeId> emitted = parts(b);
        const std::vector<ex> derived = link.parts();
        for (std::size_t i = 0; i < derived.size(); ++i) same(emitted[i], derived[i]);
    }
}

void LinkProof::columns(const ChainSlopes<ex>& slopes, By by) {
    for (std::size_t c = 0; c < column_count(system_.symbols, by); ++c) {
        in_column_.push_back(GiNaC::realsymbol(fmt::format("column {}", c)));
        if (const auto node = f_.program.find(Op::in_column, static_cast<long>(c))) define(*node, in_column_.back());
    }
    std::map<NodeId, ex> letters;
    for (std::size_t j = 0; j < chain_.rest.size(); ++j) {
        const ex& letter = system_.symbols.get(SymbolKind::acceleration, j);
        accelerations_.push_back(letter);
        if (f_.accelerations.empty()) continue;
        const auto negated = negated_by(f_.accelerations[j]);
        const NodeId solved = negated.value_or(f_.accelerations[j]);
        if (f_.program[solved].arguments.empty()) {
            accelerations_.back() = stand_in(f_.accelerations[j], letter);
            continue;
        }
        // What it was solved to be is not raised: it is long. Two coordinates may have the same.
        const auto [known, is_new] = letters.emplace(solved, negated ? ex(-letter) : letter);
        define(solved, known->second);
        if (is_new) solved_.push_back(letter);
        else accelerations_.back() = stands_for_[letter] = negated ? ex(-known->second) : known->second;
    }
    for (std::size_t r = 0; r < 6; ++r) ground_[r] = raise_(f_.chain->loads.ground[r]);
    for (std::size_t b = 0; b < chain_.links.size(); ++b) {
        changes(b, slopes.links[b], by);
        acceleration(b);
    }
    needed_.resize(chain_.links.size());
    for (std::size_t b = chain_.links.size(); b-- > 0;) needed(b);
    for (std::size_t b = 0; b < chain_.links.size(); ++b) loads(b, slopes, by);
    for (std::size_t r = 0; r < 6; ++r) {
        Products change;
        for (const auto& column : slopes.by[static_cast<std::size_t>(by)]) change.add(column.ground[r], in_column_[column.of]);
        same(f_.loop->loads.ground[r], change.sum());
    }
}

void LinkProof::changes(std::size_t b, const LinkSlopes<ex>& slopes, By by) {
    std::vector<ex> own;
    for (std::size_t k = 0; k < slopes.letters.size(); ++k) {
        Products change;
        for (const auto& slope : slopes.by_base) change.add(slope.letters[k], changes_[*chain_.links[b].base][slope.of]);
        for (const auto& slope : slopes.by[static_cast<std::size_t>(by)]) change.add(slope.letters[k], in_column_[slope.of]);
        same(f_.loop->changes[b][k], change.sum());
        own.push_back(stand_in(f_.loop->changes[b][k], GiNaC::realsymbol(fmt::format("change of {}[{}]", b, k))));
    }
    changes_.push_back(std::move(own));
}

void LinkProof::acceleration(std::size_t b) {
    const ChainLink& link = chain_.links[b];
    Twist meant;
    for (std::size_t r = 0; r < 6; ++r) {
        Products rate;
        rate.add(link.remainder[r], 1);
        for (std::size_t k = 0; k < 6; ++k) rate.add(link.transfer[r][k], base_acceleration(b)[k]);
        for (std::size_t j = 0; j < link.coordinates.size(); ++j) rate.add(link.directions[j][r], accelerations_[link.coordinates[j]]);
        meant[r] = rate.sum();
    }
    same(f_.loop->twists[b], meant);
    twists_.push_back(stand_in(f_.loop->twists[b], fmt::format("acceleration of {}", b)));
}

void LinkProof::needed(std::size_t b) {
    Twist meant;
    for (std::size_t r = 0; r < 6; ++r) {
        Products force;
        force.add(chain_.links[b].force[r], 1);
        for (std::size_t k = 0; k < 6; ++k) force.add(chain_.links[b].inertia[r][k], twists_[b][k]);
        for (const std::size_t c : on_[b])
            for (std::size_t k = 0; k < 6; ++k) force.add(chain_.links[c].transfer[k][r], needed_[c][k]);
        meant[r] = force.sum();
    }
    same(f_.loop->needed[b], meant);
    needed_[b] = stand_in(f_.loop->needed[b], fmt::format("force of {}", b));
}

std::vector<LinkProof::Change> LinkProof::changes_of_parts(std::size_t b, const LinkSlopes<ex>& slopes, By by) const {
    std::vector<Change> result;
    const auto add = [&](const ChainSlope<ex>& slope, const ex& change) {
        result.push_back({{chain_.links[b].coordinates.size(), [&](std::size_t i) { return slope.parts[i]; }}, change});
    };
    for (const auto& slope : slopes.by_base) add(slope, changes_[*chain_.links[b].base][slope.of]);
    for (const auto& slope : slopes.by_own) add(slope, changes_[b][slope.of]);
    for (const auto& slope : slopes.by[static_cast<std::size_t>(by)]) add(slope, in_column_[slope.of]);
    return result;
}

void LinkProof::loads(std::size_t b, const ChainSlopes<ex>& slopes, By by) {
    const ChainLink& link = chain_.links[b];
    const ChainLoads& emitted = f_.loop->loads;
    const std::vector<Change> own = changes_of_parts(b, slopes.links[b], by);
    Twist remainder, force;
    for (std::size_t r = 0; r < 6; ++r) {
        Products of_remainder, of_force;
        for (const auto& [parts, change] : own) {
            Products on_twist, on_force;
            on_twist.add(parts.remainder[r], 1);
            on_force.add(parts.force[r], 1);
            for (std::size_t k = 0; k < 6; ++k) {
                on_twist.add(parts.transfer[r][k], base_acceleration(b)[k]);
                on_force.add(parts.inertia[r][k], twists_[b][k]);
            }
            for (std::size_t j = 0; j < link.coordinates.size(); ++j)
                on_twist.add(parts.directions[j][r], accelerations_[link.coordinates[j]]);
            of_remainder.add(on_twist.sum(), change);
            of_force.add(on_force.sum(), change);
        }
        remainder[r] = of_remainder.sum();
        force[r] = of_force.sum();
    }
    for (const std::size_t c : on_[b])
        for (const auto& [parts, change] : changes_of_parts(c, slopes.links[c], by))
            for (std::size_t r = 0; r < 6; ++r) {
                Products handed_on;
                for (std::size_t k = 0; k < 6; ++k) handed_on.add(parts.transfer[k][r], needed_[c][k]);
                force[r] += handed_on.sum() * change;
            }
    same(emitted.remainder[b], remainder);
    same(emitted.force[b], force);
    for (std::size_t j = 0; j < link.coordinates.size(); ++j) {
        Products rest;
        for (const auto& column : slopes.by[static_cast<std::size_t>(by)])
            rest.add(column.rest[link.coordinates[j]], in_column_[column.of]);
        for (const auto& [parts, change] : own) {
            Products along;
            for (std::size_t r = 0; r < 6; ++r) along.add(parts.directions[j][r], needed_[b][r]);
            rest.add(along.sum(), -change);
        }
        same(emitted.rest[link.coordinates[j]], rest.sum());
    }
}

}  // namespace dalembert
