// SPDX-License-Identifier: GPL-3.0-or-later
// A checker that calls everything proven would prove nothing: slips in proven equations have to be seen. Of every proven entry of every
// catalogue a slip at a random place, with a fixed seed; three with DALEMBERT_FULL. What is proven equal to the original is no slip, as a
// factor of a term that is zero, and another one is taken instead; all of them are listed.
#include <doctest/doctest.h>

#include <iostream>
#include <random>

#include "book/catalogues.hpp"
#include "language/expression_text.hpp"

using namespace dalembert;

namespace {

const int mutations_each = is_full_tier() ? 3 : 1;

struct Count {
    int entries = 0, mutations = 0, caught = 0;
    std::vector<std::string> survivors, equal;
};

bool is_proven(Verdict verdict) { return verdict == Verdict::proven || verdict == Verdict::proven_under_assumption; }

/// What became of a slip; nothing where it makes no expression at all.
std::optional<Verdict> verdict_of(const System& system, const PrintedEquation& entry, int index, std::size_t which, const Slip& slip) {
    try {
        const PrintedEquation mutated = with_equation(entry, which, slip.equation);
        const Member<PrintedEquation> member{&mutated, index};
        return may_hold(system, member) ? check_printed(system, member).verdict() : Verdict::wrong;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

/// False where the system does not have the entry.
bool mutate(const System& system, const PrintedEquation& entry, std::mt19937& random, Count& count) {
    const auto [from, to] = entry.family ? bounds(*entry.family, system.scene) : std::pair(0, 0);
    const Member<PrintedEquation> member{&entry, from};
    if (from > to || !system.scene.holds(entry.when) || !is_proven(check_printed(system, member).verdict())) return false;
    ++count.entries;
    auto slips = slips_in(system, entry);
    for (int made = 0; made < mutations_each && !slips.empty();) {
        const std::size_t at = random() % slips.size();
        const auto [which, slip] = slips[at];
        slips.erase(slips.begin() + static_cast<std::ptrdiff_t>(at));
        const auto verdict = verdict_of(system, entry, from, which, slip);
        if (!verdict || *verdict == Verdict::not_checkable) continue;
        if (is_proven(*verdict)) {
            count.equal.push_back(entry.name + ": " + slip.words);
            continue;
        }
        ++made;
        ++count.mutations;
        if (*verdict == Verdict::wrong || *verdict == Verdict::dimensionally_wrong)
            ++count.caught;
        else
            count.survivors.push_back(entry.name + ": " + slip.words + ": equal by numbers, but not proven to be");
    }
    return true;
}

}  // namespace

TEST_CASE("slips in proven entries are seen") {
    Count count;
    std::mt19937 random(1);
    for_each_entry([&](CatalogueVerdicts& verdicts, const CatalogueEntry& entry) {
        bool is_done = false;  // in the first system that has it
        verdicts.each(entry, [&](const System& system, const PrintedEquation& checked) {
            if (!is_done) is_done = mutate(system, checked, random, count);
        });
    });
    std::cout << count.entries << " entries, " << count.mutations << " mutations, " << count.caught << " caught\n";
    for (const std::string& survivor : count.survivors) std::cout << "  survived: " << survivor << "\n";
    for (const std::string& equal : count.equal) std::cout << "  no slip, because it is equal: " << equal << "\n";
    CHECK(count.entries > 20);
    CHECK(count.mutations * 100 >= count.entries * mutations_each * 95);  // of a few everything is zero
    CHECK(count.caught * 100 >= count.mutations * 99);
}
