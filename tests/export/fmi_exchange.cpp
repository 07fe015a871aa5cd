// SPDX-License-Identifier: GPL-3.0-or-later
#include "fmi_exchange.hpp"

#include <algorithm>
#include <limits>

namespace fmi_test {

namespace {

/// Solves A x = b for many b; A is given column by column.
class Elimination {
public:
    Elimination(Vector a, std::size_t n) : a_(std::move(a)), rows_(n), n_(n) {
        for (std::size_t k = 0; k < n_; ++k) {
            std::size_t best = k;
            for (std::size_t i = k; i < n_; ++i)
                if (std::abs(at(i, k)) > std::abs(at(best, k))) best = i;
            rows_[k] = best;
            for (std::size_t j = 0; j < n_ && best != k; ++j) std::swap(at(k, j), at(best, j));
            for (std::size_t i = k + 1; i < n_; ++i) at(i, k) /= at(k, k);
            for (std::size_t j = k + 1; j < n_; ++j)
                for (std::size_t i = k + 1; i < n_; ++i) at(i, j) -= at(i, k) * at(k, j);
        }
    }
    void solve(Vector& b) const {
        for (std::size_t k = 0; k < n_; ++k) {
            std::swap(b[k], b[rows_[k]]);
            for (std::size_t i = k + 1; i < n_; ++i) b[i] -= at(i, k) * b[k];
        }
        for (std::size_t k = n_; k-- > 0;) {
            b[k] /= at(k, k);
            for (std::size_t i = 0; i < k; ++i) b[i] -= at(i, k) * b[k];
        }
    }

private:
    double& at(std::size_t i, std::size_t j) { return a_[j * n_ + i]; }
    double at(std::size_t i, std::size_t j) const { return a_[j * n_ + i]; }
    Vector a_;
    std::vector<std::size_t> rows_;
    std::size_t n_;
};

class Exchange {
public:
    Exchange(Instance& fmu, const Description& d, const RunWish& wish)
        : fmu_(fmu), d_(d), wish_(wish), n_(d.derivatives.size()), x_(n_), dxdt_(n_), largest_(n_, 0) {
        result_.is_stiff = wish.is_stiff;
    }

    Trajectory run() {
        if (!pass_event(false)) return std::move(result_);
        output();
        const double longest = d_.indicators > 0 ? wish_.until / 200 : wish_.until;
        double h = std::min(longest, wish_.until * 1e-4);
        std::size_t next = 1, rejected_in_row = 0;
        while (next <= wish_.intervals) {
            const double goal = wish_.until * double(next) / double(wish_.intervals);
            if (++result_.steps > (wish_.is_stiff ? 200000U : 100000U)) return fail("too many steps");
            const double stop = std::min(goal, next_event_);
            const bool is_last = t_ + h * (1 + 1e-10) >= stop;
            const double used = is_last ? stop - t_ : h;
            Vector y;
            double error = 0;
            const bool is_made = make_step(used, y, error, true) && evaluate_indicators(t_ + used, y);
            if (!is_made || !(error <= 1)) {
                h = is_made && std::isfinite(error) ? used * std::max(0.2, 0.8 * std::pow(error, -1.0 / order())) : used / 4;
                if (++rejected_in_row > 200 || h < 1e-15 * std::max(1.0, t_)) return fail("the step is too small");
                continue;
            }
            rejected_in_row = 0;
            double made = used;
            const bool has_event = differs(z_, z_new_);
            if (has_event && !locate(made, y)) return fail("the event is not found");
            t_ = has_event ? t_ + made : (is_last ? stop : t_ + used);
            const bool is_time_event = t_ >= next_event_;
            x_ = y;
            for (std::size_t i = 0; i < n_; ++i) largest_[i] = std::max(largest_[i], std::abs(x_[i]));
            if (!set(t_, x_)) return fail("the state is not taken");
            bool wants_events = false, is_over = false;
            if (fmu_.completed(wants_events, is_over) != ok) return fail("the step is not completed");
            if (is_over) return end();
            if (has_event || wants_events || is_time_event) {
                if (wants_events && !has_event) ++projections_;
                if (!pass_event(true)) return std::move(result_);
                if (has_event && ++at_once_ > 100 && t_ - last_event_ < 1e-12 * std::max(1.0, t_)) return fail("an event storm");
                if (t_ - last_event_ > 1e-9 * wish_.until) at_once_ = 0;
                if (has_event) last_event_ = t_;
                if (has_event) h = std::min(h, wish_.until * 1e-4);
            } else {
                z_ = z_new_;
                fmu_.rates(dxdt_);
            }
            if (!has_event)
                h = std::min(longest, std::max(h, used) * std::clamp(0.8 * std::pow(std::max(error, 1e-10), -1.0 / order()), 0.2, 4.0));
            if (t_ >= goal) {
                output();
                ++next;
            }
        }
        return std::move(result_);
    }

private:
    double order() const { return wish_.is_stiff ? 7 : 5; }

