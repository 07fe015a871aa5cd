// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "elements/statics.hpp"
#include "form/loose_joints.hpp"
#include "form/random_points.hpp"
#include "symbolic/quotient.hpp"
#include "symbolic/values.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::size_t term_count(const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1; }

/// Squares of one of the functions sine and cosine by those of the other.
struct SquaresReplaced : GiNaC::map_function {
    explicit SquaresReplaced(bool sines) : sines_(sines) {}
    ex operator()(const ex& e) override {
        const bool is_power =
            GiNaC::is_a<GiNaC::power>(e) && GiNaC::is_a<GiNaC::function>(e.op(0)) && e.op(1).info(GiNaC::info_flags::posint);
        if (!is_power) return GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e) ? e.map(*this) : e;
        const std::string name = GiNaC::ex_to<GiNaC::function>(e.op(0)).get_name();
        if (name != (sines_ ? "sin" : "cos")) return e;
        const int n = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int();
        const ex& angle = e.op(0).op(0);
        const ex other = sines_ ? GiNaC::cos(angle) : GiNaC::sin(angle);
        return GiNaC::pow(e.op(0), n % 2) * GiNaC::pow(1 - GiNaC::pow(other, 2), n / 2);
    }
    bool sines_;
};

/// Written out, with sin^2 + cos^2 = 1 used in the way that leaves the fewest terms; as it is where that is long.
ex shortest(const ex& e) {
    constexpr std::size_t most_terms = 200;
    const ex written = e.expand();
    if (term_count(written) > most_terms) return e;
    ex best = written;
    for (const bool sines : {false, true}) {
        SquaresReplaced replace(sines);
        const ex other = replace(written).expand();
        if (term_count(other) < term_count(best)) best = other;
    }
    return best;
}

constexpr const char* balance_names[]{"force along x",  "force along y",  "force along z",
                                      "moment about x", "moment about y", "moment about z"};

/// factors*unknowns + constant = 0
struct Balance {
    std::size_t body;   ///< none of them: the sum over all
    std::size_t which;
    std::vector<ex> factors;
    ex constant;
    std::optional<std::size_t> pivot = {};

    std::size_t unknowns() const {
        return static_cast<std::size_t>(std::count_if(factors.begin(), factors.end(), [](const ex& f) { return !f.is_zero(); }));
    }
};

/// Numbers first, then what is short.
std::size_t weight(const ex& factor) {
    if (GiNaC::is_a<GiNaC::numeric>(factor)) return factor.is_equal(1) || factor.is_equal(-1) ? 0 : 1;
    return 1 + static_cast<std::size_t>(std::distance(factor.preorder_begin(), factor.preorder_end()));
}

class LoadElimination {
public:
    LoadElimination(const System& system, const Load& load)
        : system_(system), load_(load), bodies_(load_bodies(load)), seems_zero_(system) {
        for (const Unknown& unknown : load.unknowns) {
            letters_.push_back(GiNaC::realsymbol(unknown.name));
            named_[unknown.name] = letters_.back();
        }
        scales_.assign(letters_.size(), 1);
        const std::vector<ex> lengths = bar_lengths(load, system.translate, named_);
        std::copy(lengths.begin(), lengths.end(), scales_.end() - static_cast<std::ptrdiff_t>(lengths.size()));
        check_bars();
        shares_ = load_shares(load, system.translate, named_);
    }

