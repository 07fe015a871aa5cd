// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/effect_size.hpp"

#include <fmt/format.h>

#include "elements/runs.hpp"
#include "prove/motion_at.hpp"
#include "scene/fix_parameters.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

constexpr int few_digits = 40;

/// Rates of states and accelerations by name, at the start. What shrinks when more digits are used is nothing but rounding: the rate of
/// what starts at rest is zero.
std::map<std::string, cln::cl_R> rates(const System& system) {
    const Values values(system.scene, system.translate);
    const MotionAt coarse(system, values, few_digits);
    const MotionAt fine(system, values, 2 * few_digits);
    std::map<std::string, cln::cl_R> result;
    for (const SymbolKind kind : {SymbolKind::acceleration, SymbolKind::state_rate})
        for (const Variable& variable : system.symbols.all(kind)) {
            const cln::cl_R value = fine(variable.symbol);
            const cln::cl_R before = cln::abs(coarse(variable.symbol));
            const bool is_rounding = cln::zerop(before) || cln::abs(value) <= cln::expt(cln::cl_RA(10), -few_digits / 4) * before;
            result.emplace(variable.name, is_rounding ? cln::cl_R(0) : value);
        }
    return result;
}

std::string difference(const System& without, const System& with) {
    std::string text;
    const auto before = without.scene.state_count(), after = with.scene.state_count();
    if (before != after)
        text = fmt::format("{} {} state{}", after > before ? "adds" : "removes", after > before ? after - before : before - after,
                           after + 1 == before || before + 1 == after ? "" : "s");
    std::string name;
    cln::cl_R largest = 0;
    const cln::cl_RA rounding = cln::expt(cln::cl_RA(10), 10 - few_digits);
    const auto with_it = rates(with);
    for (const auto& [rate, value] : rates(without)) {
        const auto other = with_it.find(rate);
        if (other == with_it.end()) continue;
        const cln::cl_R scale = cln::max(cln::abs(value), cln::cl_R(cln::abs(other->second)));
        if (cln::zerop(scale)) continue;
        const cln::cl_R share = cln::abs(other->second - value) / scale;
        if (share <= largest + rounding) continue;  // of equal ones the first by name, whatever the rounding
        largest = share;
        name = rate;
    }
    const double percent = 100 * cln::double_approx(largest);
    if (!name.empty())
        return fmt::format("{}{}changes {} by {} %", text, text.empty() ? "" : ", ", name,
                           percent < 10 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent));
    return text.empty() ? "changes nothing" : text;
}

}  // namespace

std::vector<EffectSize> sizes_of_effects_out(const System& system, const std::map<std::string, int>& sizes) {
    std::vector<EffectSize> result;
    const Scene& scene = system.scene;
    for (const Effect* effect : scene.effects_out) {
        std::string text;
        try {
            Scene chosen = select_scene(*scene.model, system.names, scene.wish + "+" + effect->name, sizes);
            fix_as_in(chosen, system.names, scene);
            if (!chosen.modes.empty()) chosen = in_mode(chosen, 0);
            const auto with = derive(system.names, std::move(chosen));
            text = difference(system, *with);
        } catch (const Failure& failure) {
            const bool is_contradiction = !failure.diagnostics().empty() && failure.diagnostics().front().id == Id::scene_contradiction;
            text = is_contradiction ? "contradicts effects that are in" : "has no value";
        }
        result.push_back({effect, std::move(text)});
    }
    return result;
}

}  // namespace dalembert
