// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/scene_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <thread>

#include "elements/model.hpp"
#include "elements/runs.hpp"

namespace dalembert {

namespace {

/// A CSV as `simulate` writes it, by the titles of its columns.
std::map<std::string, std::vector<double>> columns_of(const std::string& csv) {
    const auto cells_of = [](const std::string& line) {
        std::istringstream text(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
        return cells;
    };
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> titles = cells_of(line);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = cells_of(line);
        for (std::size_t i = 0; i < cells.size(); ++i) columns[titles.at(i)].push_back(std::strtod(cells[i].c_str(), nullptr));
    }
    return columns;
}

struct Compared {
    ComparedScene row;
    std::set<std::string> effects;
    std::optional<PreparedSimulation> prepared = {};
    std::map<std::string, std::vector<double>> results = {};
    std::vector<std::string> outputs = {};
};

class SideBySide {
public:
    SideBySide(const std::shared_ptr<const LoadedModel>& model, const Options& options, Streams streams)
        : model_(model), options_(options), streams_(streams) {
        options_.compares_scenes = true;
    }

    SceneComparison run() {
        for (const std::string& name : scene_names(model_->model)) add(name, true);
        const std::size_t fullest = against();
        const std::size_t barest = extreme([](std::size_t a, std::size_t b) { return a < b; });
        single_changes(fullest, barest);
        simulate();
        measure();
        if (!all_[fullest].row.refused.empty())
            throw Failure(Diagnostic{Id::bad_option, model_->model.name_span,
                                     fmt::format("scene '{}', the base of the comparison, cannot be run: {}", all_[fullest].row.wish,
                                                 all_[fullest].row.refused)});
        SceneComparison result{fullest, {}};
        for (Compared& compared : all_) {
            deviations(compared, all_[fullest]);
            result.scenes.push_back(compared.row);
        }
        return result;
    }

private:
    /// Derives and generates; a scene that is refused says why.
    void add(const std::string& wish, bool is_named) {
        Compared compared{{}, {}};
        compared.row.wish = wish;
        compared.row.is_named = is_named;
        if (const Compared* same = is_named ? nullptr : with_effects(wish)) {
            compared.row.same_as = same->row.wish;
            all_.push_back(std::move(compared));
            return;
        }
        try {
            compared.prepared = prepare_simulation(model_, wish, options_);
            const System& system = *compared.prepared->machine.system;
            for (const Effect* effect : system.scene.effects_in) compared.effects.insert(effect->name);
            for (const OutputEquation& output : system.outputs) compared.outputs.push_back(output.name);
            compared.row.states = system.scene.state_count();
            compared.row.parameters = system.symbols.count(SymbolKind::parameter);
            compared.row.operations = operations(compared.prepared->machine, Function::rhs).total();
            streams_.err << fmt::format("  {}: derived, proven, generated\n", wish);
        } catch (const Failure& failure) {
            compared.row.refused = failure.diagnostics().empty() ? failure.what() : failure.diagnostics().front().message;
        }
        all_.push_back(std::move(compared));
    }

    /// Two ways to the same effects are one scene.
    const Compared* with_effects(const std::string& wish) const {
        std::set<std::string> effects;
        try {
            for (const Effect* effect : select_scene(model_->model, model_->names, wish, options_.choice.sizes).effects_in)
                effects.insert(effect->name);
        } catch (const Failure&) {  // the reason is told when it is prepared
            return nullptr;
        }
        const auto found =
            std::find_if(all_.begin(), all_.end(), [&](const Compared& other) { return other.prepared && other.effects == effects; });
        return found == all_.end() ? nullptr : &*found;
    }

    template <class Better>
    std::size_t extreme(const Better& better) const {
        std::size_t best = 0;
        for (std::size_t i = 1; i < all_.size(); ++i)
            if (all_[i].row.is_named && all_[i].row.refused.empty() &&
                (!all_[best].row.refused.empty() || better(all_[i].effects.size(), all_[best].effects.size())))
                best = i;
        return best;
    }

    std::size_t against() const {
        if (options_.against.empty()) return extreme([](std::size_t a, std::size_t b) { return a > b; });
        const std::string name = resolve_scene(model_->model, options_.against);
        for (std::size_t i = 0; i < all_.size(); ++i)
            if (all_[i].row.wish == name) return i;
        throw Failure(Diagnostic{Id::unknown_scene, model_->model.name_span,
                                 fmt::format("the base of the comparison, '{}', is not a scene of the model", name)});
    }

