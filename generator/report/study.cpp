// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/json_output.hpp"
#include "study/study.hpp"

namespace dalembert {

namespace {

constexpr std::uint64_t seed_of_errors = 1;
constexpr std::size_t most_left_out = 10;

/// Values of what is observed in the runs of each group, of groups whose runs all have one.
std::vector<std::vector<double>> groups_of(const RunTable& table, std::size_t observed, std::size_t size) {
    std::vector<std::vector<double>> groups;
    for (std::size_t first = 0; first + size <= table.rows.size(); first += size) {
        std::vector<double> group;
        for (std::size_t k = first; k < first + size; ++k)
            if (table.rows[k].is_good() && std::isfinite(table.rows[k].observed[observed]))
                group.push_back(table.rows[k].observed[observed]);
        if (group.size() == size) groups.push_back(std::move(group));
    }
    return groups;
}

StudiedQuantity studied(const RunTable& table, std::size_t place, std::size_t group, std::size_t worst) {
    StudiedQuantity result{table.observed[place], {}, 0, {}, {}};
    std::vector<double> values;
    std::vector<OutstandingRun> runs;
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
        const RowOfRun& row = table.rows[k];
        if (!row.is_good()) continue;
        const double value = row.observed[place];
        if (!std::isfinite(value)) {
            ++result.missing;
            continue;
        }
        runs.push_back({row.run, value});
        // The other runs of a group share values with these two.
        if (group == 1 || k % group < 2) values.push_back(value);
    }
    result.statistics = statistics_of(std::move(values));
    worst = std::min(worst, runs.size());
    const auto take = [&](auto before) {
        std::partial_sort(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(worst), runs.end(), before);
        return std::vector<OutstandingRun>(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(worst));
    };
    using Run = OutstandingRun;
    result.least = take([](const Run& a, const Run& b) { return std::pair(a.value, a.run) < std::pair(b.value, b.run); });
    result.most = take([](const Run& a, const Run& b) { return std::pair(-a.value, a.run) < std::pair(-b.value, b.run); });
    if (group > 1) result.indices = sobol_indices(groups_of(table, place, group), seed_of_errors);
    return result;
}

std::string runs_text(const std::vector<OutstandingRun>& runs) {
    std::string text;
    for (const OutstandingRun& one : runs) text += fmt::format("{}{:.6g} in run {}", text.empty() ? "" : ", ", one.value, one.run);
    return text;
}

nlohmann::ordered_json json_of(const std::vector<OutstandingRun>& runs) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const OutstandingRun& one : runs) json.push_back({{"run", one.run}, {"value", one.value}});
    return json;
}

}  // namespace

void fill(StudyResult& result, const RunTable& table, std::size_t worst) {
    result.runs = table.study.at("runs").get<std::size_t>();
    result.first = table.shard.first(result.runs);
    result.last = result.first + table.rows.size();
    result.varied = table.varied;
    result.has_indices = table.study.at("indices").get<bool>() && table.shard.is_whole();
    std::map<std::string, std::size_t> statuses;
    for (const RowOfRun& row : table.rows) {
        ++statuses[row.status];
        if (row.is_good()) continue;
        if (++result.left_out_count <= most_left_out) result.left_out.push_back(row.run);
    }
    result.statuses.assign(statuses.begin(), statuses.end());
    const std::size_t group = result.has_indices ? table.varied.size() + 2 : 1;
    for (std::size_t first = 0; group > 1 && first + group <= table.rows.size(); first += group)
        result.groups_left_out += std::any_of(table.rows.begin() + static_cast<std::ptrdiff_t>(first),
                                              table.rows.begin() + static_cast<std::ptrdiff_t>(first + group),
                                              [](const RowOfRun& row) { return !row.is_good(); });
    for (std::size_t i = 0; i < table.observed.size(); ++i) result.observed.push_back(studied(table, i, group, worst));
}

