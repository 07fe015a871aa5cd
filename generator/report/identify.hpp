// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert identify`.
#pragma once

#include <dalembert/recording.hpp>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "identify/statistics.hpp"
#include "report/subject.hpp"

namespace dalembert {

struct IdentifiedValue {
    std::string name;  ///< "d_R", "start(phi) of run1.csv"
    ShownNumber shown;
    double value, begin;  ///< in SI; where the fit began
    double low, high;     ///< its bounds; infinite where there are none
    double error;         ///< standard error; infinite where the data do not tell
    double low_95, high_95;
    int at_bound;    ///< -1, 0, 1
    bool is_common;  ///< to all experiments
};

struct ComparedColumn {
    std::string experiment, column;
    ShownNumber shown;
    double noise;  ///< in SI
    bool noise_is_given;
    ResidualReport residuals;
};

struct IdentifyResult {
    Subject subject;
    std::vector<std::string> experiments;
    std::vector<IdentifiedValue> values;
    std::vector<ComparedColumn> columns;
    std::vector<std::string> unseen;  ///< sentences
    std::vector<std::vector<double>> correlations;
    std::vector<std::vector<double>> shares;  ///< of experiments (rows) in what is known of each value
    std::vector<std::string> notes;           ///< sentences about columns that were not used
    std::size_t count = 0;                    ///< of measured values
    std::size_t unweighted = 0;               ///< of them those that a robust loss counts by less than a half
    int starts = 1, agreeing = 1;
    int iterations = 0;
    std::size_t runs = 0;
    bool converged = false;
    std::vector<std::filesystem::path> files;
};

IdentifyResult result_of(const FitRun& run, const Fit& fit, const FitStatistics& statistics, const FitSettings& settings);

std::string as_text(const IdentifyResult& result);
nlohmann::ordered_json as_json(const IdentifyResult& result);

/// What `--parameters FILE` reads.
std::string parameter_file(const IdentifyResult& result);

/// The values of an experiment beside its run, in SI: t, and for each column simulated, measured and residual.
Recording comparison_table(const Experiment& experiment, const RunBesideData& comparison);

/// A page with tables, and a picture for each experiment; `pictures` are SVG texts, empty where there are none.
std::string identify_page(const IdentifyResult& result, const std::vector<std::string>& pictures);

}  // namespace dalembert
