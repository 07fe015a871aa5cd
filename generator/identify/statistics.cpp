// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/statistics.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Sensitivities have about six digits: what is below is no information.
constexpr double unseen_limit = 1e-5;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// Rows of residuals as the loss counts them, and of priors.
Matrix weighted_slopes(const Fit& fit, const FitSettings& settings) {
    const std::size_t rows = fit.residuals.size(), unknowns = fit.x.size();
    Matrix J = Matrix::Zero(index(rows + settings.priors.size()), index(unknowns));
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < unknowns; ++k) J(index(i), index(k)) = std::sqrt(fit.residuals[i].weight) * fit.slopes[i][k];
    for (std::size_t i = 0; i < settings.priors.size(); ++i)
        J(index(rows + i), index(settings.priors[i].unknown)) = 1 / settings.priors[i].deviation;
    return J;
}

std::vector<int> bounds_met(const FitRun& run, const Fit& fit) {
    std::vector<int> met;
    for (std::size_t k = 0; k < fit.x.size(); ++k) {
        const Fitted& one = run.fitted(run.unknowns()[k]);
        const double width =
            std::isfinite(one.high - one.low) ? one.high - one.low : std::max(std::fabs(fit.x[k]), std::fabs(run.start()[k]));
        const double room = 1e-9 * width;
        met.push_back(fit.x[k] <= one.low + room ? -1 : fit.x[k] >= one.high - room ? 1 : 0);
    }
    return met;
}

/// Basis vectors of unseen changes, each with as few parts as there can be: reduced by rows.
Matrix reduced(Matrix basis) {
    Eigen::Index row = 0;
    for (Eigen::Index column = 0; column < basis.cols() && row < basis.rows(); ++column) {
        Eigen::Index pivot = 0;
        const double size = basis.col(column).tail(basis.rows() - row).cwiseAbs().maxCoeff(&pivot);
        if (size < 1e-3) continue;
        basis.row(row).swap(basis.row(row + pivot));
        basis.row(row) /= basis(row, column);
        for (Eigen::Index other = 0; other < basis.rows(); ++other)
            if (other != row) basis.row(other) -= basis(other, column) * basis.row(row);
        ++row;
    }
    return basis;
}

class Statistics {
public:
    Statistics(const FitRun& run, const Fit& fit, const FitSettings& settings) : run_(run), fit_(fit), J_(weighted_slopes(fit, settings)) {}

