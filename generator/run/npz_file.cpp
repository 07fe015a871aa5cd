// SPDX-License-Identifier: GPL-3.0-or-later
// A zip archive of .npy files, as numpy documents them (NEP 1): version 1.0, in the order of C, little-endian.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>

#include "run/result_files.hpp"
#include "text/archive.hpp"

namespace dalembert {

namespace {

void append_little_endian(std::string& bytes, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xFF);
}

/// One axis.
std::string npy(const std::string& type, std::size_t count, const std::string& data) {
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", type, count);
    constexpr std::size_t before = 10, block = 64;  // magic string, version and length; all of it fills blocks
    header.append(block - 1 - (before + header.size()) % block, ' ');
    header += '\n';
    std::string bytes = std::string("\x93NUMPY\x01", 7) + '\0';
    append_little_endian(bytes, header.size(), 2);
    return bytes + header + data;
}

std::string npy(const std::vector<double>& values) {
    std::string data;
    for (const double value : values) append_little_endian(data, std::bit_cast<std::uint64_t>(value), 8);
    return npy("<f8", values.size(), data);
}

/// The characters of a UTF-8 text. What is no UTF-8 counts as Latin-1.
std::u32string characters(const std::string& text) {
    std::u32string result;
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char first = static_cast<unsigned char>(text[i++]);
        const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
        char32_t c = more == 0 ? first : first & (0x3F >> more);
        for (int k = 0; k < more && i < text.size(); ++k) c = c << 6 | (static_cast<unsigned char>(text[i++]) & 0x3F);
        result += c;
    }
    return result;
}

std::string npy(const std::vector<std::string>& texts) {
    std::vector<std::u32string> all;
    std::size_t longest = 1;
    for (const std::string& text : texts) longest = std::max(longest, all.emplace_back(characters(text)).size());
    std::string data;
    for (std::u32string& text : all) {
        text.resize(longest, U'\0');
        for (const char32_t c : text) append_little_endian(data, c, 4);
    }
    return npy(fmt::format("<U{}", longest), texts.size(), data);
}

}  // namespace

std::string npz_file(const ResultTable& table) {
    std::vector<std::string> names, units, event_names, from, to;
    std::vector<double> times;
    for (const Column& column : table.recording.columns) {
        names.push_back(column.name);
        units.push_back(column.unit);
    }
    for (const ResultTable::Event& event : table.events) {
        times.push_back(event.t);
        event_names.push_back(event.name);
        from.push_back(event.from);
        to.push_back(event.to);
    }
    FileContents files;
    std::set<std::string> taken;
    const auto add = [&](std::string name, std::string array) {
        while (!taken.insert(name).second) name += '_';
        files.emplace_back(name + ".npy", std::move(array));
    };
    for (const auto& [name, texts] : {std::pair{"names", &names}, std::pair{"units", &units}}) add(name, npy(*texts));
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::vector<double> column;
        for (const std::vector<double>& row : table.recording.rows) column.push_back(row[i]);
        add(names[i], npy(column));
    }
    if (!table.modes.empty()) {
        add("modes", npy(table.modes));
        add("event_times", npy(times));
        for (const auto& [name, texts] :
             {std::pair{"event_names", &event_names}, std::pair{"event_from", &from}, std::pair{"event_to", &to}})
            add(name, npy(*texts));
    }
    return zip_archive(files);
}

}  // namespace dalembert