    void single_changes(std::size_t fullest, std::size_t barest) {
        const std::string full = all_[fullest].row.wish, bare = all_[barest].row.wish;
        const std::set<std::string> in_full = all_[fullest].effects, in_bare = all_[barest].effects;
        for (const Effect& effect : model_->model.effects)
            if (in_full.contains(effect.name)) add(full + "-" + effect.name, false);
        if (fullest == barest) return;
        for (const Effect& effect : model_->model.effects)
            if (!in_bare.contains(effect.name)) add(bare + "+" + effect.name, false);
    }

    /// On all processors.
    void simulate() {
        const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
        std::vector<std::pair<Compared*, std::future<SimulationReport>>> running;
        const auto finish = [&](auto& job) {
            ComparedScene& row = job.first->row;
            try {
                const SimulationReport report = job.second.get();
                row.status = report.status;
                row.until = report.t;
                for (const auto& [path, content] : report.files)
                    if (path.filename() == job.first->prepared->name + ".csv") job.first->results = columns_of(content);
                streams_.err << fmt::format("  {}: compiled and run\n", row.wish);
            } catch (const Failure& failure) {
                if (failure.exit_code() == ExitCode::tool_missing) throw;
                row.refused = failure.diagnostics().front().message;
            }
        };
        std::size_t finished = 0;
        for (Compared& compared : all_) {
            if (!compared.prepared) continue;
            if (running.size() - finished >= workers) finish(running[finished++]);
            compared.prepared->draw = false;
            running.emplace_back(
                &compared, std::async(std::launch::async, [&prepared = *compared.prepared] { return run_simulation(prepared, "."); }));
        }
        while (finished < running.size()) finish(running[finished++]);
    }

    /// In rounds, so that all scenes meet the same noise, and one at a time.
    void measure() {
        constexpr int rounds = 5;
        std::vector<std::pair<ComparedScene*, CostMeasurement>> measured;
        for (Compared& compared : all_)
            if (compared.prepared) measured.emplace_back(&compared.row, CostMeasurement(*compared.prepared));
        for (int round = 0; round < rounds; ++round)
            for (auto& [row, cost] : measured) cost.measure();
        for (auto& [row, cost] : measured) {
            row->nanoseconds = cost.nanoseconds();
            std::sort(row->nanoseconds.begin(), row->nanoseconds.end());
            row->bytes = cost.bytes();
        }
        streams_.err << "  measured\n";
    }

    /// Of outputs, or of states where the model names none; up to the time that both reach.
    static void deviations(Compared& compared, const Compared& full) {
        if (compared.results.empty()) return;
        const auto is_compared = [&](const std::string& title) {
            const std::string name = title.substr(0, title.find(" ["));
            static const std::set<std::string> others{"t", "kinetic_energy", "potential_energy", "internal_energy", "work"};
            return full.outputs.empty() ? !others.contains(name)
                                        : std::find(full.outputs.begin(), full.outputs.end(), name) != full.outputs.end();
        };
        for (const auto& [title, exact] : full.results) {
            const auto found = compared.results.find(title);
            if (!is_compared(title) || found == compared.results.end()) continue;
            const std::size_t count = std::min(exact.size(), found->second.size());
            double largest = 0;
            double magnitude = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const double difference = std::fabs(found->second[i] - exact[i]);
                if (!(difference <= largest)) largest = difference;  // what is no number stays so
                magnitude = std::max(magnitude, std::fabs(exact[i]));
            }
            compared.row.deviations.push_back({title, largest,
                                               magnitude > 0 || std::isnan(largest) ? largest / magnitude
                                               : largest > 0                        ? std::numeric_limits<double>::infinity()
                                                                                    : 0.0});
        }
    }

    std::shared_ptr<const LoadedModel> model_;
    Options options_;
    Streams streams_;
    std::vector<Compared> all_;
};

}  // namespace

const Deviation* ComparedScene::worst() const {
    const Deviation* worst = nullptr;
    for (const Deviation& d : deviations)
        if (std::isfinite(d.relative) && (worst == nullptr || d.relative > worst->relative)) worst = &d;
    return worst;
}

SceneComparison compare_scenes(const std::shared_ptr<const LoadedModel>& model, const Options& options, Streams streams) {
    return SideBySide(model, options, streams).run();
}

}  // namespace dalembert
