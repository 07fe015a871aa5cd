// SPDX-License-Identifier: GPL-3.0-or-later
// A table of measured numbers: a CSV file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "text/source.hpp"

namespace dalembert {

struct DataColumn {
    std::string name;
    std::string unit;            ///< as it is written; empty where none is
    Span place;                  ///< of the title
    std::vector<double> values;  ///< as they are written; NaN where one is missing
};

struct DataFile {
    SourcePtr source;
    std::vector<DataColumn> columns;
    std::vector<std::size_t> lines;  ///< of the file, from 1, one a row
    char separator = ',';

    /// Null where there is none of that name.
    const DataColumn* find(const std::string& name) const;
    std::vector<std::string> names() const;
    /// The values of a row, as a place.
    Span place(std::size_t row) const;
    /// A value as it is written, for those who need all its digits.
    std::string written(const DataColumn& column, std::size_t row) const;
};

/// Fields are separated by commas, semicolons or tabs: by what the line of titles has most of. A title is a name with a unit: "phi [deg]".
/// Lines that begin with '#' are comments. An empty field, NA and nan are missing values. Throws Failure (unreadable-file, wrong-type,
/// doubly-defined, missing-key).
DataFile read_data_file(const std::filesystem::path& path);
/// The same of a text.
DataFile parse_data(const SourcePtr& source);

}  // namespace dalembert