std::string as_text(const StudyResult& result) {
    std::string text = fmt::format("{}, scene {}: {} runs", result.subject.sized_name, result.subject.scene, result.last - result.first);
    if (result.last - result.first < result.runs) text += fmt::format(" of {}, from run {} on", result.runs, result.first);
    if (result.found > 0) text += fmt::format("; {} were there already", result.found);
    text += "\n";
    if (result.statuses.size() > 1 || result.left_out_count > 0)
        for (const auto& [status, count] : result.statuses) text += fmt::format("  {:<24} {}\n", status, count);
    if (result.left_out_count > 0) {
        text += fmt::format("  left out of all statistics are {} runs:", result.left_out_count);
        for (std::size_t i = 0; i < result.left_out.size(); ++i) text += fmt::format("{} {}", i == 0 ? "" : ",", result.left_out[i]);
        text += result.left_out_count > result.left_out.size() ? ", ...\n" : "\n";
    }
    if (result.groups_left_out > 0) text += fmt::format("  and of the indices {} groups of runs\n", result.groups_left_out);
    for (const StudiedQuantity& one : result.observed) {
        if (one.statistics.count == 0 && one.missing == 0) continue;
        text += fmt::format("\n{}\n", one.column.title());
        if (one.missing > 0) text += fmt::format("  {:<20} {} runs\n", "without a value", one.missing);
        if (one.statistics.count == 0) continue;
        text +=
            fmt::format("  {:<20} {:.8g}\n  {:<20} {:.6g}\n", "mean", one.statistics.mean, "standard deviation", one.statistics.deviation);
        text += fmt::format("  {:<20}", "quantiles");
        for (std::size_t i = 0; i < one.statistics.quantiles.size(); ++i)
            text += fmt::format("{} {:g} %: {:.6g}", i == 0 ? "" : ",", 100 * told_quantiles[i], one.statistics.quantiles[i]);
        text += fmt::format("\n  {:<20} {}\n  {:<20} {}\n", "smallest", runs_text(one.least), "largest", runs_text(one.most));
        for (std::size_t i = 0; i < one.indices.size(); ++i)
            text += fmt::format("  {:<20} first order {:7.4f} +- {:.4f}, total {:7.4f} +- {:.4f}\n", result.varied[i].name,
                                one.indices[i].first, one.indices[i].first_error, one.indices[i].total, one.indices[i].total_error);
        if (result.has_indices && one.indices.empty()) text += "  no Sobol indices, because it does not vary\n";
    }
    for (const std::filesystem::path& file : result.files)
        text += fmt::format("{}{}\n", &file == &result.files.front() ? "\n" : "", file.string());
    return text;
}

nlohmann::ordered_json as_json(const StudyResult& result) {
    nlohmann::ordered_json json = json_result("study", result.subject);
    json["runs"] = result.runs;
    json["first"] = result.first;
    json["made"] = result.last - result.first;
    json["found"] = result.found;
    json["statuses"] = nlohmann::ordered_json::array();
    for (const auto& [status, count] : result.statuses) json["statuses"].push_back({{"status", status}, {"runs", count}});
    json["left_out"] = result.left_out_count;
    json["groups_left_out"] = result.groups_left_out;
    json["observed"] = nlohmann::ordered_json::array();
    for (const StudiedQuantity& one : result.observed) {
        nlohmann::ordered_json entry{{"name", one.column.name}, {"unit", one.column.unit},     {"count", one.statistics.count},
                                     {"missing", one.missing},  {"mean", one.statistics.mean}, {"deviation", one.statistics.deviation}};
        entry["quantiles"] = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < one.statistics.quantiles.size(); ++i)
            entry["quantiles"].push_back({{"part", told_quantiles[i]}, {"value", one.statistics.quantiles[i]}});
        entry["smallest"] = json_of(one.least);
        entry["largest"] = json_of(one.most);
        entry["indices"] = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < one.indices.size(); ++i)
            entry["indices"].push_back({{"name", result.varied[i].name},
                                        {"first", one.indices[i].first},
                                        {"first_error", one.indices[i].first_error},
                                        {"total", one.indices[i].total},
                                        {"total_error", one.indices[i].total_error}});
        json["observed"].push_back(std::move(entry));
    }
    json["files"] = json_list(result.files);
    return json;
}

std::string as_text(const RepeatedOfStudy& result) {
    std::string text = fmt::format("{}, scene {}: run {}, {} at t = {:.6g} s\n", result.subject.sized_name, result.subject.scene,
                                   result.row.run, result.row.status, result.row.t);
    const auto add = [&](const std::vector<Column>& columns, const std::vector<double>& values) {
        for (std::size_t i = 0; i < columns.size(); ++i)
            text += fmt::format("  {:<20} {}{}{}\n", columns[i].name, detail::number_text(values[i]), columns[i].unit.empty() ? "" : " ",
                                columns[i].unit);
    };
    add(result.varied, result.row.varied);
    add(result.observed, result.row.observed);
    for (const std::filesystem::path& file : result.files) text += file.string() + "\n";
    return text;
}

nlohmann::ordered_json as_json(const RepeatedOfStudy& result) {
    nlohmann::ordered_json json = json_result("study", result.subject);
    json["run"] = result.row.run;
    json["status"] = result.row.status;
    json["t"] = result.row.t;
    json["values"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < result.varied.size(); ++i) json["values"][result.varied[i].name] = result.row.varied[i];
    json["output"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < result.observed.size(); ++i) json["output"][result.observed[i].name] = result.row.observed[i];
    json["files"] = json_list(result.files);
    return json;
}

}  // namespace dalembert
