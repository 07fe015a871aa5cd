// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

#include "run/in_parallel.hpp"

namespace dalembert {

namespace {

using Noise = std::map<std::string, double>;

constexpr double huber_limit = 1.345, cauchy_limit = 2.385;  // 95 % of the efficiency of least squares for normal noise

/// A number from 0 to 1 that every machine draws alike.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// The runs at the point that the minimiser asks for, made once for all residuals.
class Runs : public ceres::EvaluationCallback {
public:
    Runs(const FitRun& run, const std::vector<double>& scale, bool is_parallel, bool by_differences)
        : run_(run), scale_(scale), is_parallel_(is_parallel), by_differences_(by_differences), values(scale.size()) {}

    void PrepareForEvaluation(bool with_slopes, bool is_new) override {
        if (!is_new && (has_slopes_ || !with_slopes)) return;
        // Most steps are taken, and then their derivatives are asked for: they come with the run for less than a second run costs.
        with_slopes = with_slopes || !by_differences_;
        const std::vector<double> x = in_si();
        comparisons.clear();
        const auto work = [&](std::size_t e) { return compare(e, x, with_slopes); };
        const std::size_t experiments = run_.experiments().size();
        if (is_parallel_ && experiments > 1)
            in_parallel(experiments, work, [&](std::size_t, RunBesideData one) { comparisons.push_back(std::move(one)); });
        else
            for (std::size_t e = 0; e < experiments; ++e) comparisons.push_back(work(e));
        has_slopes_ = with_slopes;
    }
    std::vector<double> in_si() const {
        std::vector<double> x = values;
        for (std::size_t k = 0; k < x.size(); ++k) x[k] *= scale_[k];
        return x;
    }

private:
    RunBesideData compare(std::size_t e, const std::vector<double>& x, bool with_slopes) {
        if (!with_slopes || !by_differences_) {
            ++count;
            return run_.compare(e, x, with_slopes);
        }
        RunBesideData here = run_.compare(e, x, false);
        count += 1 + x.size();
        for (std::size_t k = 0; k < x.size() && here.failure.empty(); ++k) {
            std::vector<double> there = x;
            const double step = 1e-5 * scale_[k];
            there[k] += step;
            const RunBesideData moved = run_.compare(e, there, false);
            if (!moved.failure.empty()) return moved;
            for (std::size_t c = 0; c < here.columns.size(); ++c) {
                auto& slopes = here.columns[c].slopes.emplace_back();
                for (std::size_t i = 0; i < here.columns[c].simulated.size(); ++i)
                    slopes.push_back((moved.columns[c].simulated[i] - here.columns[c].simulated[i]) / step);
            }
        }
        return here;
    }

    const FitRun& run_;
    const std::vector<double>& scale_;
    bool is_parallel_, by_differences_;
    bool has_slopes_ = false;

public:
    std::vector<double> values;  ///< in units of the scale
    std::vector<RunBesideData> comparisons;
    std::atomic<std::size_t> count{0};
    const std::vector<double>& scale() const { return scale_; }
};

/// Values of one column: (measured - simulated)/noise.
class ColumnBlock : public ceres::CostFunction {
public:
    ColumnBlock(const Runs& runs, const Measured& measured, std::size_t experiment, std::size_t column, std::vector<std::size_t> samples,
                double noise)
        : runs_(runs), measured_(measured), experiment_(experiment), column_(column), samples_(std::move(samples)), noise_(noise) {
        set_num_residuals(static_cast<int>(samples_.size()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(runs.scale().size()));
    }
    bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
        const RunBesideData& comparison = runs_.comparisons[experiment_];
        if (!comparison.failure.empty()) return false;
        const RunBesideData::Column& column = comparison.columns[column_];
        const std::size_t unknowns = runs_.scale().size();
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            residuals[i] = (measured_.values[samples_[i]] - column.simulated[samples_[i]]) / noise_;
            if (!std::isfinite(residuals[i])) return false;
            if (jacobians == nullptr || jacobians[0] == nullptr) continue;
            for (std::size_t k = 0; k < unknowns; ++k) jacobians[0][i * unknowns + k] = -column.slopes[k][samples_[i]] * runs_.scale()[k] / noise_;
        }
        return true;
    }

private:
    const Runs& runs_;
    const Measured& measured_;
    std::size_t experiment_, column_;
    std::vector<std::size_t> samples_;
    double noise_;
};

class PriorBlock : public ceres::CostFunction {
public:
    PriorBlock(const Prior& prior, const std::vector<double>& scale) : prior_(prior), scale_(scale) {
        set_num_residuals(1);
        mutable_parameter_block_sizes()->push_back(static_cast<int>(scale.size()));
    }
    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
        const std::size_t k = prior_.unknown;
        residuals[0] = (x[0][k] * scale_[k] - prior_.mean) / prior_.deviation;
        if (jacobians == nullptr || jacobians[0] == nullptr) return true;
        std::fill_n(jacobians[0], scale_.size(), 0.0);
        jacobians[0][k] = scale_[k] / prior_.deviation;
        return true;
    }

private:
    const Prior& prior_;
    const std::vector<double>& scale_;
};

