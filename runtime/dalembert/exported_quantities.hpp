// SPDX-License-Identifier: BSL-1.0
// Tables of quantities of a generated header, as libraries export them.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>

#include "dalembert/plant.h"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Tables of one size are of one type: each table of its owner has a place of its own, by number.
template <class Owner, int number, class Table>
const dalembert_quantity* exported_quantities(const Table& of) {
    static std::array<dalembert_quantity, std::tuple_size<Table>::value + 1> list;
    for (std::size_t i = 0; i < of.size(); ++i) list[i] = {of[i].name, of[i].unit, of[i].description, of[i].low, of[i].high};
    return list.data();
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
