// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/accuracy_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "command/run_header.hpp"

namespace dalembert {

struct AccuracyMeasurement::Drawn {
    EdgePoint point;
    std::vector<char> holds;  ///< by mode: the model holds there
};

namespace {

std::vector<Rational> all_exact(const std::vector<double>& values) {
    std::vector<Rational> result;
    for (const double value : values) result.push_back(exact(value));
    return result;
}

/// Whether no guard says that the model does not hold, and the machine has rates.
bool holds(const Code& code, ExactCode& at) {
    const System& system = code.system;
    const auto is_met = [&](Function function, std::size_t i) {
        const MaybeExact& value = at.at(function, code[function].results[i]);
        return value && !cln::minusp(value->value);
    };
    for (std::size_t i = 0; i < system.fluids.guards.size(); ++i)
        if (system.fluids.guards[i].ends && !is_met(Function::guards, i)) return false;
    for (std::size_t e = 0; e < system.events.size(); ++e)
        if (system.events[e].ends && system.events[e].is_watched && !is_met(Function::events, e)) return false;
    const std::vector<MaybeExact> rates = at.rates();
    return std::all_of(rates.begin(), rates.end(), [](const MaybeExact& rate) { return rate.has_value(); });
}

/// The error of one number, as often as it takes to know the worst.
class ErrorsSeen {
public:
    ErrorsSeen(const Code& code, const Arithmetic& arithmetic, FunctionAccuracy& total) : arithmetic_(arithmetic), total_(total), finer_(code, 2 * AccuracyMeasurement::digits) {}

    void operator()(const MeasuredResult& result, const MaybeExact& expected, double computed, const EdgePoint& point) {
        if (!expected) return;
        const double value = cln::double_approx(expected->value);
        if (!(std::fabs(value) <= arithmetic_.largest)) return;
        const double difference = distance(computed, expected->value);
        const bool is_constant = std::all_of(expected->slopes.begin(), expected->slopes.end(), [](double slope) { return slope == 0; });
        if (is_constant && difference == 0) return;
        ++total_.measured;
        const double plain = difference / arithmetic_.ulp(value);
        const double beyond = difference / (arithmetic_.ulp(value) + by_inputs(*expected, point.values));
        plain_.push_back(plain);
        beyond_.push_back(beyond);
        total_.largest_plain = std::max(total_.largest_plain, plain);
        if (!(beyond <= total_.largest())) consider(result, computed, point);
    }

    void finish() {
        total_.typical_plain = median(plain_);
        total_.typical = median(beyond_);
    }

private:
    static double distance(double computed, const cln::cl_R& expected) {
        if (!std::isfinite(computed)) return std::numeric_limits<double>::infinity();
        return cln::double_approx(cln::abs(exact(computed) - expected));
    }
    static double median(std::vector<double>& values) {
        if (values.empty()) return 0;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }
    double by_inputs(const ExactNumber& number, const std::vector<double>& inputs) const {
        double sum = 0;
        for (std::size_t i = 0; i < number.slopes.size(); ++i)
            if (number.slopes[i] != 0) sum += std::fabs(number.slopes[i]) * arithmetic_.ulp(inputs[i]) / 2;
        return sum;
    }

    /// One that seems the worst is looked at closely: with twice as many digits, and with inputs that are in fact half an ulp off, which matters
    /// where slopes say little: at roots of zero, kinks and jumps.
    void consider(const MeasuredResult& result, double computed, const EdgePoint& point) {
        std::vector<Rational> inputs = all_exact(point.values);
        const auto at = [&]() -> MaybeExact {
            finer_.set(inputs);
            return result.exact(finer_);
        };
        const MaybeExact here = at();
        if (!here) return;
        double spread = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const Rational value = inputs[i];
            const Rational half = exact(arithmetic_.ulp(point.values[i])) / 2;
            double one = 0;
            for (const int side : {1, -1}) {
                inputs[i] = value + side * half;
                const MaybeExact there = at();
                one = std::max(one, there ? cln::double_approx(cln::abs(there->value - here->value)) : std::numeric_limits<double>::infinity());
            }
            inputs[i] = value;
            spread += one;
        }
        const double unit = arithmetic_.ulp(cln::double_approx(here->value)) + std::max(spread, by_inputs(*here, point.values));
        const double difference = distance(computed, here->value);
        const double error = std::isinf(unit) ? 0 : difference / unit;
        if (error > total_.largest()) total_.worst = WorstInput{result.name, point.kind, point.values, computed, here->value, error};
    }

    const Arithmetic& arithmetic_;
    FunctionAccuracy& total_;
    ExactCode finer_;
    std::vector<double> plain_, beyond_;
};

}  // namespace

AccuracyMeasurement::AccuracyMeasurement(const Machine& machine, const Header& header) : inputs_(ExactCode::inputs(*machine.system)), program_(std::make_unique<ScratchFolder>()) {
    modes_.push_back(machine.code.get());
    for (const Machine& other : machine.other_modes) modes_.push_back(other.code.get());
    for (std::size_t mode = 0; mode < modes_.size(); ++mode) functions_.push_back(measured_functions(modes_, mode));
    compile_with_header(*program_, header, accuracy_source(*machine.system, header, functions_), "-O2");
}

AccuracyMeasurement::~AccuracyMeasurement() = default;

std::vector<AccuracyMeasurement::Drawn> AccuracyMeasurement::draw(const Arithmetic& arithmetic, std::size_t points, std::uint64_t seed, AccuracyReport& report) const {
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
        for (const Drawn& one : points) file.write(reinterpret_cast<const char*>(one.point.values.data()), static_cast<std::streamsize>(one.point.values.size() * sizeof(double)));
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
    std::size_t offset = 0;
    for (std::size_t m = 0; m < modes_.size(); ++m) {
        const System& system = modes_[m]->system;
        ExactCode at(*modes_[m], digits);
        const std::size_t first = report.functions.size();
        for (const MeasuredFunction& function : functions_[m]) report.functions.push_back({system.scene.mode ? system.scene.modes[*system.scene.mode].name : "", function.name, function.results.size()});
        std::vector<ErrorsSeen> comparisons;
        for (std::size_t f = 0; f < functions_[m].size(); ++f) comparisons.emplace_back(*modes_[m], arithmetic, report.functions[first + f]);
        std::size_t after = offset;
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            if (drawn[k].holds[m] == 0) continue;
            at.set(all_exact(drawn[k].point.values));
            after = offset;
            for (std::size_t f = 0; f < functions_[m].size(); ++f)
                for (const MeasuredResult& result : functions_[m][f].results) {
                    const double value = computed[k * row + after++];
                    if (result.exact) comparisons[f](result, result.exact(at), value, drawn[k].point);
                }
        }
        for (ErrorsSeen& comparison : comparisons) comparison.finish();
        offset = 0;
        for (std::size_t before = 0; before <= m; ++before)
            for (const MeasuredFunction& function : functions_[before]) offset += function.results.size();
    }
    return report;
}

}  // namespace dalembert
