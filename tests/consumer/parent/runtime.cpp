// SPDX-License-Identifier: BSL-1.0
// The runtime and its two libraries are in reach, in the language of the parent.
#include <Eigen/Core>
#include <boost/version.hpp>
#include <cstdio>

#include "dalembert/status.hpp"

static_assert(__cplusplus == 201703L, "the parent chose C++17");

int main() {
    std::printf("%s, Eigen %d, Boost %d\n", dalembert::to_string(dalembert::Status::success), EIGEN_WORLD_VERSION, BOOST_VERSION);
    return 0;
}
