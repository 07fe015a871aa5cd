// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/fit.hpp"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "identify/residuals.hpp"

namespace dalembert {

namespace {

using Noise = std::map<std::string, double>;

/// A number from 0 to 1 that every machine draws alike.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// From one start, with noise that is known.
class Minimisation {
public:
    Minimisation(const FitRun& run, const FitSettings& settings, const std::vector<double>& scale, bool is_parallel)
        : run_(run), settings_(settings), scale_(scale), runs_(run, scale, is_parallel, settings.by_differences) {}

    /// To the first part of the data, then to more and more of them. A part of a run has fewer swings and events to count wrongly.
    void grow(std::vector<double>& x, const Noise& noise) {
        for (const double part : {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2}) (*this)(x, noise, part);
    }

    /// False where the runs do not come to their ends at the start.
    bool operator()(std::vector<double>& x, const Noise& noise, double part = 1) {
        runs_.end_after(part);
        for (std::size_t k = 0; k < x.size(); ++k) runs_.values[k] = x[k] / scale_[k];
        ceres::Problem::Options of_problem;
        of_problem.evaluation_callback = &runs_;
        ceres::Problem problem(of_problem);
        double* values = runs_.values.data();
        problem.AddParameterBlock(values, static_cast<int>(x.size()));
        const bool is_whole = part == 1;
        // Far from the solution the loss of Cauchy has minima that the one of Huber does not have.
        const Loss loss = is_whole || settings_.loss == Loss::none ? settings_.loss : Loss::huber;
        const auto& experiments = run_.experiments();
        for (std::size_t e = 0; e < experiments.size(); ++e)
            for (std::size_t c = 0; c < experiments[e].measured.size(); ++c) {
                const Measured& measured = experiments[e].measured[c];
                const auto add = [&](std::vector<std::size_t> samples) {
                    if (!samples.empty())
                        problem.AddResidualBlock(new ColumnBlock(runs_, measured, e, c, std::move(samples), noise.at(measured.column)),
                                             new_loss(loss), values);
                };
                std::vector<std::size_t> samples = samples_of(measured);
                samples.erase(std::lower_bound(samples.begin(), samples.end(), runs_.samples[e]), samples.end());
                if (settings_.loss == Loss::none)
                    add(std::move(samples));
                else
                    for (const std::size_t sample : samples) add({sample});
            }
        for (const Prior& prior : settings_.priors) problem.AddResidualBlock(new PriorBlock(prior, scale_), nullptr, values);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const Fitted& one = run_.fitted(run_.unknowns()[k]);
            if (std::isfinite(one.low)) problem.SetParameterLowerBound(values, static_cast<int>(k), one.low / scale_[k]);
            if (std::isfinite(one.high)) problem.SetParameterUpperBound(values, static_cast<int>(k), one.high / scale_[k]);
        }
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_QR;
        options.logging_type = ceres::SILENT;
        options.max_num_iterations = is_whole ? 200 : 20;  // a part only has to come near
        options.function_tolerance = is_whole ? 1e-9 : 1e-4;
        options.parameter_tolerance = is_whole ? 1e-9 : 1e-4;
        options.gradient_tolerance = 1e-12;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
        if (summary.termination_type == ceres::FAILURE) return false;
        x = runs_.in_si();
        cost = summary.final_cost;
        converged = summary.termination_type == ceres::CONVERGENCE;
        iterations += static_cast<int>(summary.iterations.size());
        return true;
    }

    std::size_t runs() const { return runs_.count; }
    /// Why the last runs failed.
    std::string failure() const {
        for (std::size_t e = 0; e < runs_.comparisons.size(); ++e)
            if (!runs_.comparisons[e].failure.empty())
                return fmt::format("the run beside '{}' does not reach its end: {}", run_.experiments()[e].name,
                                   runs_.comparisons[e].failure);
        return "the residuals are not finite";
    }