    FitStatistics operator()() {
        const std::size_t unknowns = fit_.x.size();
        result_.freedom = static_cast<double>(J_.rows()) - static_cast<double>(unknowns);
        result_.at_bound = bounds_met(run_, fit_);
        result_.errors.assign(unknowns, 0);
        for (std::size_t k = 0; k < unknowns; ++k) free_.push_back(k);
        covariance();
        intervals();
        shares();
        residuals();
        return std::move(result_);
    }

private:
    void covariance() {
        const std::size_t unknowns = fit_.x.size();
        result_.correlations.assign(unknowns, std::vector<double>(unknowns, 0));
        for (std::size_t k = 0; k < unknowns; ++k) result_.correlations[k][k] = 1;
        if (free_.empty()) return;
        Matrix scaled(J_.rows(), index(free_.size()));
        Vector norms(index(free_.size()));
        std::vector<bool> is_seen(free_.size());
        for (std::size_t i = 0; i < free_.size(); ++i) {
            const Vector column = J_.col(index(free_[i]));
            // A change of the whole value, or of a unit where it is zero, that moves no residual by a hundred thousandth of its noise.
            const double size = fit_.x[free_[i]] != 0 ? std::fabs(fit_.x[free_[i]]) : 1;
            is_seen[i] = column.norm() * size > unseen_limit;
            norms[index(i)] = is_seen[i] ? column.norm() : 1;
            scaled.col(index(i)) = is_seen[i] ? Vector(column / column.norm()) : Vector::Zero(J_.rows());
        }
        const Eigen::JacobiSVD<Matrix> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeFullV);
        const Vector s = svd.singularValues();
        const Matrix& V = svd.matrixV();
        std::vector<Eigen::Index> seen, unseen;
        for (Eigen::Index i = 0; i < V.cols(); ++i) (i < s.size() && s[i] > unseen_limit * s[0] ? seen : unseen).push_back(i);
        Matrix covariance = Matrix::Zero(V.rows(), V.rows());
        for (const Eigen::Index i : seen) covariance += V.col(i) * V.col(i).transpose() / (s[i] * s[i]);
        for (std::size_t i = 0; i < free_.size(); ++i)
            result_.errors[free_[i]] = std::sqrt(covariance(index(i), index(i))) / norms[index(i)];
        for (std::size_t i = 0; i < free_.size(); ++i)
            for (std::size_t j = 0; j < free_.size(); ++j) {
                const double product = covariance(index(i), index(i)) * covariance(index(j), index(j));
                if (i != j && product > 0) result_.correlations[free_[i]][free_[j]] = covariance(index(i), index(j)) / std::sqrt(product);
            }
        if (unseen.empty()) return;
        Matrix basis(index(unseen.size()), V.rows());
        for (std::size_t i = 0; i < unseen.size(); ++i) basis.row(index(i)) = V.col(unseen[i]).transpose();
        basis = reduced(basis);
        for (Eigen::Index row = 0; row < basis.rows(); ++row) name(basis.row(row), norms);
    }

    /// One change that is not seen.
    void name(const Vector& change, const Vector& norms) {
        Unseen unseen;
        double largest = 0;
        for (std::size_t i = 0; i < free_.size(); ++i) {
            const double value = fit_.x[free_[i]];
            Unseen::Part part{free_[i], change[index(i)] / norms[index(i)], value != 0};
            if (part.is_relative) part.change /= value;
            unseen.parts.push_back(part);
            largest = std::max(largest, std::fabs(part.change));
        }
        if (!(largest > 0)) return;
        const double sign = std::find_if(
                                unseen.parts.begin(), unseen.parts.end(),
                                [&](const Unseen::Part& p) {
                                    return std::fabs(p.change) > 1e-3 * largest;
                                })->change > 0
                                ? 1
                                : -1;
        for (Unseen::Part& part : unseen.parts) part.change *= sign / largest;
        std::erase_if(unseen.parts, [](const Unseen::Part& part) { return std::fabs(part.change) < 1e-3; });
        for (const Unseen::Part& part : unseen.parts) result_.errors[part.unknown] = infinite;
        result_.unseen.push_back(std::move(unseen));
    }

    void intervals() {
        const bool is_known = fit_.given_noise.size() == fit_.noise.size();
        const double quantile = is_known || !(result_.freedom > 0) ? boost::math::quantile(boost::math::normal(), 0.975)
                                                                   : boost::math::quantile(boost::math::students_t(result_.freedom), 0.975);
        // What lies outside of the range is known to be wrong, also of a value at its bound.
        for (std::size_t k = 0; k < fit_.x.size(); ++k) {
            const Fitted& one = run_.fitted(run_.unknowns()[k]);
            result_.low.push_back(std::max(one.low, fit_.x[k] - quantile * result_.errors[k]));
            result_.high.push_back(std::min(one.high, fit_.x[k] + quantile * result_.errors[k]));
        }
    }

    void shares() {
        const std::size_t unknowns = fit_.x.size(), experiments = run_.experiments().size();
        result_.shares.assign(experiments, std::vector<double>(unknowns, 0));
        std::vector<double> sums(unknowns, 0);
        for (std::size_t i = 0; i < fit_.residuals.size(); ++i)
            for (std::size_t k = 0; k < unknowns; ++k) {
                const double told = J_(index(i), index(k)) * J_(index(i), index(k));
                result_.shares[fit_.residuals[i].experiment][k] += told;
                sums[k] += told;
            }
        for (std::vector<double>& row : result_.shares)
            for (std::size_t k = 0; k < unknowns; ++k) row[k] = sums[k] > 0 ? row[k] / sums[k] : 0;
    }

    void residuals() {
        for (std::size_t e = 0; e < run_.experiments().size(); ++e)
            for (std::size_t c = 0; c < run_.experiments()[e].measured.size(); ++c) {
                const Experiment& experiment = run_.experiments()[e];
                const double noise = fit_.noise.at(experiment.measured[c].column);
                std::vector<double> values;
                ResidualReport report{e, c, 0, 0, 0, 0, 0, 0};
                for (const Residual& residual : fit_.residuals) {
                    if (residual.experiment != e || residual.column != c) continue;
                    values.push_back(residual.value);
                    report.rms += residual.value * residual.value;
                    if (std::fabs(residual.value) > 4) ++report.outliers;
                    if (std::fabs(residual.value) < std::fabs(report.largest)) continue;
                    report.largest = residual.value;
                    report.at = experiment.t[residual.sample];
                }
                report.count = values.size();
                report.rms = noise * std::sqrt(report.rms / static_cast<double>(values.size()));
                report.largest *= noise;
                report.white = probability_of_white(values);
                result_.residuals.push_back(report);
            }
    }

    /// Of correlations between neighbours: Ljung and Box.
    static double probability_of_white(const std::vector<double>& values) {
        const std::size_t n = values.size(), lags = std::min<std::size_t>(10, n / 5);
        if (lags == 0) return std::numeric_limits<double>::quiet_NaN();
        double mean = 0, variance = 0;
        for (const double value : values) mean += value / static_cast<double>(n);
        for (const double value : values) variance += (value - mean) * (value - mean);
        if (!(variance > 0)) return std::numeric_limits<double>::quiet_NaN();
        double sum = 0;
        for (std::size_t lag = 1; lag <= lags; ++lag) {
            double product = 0;
            for (std::size_t i = lag; i < n; ++i) product += (values[i] - mean) * (values[i - lag] - mean);
            sum += product / variance * (product / variance) / static_cast<double>(n - lag);
        }
        const double q = static_cast<double>(n) * static_cast<double>(n + 2) * sum;
        return boost::math::cdf(boost::math::complement(boost::math::chi_squared(static_cast<double>(lags)), q));
    }

    const FitRun& run_;
    const Fit& fit_;
    Matrix J_;
    std::vector<std::size_t> free_;
    FitStatistics result_;
};

}  // namespace

