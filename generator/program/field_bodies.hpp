// SPDX-License-Identifier: GPL-3.0-or-later
// What functions of rods and blocks with many cells do, as statements: loops over cells k, or over the faces behind cells k.
#pragma once

#include <functional>

#include "program/statement_maker.hpp"
#include "form/state_places.hpp"
#include "graph/field_code.hpp"

namespace dalembert {

class FieldBodies {
public:
    explicit FieldBodies(const FieldCode& code);

    Statements update();
    Statements start_state();
    /// Adds what cells do to dxdt, which is zero before.
    Statements rates();
    /// Adds slopes by the cells to J, whose entries place(row, column) finds. After rates().
    Statements jacobian();
    /// Adds slopes by inputs, parameters or the time to J, column by column.
    Statements jacobian(By by);
    /// Add to `energy` and `power`.
    Statements energy();
    Statements power();

    // Of outputs that contain sums over cells.
    /// Adds to `sums`.
    Statements sums();
    /// Adds slopes by cells to C, and slopes of what is summed by inputs to D, with the slopes by sums in `by_sums`.
    Statements sum_slopes();
    Statements sum_slopes_by_inputs();
    /// Outputs y, and what they are differentiated by: C and D at fixed sums, and `by_sums`.
    Statements output_values();
    Statements output_by_state();
    Statements output_by_input();
    Statements output_by_sum();

    /// A member that keeps what depends on parameters alone: "k3", or an array of them over the cells of a field.
    struct CachedMember {
        std::string name;
        std::optional<std::size_t> cells;
    };
    std::vector<CachedMember> cached_members() const;
    /// Functions that the header brings itself and that the statements call. After them.
    const std::set<std::string>& helpers() const { return helpers_; }

private:
    using Results = const std::vector<Value>&;
    using Use = std::function<Statements(Results)>;

    const CellField& field(std::size_t r) const { return *code_.fields[r].field; }
    std::size_t first_place(std::size_t r) const { return places_.firsts[r]; }
    /// The index of cell k in x.
    Value cell_place(std::size_t r) const;
    static std::string sum_name(std::size_t i);
    void name_cached();
    Statements computed(const FunctionCode& f, const Use& use);
    Statements grid_numbers(std::size_t r, const Statements& statements) const;
    Statement loop(std::size_t r, const CellRange& cells, Statements statements, std::size_t offset = 1) const;
    Statement over(std::size_t r, const CellRange& cells, const FunctionCode& f, const Use& use, std::size_t offset = 1);
    Statements filled_cache(std::size_t r, const CellRange& cells, const std::vector<std::uint32_t>& wanted);
    static FunctionCode without_first(FunctionCode f);
    Statements cell_slopes(std::size_t r, std::size_t law);
    Statement total(std::size_t r, const CellRange& cells, const FunctionCode& f, const char* name);
    Statements column_loops(std::size_t r, const FieldColumn& column);
    Statements added_slope(std::size_t i, const FunctionCode& f, const char* array, const Value& column);
    Value of_matrix(const char* array, std::size_t column, std::size_t output) const;
    Statements of_outputs(const FunctionCode& f, const std::function<Value(std::size_t column, std::size_t output)>& target);

    const FieldCode& code_;
    const System& system_;
    const StatePlaces places_;
    std::map<std::uint32_t, std::size_t> links_, cells_;  ///< cached values that code of faces and cells uses, with the field
    std::map<std::uint32_t, std::string> members_;
    CachedValues cached_;
    std::set<std::string> helpers_;
};

}  // namespace dalembert
