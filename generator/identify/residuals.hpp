// SPDX-License-Identifier: GPL-3.0-or-later
// What Ceres minimises: residuals of runs beside experiments, and of what is known beforehand.
#pragma once

#include <ceres/ceres.h>

#include <atomic>

#include "identify/fit.hpp"
#include "run/in_parallel.hpp"

namespace dalembert {

inline constexpr double huber_limit = 1.345, cauchy_limit = 2.385;  // 95 % of the efficiency of least squares for normal noise

inline std::vector<std::size_t> samples_of(const Measured& measured) {
    std::vector<std::size_t> samples;
    for (std::size_t i = 0; i < measured.values.size(); ++i)
        if (std::isfinite(measured.values[i])) samples.push_back(i);
    return samples;
}

/// The runs at the point that the minimiser asks for, made once for all residuals.
class Runs : public ceres::EvaluationCallback {
public:
    Runs(const FitRun& run, const std::vector<double>& scale, bool is_parallel, bool by_differences)
        : run_(run), scale_(scale), is_parallel_(is_parallel), by_differences_(by_differences), values(scale.size()) {
        end_after(1);
    }

    /// Of each experiment the first part alone, as `part` of 1 says.
    void end_after(double part) {
        samples.clear();
        for (const Experiment& experiment : run_.experiments()) {
            const auto behind = std::upper_bound(experiment.t.begin(), experiment.t.end(), part * experiment.end());
            samples.push_back(std::max<std::size_t>(2, static_cast<std::size_t>(behind - experiment.t.begin())));
        }
    }

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
            return run_.compare(e, x, with_slopes, samples[e]);
        }
        RunBesideData here = run_.compare(e, x, false, samples[e]);
        count += 1 + x.size();
        for (std::size_t k = 0; k < x.size() && here.failure.empty(); ++k) {
            std::vector<double> there = x;
            const double step = 1e-5 * scale_[k];
            there[k] += step;
            const RunBesideData moved = run_.compare(e, there, false, samples[e]);
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
    std::vector<double> values;        ///< in units of the scale
    std::vector<std::size_t> samples;  ///< of each experiment, how many the runs meet
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
            for (std::size_t k = 0; k < unknowns; ++k)
                jacobians[0][i * unknowns + k] = -column.slopes[k][samples_[i]] * runs_.scale()[k] / noise_;
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

inline ceres::LossFunction* new_loss(Loss loss) {
    if (loss == Loss::huber) return new ceres::HuberLoss(huber_limit);
    return loss == Loss::cauchy ? new ceres::CauchyLoss(cauchy_limit) : nullptr;
}

}  // namespace dalembert
