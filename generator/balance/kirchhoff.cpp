// SPDX-License-Identifier: GPL-3.0-or-later
// Branches with known voltages join pins to groups, in which potentials differ by what is known. The group of ground is known altogether.
// Of each other group one potential is sought: resistors lead to other groups and pins, known currents come in. Those potentials are
// eliminated one by one, by which their neighbours get resistors between each other; the group with the fewest neighbours goes first. Sums
// of conductances have positive terms only, so nothing is divided by that could vanish. Then the currents of resistors are known, and those
// of the branches with known voltages, which form trees, follow from their leaves.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "balance/interruptions.hpp"
#include "balance/transformers.hpp"
#include "text/diagnostic.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

using BranchLaw = Branch::Law;
using Known = BranchState::Known;

/// Of groups with three neighbours or more, how many are written out at most: closed forms of more contain each other.
constexpr std::size_t most_meshed = 4;

/// A potential minus that of a neighbour, as a fraction whose terms are not over each other.
struct PotentialDifference {
    ex numerator, denominator;
};

class Kirchhoff {
public:
    explicit Kirchhoff(Circuit& circuit) : circuit_(circuit) {}

    void run() {
        give_letters();
        group();
        join_groups();
        gather();
        while (const auto next = fewest_neighbours()) eliminate(*next);
        find_potentials();
        find_currents();
    }

private:
    /// Letters for what is known keep sums short until the end.
    void give_letters() {
        for (const BranchState& b : circuit_.branches) {
            letters_.push_back(GiNaC::symbol(b.name));
            known_[letters_.back()] = b.known == Known::ratio ? b.value : b.known == Known::voltage ? b.fall : b.current;
            forward_.emplace_back(0);
            if (b.known != Known::ratio || b.forward_voltage.is_zero()) continue;
            forward_.back() = GiNaC::symbol("u_" + b.name);
            known_[forward_.back()] = b.forward_voltage;
        }
    }

    const BranchState& branch(std::size_t b) const { return circuit_.branches[b]; }

    /// The way from one pin to another over branches with known voltages, added to that which led here.
    bool find_way(std::size_t from, std::size_t to, std::vector<std::size_t>& way) const {
        if (from == to) return true;
        for (const std::size_t b : tree_) {
            if (std::find(way.begin(), way.end(), b) != way.end() || (branch(b).from != from && branch(b).to != from)) continue;
            way.push_back(b);
            if (find_way(branch(b).from == from ? branch(b).to : branch(b).from, to, way)) return true;
            way.pop_back();
        }
        return false;
    }

    /// Trees of branches with known voltages. Throws Failure (doubly-determined) where one closes a loop.
    void group() {
        for (std::size_t b = 0; b < circuit_.branches.size(); ++b) {
            if (branch(b).known != Known::voltage) continue;
            std::vector<std::size_t> way;
            if (find_way(branch(b).from, branch(b).to, way)) refuse_loop(b, way);
            tree_.push_back(b);
        }
        group_.assign(circuit_.pins.size(), none);
        offset_.assign(circuit_.pins.size(), 0);
        for (std::size_t pin = 0; pin < circuit_.pins.size(); ++pin) {
            if (group_[pin] != none) continue;
            group_[pin] = pin;
            std::vector<std::size_t> waiting{pin};
            while (!waiting.empty()) {
                const std::size_t at = waiting.back();
                waiting.pop_back();
                for (const std::size_t b : tree_) {
                    const bool begins = branch(b).from == at;
                    if (!begins && branch(b).to != at) continue;
                    const std::size_t other = begins ? branch(b).to : branch(b).from;
                    if (group_[other] != none) continue;
                    group_[other] = pin;
                    offset_[other] = begins ? offset_[at] - letters_[b] : offset_[at] + letters_[b];
                    waiting.push_back(other);
                }
            }
        }
    }

