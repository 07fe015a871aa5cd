// SPDX-License-Identifier: BSL-1.0
// The derivatives of a Jacobian along the columns of S.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/sensitivities/varied.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Refers to all that it is given but the scale. See Variational.
template <class System, class Inputs, class List, class View, class Sides>
class JacobianAlong {
    using Scalar = typename System::scalar_type;
    using Plain = typename System::State;
    using Jacobian = typename System::JacobianX;

public:
    template <class Scale>
    JacobianAlong(const System& system, const Inputs& inputs, const List& varied, const MovedSystems<System, List>& moved,
                  const Scale& scale, const View& view, const Sides& sides)
        : system_(system),
          inputs_(inputs),
          varied_(varied),
          moved_(moved),
          view_(view),
          sides_(sides),
          parts_(Columns<List>::filled(varied, Scalar(1))) {
        std::copy_n(scale.begin(), scale_.size(), scale_.begin());
    }

    /// Along column c of S, which is s at the state x, and its parameter with it; `here` is the Jacobian there. Where it bends on this
    /// way, as that of steep friction next to rest, along the state in shorter steps: errors here would take its order from Rodas5p.
    void differentiate(std::size_t c, const Plain& x, const Plain& s, const Scalar& t, const Jacobian& here, Jacobian& result) {
        constexpr int most_tries = 12;
        result.fill(Scalar(0));
        const Scalar step = usual_step(c, x, s);
        if (step == Scalar(0)) return;
        Jacobian ahead{}, behind{};
        const auto take = [&](Jacobian& J, const System& system, const Scalar& length) {
            Plain there = x;
            for (std::size_t i = 0; i < there.size(); ++i) there[i] += length * s[i];
            const auto u = inputs_with(inputs_, system)(there, t);
            sides_.mirror(there, u, t);
            view_(system).jacobian_x(there, u, t, J);
        };
        const auto add_slope = [&](const Scalar& distance) {
            for (std::size_t k = 0; k < result.size(); ++k) result[k] += (ahead[k] - behind[k]) / distance;
        };
        if (const int side = sides_(c, t); side != 0) {
            take(ahead, side < 0 ? system_ : moved_.ahead[c], side < 0 ? Scalar(0) : step);
            take(behind, side > 0 ? system_ : moved_.behind[c], side > 0 ? Scalar(0) : -step);
            return add_slope(step);
        }
        Scalar& part = parts_[c];
        if (part == Scalar(1)) {
            take(ahead, moved_.ahead[c], step);
            take(behind, moved_.behind[c], -step);
            if (bend(ahead, behind, here) <= Scalar(1)) return add_slope(Scalar(2) * step);
            part /= Scalar(4);
        }
        if (varied_[c].of == Varied::Of::parameter) {
            take(ahead, moved_.ahead[c], Scalar(0));
            take(behind, moved_.behind[c], Scalar(0));
            add_slope(Scalar(2) * step);
        }
        for (int tries = 0;; ++tries) {
            take(ahead, system_, part * step);
            take(behind, system_, -part * step);
            const Scalar found = bend(ahead, behind, here);
            if (found <= Scalar(1) || tries == most_tries) {
                add_slope(Scalar(2) * part * step);
                if (found < Scalar(1) / Scalar(8)) part *= Scalar(4);  // next time
                return;
            }
            part /= Scalar(4);
        }
    }

private:
    /// Of a central difference.
    Scalar usual_step(std::size_t c, const Plain& x, const Plain& s) const {
        if (varied_[c].of == Varied::Of::parameter) return moved_.distance[c];
        const Scalar longest = largest_part<System>(s, x, scale_);
        return longest > Scalar(0) ? step_of_differences<Scalar>() / longest : Scalar(0);
    }

    /// How much a Jacobian bends between both sides, beside what leaves its slope nine digits.
    static Scalar bend(const Jacobian& ahead, const Jacobian& behind, const Jacobian& here) {
        using std::abs;
        const Scalar least = Scalar(1) / Scalar(32768);
        Scalar largest = Scalar(0);
        for (std::size_t k = 0; k < here.size(); ++k) {
            const Scalar second = abs(ahead[k] + behind[k] - Scalar(2) * here[k]);
            const Scalar size = std::max({Scalar(abs(ahead[k])), Scalar(abs(behind[k])), Scalar(abs(here[k]))});
            const Scalar allowed = least * std::max(Scalar(abs(ahead[k] - behind[k])), Scalar(least * size));
            if (!(second <= allowed * largest)) largest = second / allowed;
            if (!(largest <= std::numeric_limits<Scalar>::max())) return largest;  // it ends on the way
        }
        return largest;
    }

    const System& system_;
    const Inputs& inputs_;
    const List& varied_;
    const MovedSystems<System, List>& moved_;
    View view_;
    Sides sides_;
    Plain scale_;
    typename Columns<List>::template Of<Scalar> parts_;  ///< of the usual steps
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
