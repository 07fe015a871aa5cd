// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/data_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "text/diagnostic.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

/// A part of a line, [begin, end) of the source.
struct CsvField {
    std::size_t begin, end;
    std::string text;  ///< without quotes and blanks around it
};

std::string trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    return begin == std::string_view::npos ? "" : std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

std::vector<CsvField> fields_of(std::string_view line, std::size_t begin, char separator) {
    std::vector<CsvField> fields;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        CsvField field{begin + i, 0, ""};
        std::string text;
        for (bool is_quoted = false; i < line.size() && (is_quoted || line[i] != separator); ++i) {
            if (line[i] != '"')
                text += line[i];
            else if (is_quoted && i + 1 < line.size() && line[i + 1] == '"')
                text += line[i++];
            else
                is_quoted = !is_quoted;
        }
        field.end = begin + i;
        field.text = trimmed(text);
        fields.push_back(std::move(field));
    }
    return fields;
}

char separator_of(std::string_view titles) {
    const auto count = [&](char c) { return std::count(titles.begin(), titles.end(), c); };
    char best = ',';
    for (const char c : {';', '\t'})
        if (count(c) > count(best)) best = c;
    return best;
}

/// "phi [deg]"
DataColumn column_of(const CsvField& title, const SourcePtr& source) {
    DataColumn column{title.text, "", Span{source, title.begin, title.end}, {}};
    const auto open = title.text.rfind('[');
    if (open == std::string::npos || !title.text.ends_with("]") || open == 0 || title.text[open - 1] != ' ') return column;
    column.name = trimmed(std::string_view(title.text).substr(0, open));
    column.unit = trimmed(std::string_view(title.text).substr(open + 1, title.text.size() - open - 2));
    return column;
}

double number_of(const CsvField& field, const SourcePtr& source, char separator) {
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    std::string text = field.text;
    if (text.starts_with("+")) text.erase(0, 1);
    if (text.empty() || text == "NA" || text == "nan" || text == "NaN" || text == "NAN") return missing;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    if (!is_number)
        throw Failure(Diagnostic{
            Id::wrong_type, Span{source, field.begin, field.end},
            fmt::format("'{}' is no number{}; a missing value is an empty field, NA or nan", field.text,
                        separator != ',' && field.text.find(',') != std::string::npos ? ", which has a decimal point and no comma" : "")});
    return value;
}

}  // namespace

const DataColumn* DataFile::find(const std::string& name) const {
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const DataColumn& column) { return column.name == name; });
    return found == columns.end() ? nullptr : &*found;
}

std::vector<std::string> DataFile::names() const {
    std::vector<std::string> all;
    for (const DataColumn& column : columns) all.push_back(column.name);
    return all;
}

Span DataFile::place(std::size_t row) const {
    const std::size_t begin = source->offset({lines.at(row), 1});
    return {source, begin, begin + source->line(lines.at(row)).size()};
}

std::string DataFile::written(const DataColumn& column, std::size_t row) const {
    const Span line = place(row);
    return fields_of(line.text(), line.begin, separator).at(static_cast<std::size_t>(&column - columns.data())).text;
}

DataFile parse_data(const SourcePtr& source) {
    DataFile file{source, {}, {}};
    const std::string& text = source->text();
    char& separator = file.separator;
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        const std::size_t here = std::exchange(begin, end + 1);
        ++number;
        if (trimmed(line).empty() || line.front() == '#') continue;
        const bool is_title = file.columns.empty();
        if (is_title) separator = separator_of(line);
        const std::vector<CsvField> fields = fields_of(line, here, separator);
        if (is_title) {
            for (const CsvField& title : fields) {
                if (!title.text.empty() && file.find(column_of(title, source).name) != nullptr)
                    throw Failure(Diagnostic{Id::doubly_defined, Span{source, title.begin, title.end},
                                             fmt::format("two columns are called '{}'", column_of(title, source).name)});
                file.columns.push_back(column_of(title, source));
            }
            continue;
        }
        if (fields.size() != file.columns.size())
            throw Failure(Diagnostic{Id::wrong_type, Span{source, here, end},
                                     fmt::format("the line has {} fields, but there are {} titles", fields.size(), file.columns.size())});
        for (std::size_t i = 0; i < fields.size(); ++i)
            if (!file.columns[i].name.empty()) file.columns[i].values.push_back(number_of(fields[i], source, separator));
        file.lines.push_back(number);
    }
    if (file.lines.empty())
        throw Failure(Diagnostic{Id::missing_key, Span{source, 0, 0},
                                 "there are no data: a line of titles, as t [s],phi [deg], and lines of numbers"});
    return file;
}

DataFile read_data_file(const std::filesystem::path& path) {
    FilesRead::note(path);
    std::string text = read_file(path);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // the mark of UTF-8 that spreadsheets write
    return parse_data(std::make_shared<const Source>(path.string(), text));
}

}  // namespace dalembert
