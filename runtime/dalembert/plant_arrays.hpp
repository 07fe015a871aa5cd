// SPDX-License-Identifier: BSL-1.0
// Arrays, tables and patterns of a plant (plant.h), with sizes that are known when it is loaded.
//
// note [in use]: Arrays of a run have the sizes of the plant that the thread uses at the moment: whoever works with a plant holds a
// UsePlant for as long as there are arrays, systems or results of it.
#pragma once

#include <cstddef>

#include "dalembert/plant.h"
#include "dalembert/run_array.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

inline thread_local const dalembert_plant* plant_in_use = nullptr;

/// A number of the plant in use, that says it when it is read.
template <std::size_t (*read)(const dalembert_plant&)>
struct OfPlant {
    static std::size_t of_run() noexcept { return read(*plant_in_use); }
    operator std::size_t() const noexcept { return of_run(); }
};
/// An entry of a list that belongs to the plant in use.
template <class T, T (*read)(const dalembert_plant&, std::size_t)>
struct ListOfPlant {
    T operator[](std::size_t i) const noexcept { return read(*plant_in_use, i); }
};
template <class T>
struct TableOfPlant {
    const T* entries;
    std::size_t count;
    std::size_t size() const noexcept { return count; }
    const T* begin() const noexcept { return entries; }
    const T* end() const noexcept { return entries + count; }
    const T& operator[](std::size_t i) const noexcept { return entries[i]; }
};

namespace of_plant {

using Plant = const dalembert_plant&;
inline std::size_t states(Plant p) { return p.states; }
inline std::size_t inputs(Plant p) { return p.inputs; }
inline std::size_t outputs(Plant p) { return p.outputs; }
inline std::size_t degrees(Plant p) { return p.degrees; }
inline std::size_t separable(Plant p) { return p.is_separable != 0 ? p.degrees : 0; }
inline std::size_t square(Plant p) { return p.degrees * p.degrees; }
inline std::size_t guards(Plant p) { return p.guards; }
inline std::size_t kinks(Plant p) { return p.kinks; }
inline std::size_t events(Plant p) { return p.events; }
inline std::size_t constraints(Plant p) { return p.constraints; }
inline std::size_t constraint_entries(Plant p) { return p.constraints * p.degrees; }
inline std::size_t rank(Plant p) { return p.constraint_rank; }
inline std::size_t velocity_place(Plant p) { return p.velocity_place; }
inline std::size_t outputs_by_states(Plant p) { return p.outputs * p.states; }
inline std::size_t outputs_by_inputs(Plant p) { return p.outputs * p.inputs; }
inline std::size_t series_rows(Plant p) { return p.series_rows; }
inline bool can_be_left_out(Plant p, std::size_t i) { return p.constraint_table[i].can_be_left_out != 0; }
inline bool solved_for_at_start(Plant p, std::size_t i) { return p.constraint_table[i].solved_for_at_start != 0; }
inline const dalembert_pattern& x(Plant p) { return p.pattern_x; }
inline const dalembert_pattern& u(Plant p) { return p.pattern_u; }
inline const dalembert_pattern& p(Plant p) { return p.pattern_p; }

}  // namespace of_plant

/// As the patterns of generated headers; all have as many rows as there are states.
template <const dalembert_pattern& (*which)(const dalembert_plant&)>
struct PatternOfPlant {
    static constexpr bool is_sparse = true;
    static std::size_t start(const dalembert_plant& plant, std::size_t column) {
        const dalembert_pattern& pattern = which(plant);
        return pattern.column_starts != nullptr ? pattern.column_starts[column] : column * plant.states;
    }
    static std::size_t row(const dalembert_plant& plant, std::size_t entry) {
        const dalembert_pattern& pattern = which(plant);
        return pattern.column_starts != nullptr ? pattern.row_indices[entry] : entry % plant.states;
    }
    static constexpr ListOfPlant<std::size_t, start> column_starts{};
    static constexpr ListOfPlant<std::size_t, row> row_indices{};
};
using PatternXOfPlant = PatternOfPlant<of_plant::x>;
using PatternUOfPlant = PatternOfPlant<of_plant::u>;
using PatternPOfPlant = PatternOfPlant<of_plant::p>;
namespace of_plant {
inline std::size_t entries_x(Plant p) { return PatternXOfPlant::start(p, p.states); }
inline std::size_t entries_u(Plant p) { return PatternUOfPlant::start(p, p.inputs); }
inline std::size_t entries_p(Plant p) { return p.jacobian_p != nullptr ? PatternPOfPlant::start(p, p.parameters) : 0; }
}  // namespace of_plant

template <std::size_t (*count)(const dalembert_plant&)>
using PlantArray = RunArray<OfPlant<count>, double>;

}  // namespace detail

/// Makes a plant the one whose sizes the arrays of this thread have; see note [in use]. The one before is back afterwards.
class UsePlant {
public:
    explicit UsePlant(const dalembert_plant& plant) : before_(detail::plant_in_use) { detail::plant_in_use = &plant; }
    ~UsePlant() { detail::plant_in_use = before_; }
    UsePlant(const UsePlant&) = delete;
    UsePlant& operator=(const UsePlant&) = delete;

private:
    const dalembert_plant* before_;
};

}  // namespace v1
}  // namespace dalembert
