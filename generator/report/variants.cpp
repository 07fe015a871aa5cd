// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "report/precision_table.hpp"

namespace dalembert {

namespace {

using Sizes = std::map<std::string, int>;

std::string size_text(const Scene& scene) {
    std::string text;
    for (const auto& [name, value] : scene.sizes) text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
    return text;
}

/// Every combination of the sizes that were given. Where there are several models, a size is meant for those that have it.
std::vector<Sizes> combinations(const Model& model, const Options& options) {
    std::vector<Sizes> result{{}};
    for (const auto& [wanted, values] : options.size_lists) {
        const std::string& name = wanted;
        const bool has_it = std::any_of(model.sizes.begin(), model.sizes.end(), [&](const Size& size) { return size.name == name; });
        if (!has_it && options.models.size() > 1) continue;
        std::vector<Sizes> longer;
        for (const Sizes& sizes : result)
            for (const int value : values) {
                longer.push_back(sizes);
                longer.back()[name] = value;
            }
        result = std::move(longer);
    }
    return result;
}

Variant make_variant(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Sizes& sizes, const Options& all,
                     Streams streams, const std::function<void(const PreparedRun&)>& check) {
    Options options = all;
    options.choice.sizes = sizes;
    options.compares_scenes = true;
    WorkPrecision::Limits limits;
    limits.run = options.limit;
    limits.reference = 12 * options.limit;
    Variant variant;
    std::vector<std::string> measured;
    for (const char* arithmetic : arithmetics)
        if (is_wanted(options.arithmetics, arithmetic)) measured.emplace_back(arithmetic);
    PreparedRun run = prepare_run(model, scene, options, "cost", is_wanted(options.methods, "taylor"));
    check(run);
    variant.work = std::make_unique<WorkPrecision>(std::move(run), limits, measured);
    const System& system = *variant.work->run().machine.system;
    variant.scene = system.scene.name;
    variant.size = size_text(system.scene);
    variant.effects = system.scene.effects_in.size();
    variant.states = system.scene.state_count();
    streams.err << fmt::format("  {}: compiled\n", variant.name());
    variant.work->find_reference();
    const ReferenceRun& reference = variant.work->reference();
    streams.err << fmt::format("  {}: reference by {}, its own error {}\n", variant.name(), name_of(reference.plan), error_text(reference));
    return variant;
}

/// Columns of the same name, at the output points of both, relative to the magnitudes of the fullest.
double distance(const WorkPrecision& work, const WorkPrecision& fullest) {
    const ReferenceRun& full = fullest.reference();
    const ReferenceRun& other = work.reference();
    const std::vector<std::string> names = compared_columns(*fullest.run().machine.system),
                                   own = compared_columns(*work.run().machine.system);
    double largest = 0;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const auto found = std::find(own.begin(), own.end(), names[c]);
        if (found == own.end() || !(full.scales[c] > 0)) continue;
        const auto column = static_cast<std::size_t>(found - own.begin()) + 1;
        for (std::size_t i = 0; i < std::min(full.counted, other.counted); ++i)
            largest = std::max(largest, static_cast<double>(std::fabs(other.rows[i][column] - full.rows[i][c + 1])) / full.scales[c]);
    }
    return largest;
}

}  // namespace

std::vector<Variant> make_variants(const std::shared_ptr<const LoadedModel>& model, const std::vector<std::string>& scenes,
                                   bool may_leave_out, const Options& options, Streams streams,
                                   const std::function<void(const PreparedRun&)>& check) {
    std::vector<Variant> variants;
    for (const std::string& scene : scenes) {
        const bool is_last = &scene == &scenes.back() && variants.empty() && options.models.size() == 1;
        const auto leave_out = [&](const std::string& why) {
            streams.err << fmt::format("  {}, scene '{}' is left out: {}\n", model->model.name, scene, why);
        };
        try {
            for (const Sizes& sizes : combinations(model->model, options))
                variants.push_back(make_variant(model, scene, sizes, options, streams, check));
        } catch (const Failure& failure) {
            if (!may_leave_out || is_last || failure.exit_code() == ExitCode::tool_missing) throw;
            leave_out(failure.diagnostics().empty() ? failure.what() : failure.diagnostics().front().message);
        } catch (const RunStopped& stopped) {
            if (!may_leave_out || is_last) throw;
            leave_out(stopped.what());
        }
    }
    const auto fullest = std::max_element(variants.begin(), variants.end(), [](const Variant& a, const Variant& b) {
        return std::pair(a.effects, a.states) < std::pair(b.effects, b.states);
    });
    for (Variant& v : variants) v.from_fullest = distance(*v.work, *fullest->work);
    return variants;
}

}  // namespace dalembert
