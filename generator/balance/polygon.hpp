// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry of a simple polygon by numbers: whether it is one, and the shortest ways inside it.
#pragma once

#include <cln/real.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace dalembert {

using PlanePoint = std::array<cln::cl_R, 2>;

/// Corners on the way from one corner to another, both included.
using Course = std::vector<std::size_t>;

/// A polygon with exact corners, or corners with 60 digits. Side i goes from corner i to corner i + 1.
class Polygon {
public:
    explicit Polygon(std::vector<PlanePoint> corners);

    std::size_t size() const { return corners_.size(); }
    std::size_t next(std::size_t i) const { return (i + 1) % size(); }
    /// Two sides that cross, touch or lie on each other; a side without length is paired with itself.
    std::optional<std::pair<std::size_t, std::size_t>> problem() const;
    /// The course of a taut string between each two corners, from the first to the second. A corner that a string only touches is on
    /// its course.
    std::vector<std::vector<Course>> strings() const;

private:
    int turn(std::size_t a, std::size_t b, std::size_t c) const;
    bool is_between(std::size_t a, std::size_t c, std::size_t b) const;
    bool is_inward(std::size_t a, std::size_t b) const;
    bool see_each_other(std::size_t a, std::size_t b) const;

    std::vector<PlanePoint> corners_;
    cln::cl_R tiny_ = 0;    ///< areas below it are zero
    int orientation_ = 1;   ///< 1 where the inside lies on the left
};

}  // namespace dalembert