    /// Notes where the run stops. Always false.
    bool stop(const std::string& why) {
        result_.failure = why;
        output();
        return false;
    }
    Trajectory fail(const std::string& why) { return stop(why), std::move(result_); }
    Trajectory end() { return fail(""); }
    void output() {
        result_.t.push_back(t_);
        result_.x.push_back(x_);
    }

    bool set(double t, const Vector& x) { return fmu_.set_time(t) == ok && (n_ == 0 || fmu_.set_states(x) == ok); }
    bool rates(double t, const Vector& x, Vector& f) {
        f.resize(n_);
        return set(t, x) && fmu_.rates(f) == ok;
    }
    bool evaluate_indicators(double t, const Vector& x) {
        z_new_.resize(d_.indicators);
        return set(t, x) && fmu_.indicators(z_new_) == ok;
    }
    static bool differs(const Vector& a, const Vector& b) {
        for (std::size_t i = 0; i < a.size(); ++i)
            if ((a[i] > 0) != (b[i] > 0)) return true;
        return false;
    }

    double norm(const Vector& difference, const Vector& y, double h) const {
        double result = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const double size = std::max({std::abs(x_[i]), std::abs(y[i]), largest_[i], std::abs(h * dxdt_[i]), 1e-9});
            const double one = std::abs(difference[i]) / (size * wish_.tolerance);
            if (!(one <= result)) result = one;
        }
        return result;
    }

    bool make_step(double h, Vector& y, double& error, bool wants_error) {
        return wish_.is_stiff ? implicit(h, y, error, wants_error) : dormand_prince(h, y, error);
    }