FitStatistics statistics_of(const FitRun& run, const Fit& fit, const FitSettings& settings) { return Statistics(run, fit, settings)(); }

std::string in_words(const Unseen& unseen, const FitRun& run) {
    const auto name = [&](std::size_t i) { return run.name(run.unknowns()[unseen.parts[i].unknown]); };
    if (unseen.parts.size() == 1) return fmt::format("the data do not depend on '{}'", name(0));
    const bool are_two = unseen.parts.size() == 2 && unseen.parts[0].is_relative && unseen.parts[1].is_relative;
    if (are_two && std::fabs(unseen.parts[0].change - unseen.parts[1].change) < 1e-3)
        return fmt::format(
            "the data do not tell '{0}' and '{1}' apart: they stay the same where both grow by the same factor, and show {0}/{1} alone",
            name(0), name(1));
    if (are_two && std::fabs(unseen.parts[0].change + unseen.parts[1].change) < 1e-3)
        return fmt::format(
            "the data do not tell '{0}' and '{1}' apart: they stay the same where one grows by the factor by which the other falls, and "
            "show {0}*{1} alone",
            name(0), name(1));
    std::string names, changes;
    for (std::size_t i = 0; i < unseen.parts.size(); ++i) {
        const Unseen::Part& part = unseen.parts[i];
        const char* before = i == 0 ? "" : i + 1 == unseen.parts.size() ? " and " : ", ";
        names += fmt::format("{}'{}'", before, name(i));
        changes += part.is_relative ? fmt::format("{}'{}' by {:+.3g} %", before, name(i), part.change)
                                    : fmt::format("{}'{}' by {:+.3g} {}", before, name(i), part.change / 100,
                                                  run.fitted(run.unknowns()[part.unknown]).shown.unit);
    }
    return fmt::format("the data do not tell {} apart: they stay the same where {} change together", names, changes);
}

}  // namespace dalembert
