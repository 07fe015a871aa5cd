// SPDX-License-Identifier: GPL-3.0-or-later
// On the desk: judges what the board answered.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "host_points.hpp"

/// max |a - b|/max |b| over the entries from `first` to `last`; infinite where something is not finite.
template <class Reference>
double relative_error(const std::vector<float>& computed, const Reference& reference, std::size_t first, std::size_t last) {
    long double difference = 0, size = 0;
    for (std::size_t i = first; i < last; ++i) {
        if (!std::isfinite(computed[i]) || !std::isfinite(reference[i])) return std::numeric_limits<double>::infinity();
        difference = std::max(difference, std::abs(static_cast<long double>(computed[i]) - reference[i]));
        size = std::max(size, std::abs(reference[i]));
    }
    return difference == 0 ? 0 : static_cast<double>(difference / size);
}

/// What the board answered for one function at one point.
struct Answer {
    double instructions = 0, stack = 0;
    std::vector<float> values;
};

/// Gates: each names what failed and where, and the whole fails.
class Gates {
public:
    explicit Gates(std::string name) : name_(std::move(name)) {}
    template <class... Arguments>
    void fail(const char* format, Arguments... arguments) {
        std::fprintf(stderr, "%s: ", name_.c_str());
        std::fprintf(stderr, format, arguments...);
        std::fprintf(stderr, "\n");
        passed = false;
    }
    bool passed = true;

private:
    std::string name_;
};

inline std::vector<Answer> answers(const std::string& path, const std::string& what, std::size_t size, Gates& gates) {
    std::vector<Answer> result;
    std::ifstream in(path);
    bool ended = false;
    for (std::string line, word; std::getline(in, line);) {
        std::istringstream words(line);
        words >> word;
        ended = word == "end";
        if (word != what && word != "known") continue;
        Answer answer;
        double point = 0;
        words >> point >> answer.instructions >> answer.stack;
        for (std::uint32_t bits = 0; words >> std::hex >> bits;) {
            float value;
            std::memcpy(&value, &bits, sizeof value);
            answer.values.push_back(value);
        }
        if (word == what) result.push_back(answer);
        else if (answer.instructions != point) gates.fail("instructions are not counted right: %.0f for code of %.0f", answer.instructions, point);
    }
    const auto is_short = [size](const Answer& answer) { return answer.values.size() != size; };
    if (!ended || result.size() != point_count || std::any_of(result.begin(), result.end(), is_short)) gates.fail("the board did not come to its end; it wrote %s", path.c_str());
    result.resize(point_count);
    return result;
}

/// Pivots of M = L D L', row by row, that are not the same at all points: each of them costs a division in every step. Constraints border
/// M, and have a pivot each.
template <class System>
int changing_pivots(const std::vector<Eigen::MatrixXd>& matrices) {
    std::vector<Eigen::VectorXd> pivots;
    for (Eigen::MatrixXd M : matrices) {
        for (Eigen::Index k = 0; k < M.rows(); ++k)
            for (Eigen::Index i = k + 1; i < M.rows(); ++i) M.row(i).tail(M.rows() - k - 1) -= M(i, k) / M(k, k) * M.row(k).tail(M.rows() - k - 1);
        pivots.push_back(M.diagonal());
    }
    int count = 0;
    for (Eigen::Index k = 0; k < pivots[0].size(); ++k)
        count += std::any_of(pivots.begin(), pivots.end(), [&](const auto& d) { return std::abs(d[k] - pivots[0][k]) > 1e-9 * std::abs(d[k]); });
    if constexpr (dalembert::detail::needs_projection<System>) count += static_cast<int>(System::constraint_table().size());
    return count;
}

/// Gates on what the board wrote, and the numbers of a row: degrees of freedom, stack, largest error of the rates and
/// what is allowed there, largest error of the Jacobian, changing pivots.
template <template <class> class System, template <class> class Parameters>
int judge(const std::string& path, const std::string& name) {
    using Exact = System<long double>;
    Gates gates(name);
    const Exact system(float_parameters<long double, Parameters>());
    const auto table = points<System, Parameters>();
    const auto rates = answers(path, "rhs", std::tuple_size_v<typename Exact::State>, gates), jacobians = answers(path, "jacobian", std::tuple_size_v<typename Exact::JacobianX>, gates);
    const auto use = [&system](auto member, auto&&... arguments) { (system.*member)(arguments...); };
    const auto deepest = [](const auto& all) { return std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.stack < b.stack; })->stack; };
    std::size_t coordinates = Exact::degrees;
    if constexpr (dalembert::detail::needs_projection<Exact>) coordinates = Exact::velocity_place;
    double worst = -1, allowed = 0, worst_jacobian = 0;
    std::vector<Eigen::MatrixXd> matrices;
    for (std::size_t k = 0; k < point_count && gates.passed; ++k) {
        const auto x = converted<typename Exact::State>(table[k].x);
        const auto u = converted<typename Exact::Input>(table[k].u);
        const long double t = table[k].t;
        typename Exact::State dxdt{};
        typename Exact::JacobianX J{};
        typename Exact::MassMatrix M{};
        with_mode(use, &Exact::rhs_and_jacobian, table[k].mode, x, u, t, dxdt, J);
        with_mode(use, &Exact::mass_matrix, table[k].mode, x, t, M);
        constexpr auto n = static_cast<Eigen::Index>(Exact::degrees);
        matrices.push_back(Eigen::Map<const Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>>(M.data(), n, n).template cast<double>());
        double limit = 4e-6;
        if (n > 5) {
            const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrices.back(), Eigen::EigenvaluesOnly).eigenvalues();
            limit = 16 * static_cast<double>(std::numeric_limits<float>::epsilon()) * values.maxCoeff() / values.minCoeff();
        }
        // Accelerations beside the largest acceleration: rates of coordinates may be far larger, and are copied.
        const double error = std::max(relative_error(rates[k].values, dxdt, 0, coordinates), relative_error(rates[k].values, dxdt, coordinates, dxdt.size()));
        const double error_jacobian = relative_error(jacobians[k].values, J, 0, J.size());
        worst_jacobian = std::max(worst_jacobian, error_jacobian);
        if (!(error <= limit)) gates.fail("rhs at point %zu: the relative error is %.1e, allowed are %.1e", k, error, limit);
        if (!(error_jacobian <= limit)) gates.fail("Jacobian at point %zu: the relative error is %.1e, allowed are %.1e", k, error_jacobian, limit);
        if (worst < 0 || error * allowed > worst * limit) worst = error, allowed = limit;
    }
    if (gates.passed)
        std::printf("%zu %.0f %.0f %.2g %.2g %.2g %d\n", Exact::degrees, deepest(rates), deepest(jacobians), worst, allowed, worst_jacobian, changing_pivots<Exact>(matrices));
    return gates.passed ? 0 : 1;
}
