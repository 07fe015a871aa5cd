// SPDX-License-Identifier: GPL-3.0-or-later
// The code of rods and blocks with many cells: what one cell does, as straight-line code that is emitted inside of loops.
#pragma once

#include "balance/field.hpp"
#include "graph/code.hpp"
#include "prove/audit.hpp"

namespace dalembert {

/// Derivatives by one input, the time or a parameter. A function has no results where its law does not depend on it.
struct FieldColumn {
    By by;
    std::size_t column;
    std::vector<FunctionCode> faces;  ///< result: d(heat to the cell behind)
    std::vector<FunctionCode> sides;  ///< result: d(heat through a side)
    std::vector<FunctionCode> cells;  ///< results: d(source), d(capacity), 1/capacity; always
};

struct FaceFunctions {
    FunctionCode heat;         ///< result: heat to the cell behind
    FunctionCode slopes;       ///< results: that, d/d(here), d/d(next)
};

struct SideFunctions {
    FunctionCode heat;         ///< result: heat through a side
    FunctionCode slope;        ///< result: d/d(here)
};

struct CellFunctions {
    FunctionCode rate;         ///< results: source, 1/capacity
    FunctionCode slopes;       ///< results: those, d(source)/d(here), d(capacity)/d(here)
    FunctionCode source;       ///< result: source
    FunctionCode energy;       ///< result: energy
};

/// One of each law of the field, in their order.
struct FieldFunctions {
    const CellField* field;
    std::vector<FaceFunctions> faces;
    std::vector<SideFunctions> sides;
    std::vector<CellFunctions> cells;
    FunctionCode start;        ///< result: temperature at the start
    std::vector<FieldColumn> columns;
};

/// A sum over cells that outputs contain: what the loop adds up.
struct SumFunctions {
    FunctionCode term;                                        ///< result: of one cell
    FunctionCode slope;                                       ///< result: d(term)/d(here)
    std::vector<std::pair<std::size_t, FunctionCode>> by_input;  ///< where not zero: d(term)/d(input)
};

/// Outputs that contain such sums.
struct SumOutputs {
    std::vector<std::size_t> outputs;                ///< among all
    FunctionCode values = {};                        ///< results: one of each
    FunctionCode by_state = {}, by_input = {}, by_sum = {};  ///< results: slopes at fixed sums, column by column
};

struct FieldCode {
    explicit FieldCode(const System& system) : code(system) {}
    FieldCode(const FieldCode&) = delete;

    Code code;                                ///< atoms and cache only
    std::vector<FieldFunctions> fields;
    std::vector<SumFunctions> sums;           ///< of the sums of the system
    SumOutputs outputs;
    FunctionCode update;                      ///< results: cached values
    bool depends_on_grid(std::uint32_t cached) const;
    /// Of the right-hand side, for each cell and the faces behind it; of a block where most is done.
    OperationCount per_cell(const FieldFunctions& functions) const;
};

std::unique_ptr<FieldCode> make_field_code(const System& system);

/// Proves the code equal to what cells do, and the capacity the slope of the energy.
std::vector<AuditEntry> verify_fields(const FieldCode& code);

}  // namespace dalembert
