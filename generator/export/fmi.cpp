// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/fmi.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "export/c_library.hpp"
#include "export/fmi_model.hpp"
#include "text/archive.hpp"
#include "text/diagnostic.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// FNV-1a (Fowler, Noll, Vo) with 128 bits: x = (x ^ byte) * (2^88 + 0x13B), in four parts of 32 bits, the lowest first.
class Hash {
public:
    void add(std::string_view text) {
        for (const char c : text) add(static_cast<unsigned char>(c));
        add(static_cast<unsigned char>(0));  // so that texts do not run into each other
    }
    std::string in_braces() const {
        const auto part = [&](std::size_t i) { return fmt::format("{:08x}", parts_[i]); };
        const std::string all = part(3) + part(2) + part(1) + part(0);
        return fmt::format("{{{}-{}-{}-{}-{}}}", all.substr(0, 8), all.substr(8, 4), all.substr(12, 4), all.substr(16, 4), all.substr(20));
    }

private:
    void add(unsigned char byte) {
        parts_[0] ^= byte;
        std::array<std::uint64_t, 4> sums{};
        for (std::size_t i = 0; i < 4; ++i) sums[i] = std::uint64_t(parts_[i]) * 0x13BU;
        sums[2] += std::uint64_t(parts_[0]) << 24U & 0xFFFFFFFFU;
        sums[3] += (std::uint64_t(parts_[1]) << 24U & 0xFFFFFFFFU) + (parts_[0] >> 8U);
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            carry += sums[i];
            parts_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32U;
        }
    }

    std::array<std::uint32_t, 4> parts_{0x6295C58DU, 0x62B82175U, 0x07BB0142U, 0x6C62272EU};
};

/// Where the binary of a machine stands, and the end of its name.
struct BinaryPlace {
    std::string folder, suffix;
};

BinaryPlace place_of(const std::string& machine, FmiVersion version) {
    const std::string processor = machine.substr(0, machine.find('-'));
    const auto has = [&](const char* system) { return machine.find(system) != std::string::npos; };
    const bool is_windows = has("mingw") || has("windows"), is_mac = has("darwin") || has("apple");
    const std::string system = is_windows ? "windows" : is_mac ? "darwin" : "linux";
    const bool is_x86 = processor.size() == 4 && processor.starts_with('i') && processor.ends_with("86");
    const std::string name = is_x86 ? "x86" : processor.starts_with("arm") ? "aarch32" : processor;
    const BinaryPlace in_three{name + "-" + system, is_windows ? ".dll" : is_mac ? ".dylib" : ".so"};
    if (version == FmiVersion::three || (name != "x86" && name != "x86_64")) return in_three;  // version 2 names no others
    return {(is_windows ? "win" : system) + (name == "x86" ? "32" : "64"), in_three.suffix};
}

/// The C files of the FMU, below sources/.
FileContents sources(const ExportSubject& subject, FmiVersion version) {
    FileContents files = subject.c_files;
    for (auto& text : texts_of_runs()) files.push_back(std::move(text));
    const char* const other = version == FmiVersion::two ? "fmi3" : "fmi2";
    for (const EmbeddedFile& file : embedded_files())
        if (file.name.starts_with("fmi") && !file.name.starts_with(other)) files.emplace_back(file.name, file.text);
    return files;
}

Exported files_of(const ExportSubject& subject, const ExportWish& wish, FmiVersion version) {
    const FmiModel model = fmi_model(subject, version);
    const std::vector<std::string> compiled{version == FmiVersion::two ? "fmi2.c" : "fmi3.c"};
    FileContents c_files = sources(subject, version);
    Hash hash;
    hash.add(fmi_description(model, version, "", compiled));
    for (const auto& [path, content] : c_files) {
        hash.add(path.generic_string());
        hash.add(content);
    }
    const std::string token = hash.in_braces();
    c_files.emplace_back("fmi_identity.h", fmt::format("/* SPDX-License-Identifier: BSL-1.0 */\n"
                                                       "/* The model of this FMU, and the token of its modelDescription.xml. */\n"
                                                       "#include \"{0}_plant.h\"\n"
                                                       "#define FMI_PLANT {0}_plant_table()\n"
                                                       "#define FMI_TOKEN \"{1}\"\n",
                                                       subject.name, token));
    FileContents files{{"modelDescription.xml", fmi_description(model, version, token, compiled)}};
    if (!wish.sources_only)
        for (const std::vector<std::string>& compiler : c_compilers()) {
            const std::string machine = machine_of(compiler);
            const BinaryPlace place = place_of(machine, version);
            const std::filesystem::path binary = fmt::format("binaries/{}/{}{}", place.folder, subject.name, place.suffix);
            if (std::any_of(files.begin(), files.end(), [&](const auto& file) { return file.first == binary; }))
                throw Failure(
                    Diagnostic{Id::tool_failed,
                               {},
                               fmt::format("CC names two compilers for the machine '{}'; an FMU has one library for each", machine)},
                    ExitCode::tool_missing);
            files.emplace_back(binary, c_library(c_files, compiled.front(), compiler));
        }
    if (version == FmiVersion::three) files.emplace_back("sources/buildDescription.xml", fmi_build_description(model, compiled));
    for (const auto& [path, content] : c_files) files.emplace_back("sources" / path, content);
    return {{{subject.name + ".fmu", zip_archive(files)}}, model.notes};
}

}  // namespace

Exported fmi2_files(const ExportSubject& subject, const ExportWish& wish) { return files_of(subject, wish, FmiVersion::two); }
Exported fmi3_files(const ExportSubject& subject, const ExportWish& wish) { return files_of(subject, wish, FmiVersion::three); }

}  // namespace dalembert