    LoadSolution solve() {
        set_up();
        check_joints();
        while (Balance* next = next_balance()) substitute(*next);
        check_left_over();
        check_determined();
        LoadSolution result{&load_, shares_, std::vector<ex>(letters_.size())};
        GiNaC::exmap solution;
        for (const Balance& balance : balances_)
            if (balance.pivot) {
                result.unknowns[*balance.pivot] =
                    scales_[*balance.pivot] * divided(-balance.constant, balance.factors[*balance.pivot]);
                solution[letters_[*balance.pivot]] = result.unknowns[*balance.pivot];
            }
        check_values(result);
        for (LoadShare& share : result.shares)
            for (SpaceVector* v : {&share.force, &share.moment})
                for (ex& e : *v) e = e.subs(solution, GiNaC::subs_options::no_pattern);
        return result;
    }

private:
    void check_bars() const {
        for (std::size_t i = 0; i < load_.bars.size(); ++i)
            if (const Bar& bar = load_.bars[i]; seems_zero_(scales_[scales_.size() - load_.bars.size() + i]))
                throw Failure(Diagnostic{Id::value_out_of_range, bar.span,
                                         fmt::format("bar '{}' of load '{}' has no length: '{}' and '{}' are at the same place", bar.name,
                                                     load_.name, bar.between[0].first, bar.between[1].first)});
    }

    /// Of several bodies the balances of all together come first: they are sums of the others, and often tell a force at once.
    void set_up() {
        const std::size_t n = bodies_.size();
        std::vector<std::vector<Balance>> all(n);
        for (std::size_t body = 0; body < n; ++body)
            for (std::size_t which = 0; which < 6; ++which) all[body].push_back(balance_of(body, which));
        for (std::size_t which = 0; n > 1 && which < 6; ++which) {
            Balance whole{n, which, std::vector<ex>(letters_.size(), 0), 0};
            for (const auto& balances : all) {
                for (std::size_t j = 0; j < letters_.size(); ++j) whole.factors[j] += balances[which].factors[j];
                whole.constant += balances[which].constant;
            }
            add(std::move(whole));
        }
        for (std::size_t body = 0; body < n; ++body)
            for (std::size_t which = 0; which < bodies_[body].balances(); ++which) add(std::move(all[body][which]));
    }

    Balance balance_of(std::size_t body, std::size_t which) const {
        Balance balance{body, which, std::vector<ex>(letters_.size(), 0), 0};
        for (const LoadShare& share : shares_) {
            if (share.body != body) continue;
            ex rest = (which < 3 ? share.force[which] : share.moment[which - 3]);
            for (std::size_t j = 0; j < letters_.size(); ++j) {
                const ex factor = partial(rest, letters_[j]) * scales_[j];
                check_linear(share, which, j, factor);
                balance.factors[j] += factor;
                rest = rest.subs(letters_[j] == 0, GiNaC::subs_options::no_pattern);
            }
            balance.constant += rest;
        }
        return balance;
    }

    void add(Balance balance) {
        clean(balance);
        if (balance.unknowns() == 0 && seems_zero_(balance.constant)) return;  // says nothing, as three of them in a plane
        balances_.push_back(std::move(balance));
    }

    /// Joints that bars let move are refused even where the forces do not move them.
    void check_joints() const {
        std::vector<JointBalance> rows;
        for (std::size_t which = 0; which < 3; ++which) {
            const bool counts = std::any_of(balances_.begin(), balances_.end(), [&](const Balance& b) {
                return b.which == which && b.body < bodies_.size() && bodies_[b.body].is_joint;
            });
            for (std::size_t body = 0; counts && body < bodies_.size(); ++body) {
                if (!bodies_[body].is_joint) continue;
                const auto found = std::find_if(balances_.begin(), balances_.end(),
                                                [&](const Balance& b) { return b.which == which && b.body == body; });
                rows.push_back(
                    {bodies_[body].name, which, found == balances_.end() ? std::vector<ex>(letters_.size(), 0) : found->factors});
            }
        }
        const LooseJoints loose = loose_joints(system_, rows);
        if (loose.names.empty()) return;
        const auto point =
            std::find_if(load_.points.begin(), load_.points.end(), [&](const LoadPoint& p) { return p.name == loose.names[0]; });
        const bool is_one = loose.names.size() == 1;
        throw Failure(Diagnostic{
            Id::no_equilibrium,
            point->span,
            fmt::format("load '{}' is a mechanism: nothing keeps joint{} {} from moving{}; a bar or an unknown force at a support is "
                        "missing",
                        load_.name, is_one ? "" : "s", quoted_list(loose.names),
                        !is_one ? " together" : loose.axis ? fmt::format(" along {}", "xyz"[*loose.axis]) : ""),
            {{load_.span, "the load is defined here"}}});
    }

