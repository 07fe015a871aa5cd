// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/net_radiation.hpp"

#include <algorithm>
#include <memory>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

bool is_surely_positive(const ex& e) { return e.info(GiNaC::info_flags::positive); }

/// How exchange factors depend on parameters. In the network of conductances A_i*F_ij between radiosities, dG_ij is the change of a
/// conductance times the differences across it when surface i, and when surface j, alone has sigma*T^4 = 1 (Tellegen).
class Slopes {
public:
    Slopes(Surroundings surroundings, std::vector<ex> reflectivities, std::vector<std::vector<ex>> reach)
        : s_(std::move(surroundings)), rho_(std::move(reflectivities)), reach_(std::move(reach)), n_(s_.areas.size()) {}

    ex operator()(std::size_t i, std::size_t j, const Symbols& symbols, std::size_t parameter) {
        const Changes& d = changes(symbols, parameter);
        ex sum = 0;
        for (std::size_t k = 0; k < n_; ++k) {
            // A_k*eps_k/(1 - eps_k) is the conductance from sigma*T_k^4 to the radiosity.
            const ex own = s_.areas[k] * d.emissivities[k] + s_.emissivities[k] * rho_[k] * d.areas[k];
            if (!own.is_zero()) sum -= own * shortfall(k, i) * shortfall(k, j);
            // Conductances between radiosities, gathered at each end: the sums are the same for all i.
            ex gathered = 0;
            for (std::size_t l = 0; l < n_; ++l)
                if (l != k && !d.direct[k][l].is_zero()) gathered += d.direct[k][l] * whole(radiosity(k, j) - radiosity(l, j));
            if (!gathered.is_zero()) sum -= radiosity(k, i) * whole(gathered);
        }
        return sum;
    }

private:
    struct Changes {
        std::vector<ex> areas, emissivities;
        std::vector<std::vector<ex>> direct;
    };

    const Changes& changes(const Symbols& symbols, std::size_t parameter) {
        if (const auto known = changes_.find(parameter); known != changes_.end()) return known->second;
        const auto slope = [&](const ex& e) { return symbols.derivative_by_parameter(e, parameter); };
        Changes d{std::vector<ex>(n_), std::vector<ex>(n_), std::vector<std::vector<ex>>(n_, std::vector<ex>(n_))};
        for (std::size_t k = 0; k < n_; ++k) {
            d.areas[k] = slope(s_.areas[k]);
            d.emissivities[k] = slope(s_.emissivities[k]);
            for (std::size_t l = k + 1; l < n_; ++l) d.direct[k][l] = d.direct[l][k] = slope(s_.direct[k][l]);
        }
        return changes_[parameter] = std::move(d);
    }

    /// What arrives at k by area when i alone has sigma*T^4 = 1.
    ex irradiation(std::size_t k, std::size_t i) const { return reach_[k][i] * s_.emissivities[i] / s_.areas[k]; }
    ex radiosity(std::size_t k, std::size_t i) const { return rho_[k] * irradiation(k, i) + (k == i ? s_.emissivities[i] : ex(0)); }
    /// sigma*T^4 - irradiation of k. All irradiations of k together are 1.
    ex shortfall(std::size_t k, std::size_t i) const {
        if (k != i) return -irradiation(k, i);
        ex others = 0;
        for (std::size_t j = 0; j < n_; ++j)
            if (j != k) others += irradiation(k, j);
        return whole(others);
    }

    Surroundings s_;
    std::vector<ex> rho_;
    std::vector<std::vector<ex>> reach_;
    std::size_t n_;
    std::map<std::size_t, Changes> changes_;
};

class RadiosityElimination {
public:
    RadiosityElimination(const Surroundings& surroundings, Steps& steps) : s_(surroundings), steps_(steps), n_(surroundings.areas.size()) {
        for (std::size_t k = 0; k < n_; ++k) rho_.push_back(steps("reflectivity", {k}, 1 - s_.emissivities[k]));
        // Where everything may be a perfect mirror, nothing leaves for good, and nothing is exchanged.
        may_vanish_ = std::none_of(s_.emissivities.begin(), s_.emissivities.end(), is_surely_positive);
    }