    double cost = 0;
    bool converged = false;
    int iterations = 0;

private:
    const FitRun& run_;
    const FitSettings& settings_;
    const std::vector<double>& scale_;
    Runs runs_;
};

/// How large residuals of each column are, in SI; `unknowns` are shared out among the columns.
Noise noise_of_residuals(const FitRun& run, const std::vector<RunBesideData>& comparisons, Loss loss, Noise noise) {
    std::map<std::string, std::vector<double>> residuals;
    Noise largest;
    std::size_t all = 0;
    for (std::size_t e = 0; e < comparisons.size(); ++e)
        for (std::size_t c = 0; c < comparisons[e].columns.size(); ++c) {
            const Measured& measured = run.experiments()[e].measured[c];
            for (const std::size_t i : samples_of(measured)) {
                residuals[measured.column].push_back(measured.values[i] - comparisons[e].columns[c].simulated[i]);
                largest[measured.column] = std::max(largest[measured.column], std::fabs(measured.values[i]));
                ++all;
            }
        }
    const double left = 1 - static_cast<double>(run.unknowns().size()) / static_cast<double>(all);
    for (auto& [column, values] : residuals) {
        double size = 0;
        if (loss == Loss::none) {
            for (const double value : values) size += value * value;
            size = std::sqrt(size / (left * static_cast<double>(values.size())));
        } else {  // the median is not moved by outliers
            for (double& value : values) value = std::fabs(value);
            std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
            size = 1.4826 * values[values.size() / 2] / std::sqrt(left);
        }
        // Data without noise leave roundings at least.
        noise[column] = std::max(size, std::numeric_limits<double>::epsilon() * (largest[column] > 0 ? largest[column] : 1));
    }
    return noise;
}

/// Noise that is given, or for a begin the spread of the values.
std::pair<Noise, std::vector<std::string>> first_noise(const FitRun& run) {
    Noise noise;
    std::vector<std::string> given;
    std::map<std::string, std::vector<double>> values;
    for (const Experiment& experiment : run.experiments())
        for (const Measured& measured : experiment.measured) {
            for (const std::size_t i : samples_of(measured)) values[measured.column].push_back(measured.values[i]);
            if (measured.noise > 0) noise[measured.column] = measured.noise;
        }
    for (const auto& [column, all] : values) {
        if (noise.contains(column)) {
            given.push_back(column);
            continue;
        }
        double mean = 0, spread = 0;
        for (const double value : all) mean += value / static_cast<double>(all.size());
        for (const double value : all) spread += (value - mean) * (value - mean) / static_cast<double>(all.size());
        noise[column] = spread > 0 ? std::sqrt(spread) : 1;
    }
    return {noise, given};
}

struct Start {
    std::vector<double> x;
    bool grows;  ///< from the first part of the data to all
};

/// The given one, to all data at once and growing; then random ones, in turn near the given one and in the whole range. Of four one is
/// fitted to all data at once: their beginning may say nothing.
std::vector<Start> starts_of(const FitRun& run, const FitSettings& settings) {
    const std::vector<double>& given = settings.begin.empty() ? run.start() : settings.begin;
    std::vector<Start> starts{{given, false}, {given, true}};
    std::mt19937_64 generator(settings.seed);
    while (starts.size() < static_cast<std::size_t>(settings.starts)) {
        const std::size_t number = starts.size();
        std::vector<double> x = given;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const Fitted& one = run.fitted(run.unknowns()[k]);
            const double part = uniform(generator);
            if (number % 2 == 0 || !std::isfinite(one.low) || !std::isfinite(one.high))
                x[k] = std::clamp(x[k] * std::pow(5.0, 2 * part - 1), one.low, one.high);
            else
                x[k] = one.low > 0 ? one.low * std::pow(one.high / one.low, part) : one.low + part * (one.high - one.low);
        }
        starts.push_back({std::move(x), number % 4 < 3});
    }
    starts.resize(static_cast<std::size_t>(settings.starts));
    return starts;
}

void check_count(const FitRun& run, const FitSettings& settings) {
    std::size_t values = settings.priors.size();
    for (const Experiment& experiment : run.experiments())
        for (const Measured& measured : experiment.measured) values += samples_of(measured).size();
    if (values > run.unknowns().size()) return;
    throw Failure(Diagnostic{Id::bad_option,
                             {},
                             fmt::format("the data have {} values for {} unknowns; a fit with error bars needs more values than unknowns",
                                         values, run.unknowns().size())});
}

/// From all starts.
class Fitting {
public:
    Fitting(const FitRun& run, const FitSettings& settings) : run_(run), settings_(settings) {
        std::tie(first_, given_) = first_noise(run);
        for (const double value : run.start()) scale_.push_back(value != 0 ? std::fabs(value) : 1);
    }

