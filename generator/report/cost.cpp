// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/cost.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/json_output.hpp"
#include "report/precision_table.hpp"

namespace dalembert {

namespace {

std::string reference_text(const ReferenceRun& reference) {
    std::string text = fmt::format("reference: {}, its own error {}", name_of(reference.plan), error_text(reference));
    if (!reference.closed_forms.empty()) text += fmt::format("; of {} closed forms", fmt::join(reference.closed_forms, ", "));
    text += reference.growth ? fmt::format("; a disturbance of the start grows {:.2g}-fold", *reference.growth)
                             : "; the growth of a disturbance of the start is not known";
    if (reference.is_sensitive()) text += fmt::format(": errors count up to t = {:.4g} s, before it hides them", reference.until());
    return text + "\n";
}

/// The cheapest way to an error.
std::string advice(const MeasuredMachine& m, double error) {
    const WorkPoint* best = cheapest(m.points, error);
    if (best == nullptr) return fmt::format("error {:.0e}: not reached\n", error);
    std::string text = fmt::format("error {:.0e}: {}: {:.3g} us per simulated second (up to {:.3g}), {} right-hand sides", error,
                                   name_of(best->plan), best->fastest / m.until, best->slowest / m.until, best->rhs_calls);
    const WorkPoint* usual = cheapest(m.points, error, "double", m.usual_method);
    if (usual != nullptr && usual != best)
        text += fmt::format("; {} takes {:.2g} times as long", name_of(usual->plan), usual->fastest / best->fastest);
    return text + "\n";
}

/// Which method to take for which accuracy.
std::string advice(const MeasuredMachine& m) {
    std::string text = reference_text(m.reference);
    for (const double error : wanted_errors) text += advice(m, error);
    for (const char* arithmetic : arithmetics)
        if (const WorkPoint* best = most_accurate(m.points, arithmetic)) {
            const std::string name = name_of(best->plan);
            const std::size_t comma = name.find(',');
            text += fmt::format("{} no better than {:.1e}:{}\n", name.substr(0, comma), best->error, name.substr(comma + 1));
        }
    if (!m.reference.is_sensitive()) return text;
    if (const WorkPoint* best = cheapest(m.points, 1e-6, "double"))
        text += fmt::format("over the whole run, up to t = {:.4g} s, {} keeps the energy to {:.1e}\n", best->t, name_of(best->plan),
                            best->energy_error);
    return text;
}

nlohmann::ordered_json as_json(const ReferenceRun& reference) {
    return {{"arithmetic", reference.plan.arithmetic},
            {"method", reference.plan.method},
            {"tolerance", reference.plan.tolerance},
            {"error", reference.error},
            {"closed_forms", reference.closed_forms},
            {"growth", reference.growth ? nlohmann::ordered_json(*reference.growth) : nlohmann::ordered_json()},
            {"counted_until", reference.until()}};
}

nlohmann::ordered_json as_json(const WorkPoint& p) {
    return {{"arithmetic", p.plan.arithmetic},
            {"method", p.plan.method},
            {"tolerance", p.plan.tolerance},
            {"step", p.plan.step},
            {"status", p.status},
            {"good", p.is_good},
            {"steps", p.steps},
            {"rejected", p.rejected},
            {"rhs_calls", p.rhs_calls},
            {"microseconds", {{"median", p.microseconds}, {"lowest", p.fastest}, {"highest", p.slowest}}},
            {"error_at_end", p.error_at_end},
            {"error_on_the_way", p.error},
            {"energy_error", p.energy_error},
            {"constraint_error", p.constraint_error}};
}

nlohmann::ordered_json as_json(const MeasuredMachine& m) {
    nlohmann::ordered_json json{
        {"model", m.model}, {"scene", m.scene}, {"size", m.size}, {"states", m.states}, {"from_fullest", m.from_fullest}};
    json["reference"] = as_json(m.reference);
    json["runs"] = nlohmann::ordered_json::array();
    for (const WorkPoint& p : m.points) json["runs"].push_back(as_json(p));
    json["cheapest"] = nlohmann::ordered_json::array();
    for (const double error : wanted_errors)
        if (const WorkPoint* best = cheapest(m.points, error)) {
            const WorkPoint* usual = cheapest(m.points, error, "double", "dopri5");
            nlohmann::ordered_json row{{"error", error}, {"arithmetic", best->plan.arithmetic}, {"method", best->plan.method},
                                       {"tolerance", best->plan.tolerance}, {"step", best->plan.step}, {"microseconds", best->fastest}};
            if (usual != nullptr) row["share_of_dopri5"] = best->fastest / usual->fastest;
            json["cheapest"].push_back(std::move(row));
        }
    return json;
}

/// One line a machine: the cheapest way to each accuracy, in units of dopri5 in double.
std::string summary_line(const MeasuredMachine& m, std::size_t width) {
    std::string text = fmt::format("{:<{}}  {:>6}", m.name, width, m.states);
    for (const double error : wanted_errors) {
        const WorkPoint* best = cheapest(m.points, error);
        const WorkPoint* usual = cheapest(m.points, error, "double", "dopri5");
        std::string cell = "not reached";
        if (best != nullptr) {
            cell = best->plan.method;
            if (best->plan.step <= 0) cell += fmt::format(" {:.0e}", best->plan.tolerance);
            if (best->plan.arithmetic != "double") cell += " in " + best->plan.arithmetic;
            if (usual != nullptr) cell += fmt::format(", {:.2f}", best->fastest / usual->fastest);
        }
        text += fmt::format("  {:<30}", cell);
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string summary(const std::vector<MeasuredMachine>& all) {
    std::size_t width = 8;
    for (const MeasuredMachine& m : all) width = std::max(width, m.name.size());
    std::string text = fmt::format("{:<{}}  {:>6}", "machine", width, "states");
    for (const double error : wanted_errors) text += fmt::format("  {:<30}", fmt::format("cheapest for {:.0e}", error));
    text = text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
    for (const MeasuredMachine& m : all) text += summary_line(m, width);
    return text +
           "behind each method and tolerance: its time divided by that of dopri5 in double for the same accuracy, if dopri5 was measured "
           "and reaches it\n";
}

}  // namespace

std::string as_text(const CostResult& result) {
    std::string text;
    for (const MeasuredMachine& m : result.machines) {
        text += fmt::format("{}\n{}", m.name, advice(m));
        if (m.from_fullest > 0)
            text += fmt::format("off by {:.1e} from the fullest scene in the finest size, whatever the integrator\n", m.from_fullest);
        text += "\n";
    }
    if (result.machines.size() > 1) text += summary(result.machines) + "\n";
    for (const std::filesystem::path& file : result.files) text += file.string() + "\n";
    return text;
}

nlohmann::ordered_json as_json(const CostResult& result) {
    nlohmann::ordered_json json = json_result("cost");
    json["machines"] = nlohmann::ordered_json::array();
    for (const MeasuredMachine& m : result.machines) json["machines"].push_back(as_json(m));
    json["files"] = json_list(result.files);
    return json;
}

}  // namespace dalembert
