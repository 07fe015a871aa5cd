// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/angle_basis.hpp"

#include <doctest/doctest.h>

#include "prove/normal_form.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

struct Angles {
    std::vector<ex> q, sums;
    explicit Angles(int n) {
        for (int k = 1; k <= n; ++k) {
            q.push_back(GiNaC::realsymbol("q[" + std::to_string(k) + "]"));
            sums.push_back(k == 1 ? q[0] : sums.back() + q.back());
        }
    }
};

/// cos and sin of the sum of the first k, by the addition theorem from those before.
std::pair<ex, ex> from_one_to_the_next(const Angles& angles, std::size_t k) {
    ex c = 1, s = 0;
    for (std::size_t i = 0; i < k; ++i) {
        const ex next = c * GiNaC::cos(angles.q[i]) - s * GiNaC::sin(angles.q[i]);
        s = s * GiNaC::cos(angles.q[i]) + c * GiNaC::sin(angles.q[i]);
        c = next;
    }
    return {c, s};
}

}  // namespace

TEST_CASE("sums of angles become letters where their addition theorems would be long") {
    const Angles angles(12);
    ex sum = 0;
    for (std::size_t k = 1; k <= angles.q.size(); ++k) sum += GiNaC::cos(angles.sums[k - 1]) - from_one_to_the_next(angles, k).first;
    const ShortAngles changed = with_short_angles(sum);
    CHECK_FALSE(changed.meaning.empty());
    CHECK((changed.expression.subs(changed.meaning) - sum).expand().is_zero());
    CHECK(NormalForm().is_zero(sum));
    CHECK_FALSE(NormalForm().is_zero(sum + GiNaC::sin(angles.q[7])));
}

TEST_CASE("few angles stay what they are") {
    const Angles angles(3);
    const ex difference = GiNaC::cos(angles.q[0] - angles.q[1]) * GiNaC::sin(angles.q[2]);
    CHECK(with_short_angles(difference).meaning.empty());
}

TEST_CASE("rates go with their angles") {
    const Angles angles(4);
    const ex w = GiNaC::realsymbol("dot(q[3])"), other = GiNaC::realsymbol("dot(q[1])");
    const ex e = w * GiNaC::cos(angles.sums[3]) + other * GiNaC::cos(angles.sums[2]) * GiNaC::sin(angles.sums[1]);
    const ShortAngles changed = with_short_angles(e);
    CHECK_FALSE(changed.expression.has(w));
    CHECK((changed.expression.subs(changed.meaning) - e).expand().is_zero());
}

TEST_CASE("what must not be zero is told in the letters of the question") {
    const Angles angles(5);
    NormalForm form;
    const ex c = GiNaC::cos(angles.sums[4]);
    CHECK(form.is_zero(1 / c * c - 1 + GiNaC::sin(angles.sums[3]) * 0 + (from_one_to_the_next(angles, 5).first - c) / (2 + c)));
    for (const ex& claimed : form.must_not_vanish())
        for (auto part = claimed.preorder_begin(); part != claimed.preorder_end(); ++part)
            if (GiNaC::is_a<GiNaC::symbol>(*part)) CHECK(std::any_of(angles.q.begin(), angles.q.end(), [&](const ex& q) { return q.is_equal(*part); }));
}
