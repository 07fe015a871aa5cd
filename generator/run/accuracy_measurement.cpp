// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/accuracy_measurement.hpp"

#include <algorithm>
#include <fstream>

#include "run/accuracy_errors.hpp"
#include "run/run_header.hpp"

namespace dalembert {

struct AccuracyMeasurement::Drawn {
    EdgePoint point;
    std::vector<char> holds;  ///< by mode: the model holds there
};

namespace {

/// Whether no guard says that the model does not hold, and the machine has rates.
bool holds(const Code& code, ExactCode& at) {
    const System& system = code.system;
    const auto is_met = [&](Function function, std::size_t i) {
        const MaybeExact& value = at.at(function, code[function].results[i]);
        return value && !cln::minusp(value->value);
    };
    for (std::size_t i = 0; i < system.guards.size(); ++i)
        if (system.guards[i].ends && !is_met(Function::guards, i)) return false;
    for (std::size_t e = 0; e < system.events.size(); ++e)
        if (system.events[e].ends && system.events[e].is_watched && !is_met(Function::events, e)) return false;
    const std::vector<MaybeExact> rates = at.rates();
    return std::all_of(rates.begin(), rates.end(), [](const MaybeExact& rate) { return rate.has_value(); });
}

}  // namespace

AccuracyMeasurement::AccuracyMeasurement(const Machine& machine, const Header& header)
    : inputs_(ExactCode::inputs(*machine.system)), program_(std::make_unique<ScratchFolder>()) {
    modes_.push_back(machine.code.get());
    for (const Machine& other : machine.other_modes) modes_.push_back(other.code.get());
    for (std::size_t mode = 0; mode < modes_.size(); ++mode) functions_.push_back(measured_functions(modes_, mode));
    compile_with_header(*program_, header, accuracy_source(*machine.system, header, functions_), "-O2");
}

AccuracyMeasurement::~AccuracyMeasurement() = default;

std::vector<AccuracyMeasurement::Drawn> AccuracyMeasurement::draw(const Arithmetic& arithmetic, std::size_t points, std::uint64_t seed,
                                                                  AccuracyReport& report) const {
    EdgePoints edges(modes_.front()->system, inputs_, arithmetic, seed);
    std::vector<ExactCode> at;
    for (const Code* code : modes_) at.emplace_back(*code, digits);
    std::vector<Drawn> drawn;
    constexpr std::size_t most_tries = 10;
    for (std::size_t tries = 0; drawn.size() < points && tries < most_tries * points; ++tries) {
        Drawn one{edges.next(), {}};
        for (std::size_t m = 0; m < modes_.size(); ++m) {
            at[m].set(all_exact(one.point.values));
            one.holds.push_back(holds(*modes_[m], at[m]) ? 1 : 0);
        }
        if (std::find(one.holds.begin(), one.holds.end(), 1) != one.holds.end()) drawn.push_back(std::move(one));
        else ++report.outside;
    }
    report.points = drawn.size();
    return drawn;
}

std::vector<double> AccuracyMeasurement::compute(const Arithmetic& arithmetic, const std::vector<Drawn>& points) const {
    const std::string in = program_->path() + "/points", out = program_->path() + "/results";
    {
        std::ofstream file(in, std::ios::binary);
        for (const Drawn& one : points)
            file.write(reinterpret_cast<const char*>(one.point.values.data()),
                       static_cast<std::streamsize>(one.point.values.size() * sizeof(double)));
    }
    run_compiled(*program_, {arithmetic.name, in, out});
    std::ifstream file(out, std::ios::binary | std::ios::ate);
    std::vector<double> results(static_cast<std::size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(results.data()), static_cast<std::streamsize>(results.size() * sizeof(double)));
    return results;
}

AccuracyReport AccuracyMeasurement::measure(const Arithmetic& arithmetic, std::size_t points, std::uint64_t seed) const {
    AccuracyReport report{&arithmetic};
    const std::vector<Drawn> drawn = draw(arithmetic, points, seed, report);
    const std::vector<double> computed = compute(arithmetic, drawn);
    std::size_t row = 0;
    for (const auto& mode : functions_)
        for (const MeasuredFunction& function : mode) row += function.results.size();
    if (computed.size() != row * drawn.size()) throw std::logic_error("the program gave too few results");
    const std::vector<double> input_sizes = EdgePoints(modes_.front()->system, inputs_, arithmetic, seed).sizes();
    std::size_t offset = 0;
    for (std::size_t m = 0; m < modes_.size(); ++m) {
        const System& system = modes_[m]->system;
        ExactCode at(*modes_[m], digits);
        const std::size_t first = report.functions.size();
        for (const MeasuredFunction& function : functions_[m])
            report.functions.push_back(
                {system.scene.mode ? system.scene.modes[*system.scene.mode].name : "", function.name, function.results.size()});
        std::vector<ErrorsSeen> errors;
        for (std::size_t f = 0; f < functions_[m].size(); ++f) errors.emplace_back(*modes_[m], arithmetic, report.functions[first + f]);
        std::size_t after = offset;
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            if (drawn[k].holds[m] == 0) continue;
            at.set(all_exact(drawn[k].point.values));
            Roundings roundings(at, drawn[k].point.values, arithmetic);
            after = offset;
            for (std::size_t f = 0; f < functions_[m].size(); ++f) {
                const auto& results = functions_[m][f].results;
                std::vector<MaybeExact> expected;
                for (const MeasuredResult& result : results) expected.push_back(result.exact ? result.exact(at) : std::nullopt);
                const std::vector<double> beside = row_norms(results, expected, at, input_sizes);
                for (std::size_t i = 0; i < results.size(); ++i, ++after)
                    if (expected[i]) errors[f](results[i], *expected[i], computed[k * row + after], beside[i], drawn[k].point, roundings);
            }
        }
        for (ErrorsSeen& seen : errors) seen.finish();
        offset = 0;
        for (std::size_t before = 0; before <= m; ++before)
            for (const MeasuredFunction& function : functions_[before]) offset += function.results.size();
    }
    return report;
}

}  // namespace dalembert
