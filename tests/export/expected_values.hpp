// SPDX-License-Identifier: GPL-3.0-or-later
// What the table of a plant says that exported functions are: values and whole Jacobians, and products with them.
#pragma once

#include <dalembert/plant.h>

#include "export/loaded_function.hpp"

/// The values of a function of u, x and p at a point.
struct Point {
    Vector x, u, p;
    double t = 0;
};

class ExpectedValues {
public:
    ExpectedValues(const dalembert_plant& of, unsigned mode) : table(of), mode_(mode), self_(table.create()) {}
    ~ExpectedValues() { table.destroy(self_); }
    ExpectedValues(const ExpectedValues&) = delete;

    std::size_t states() const { return table.states; }
    std::size_t inputs() const { return table.inputs; }
    std::size_t outputs() const { return table.outputs; }
    std::size_t parameters() const { return table.parameters; }

    void at(const Point& q) {
        const std::size_t n = states(), m = inputs(), l = outputs();
        table.set_parameters(self_, q.p.data());
        rates = Vector(n), by_time = Vector(n, 0.0), y = Vector(l);
        C = Vector(l * n), D = Vector(l * m);
        Vector J(n * n), B(n * m), P(n * parameters());
        table.rhs_and_jacobian(self_, mode_, q.x.data(), q.u.data(), q.t, rates.data(), J.data());
        by_x = spread(table.pattern_x, J, n);
        if (m > 0) table.jacobian_u(self_, mode_, q.x.data(), q.u.data(), q.t, B.data());
        by_u = spread(table.pattern_u, B, m);
        if (parameters() > 0) table.jacobian_p(self_, mode_, q.x.data(), q.u.data(), q.t, P.data());
        by_p = spread(table.pattern_p, P, parameters());
        if (table.jacobian_t != nullptr) table.jacobian_t(self_, mode_, q.x.data(), q.u.data(), q.t, by_time.data());
        rates_with_jacobian = rates;
        table.rhs(self_, mode_, q.x.data(), q.u.data(), q.t, rates.data());
        if (l == 0) return;
        table.output(self_, mode_, q.x.data(), q.u.data(), q.t, y.data());
        table.output_jacobian_x(self_, mode_, q.x.data(), q.u.data(), q.t, C.data());
        if (m > 0) table.output_jacobian_u(self_, mode_, q.x.data(), q.u.data(), q.t, D.data());
    }
    /// dy/d(parameter), or behind the last one dy/dt, by differences of fourth order, and how far a step of half the length is from it.
    std::pair<Vector, Vector> slopes_of_outputs(const Point& q, std::size_t parameter) {
        const auto difference = [&](double h) {
            Vector sum(outputs(), 0.0);
            for (const auto& [step, weight] : {std::pair(-2.0, 1.0), std::pair(-1.0, -8.0), std::pair(1.0, 8.0), std::pair(2.0, -1.0)}) {
                Point there = q;
                (parameter < parameters() ? there.p[parameter] : there.t) += step * h;
                Vector values(outputs());
                table.set_parameters(self_, there.p.data());
                table.output(self_, mode_, there.x.data(), there.u.data(), there.t, values.data());
                for (std::size_t i = 0; i < values.size(); ++i) sum[i] += weight * values[i] / (12.0 * h);
            }
            return sum;
        };
        const double at = parameter < parameters() ? q.p[parameter] : q.t, h = 1e-3 * (at == 0 ? 1.0 : std::abs(at));
        Vector coarse = difference(h), fine = difference(h / 2);
        for (std::size_t i = 0; i < fine.size(); ++i) coarse[i] = std::abs(coarse[i] - fine[i]);
        return {fine, coarse};
    }
    Vector start(const Vector& p) {
        Vector x(states());
        table.set_parameters(self_, p.data());
        table.start_state(self_, x.data());
        return x;
    }

    bool is_finite() const { return std::all_of(rates.begin(), rates.end(), [](double v) { return std::isfinite(v); }); }

    const dalembert_plant& table;
    Vector rates_with_jacobian;  ///< as rhs_and_jacobian() computes them, in another order of operations
    Vector rates, by_x, by_u, by_p, by_time, y, C, D;  ///< matrices with all entries, column by column

private:
    Vector spread(const dalembert_pattern& pattern, const Vector& stored, std::size_t columns) const {
        Vector all = stored;
        if (pattern.column_starts == nullptr) return all;
        std::fill(all.begin(), all.end(), 0.0);
        for (std::size_t c = 0; c < columns; ++c)
            for (std::size_t i = pattern.column_starts[c]; i < pattern.column_starts[c + 1]; ++i)
                all[c * states() + pattern.row_indices[i]] = stored[i];
        return all;
    }

    unsigned mode_;
    void* self_;
};

/// A*v, and A'*w; A with all entries, column by column.
inline Vector product(const Vector& A, const Vector& v, std::size_t rows) {
    Vector result(rows, 0.0);
    for (std::size_t c = 0; c < v.size(); ++c)
        for (std::size_t r = 0; r < rows; ++r) result[r] += A[c * rows + r] * v[c];
    return result;
}
inline Vector transposed_product(const Vector& A, const Vector& w, std::size_t columns) {
    Vector result(columns, 0.0);
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t r = 0; r < w.size(); ++r) result[c] += A[c * w.size() + r] * w[r];
    return result;
}
inline Vector sum(Vector a, const Vector& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
}
inline Vector negative(Vector a) {
    for (double& value : a) value = -value;
    return a;
}

/// How many numbers were compared.
inline std::size_t& compared() {
    static std::size_t count = 0;
    return count;
}

/// `size`: of the terms that were added up, where these can be larger than their sum.
inline void same(const std::string& of, const Vector& found, const Vector& expected, double tolerance = 1e-14, double size = 0) {
    require(found.size() == expected.size(), of + ": " + std::to_string(found.size()) + " numbers, not " + std::to_string(expected.size()));
    for (const double value : expected)
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < found.size(); ++i) {
        ++compared();
        if (!std::isfinite(expected[i])) {
            require(!std::isfinite(found[i]), of + ": finite where the plant is not");
            continue;
        }
        char text[100];
        std::snprintf(text, sizeof text, "[%zu]: %.17g, not %.17g", i, found[i], expected[i]);
        require(std::abs(found[i] - expected[i]) <= tolerance * size, of + text);
    }
}
/// The size of the terms of a product.
inline double size_of(const Vector& A, const Vector& v) {
    double a = 0, b = 0;
    for (const double value : A) a = std::max(a, std::isfinite(value) ? std::abs(value) : 0);
    for (const double value : v) b = std::max(b, std::abs(value));
    return a * b;
}