    /// "force along x of joint 'A'"
    std::string words(std::size_t body, std::size_t which) const {
        if (bodies_.size() == 1) return balance_names[which];
        if (body == bodies_.size()) return fmt::format("{} of all bodies together", balance_names[which]);
        return fmt::format("{} of {} '{}'", balance_names[which], bodies_[body].is_joint ? "joint" : "body", bodies_[body].name);
    }

    void check_linear(const LoadShare& share, std::size_t which, std::size_t unknown, const ex& factor) const {
        const ex written = factor.expand();
        for (std::size_t other = 0; other < letters_.size(); ++other)
            if (written.has(letters_[other]))
                throw Failure(Diagnostic{
                    Id::not_affine,
                    share.part->span,
                    other == unknown
                        ? fmt::format("the balance of {} of load '{}' is not linear in '{}'", words(share.body, which), load_.name,
                                      load_.unknowns[unknown].name)
                        : fmt::format("the balance of {} of load '{}' is not linear in its unknowns: '{}' is multiplied by '{}'",
                                      words(share.body, which), load_.name, load_.unknowns[unknown].name, load_.unknowns[other].name),
                    {{load_.unknowns[unknown].span, fmt::format("'{}' is unknown", load_.unknowns[unknown].name)}}});
    }

    /// What is zero everywhere is a zero.
    void clean(Balance& balance) const {
        for (ex& factor : balance.factors)
            if (seems_zero_(factor)) factor = 0;
    }

    /// One that is not used yet, with as few unknowns as possible and the simplest factor.
    Balance* next_balance() {
        Balance* best = nullptr;
        std::pair<std::size_t, std::size_t> best_cost;
        std::size_t pivot = 0;
        for (Balance& balance : balances_) {
            if (balance.pivot) continue;
            for (std::size_t j = 0; j < letters_.size(); ++j) {
                if (balance.factors[j].is_zero()) continue;
                const std::pair cost(balance.unknowns(), weight(balance.factors[j]));
                if (best != nullptr && cost >= best_cost) continue;
                best = &balance;
                best_cost = cost;
                pivot = j;
            }
        }
        if (best != nullptr) best->pivot = pivot;
        return best;
    }

    /// By what has one term, in each term.
    static ex divided(const ex& above, const ex& below) {
        if (term_count(below.expand()) == 1) return shortest(above / below.expand());
        return quotient(shortest(above), shortest(below));
    }

    /// Puts what the balance gives for its pivot into all others: by division where its factor is a number, or has one term and stands
    /// alone; else the other balances are multiplied by the factor, so that no sums come into denominators.
    void substitute(const Balance& solved) {
        const std::size_t pivot = *solved.pivot;
        const ex& factor = solved.factors[pivot];
        const bool divides = GiNaC::is_a<GiNaC::numeric>(factor) || (solved.unknowns() == 1 && term_count(factor.expand()) == 1);
        for (Balance& other : balances_) {
            if (&other == &solved || other.factors[pivot].is_zero()) continue;
            const ex scale = divides ? ex(1) : factor;
            const ex share = divides ? divided(other.factors[pivot], factor) : other.factors[pivot];
            const auto reduced = [&](const ex& a, const ex& b) { return b.is_zero() && divides ? a : shortest(scale * a - share * b); };
            for (std::size_t j = 0; j < letters_.size(); ++j)
                other.factors[j] = j == pivot ? ex(0) : reduced(other.factors[j], solved.factors[j]);
            other.constant = reduced(other.constant, solved.constant);
            clean(other);
        }
    }