ceres::LossFunction* new_loss(Loss loss) {
    if (loss == Loss::huber) return new ceres::HuberLoss(huber_limit);
    return loss == Loss::cauchy ? new ceres::CauchyLoss(cauchy_limit) : nullptr;
}

std::vector<std::size_t> samples_of(const Measured& measured) {
    std::vector<std::size_t> samples;
    for (std::size_t i = 0; i < measured.values.size(); ++i)
        if (std::isfinite(measured.values[i])) samples.push_back(i);
    return samples;
}

/// From one start, with noise that is known.
class Minimisation {
public:
    Minimisation(const FitRun& run, const FitSettings& settings, const std::vector<double>& scale, bool is_parallel)
        : run_(run), settings_(settings), scale_(scale), runs_(run, scale, is_parallel, settings.by_differences) {}

    /// False where the runs do not come to their ends at the start.
    bool operator()(std::vector<double>& x, const Noise& noise) {
        for (std::size_t k = 0; k < x.size(); ++k) runs_.values[k] = x[k] / scale_[k];
        ceres::Problem::Options of_problem;
        of_problem.evaluation_callback = &runs_;
        ceres::Problem problem(of_problem);
        double* values = runs_.values.data();
        const auto& experiments = run_.experiments();
        for (std::size_t e = 0; e < experiments.size(); ++e)
            for (std::size_t c = 0; c < experiments[e].measured.size(); ++c) {
                const Measured& measured = experiments[e].measured[c];
                const auto add = [&](std::vector<std::size_t> samples) {
                    problem.AddResidualBlock(new ColumnBlock(runs_, measured, e, c, std::move(samples), noise.at(measured.column)),
                                             new_loss(settings_.loss), values);
                };
                if (settings_.loss == Loss::none) add(samples_of(measured));
                else
                    for (const std::size_t sample : samples_of(measured)) add({sample});
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
        options.max_num_iterations = 200;
        options.function_tolerance = 1e-9;
        options.parameter_tolerance = 1e-9;
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
                return fmt::format("the run beside '{}' does not reach its end: {}", run_.experiments()[e].name, runs_.comparisons[e].failure);
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
    std::size_t all = 0;
    for (std::size_t e = 0; e < comparisons.size(); ++e)
        for (std::size_t c = 0; c < comparisons[e].columns.size(); ++c) {
            const Measured& measured = run.experiments()[e].measured[c];
            for (const std::size_t i : samples_of(measured)) {
                residuals[measured.column].push_back(measured.values[i] - comparisons[e].columns[c].simulated[i]);
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
        if (size > 0) noise[column] = size;
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

std::vector<std::vector<double>> starts_of(const FitRun& run, const FitSettings& settings) {
    std::vector<std::vector<double>> starts{settings.begin.empty() ? run.start() : settings.begin};
    std::mt19937_64 generator(settings.seed);
    while (starts.size() < static_cast<std::size_t>(settings.starts)) {
        std::vector<double> x = run.start();
        for (std::size_t k = 0; k < x.size(); ++k) {
            const Fitted& one = run.fitted(run.unknowns()[k]);
            const double part = uniform(generator);
            if (std::isfinite(one.low) && std::isfinite(one.high))
                x[k] = one.low > 0 ? one.low * std::pow(one.high / one.low, part) : one.low + part * (one.high - one.low);
            else
                x[k] = std::clamp(x[k] * std::pow(3.0, 2 * part - 1), one.low, one.high);
        }
        starts.push_back(std::move(x));
    }
    return starts;
}

void check_count(const FitRun& run, const FitSettings& settings) {
    std::size_t values = settings.priors.size();
    for (const Experiment& experiment : run.experiments())
        for (const Measured& measured : experiment.measured) values += samples_of(measured).size();
    if (values > run.unknowns().size()) return;
    throw Failure(Diagnostic{Id::bad_option, {},
                             fmt::format("the data have {} values for {} unknowns; a fit with error bars needs more values than unknowns", values,
                                         run.unknowns().size())});
}

}  // namespace

std::pair<double, double> loss_of(Loss loss, double squared) {
    if (loss == Loss::none) return {squared, 1};
    double rho[3];
    if (loss == Loss::huber) ceres::HuberLoss(huber_limit).Evaluate(squared, rho);
    else ceres::CauchyLoss(cauchy_limit).Evaluate(squared, rho);
    return {rho[0], rho[1]};
}

Fit fit(const FitRun& run, const FitSettings& settings) {
    static const bool is_quiet = (FLAGS_minloglevel = google::GLOG_FATAL, true);
    (void)is_quiet;
    check_count(run, settings);
    const auto [noise_at_first, given] = first_noise(run);
    std::vector<double> scale;
    for (const double value : run.start()) scale.push_back(value != 0 ? std::fabs(value) : 1);
    const bool all_given = given.size() == noise_at_first.size();
    const auto from_start = [&, &first = noise_at_first](const std::vector<double>& start, bool is_parallel) {
        Fit result;
        result.x = start;
        Noise noise = first;
        Minimisation minimise(run, settings, scale, is_parallel);
        // Weights follow from residuals, and these from weights; a few rounds are enough.
        const int rounds = all_given ? 1 : noise.size() > 1 || settings.loss != Loss::none ? 5 : 2;
        for (int round = 0; round < rounds; ++round) {
            if (!minimise(result.x, noise)) throw RunStopped(minimise.failure());
            Runs last(run, scale, is_parallel, settings.by_differences);
            for (std::size_t k = 0; k < scale.size(); ++k) last.values[k] = result.x[k] / scale[k];
            last.PrepareForEvaluation(true, true);
            result.runs += last.count;
            result.comparisons = std::move(last.comparisons);
            for (const RunBesideData& comparison : result.comparisons)
                if (!comparison.failure.empty()) throw RunStopped(comparison.failure);
            if (round + 1 == rounds) break;
            const Noise before = noise;
            noise = noise_of_residuals(run, result.comparisons, settings.loss, noise);
            for (const std::string& column : given) noise[column] = before.at(column);
            double change = 0;
            for (const auto& [column, size] : noise) change = std::max(change, std::fabs(size / before.at(column) - 1));
            // The least squares of a single column do not ask for its noise.
            if (noise.size() == 1 && settings.loss == Loss::none && settings.priors.empty()) break;
            if (change < 1e-3) break;
        }
        result.noise = noise;
        result.converged = minimise.converged;
        result.iterations = minimise.iterations;
        result.runs += minimise.runs();
        return result;
    };
    const std::vector<std::vector<double>> starts = starts_of(run, settings);
    std::optional<Fit> best;
    std::string failure;
    const auto cost_of = [&](Fit& one) {
        one.cost = 0;
        one.residuals.clear();
        one.slopes.clear();
        for (std::size_t e = 0; e < one.comparisons.size(); ++e)
            for (std::size_t c = 0; c < one.comparisons[e].columns.size(); ++c) {
                const Measured& measured = run.experiments()[e].measured[c];
                const RunBesideData::Column& column = one.comparisons[e].columns[c];
                for (const std::size_t i : samples_of(measured)) {
                    Residual residual{e, c, i, (measured.values[i] - column.simulated[i]) / one.noise.at(measured.column)};
                    const auto [rho, weight] = loss_of(settings.loss, residual.value * residual.value);
                    residual.weight = weight;
                    one.cost += rho / 2 + std::log(one.noise.at(measured.column));
                    one.residuals.push_back(residual);
                    std::vector<double> row;
                    for (std::size_t k = 0; k < one.x.size(); ++k) row.push_back(-column.slopes[k][i] / one.noise.at(measured.column));
                    one.slopes.push_back(std::move(row));
                }
            }
        for (const Prior& prior : settings.priors) one.cost += std::pow((one.x[prior.unknown] - prior.mean) / prior.deviation, 2) / 2;
    };
    struct Attempt {
        std::optional<Fit> fit;
        std::string failure;
    };
    const auto attempt = [&](std::size_t i) {
        try {
            return Attempt{from_start(starts[i], starts.size() == 1), ""};
        } catch (const RunStopped& stopped) {
            return Attempt{std::nullopt, stopped.what()};
        }
    };
    std::size_t all_runs = 0;
    std::vector<double> costs;
    in_parallel(starts.size(), attempt, [&](std::size_t i, Attempt one) {
        if (!one.fit) {
            if (failure.empty()) failure = one.failure;
            return;
        }
        all_runs += one.fit->runs;
        cost_of(*one.fit);
        one.fit->start = static_cast<int>(i);
        costs.push_back(one.fit->cost);
        if (!best || one.fit->cost < best->cost - 1e-9 * std::fabs(best->cost)) best = std::move(one.fit);
    });
    if (!best) throw RunStopped(failure);
    best->runs = all_runs;
    best->agreeing = static_cast<int>(std::count_if(costs.begin(), costs.end(), [&](double cost) {
        return cost - best->cost < 1e-6 * (1 + std::fabs(best->cost));
    }));
    best->given_noise = given;
    return std::move(*best);
}

}  // namespace dalembert