    [[noreturn]] void refuse_loop(std::size_t closing, std::vector<std::size_t> way) const {
        way.push_back(closing);
        std::sort(way.begin(), way.end());
        std::vector<std::string> names;
        for (const std::size_t b : way) names.push_back(branch(b).name);
        std::vector<std::string> kinds;
        for (const auto& [law, words] :
             {std::pair(BranchLaw::capacitor, "capacitors"), std::pair(BranchLaw::voltage_source, "ideal voltage sources"),
              std::pair(BranchLaw::motor, "motors"), std::pair(BranchLaw::transformer, "transformers"),
              std::pair(BranchLaw::diode, "diodes that conduct"),
              std::pair(BranchLaw::switching, "closed switches")})
            if (std::any_of(way.begin(), way.end(), [&, law = law](std::size_t b) { return branch(b).item->law == law; }))
                kinds.emplace_back(words);
        std::string of;
        for (std::size_t i = 0; i < kinds.size(); ++i) of += (i == 0 ? "" : i + 1 == kinds.size() ? " and " : ", ") + kinds[i];
        const auto with_modes = std::find_if(way.begin(), way.end(), [&](std::size_t b) { return branch(b).item->has_modes(); });
        const std::string remedy = with_modes == way.end() ? "put a resistor in series with one of them"
                                                           : fmt::format("give '{}' a resistance", branch(*with_modes).name);
        const Span& place = branch(closing).item->span;
        std::vector<Note> in_other_files;
        for (const std::size_t b : way)
            if (const Span& other = branch(b).item->span; other.source != place.source)
                in_other_files.push_back({other, fmt::format("'{}' is defined here", branch(b).name)});
        throw Failure(Diagnostic{Id::doubly_determined, place,
                                 fmt::format("branch '{}' closes a loop of {}, {}, in which each voltage follows from the others; {}",
                                             branch(closing).name, of, quoted_list(names), remedy),
                                 std::move(in_other_files)});
    }

    /// Throws Failure (undetermined) where resistors do not join all groups to ground.
    void join_groups() const {
        const std::vector<std::size_t> part = parts_of(circuit_, [](const BranchState& b) { return b.known == Known::current; });
        const auto away = std::find_if(part.begin(), part.end(), [](std::size_t p) { return p != 0; });
        if (away == part.end()) return;
        std::vector<std::string> pins, currents;
        std::vector<const BranchState*> around;
        std::vector<Note> open;
        for (std::size_t pin = 0; pin < part.size(); ++pin) {
            if (part[pin] != *away) continue;
            pins.push_back(circuit_.pins[pin].name);
            if (const Pin* item = circuit_.pins[pin].item; item != nullptr && item->open_port)
                open.push_back({item->open_port, fmt::format("nothing is joined to this port, which stands at pin '{}'", item->name)});
        }
        for (const BranchState& b : circuit_.branches)
            if ((part[b.from] == *away) != (part[b.to] == *away)) {
                if (b.is_interrupted()) around.push_back(&b);
                else currents.push_back(b.name);
            }
        const std::string those = fmt::format("pin{} {}", pins.size() == 1 ? "" : "s", quoted_list(pins));
        const Span& place = circuit_.pins[*away].place;
        const std::string where = around.empty() ? "" : fmt::format("where {}, ", interruption(around));
        const std::string fact =
            currents.empty() ? fmt::format("no branch joins {} to pin '{}', so {} not determined", those, ground_pin,
                                           pins.size() == 1 ? "its potential is" : "their potentials are")
                             : fmt::format("nothing but {}, inductors or current sources, joins {} to the rest of the circuit, so each of "
                                           "their currents follows from the others",
                                           quoted_list(currents), those);
        const std::string remedy = !around.empty()    ? fmt::format("give '{}' a conductance", around.front()->name)
                                   : currents.empty() ? fmt::format("join one of them to '{}'", ground_pin)
                                                      : "put a resistor across one of them";
        throw Failure(Diagnostic{Id::undetermined, place, fmt::format("{}{}; {}", where, fact, remedy), std::move(open)});
    }

