// SPDX-License-Identifier: BSL-1.0
// A table of results: named columns with units, written as CSV.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace dalembert {
inline namespace v1 {

struct Column {
    std::string name;
    std::string unit;  ///< SI
    /// "s [m]"
    std::string title() const { return unit.empty() ? name : name + " [" + unit + "]"; }
};

struct Recording {
    std::vector<Column> columns;
    std::vector<std::vector<double>> rows;

    /// The number of a column; columns.size() when there is none of that name.
    std::size_t find(const std::string& name) const {
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (columns[i].name == name) return i;
        return columns.size();
    }
};

/// The unit in which a column is shown: its value in SI is (value + offset) * factor.
struct ShownUnit {
    std::string column;
    std::string unit;
    double factor;
    double offset;
};

/// The table with some columns in other units.
inline Recording in_units(Recording recording, const std::vector<ShownUnit>& units) {
    for (const ShownUnit& shown : units) {
        const std::size_t column = recording.find(shown.column);
        if (column == recording.columns.size()) continue;
        recording.columns[column].unit = shown.unit;
        for (std::vector<double>& row : recording.rows) row[column] = row[column] / shown.factor - shown.offset;
    }
    return recording;
}

namespace detail {

/// The shortest text that reads back as the same number.
inline std::string number_text(double value) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);  // whatever the locale of the program
    return {buffer.data(), end.ptr};
}

inline std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace detail

/// First line: titles with units.
inline std::string csv_text(const Recording& recording) {
    std::string text;
    for (std::size_t i = 0; i < recording.columns.size(); ++i) text += (i == 0 ? "" : ",") + detail::csv_field(recording.columns[i].title());
    text += "\n";
    for (const std::vector<double>& row : recording.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i > 0) text += ",";
            text += detail::number_text(row[i]);
        }
        text += "\n";
    }
    return text;
}

/// Returns false when the file cannot be written.
inline bool write_csv(const Recording& recording, const std::string& path) {
    std::ofstream out(path);
    out << csv_text(recording);
    out.close();
    return static_cast<bool>(out);
}

}  // namespace v1
}  // namespace dalembert
