// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/accuracy_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

double distance(double computed, const cln::cl_R& expected) {
    if (!std::isfinite(computed)) return std::numeric_limits<double>::infinity();
    return cln::double_approx(cln::abs(exact(computed) - expected));
}

double median(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double size(const MaybeExact& value) { return value ? std::fabs(cln::double_approx(value->value)) : 0; }

}  // namespace

std::vector<Rational> all_exact(const std::vector<double>& values) {
    std::vector<Rational> result;
    for (const double value : values) result.push_back(exact(value));
    return result;
}

double Roundings::by_inputs(const ExactNumber& number) const {
    double sum = 0;
    for (std::size_t i = 0; i < std::min(inputs_.size(), number.slopes.size()); ++i)
        if (number.slopes[i] != 0) sum += std::fabs(number.slopes[i]) * arithmetic_.ulp(inputs_[i]) / 2;
    return sum;
}

double Roundings::operator()(const MeasuredResult& result, const ExactNumber& number) {
    const std::size_t first = inputs_.size() + unknowns();
    double sum = by_motion(result.solves, number);
    for (std::size_t i = first; result.column_of && i < number.slopes.size(); ++i)
        if (number.slopes[i] != 0) sum += std::fabs(number.slopes[i]) * of(*result.column_of, result.column)[i - first];
    return sum;
}

double Roundings::by_motion(Function solves, const ExactNumber& number) {
    double sum = 0;
    for (std::size_t i = inputs_.size(); i < std::min(inputs_.size() + unknowns(), number.slopes.size()); ++i)
        if (number.slopes[i] != 0) sum += std::fabs(number.slopes[i]) * of(solves, std::nullopt)[i - inputs_.size()];
    return sum;
}

const std::vector<double>& Roundings::of(Function function, std::optional<std::size_t> column) {
    const auto [known, is_new] = known_.try_emplace({function, column});
    if (!is_new) return known->second;
    const auto uncertainty = [&](const ExactNumber& number) { return by_inputs(number) + (column ? by_motion(Function::rhs, number) : 0); };
    known->second = at_.rounding(function, column, [this](double value) { return arithmetic_.ulp(value); }, uncertainty);
    return known->second;
}

std::vector<double> row_norms(const std::vector<MeasuredResult>& results, const std::vector<MaybeExact>& values, ExactCode& at,
                              const std::vector<double>& input_sizes) {
    std::vector<double> norms(results.size(), 0);
    if (results.empty() || !results.front().row) return norms;
    std::map<std::size_t, double> rows;
    const std::vector<MaybeExact> rates = at.rates();
    for (std::size_t i = 0; i < results.size(); ++i) {
        double& norm = rows[*results[i].row];
        norm = std::max(norm, size(values[i]) * input_sizes[results[i].input]);
        if (results[i].is_of_rate) norm = std::max(norm, size(rates[*results[i].row]));
    }
    for (std::size_t i = 0; i < results.size(); ++i) norms[i] = rows[*results[i].row] / input_sizes[results[i].input];
    return norms;
}

void ErrorsSeen::operator()(const MeasuredResult& result, const ExactNumber& expected, double computed, double norm, const EdgePoint& point,
                            Roundings& roundings) {
    const double value = cln::double_approx(expected.value);
    if (!(std::fabs(value) <= arithmetic_.largest)) return;
    const double difference = distance(computed, expected.value);
    const bool is_constant = std::all_of(expected.slopes.begin(), expected.slopes.end(), [](double slope) { return slope == 0; });
    if (is_constant && difference == 0) return;
    ++total_.measured;
    const double by_roundings = roundings(result, expected);
    const Seen seen{computed, norm, roundings.by_inputs(expected) + by_roundings, by_roundings};
    const double plain = difference / arithmetic_.ulp(value);
    const double beyond = difference / (arithmetic_.ulp(std::max(std::fabs(value), norm)) + seen.by_condition);
    plain_.push_back(plain);
    beyond_.push_back(beyond);
    total_.largest_plain = std::max(total_.largest_plain, plain);
    if (!(beyond <= total_.largest())) consider(result, seen, point);
}

void ErrorsSeen::finish() {
    total_.typical_plain = median(plain_);
    total_.typical = median(beyond_);
}

/// One that seems the worst is looked at closely: with twice as many digits, and with inputs that are in fact half an ulp off, which
/// matters where slopes say little: at roots of zero, kinks and jumps.
void ErrorsSeen::consider(const MeasuredResult& result, const Seen& seen, const EdgePoint& point) {
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
    const double unit = arithmetic_.ulp(std::max(size(here), seen.norm)) + std::max(seen.by_condition, spread + seen.by_roundings);
    const double error = std::isinf(unit) ? 0 : distance(seen.computed, here->value) / unit;
    if (error > total_.largest()) total_.worst = WorstInput{result.name, point.kind, point.values, seen.computed, here->value, error};
}

}  // namespace dalembert