    /// Pins whose potentials are known are neighbours of their own; of other groups, the first pin.
    std::size_t place_of(std::size_t pin) const { return group_[pin] == 0 ? pin : group_[pin]; }
    ex rest_of(std::size_t pin) const { return group_[pin] == 0 ? ex(0) : offset_[pin]; }
    /// What the voltage of a resistance has beside the difference of the sought potentials.
    ex rest_between(std::size_t b) const { return rest_of(branch(b).from) - rest_of(branch(b).to) - forward_[b]; }

    void gather() {
        conductances_.resize(circuit_.pins.size());
        sources_.assign(circuit_.pins.size(), 0);
        differences_.resize(circuit_.pins.size());
        for (std::size_t pin = 0; pin < circuit_.pins.size(); ++pin)
            potentials_.push_back(group_[pin] == 0 ? offset_[pin] : ex(GiNaC::symbol(circuit_.pins[pin].name)));
        for (std::size_t b = 0; b < circuit_.branches.size(); ++b) {
            if (branch(b).known == Known::voltage) continue;
            const std::size_t from = place_of(branch(b).from), to = place_of(branch(b).to);
            if (from == to) continue;
            ex flow = letters_[b];
            if (branch(b).known == Known::ratio) {
                conductances_[from][to] += 1 / letters_[b];
                conductances_[to][from] += 1 / letters_[b];
                flow = rest_between(b) / letters_[b];
            }
            sources_[from] -= flow;
            sources_[to] += flow;
        }
    }

    std::optional<std::size_t> fewest_neighbours() const {
        std::optional<std::size_t> best;
        for (std::size_t pin = 0; pin < circuit_.pins.size(); ++pin) {
            if (group_[pin] != pin || pin == 0 || std::find(order_.begin(), order_.end(), pin) != order_.end()) continue;
            if (!best || conductances_[pin].size() < conductances_[*best].size()) best = pin;
        }
        return best;
    }

    void eliminate(std::size_t k) {
        order_.push_back(k);
        const std::map<std::size_t, ex> own = conductances_[k];
        const ex source = sources_[k].expand();
        if (own.size() > 2 && ++meshed_ > most_meshed)
            throw Failure(Diagnostic{Id::too_large, circuit_.pins[k].place,
                                     fmt::format("pin '{}' is one of more than {} pins that only resistors join to three others or more; "
                                                 "this version writes out no more. Put a capacitor between one of them and '{}'",
                                                 circuit_.pins[k].name, most_meshed, ground_pin)});
        // The weights of neighbours: conductances, or of two the resistance of the other one, and of one 1.
        std::map<std::size_t, ex> weights = own;
        ex scale = 1;  // what the source is multiplied with
        if (own.size() <= 2) {
            for (const auto& [j, conductance] : own) {
                scale /= conductance;
                weights[j] = 1;
                for (const auto& [m, other] : own)
                    if (m != j) weights[j] /= other;
            }
        }
        ex all = 0;
        for (const auto& [j, weight] : weights) all += weight;
        const ex driven = (source * scale).expand();
        ex sum = driven;
        for (const auto& [j, weight] : weights) {
            sum += weight * potentials_[j];
            ex numerator = driven;
            for (const auto& [m, other] : weights)
                if (m != j) numerator += other * (potentials_[m] - potentials_[j]);
            differences_[k][j] = {numerator, all};
            sources_[j] += (source * weight).expand() / all;
            conductances_[j].erase(k);
        }
        for (auto i = weights.begin(); i != weights.end(); ++i)
            for (auto j = std::next(i); j != weights.end(); ++j) {
                const ex between = own.size() == 2 ? 1 / all : i->second * j->second / all;
                conductances_[i->first][j->first] += between;
                conductances_[j->first][i->first] += between;
            }
        values_[k] = sum.expand() / all;
    }

