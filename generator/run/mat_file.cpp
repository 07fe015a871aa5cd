// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <matio.h>

#include <cctype>
#include <ctime>
#include <filesystem>
#include <memory>
#include <set>

#include "run/result_files.hpp"
#include "text/diagnostic.hpp"
#include "text/files.hpp"
#include "text/process.hpp"

namespace dalembert {

namespace {

[[noreturn]] void fail(const std::string& what) {
    throw Failure(Diagnostic{Id::tool_failed, {}, fmt::format("the results cannot be written for MATLAB: libmatio refuses {}", what)},
                  ExitCode::tool_missing);
}

struct FreeMatVariable {
    void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatVariable = std::unique_ptr<matvar_t, FreeMatVariable>;

MatVariable made(matvar_t* variable, const char* name) {
    if (variable == nullptr) fail(fmt::format("the variable '{}'", name == nullptr ? "" : name));
    return MatVariable(variable);
}

MatVariable numbers(const char* name, std::vector<double> values) {
    std::size_t sizes[2]{values.size(), 1};
    return made(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sizes, values.data(), 0), name);
}

MatVariable text(std::string characters) {
    std::size_t sizes[2]{characters.empty() ? 0U : 1U, characters.size()};
    return made(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, sizes, characters.data(), 0), "a text");
}

MatVariable cell(const char* name, const std::vector<std::string>& texts) {
    std::vector<matvar_t*> cells;
    for (const std::string& characters : texts) cells.push_back(text(characters).release());
    std::size_t sizes[2]{cells.size(), 1};
    return made(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, sizes, cells.data(), 0), name);
}

MatVariable structure(const char* name, const std::vector<std::string>& fields) {
    std::vector<const char*> names;
    for (const std::string& field : fields) names.push_back(field.c_str());
    std::size_t sizes[2]{1, 1};
    return made(Mat_VarCreateStruct(name, 2, sizes, names.data(), static_cast<unsigned>(names.size())), name);
}

/// The structure owns the values.
void set(matvar_t& structure, const std::string& field, MatVariable value) {
    Mat_VarSetStructFieldByName(&structure, field.c_str(), 0, value.release());
}

/// A name for MATLAB: "dot(phi)" is phi_dot, "T[1]" is T_1.
std::string field_name(const std::string& name, std::set<std::string>& taken) {
    std::string text = name, dots;
    for (; text.starts_with("dot(") && text.ends_with(')'); text = text.substr(4, text.size() - 5)) dots += "_dot";
    std::string result;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            result += c;
        else if (!result.empty() && result.back() != '_')
            result += '_';
    while (!result.empty() && result.back() == '_') result.pop_back();
    if (result.empty() || std::isalpha(static_cast<unsigned char>(result[0])) == 0) result = "x_" + result;
    constexpr std::size_t longest = 60;  // of 63 in MATLAB
    result = result.substr(0, longest - std::min(longest / 2, dots.size())) + dots;
    while (!taken.insert(result).second) result += '_';
    return result;
}

/// HDF5 notes when each object was changed: a message of type 18 and 8 bytes in its header, with version 1. Same results are to be the same
/// bytes.
void forget_times(std::string& bytes, std::time_t begin, std::time_t end) {
    constexpr std::string_view message("\x12\0\x08\0", 4), version("\0\0\0\x01\0\0\0", 7);  // between them: flags
    for (std::size_t at = bytes.find(message); at != std::string::npos && at + 16 <= bytes.size(); at = bytes.find(message, at + 1)) {
        if (bytes.compare(at + 5, version.size(), version) != 0) continue;
        std::time_t seconds = 0;
        for (int i = 3; i >= 0; --i) seconds = seconds << 8 | static_cast<unsigned char>(bytes[at + 12 + static_cast<std::size_t>(i)]);
        if (begin <= seconds && seconds <= end) bytes.replace(at + 12, 4, 4, '\0');
    }
}

}  // namespace

std::string mat_file(const ResultTable& table, bool is_hdf5) {
    std::vector<std::string> names, units, fields, event_names, from, to;
    std::set<std::string> taken;
    for (const Column& column : table.recording.columns) {
        names.push_back(column.name);
        units.push_back(column.unit);
        fields.push_back(field_name(column.name, taken));
    }
    std::vector<MatVariable> variables;
    variables.push_back(structure("run", fields));
    for (std::size_t i = 0; i < fields.size(); ++i) {
        std::vector<double> column;
        for (const std::vector<double>& row : table.recording.rows) column.push_back(row[i]);
        set(*variables[0], fields[i], numbers(nullptr, std::move(column)));
    }
    variables.push_back(cell("names", names));
    variables.push_back(cell("units", units));
    variables.push_back(cell("fields", fields));
    if (!table.modes.empty()) {
        std::vector<double> times;
        for (const ResultTable::Event& event : table.events) {
            times.push_back(event.t);
            event_names.push_back(event.name);
            from.push_back(event.from);
            to.push_back(event.to);
        }
        variables.push_back(structure("events", {"t", "name", "from", "to"}));
        set(*variables.back(), "t", numbers(nullptr, std::move(times)));
        for (const auto& [field, texts] : {std::pair{"name", &event_names}, std::pair{"from", &from}, std::pair{"to", &to}})
            set(*variables.back(), field, cell(nullptr, *texts));
        variables.push_back(cell("modes", table.modes));
    }
    const std::time_t begin = std::time(nullptr);
    const ScratchFolder scratch;
    const std::string path = (std::filesystem::path(scratch.path()) / "results.mat").string();
    const char* const header = is_hdf5 ? "MATLAB 7.3 MAT-file, written by dalembert" : "MATLAB 5.0 MAT-file, written by dalembert";
    mat_t* const file = Mat_CreateVer(path.c_str(), header, is_hdf5 ? MAT_FT_MAT73 : MAT_FT_MAT5);
    if (file == nullptr) fail("the file");
    std::unique_ptr<mat_t, int (*)(mat_t*)> closed(file, Mat_Close);
    for (const MatVariable& variable : variables)
        if (Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_ZLIB) != 0) fail(fmt::format("the variable '{}'", variable->name));
    closed.reset();  // before it is read
    std::string bytes = read_file(path);
    if (is_hdf5) forget_times(bytes, begin, std::time(nullptr));
    return bytes;
}

}  // namespace dalembert