    void check_left_over() const {
        for (const Balance& balance : balances_)
            if (!balance.pivot && !seems_zero_(balance.constant))
                throw Failure(Diagnostic{
                    Id::no_equilibrium, load_.span,
                    fmt::format("load '{}' is a mechanism, and these forces set it in motion: no unknown can satisfy the balance of {}",
                                load_.name, words(balance.body, balance.which))});
    }

    void check_determined() const {
        std::vector<bool> is_known(letters_.size(), false);
        for (const Balance& balance : balances_)
            if (balance.pivot) is_known[*balance.pivot] = balance.unknowns() == 1;
        std::vector<std::string> open;
        for (std::size_t j = 0; j < letters_.size(); ++j)
            if (!is_known[j]) open.push_back(load_.unknowns[j].name);
        if (open.empty()) return;
        const auto independent = static_cast<std::size_t>(
            std::count_if(balances_.begin(), balances_.end(), [](const Balance& b) { return b.pivot.has_value(); }));
        const auto first = std::find(is_known.begin(), is_known.end(), false);
        throw Failure(
            Diagnostic{Id::undetermined,
                       load_.unknowns[static_cast<std::size_t>(first - is_known.begin())].span,
                       fmt::format("load '{}' is statically indeterminate: {} independent balance{} for {} unknowns do not determine {}{}",
                                   load_.name, independent, independent == 1 ? "" : "s", letters_.size(), quoted_list(open),
                                   load_.bars.empty() ? "" : "; leave out a bar or a support, or make a machine of springs of it"),
                       {{load_.span, "the load is defined here"}}});
    }

    /// What is determined may still move a little at these very values, as two bars in one line do.
    void check_values(const LoadSolution& solution) const {
        const GiNaC::exmap values = Values(system_.scene, system_.translate).substitution();
        for (std::size_t j = 0; j < letters_.size(); ++j) try {
                solution.unknowns[j].subs(values, GiNaC::subs_options::no_pattern);
            } catch (const GiNaC::pole_error&) {
                throw Failure(Diagnostic{Id::no_equilibrium, load_.span,
                                         fmt::format("load '{}' has no equilibrium with the values of the model file: the solution for "
                                                     "'{}' divides by zero, as where bars in one line let a joint move; other values "
                                                     "would do",
                                                     load_.name, load_.unknowns[j].name)});
            }
    }

    const System& system_;
    const Load& load_;
    std::vector<LoadBody> bodies_;
    mutable ZeroAtPoints seems_zero_;
    std::vector<ex> letters_;
    std::vector<ex> scales_;  ///< what is solved for is the unknown divided by it: of a bar by its length, which has a root
    Letters named_;
    std::vector<LoadShare> shares_;
    std::vector<Balance> balances_;
};

SpaceVector total(const std::vector<LoadShare>& shares, SpaceVector LoadShare::*which) {
    SpaceVector sum{0, 0, 0};
    for (const LoadShare& share : shares) sum = sum + share.*which;
    return sum;
}

}  // namespace

SpaceVector LoadSolution::force() const { return total(shares, &LoadShare::force); }
SpaceVector LoadSolution::moment() const { return total(shares, &LoadShare::moment); }

LoadSolution solve_load(const System& system, const Load& load) {
    if (load.unknowns.empty()) return {&load, load_shares(load, system.translate, {}), {}};
    return LoadElimination(system, load).solve();
}

const LoadSolution& System::load(const std::string& name, const Span& span) const {
    if (const auto known = loads_.find(name); known != loads_.end()) return known->second;
    const Load* item = names.find_element<Load>(name);
    if (!scene.holds(item->when))
        throw Failure(Diagnostic{
            Id::needs_absent, span, fmt::format("scene '{}' has no load '{}'", scene.name, name), {{item->span, "it is defined here"}}});
    return loads_.emplace(name, solve_load(*this, *item)).first->second;
}

}  // namespace dalembert