    /// In reverse order: the value of the last potential that was eliminated contains known quantities only.
    void find_potentials() {
        for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
            const ex value = values_[*k].subs(found_, GiNaC::subs_options::no_pattern);
            found_[potentials_[*k]] = value;
        }
        for (std::size_t pin = 0; pin < circuit_.pins.size(); ++pin)
            circuit_.pins[pin].potential = finished(potentials_[place_of(pin)] + rest_of(pin));
    }

    ex finished(const ex& e) const { return e.subs(found_, GiNaC::subs_options::no_pattern).subs(known_, GiNaC::subs_options::no_pattern); }

    ex through_resistor(std::size_t b) const {
        const std::size_t from = place_of(branch(b).from), to = place_of(branch(b).to);
        const ex rest = rest_between(b);
        const auto over = [&](const PotentialDifference& d, int sign) {
            return ((sign * d.numerator + rest * d.denominator) / letters_[b]).expand() / d.denominator;
        };
        if (from == to) return rest / letters_[b];
        if (const auto found = differences_[from].find(to); found != differences_[from].end()) return over(found->second, 1);
        if (const auto found = differences_[to].find(from); found != differences_[to].end()) return over(found->second, -1);
        return (potentials_[from] - potentials_[to] - forward_[b]) / letters_[b];
    }

    void find_currents() {
        std::vector<std::size_t> open = tree_;
        for (std::size_t b = 0; b < circuit_.branches.size(); ++b) {
            BranchState& found = circuit_.branches[b];
            if (found.known == Known::ratio) found.current = finished(through_resistor(b));
            if (found.known != Known::voltage) found.fall = circuit_.pins[found.from].potential - circuit_.pins[found.to].potential;
        }
        while (!open.empty()) {
            const auto is_leaf = [&](std::size_t pin) {
                return pin != 0 && std::count_if(open.begin(), open.end(), [&](std::size_t b) {
                           return branch(b).from == pin || branch(b).to == pin;
                       }) == 1;
            };
            for (auto b = open.begin(); b != open.end(); ++b) {
                const bool at_from = is_leaf(branch(*b).from);
                if (!at_from && !is_leaf(branch(*b).to)) continue;
                const ex rest = circuit_.outflow(at_from ? branch(*b).from : branch(*b).to);  // its own is still zero
                circuit_.branches[*b].current = at_from ? -rest : rest;
                open.erase(b);
                break;
            }
        }
    }

    static constexpr auto none = static_cast<std::size_t>(-1);

    Circuit& circuit_;
    std::vector<ex> letters_;                                    ///< of branches
    std::vector<ex> forward_;                                    ///< forward voltages of diodes with a resistance
    GiNaC::exmap known_;
    std::vector<std::size_t> tree_;                              ///< branches with known voltages
    std::vector<std::size_t> group_;                             ///< of pins, by the first pin in it
    std::vector<ex> offset_;                                     ///< of potentials from that of the first pin
    std::vector<std::map<std::size_t, ex>> conductances_;
    std::vector<ex> sources_;                                    ///< A
    std::vector<ex> potentials_;                                 ///< known, or a letter
    std::vector<std::map<std::size_t, PotentialDifference>> differences_;
    std::vector<std::size_t> order_;
    std::map<std::size_t, ex> values_;                           ///< of those letters, by others
    GiNaC::exmap found_;                                         ///< the same, by what is known
    std::size_t meshed_ = 0;
};

void solve_without_transformers(Circuit& circuit) {
    cut_off_inductors(circuit);
    Kirchhoff(circuit).run();
}

}  // namespace

void solve_kirchhoff(Circuit& circuit) {
    if (std::any_of(circuit.branches.begin(), circuit.branches.end(), [](const BranchState& b) { return b.other.has_value(); }))
        return solve_with_transformers(circuit, solve_without_transformers);
    solve_without_transformers(circuit);
}

}  // namespace dalembert