    NetRadiation run() {
        for (std::size_t k = 0; k < n_; ++k) eliminate(k);
        NetRadiation result{std::vector<std::vector<ex>>(n_, std::vector<ex>(n_, 0)),
                            std::vector<std::vector<ex>>(n_, std::vector<ex>(n_, 0))};
        for (std::size_t k = n_; k-- > 0;) put_back(k, result.reach);
        const auto slopes = std::make_shared<Slopes>(s_, rho_, result.reach);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = i + 1; j < n_; ++j) {
                const auto slope = [slopes, i, j](const Symbols& symbols, std::size_t parameter) {
                    return (*slopes)(i, j, symbols, parameter);
                };
                result.exchange[i][j] = result.exchange[j][i] =
                    steps_("exchange_factor", {i, j}, s_.emissivities[i] * s_.emissivities[j] * result.reach[i][j], slope);
            }
        return result;
    }

private:
    /// A row of what is left when reflections at surfaces before k are followed to their ends: passed_[k][j] arrives at a later j (or at k
    /// again), caught is absorbed on the way.
    void eliminate(std::size_t k) {
        passed_.emplace_back(n_, 0);
        for (std::size_t j = k; j < n_; ++j) {
            ex sum = s_.direct[k][j];
            for (std::size_t l = 0; l < k; ++l) sum += passed_[l][k] * passed_[l][j] * rho_[l] * inverse_[l];
            passed_[k][j] = steps_("passed", {k, j}, sum);
        }
        ex caught = 0;
        for (std::size_t l = 0; l < k; ++l) caught += passed_[l][k] * share_[l];
        ex later = 0;
        for (std::size_t j = k + 1; j < n_; ++j) later += passed_[k][j];
        // Of a black surface all that leaves does so for good: A_k, and what arrives there is caught.
        const bool is_black = rho_[k].is_zero();
        const ex& eps = s_.emissivities[k];
        const ex leaving = is_black ? s_.areas[k] : steps_("leaving", {k}, caught + eps * passed_[k][k] + later);
        inverse_.push_back(reciprocal(leaving));
        if (k + 1 == n_) return;
        if (is_black) share_.emplace_back(1);
        else if (caught.is_zero() && passed_[k][k].is_zero()) share_.push_back(eps);
        else share_.push_back(steps_("caught", {k}, whole(caught + eps * whole(passed_[k][k] + later)) * inverse_[k]));
    }

    ex reciprocal(const ex& leaving) const {
        if (leaving.is_zero()) return 0;
        if (!may_vanish_ || is_surely_positive(leaving)) return pow(leaving, -1);
        return pow(inverse_norm(leaving), 2);
    }

    /// reach[k][j] for j >= k from the rows behind k.
    void put_back(std::size_t k, std::vector<std::vector<ex>>& reach) const {
        for (std::size_t j = n_; j-- > k;) {
            ex sum = passed_[k][j];
            for (std::size_t l = k + 1; l < n_; ++l) sum += passed_[k][l] * rho_[l] / s_.areas[l] * reach[l][j];
            reach[k][j] = reach[j][k] = steps_("reach", {k, j}, s_.areas[k] * inverse_[k] * whole(sum));
        }
    }

    const Surroundings& s_;
    Steps& steps_;
    std::size_t n_;
    bool may_vanish_ = false;
    std::vector<ex> rho_;
    std::vector<std::vector<ex>> passed_;
    std::vector<ex> inverse_;  ///< of what leaves each surface for good
    std::vector<ex> share_;    ///< of what arrives at a surface, what is absorbed at it or those before it and goes no further
};

}  // namespace

NetRadiation net_radiation(const Surroundings& surroundings, Steps& steps) { return RadiosityElimination(surroundings, steps).run(); }

}  // namespace dalembert
