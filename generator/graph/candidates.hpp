// SPDX-License-Identifier: GPL-3.0-or-later
// What could be computed once, by what that saves: of millions of places the queue of those that pay.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace dalembert {

/// Something that occurs at several places and could be computed once.
template <class Place>
struct Candidate {
    std::uint64_t fingerprint;
    std::vector<Place> places;
    int queued = 0;                            ///< what the queue says that it saves, 0 where it is not in it
    int guessed = 0;                           ///< where more, to be queued so, 0 where not
    std::optional<std::uint32_t> letter = {};  ///< once it is computed
};

/// Where each fingerprint was seen first, and its candidate once it was seen again. Open addressing: there are millions.
template <class Place>
class FirstPlaces {
public:
    static constexpr std::uint32_t nobody = UINT32_MAX;
    struct Seen {
        std::uint64_t fingerprint;
        std::uint32_t id;
        bool is_used;
        Place first;
    };

    /// And whether it is new here.
    std::pair<Seen*, bool> emplace(std::uint64_t fingerprint, const Place& place) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Seen& seen = slot(fingerprint);
        if (seen.is_used) return {&seen, false};
        seen = {fingerprint, nobody, true, place};
        ++count_;
        return {&seen, true};
    }

private:
    Seen& slot(std::uint64_t fingerprint) {
        std::size_t i = fingerprint * 0x9E3779B97F4A7C15ULL >> shift_;
        while (slots_[i].is_used && slots_[i].fingerprint != fingerprint) i = (i + 1) & (slots_.size() - 1);
        return slots_[i];
    }

    void grow() {
        std::vector<Seen> old(std::size_t(1) << (64 - --shift_), Seen{});
        old.swap(slots_);
        for (const Seen& seen : old)
            if (seen.is_used) slot(seen.fingerprint) = seen;
    }

    unsigned shift_ = 55;
    std::vector<Seen> slots_;
    std::size_t count_ = 0;
};

/// Candidates by what they save. Among equals the one found first comes first, so the choice is the same on every run. They are
/// told apart by a 64-bit fingerprint; whoever uses a place compares what really stands there.
template <class Place>
class Candidates {
public:
    using Entry = Candidate<Place>;

    /// Notes a place. `guess` says, not too low, what the candidate saves when it has so many places.
    template <class Guess>
    void note(std::uint64_t fingerprint, const Place& place, const Guess& guess) {
        const auto [seen, is_new] = seen_.emplace(fingerprint, place);
        if (is_new) return;
        if (seen->id == FirstPlaces<Place>::nobody) {
            seen->id = static_cast<std::uint32_t>(entries_.size());
            entries_.push_back({fingerprint, {seen->first}});
        }
        Entry& entry = entries_[seen->id];
        entry.places.push_back(place);
        const int saved = guess(entry);
        if (saved <= std::max(entry.queued, entry.guessed)) return;
        if (entry.guessed == 0) grown_.push_back(seen->id);
        entry.guessed = saved;
    }

    /// The candidate that saves most by the exact count, which replaces guesses as they come to the front.
    template <class Count>
    std::optional<std::size_t> best(const Count& count) {
        for (const std::uint32_t id : grown_) requeue(id, std::exchange(entries_[id].guessed, 0));
        grown_.clear();
        while (!queue_.empty()) {
            const auto [queued, id] = queue_.top();
            const bool is_current = queued == entries_[id].queued;  // else it has another place in the queue by now, or none
            const int saved = is_current ? count(entries_[id]) : 0;
            if (is_current && saved == queued) return id;
            queue_.pop();
            if (is_current) requeue(id, saved);
        }
        return std::nullopt;
    }

    Entry& operator[](std::size_t id) { return entries_[id]; }
    void take_out(std::size_t id) { requeue(id, 0); }

private:
    struct Queued {
        int saved;
        std::uint32_t id;
        friend bool operator<(const Queued& a, const Queued& b) { return a.saved != b.saved ? a.saved < b.saved : a.id > b.id; }
    };

    void requeue(std::size_t id, int saved) {
        int& queued = entries_[id].queued;
        queued = std::max(saved, 0);
        if (queued > 0) queue_.push({queued, static_cast<std::uint32_t>(id)});
    }

    FirstPlaces<Place> seen_;
    std::vector<std::uint32_t> grown_;  ///< since the best was asked for
    std::deque<Entry> entries_;         ///< a deque, because entries are referred to while others are added
    std::priority_queue<Queued> queue_;
};

}  // namespace dalembert