    Fit operator()() const {
        struct Attempt {
            std::optional<Fit> fit;
            std::string failure;
        };
        const std::vector<Start> starts = starts_of(run_, settings_);
        const auto attempt = [&](std::size_t i) {
            try {
                return Attempt{from_start(starts[i], starts.size() == 1), ""};
            } catch (const RunStopped& stopped) {
                return Attempt{std::nullopt, stopped.what()};
            }
        };
        std::optional<Fit> best;
        std::string failure;
        std::size_t runs = 0;
        std::vector<double> costs;
        in_parallel(starts.size(), attempt, [&](std::size_t i, Attempt one) {
            if (!one.fit) {
                if (failure.empty()) failure = one.failure;
                return;
            }
            runs += one.fit->runs;
            one.fit->start = static_cast<int>(i);
            costs.push_back(one.fit->cost);
            if (!best || one.fit->cost < best->cost - 1e-9 * std::fabs(best->cost)) best = std::move(one.fit);
        });
        if (!best) throw RunStopped(failure);
        best->runs = runs;
        best->agreeing = static_cast<int>(
            std::count_if(costs.begin(), costs.end(), [&](double cost) { return cost - best->cost < 1e-6 * (1 + std::fabs(best->cost)); }));
        return std::move(*best);
    }

private:
    /// Weights follow from residuals, and these from weights; a few rounds are enough. The least squares of a single column do not ask for
    /// its noise.
    Fit from_start(const Start& start, bool is_parallel) const {
        Fit result;
        result.x = start.x;
        result.noise = first_;
        result.given_noise = given_;
        Minimisation minimise(run_, settings_, scale_, is_parallel);
        if (start.grows) minimise.grow(result.x, result.noise);
        const bool asks_for_noise = result.noise.size() > 1 || settings_.loss != Loss::none || !settings_.priors.empty();
        const int rounds = given_.size() == first_.size() ? 1 : asks_for_noise ? 5 : 2;
        for (int round = 1; round <= rounds; ++round) {
            if (!minimise(result.x, result.noise)) throw RunStopped(minimise.failure());
            Runs last(run_, scale_, is_parallel, settings_.by_differences);
            for (std::size_t k = 0; k < scale_.size(); ++k) last.values[k] = result.x[k] / scale_[k];
            last.PrepareForEvaluation(true, true);
            result.runs += last.count;
            result.comparisons = std::move(last.comparisons);
            for (const RunBesideData& comparison : result.comparisons)
                if (!comparison.failure.empty()) throw RunStopped(comparison.failure);
            if (round == rounds) break;
            const double change = take_noise(result);
            if (!asks_for_noise || change < 1e-3) break;
        }
        result.converged = minimise.converged;
        result.iterations = minimise.iterations;
        result.runs += minimise.runs();
        take_residuals(result);
        return result;
    }

    /// The largest relative change.
    double take_noise(Fit& result) const {
        const Noise before = std::exchange(result.noise, noise_of_residuals(run_, result.comparisons, settings_.loss, result.noise));
        for (const std::string& column : given_) result.noise[column] = before.at(column);
        double change = 0;
        for (const auto& [column, size] : result.noise) change = std::max(change, std::fabs(size / before.at(column) - 1));
        return change;
    }

    void take_residuals(Fit& result) const {
        for (std::size_t e = 0; e < result.comparisons.size(); ++e)
            for (std::size_t c = 0; c < result.comparisons[e].columns.size(); ++c) {
                const Measured& measured = run_.experiments()[e].measured[c];
                const RunBesideData::Column& column = result.comparisons[e].columns[c];
                const double noise = result.noise.at(measured.column);
                for (const std::size_t i : samples_of(measured)) {
                    Residual residual{e, c, i, (measured.values[i] - column.simulated[i]) / noise};
                    const auto [rho, weight] = loss_of(settings_.loss, residual.value * residual.value);
                    residual.weight = weight;
                    result.cost += rho / 2 + std::log(noise);
                    result.residuals.push_back(residual);
                    std::vector<double>& row = result.slopes.emplace_back();
                    for (std::size_t k = 0; k < result.x.size(); ++k) row.push_back(-column.slopes[k][i] / noise);
                }
            }
        for (const Prior& prior : settings_.priors)
            result.cost += std::pow((result.x[prior.unknown] - prior.mean) / prior.deviation, 2) / 2;
    }

    const FitRun& run_;
    const FitSettings& settings_;
    Noise first_;                     ///< given, or the spread of the values
    std::vector<std::string> given_;  ///< columns
    std::vector<double> scale_;
};

}  // namespace

std::pair<double, double> loss_of(Loss loss, double squared) {
    if (loss == Loss::none) return {squared, 1};
    double rho[3];
    if (loss == Loss::huber)
        ceres::HuberLoss(huber_limit).Evaluate(squared, rho);
    else
        ceres::CauchyLoss(cauchy_limit).Evaluate(squared, rho);
    return {rho[0], rho[1]};
}

Fit fit(const FitRun& run, const FitSettings& settings) {
    static const bool is_quiet = (FLAGS_minloglevel = google::GLOG_FATAL, true);
    (void)is_quiet;
    check_count(run, settings);
    return Fitting(run, settings)();
}

}  // namespace dalembert
