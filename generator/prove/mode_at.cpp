// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/mode_at.hpp"

#include <fmt/format.h>

#include "form/system.hpp"
#include "language/rational.hpp"

namespace dalembert {

namespace {

/// The rate of a guard at zero; nothing where it needs rates of accelerations, which are not solved for.
std::optional<cln::cl_R> rate_at(const EventEquation& event, const MotionAt& at) {
    try {
        return at(event.rate);
    } catch (const Failure&) {
        return std::nullopt;
    }
}

}  // namespace

std::optional<std::string> why_mode_refuses(const System& system, const MotionAt& at, int digits) {
    const cln::cl_R small = cln::expt(cln::cl_I(10), cln::cl_I(-digits));
    const auto shown = [](const cln::cl_R& value) { return decimal(cln::rational(value), 6); };
    for (const ConstraintEquation& constraint : system.constraints) {
        if (!constraint.holds) continue;
        if (constraint.position)
            if (const cln::cl_R place = at(*constraint.position); cln::abs(place) > small)
                return fmt::format("'{}' is at {} and not at 0", constraint.name, shown(place));
        const cln::cl_R rate = at(constraint.whole_rate);
        if (cln::abs(rate) > small) return fmt::format("the rate of '{}' is {} and not 0", constraint.name, shown(rate));
    }
    for (const BranchState& branch : system.circuit.branches)
        if (branch.is_cut_off)
            if (const cln::cl_R current = at(branch.level); cln::abs(current) > small)
                return fmt::format("the current of '{}' is {} A and has no path", branch.name, shown(current));
    for (const EventEquation& event : system.events) {
        if (!event.is_watched) continue;
        const cln::cl_R guard = at(event.guard);
        if (guard > small) continue;
        if (guard < -small) return fmt::format("the guard of event '{}' is {}", event.name, shown(guard));
        const auto rate = rate_at(event, at);
        if (rate && *rate < -small) return fmt::format("the guard of event '{}' is 0 and falls", event.name);
    }
    return std::nullopt;
}

}  // namespace dalembert