    bool dormand_prince(double h, Vector& y, double& error) {
        static constexpr double a[7][6] = {{},
                                           {1.0 / 5},
                                           {3.0 / 40, 9.0 / 40},
                                           {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                           {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                           {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                           {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
        static constexpr double c[7] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
        static constexpr double e[7] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
        Vector k[7];
        k[0] = dxdt_;
        for (int s = 1; s < 7; ++s) {
            y = x_;
            for (int r = 0; r < s; ++r)
                for (std::size_t i = 0; i < n_; ++i) y[i] += h * a[s][r] * k[r][i];
            if (!rates(t_ + c[s] * h, y, k[s])) return false;
        }
        Vector difference(n_, 0);
        for (int s = 0; s < 7; ++s)
            for (std::size_t i = 0; i < n_; ++i) difference[i] += h * e[s] * k[s][i];
        error = norm(difference, y, h);
        return true;
    }

    bool jacobian(Vector& J) {
        J.assign(n_ * n_, 0);
        const References rows = d_.rates(), columns = d_.states();
        for (std::size_t j = 0; j < n_; ++j) {
            Vector column;
            if (fmu_.directional(rows, {columns[j]}, {1}, column) != ok) return false;
            std::copy(column.begin(), column.end(), J.begin() + long(j * n_));
        }
        return true;
    }

    /// Linearly implicit Euler steps, 1 to 7 of them, extrapolated.
    bool implicit(double h, Vector& y, double& error, bool is_new) {
        constexpr std::size_t columns = 7;
        if (is_new && (!set(t_, x_) || !jacobian(J_))) return false;
        std::vector<Vector> table;
        for (std::size_t j = 1; j <= columns; ++j) {
            const double part = h / double(j);
            Vector matrix(n_ * n_);
            for (std::size_t i = 0; i < n_ * n_; ++i) matrix[i] = -part * J_[i];
            for (std::size_t i = 0; i < n_; ++i) matrix[i * n_ + i] += 1;
            const Elimination solve(matrix, n_);
            Vector at = x_, f;
            for (std::size_t s = 1; s <= j; ++s) {
                if (!rates(t_ + part * double(s), at, f)) return false;
                for (double& value : f) value *= part;
                solve.solve(f);
                for (std::size_t i = 0; i < n_; ++i) at[i] += f[i];
            }
            // Row j of the table, over that of j - 1.
            std::vector<Vector> row{at};
            for (std::size_t l = 1; l < j; ++l) {
                Vector next(n_);
                const double factor = double(j) / double(j - l) - 1;
                for (std::size_t i = 0; i < n_; ++i) next[i] = row[l - 1][i] + (row[l - 1][i] - table[l - 1][i]) / factor;
                row.push_back(next);
            }
            if (j == columns) {
                y = row[j - 1];
                Vector difference(n_);
                for (std::size_t i = 0; i < n_; ++i) difference[i] = row[j - 1][i] - row[j - 2][i];
                error = norm(difference, y, h);
            }
            table = row;
        }
        return true;
    }

    /// The end of the shortest step behind which an indicator has changed, by bisection.
    bool locate(double& h, Vector& y) {
        double low = 0, high = h, error = 0;
        for (int i = 0; i < 200 && high - low > 1e-15 * std::max(1.0, std::abs(t_)); ++i) {
            const double middle = (low + high) / 2;
            if (middle <= low || middle >= high || t_ + middle == t_) break;
            Vector trial;
            if (!make_step(middle, trial, error, false) || !evaluate_indicators(t_ + middle, trial) || differs(z_, z_new_)) high = middle;
            else low = middle;
        }
        h = high;
        return make_step(h, y, error, false);
    }

    /// Event mode, and back to continuous time. False if the run is over.
    bool pass_event(bool enters) {
        const auto mode = d_.mode();
        const long before = mode ? fmu_.mode(*mode) : -1;
        if (enters && fmu_.enter_events() != ok) return stop("event mode is not entered");
        News news;
        for (int i = 0; i == 0 || (news.again && i < 100); ++i)
            if (fmu_.update(news) != ok) return stop("the event fails: " + (messages().empty() ? "" : messages().back()));
        if (news.next <= t_) return stop("the next time event lies behind");
        next_event_ = news.next;
        if (n_ > 0 && fmu_.states(x_) != ok) return stop("there are no states");
        if (enters) ++result_.events;
        const long after = mode ? fmu_.mode(*mode) : -1;
        if (after != before) result_.changes.push_back({t_, before, after});
        if (news.over) {
            result_.is_over = true;
            return stop("");
        }
        if (fmu_.enter_continuous() != ok) return stop("continuous time is not entered");
        z_.resize(d_.indicators);
        if (!set(t_, x_)) return stop("the state is not taken");
        if (fmu_.indicators(z_) != ok || fmu_.rates(dxdt_) != ok) return stop("no rates at the start");
        return true;
    }

    Instance& fmu_;
    const Description& d_;
    const RunWish& wish_;
    std::size_t n_;
    double t_ = 0, last_event_ = -1, next_event_ = std::numeric_limits<double>::infinity();
    std::size_t at_once_ = 0, projections_ = 0;
    Vector x_, dxdt_, largest_, z_, z_new_, J_;
    Trajectory result_;
};

}  // namespace

Trajectory run_exchange(Instance& fmu, const Description& description, const RunWish& wish) {
    return Exchange(fmu, description, wish).run();
}

Trajectory run_steps(Instance& fmu, const Description& description, const RunWish& wish) {
    Trajectory result;
    const References states = description.states();
    const auto mode = description.mode();
    const auto output = [&](double t) {
        Vector x;
        if (fmu.get(states, x) != ok) result.failure = "states are not read";
        result.t.push_back(t);
        result.x.push_back(x);
    };
    long before = mode ? fmu.mode(*mode) : -1;
    output(0);
    for (std::size_t i = 1; i <= wish.intervals && result.failure.empty(); ++i) {
        const double from = wish.until * double(i - 1) / double(wish.intervals), to = wish.until * double(i) / double(wish.intervals);
        double reached = to;
        const Status status = fmu.step(from, to - from, result.is_over, reached);
        if (status != ok && !result.is_over) result.failure = "the step fails: " + (messages().empty() ? "" : messages().back());
        output(status == ok && !result.is_over ? to : reached);
        const long now = mode ? fmu.mode(*mode) : -1;
        if (now != before) result.changes.push_back({reached, before, now});
        before = now;
        if (result.is_over) break;
    }
    return result;
}

}  // namespace fmi_test
