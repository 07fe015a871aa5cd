// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as FMI describes it: variables with causality, variability and start values, and what depends on what. The two versions of the
// standard write the same things with other words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "export/target.hpp"

namespace dalembert {

enum class FmiVersion { two, three };

struct FmiVariable {
    enum class Type { real, mode };
    Type type = Type::real;
    std::string name;
    std::size_t reference = 0;                  ///< see runtime/export/fmi_values.h
    std::string doc;
    std::string causality, variability;
    std::string initial = {};                   ///< empty: what the standard gives such a variable
    std::string unit = {};                      ///< SI; empty: none
    std::optional<double> low = {}, high = {};
    std::optional<double> start = {};
    std::optional<double> nominal = {};
    std::optional<std::size_t> derivative_of = {};  ///< place of the state among the variables
    bool can_jump = false;                      ///< a state that events change
};

struct FmiUnknown {
    std::size_t variable;                                ///< its place
    std::optional<std::vector<std::size_t>> dependencies;  ///< places of variables, rising; nothing: all
};

struct FmiUnit {
    std::string name;
    std::vector<std::pair<std::string, int>> exponents;  ///< of base units, without zeros
    bool has_exponents = true;                           ///< whole ones
};

struct FmiModel {
    std::string identifier, name, title;
    std::vector<FmiVariable> variables;
    std::vector<FmiUnknown> outputs, derivatives, initial, indicators;
    std::size_t indicator_count = 0;
    std::vector<std::string> modes;
    std::vector<FmiUnit> units;
    std::vector<std::string> notes;   ///< names that were mapped
    std::optional<double> stop;       ///< s, of the reference run
    bool is_projected = false;
};

FmiModel fmi_model(const ExportSubject& subject, FmiVersion version);

/// modelDescription.xml; `files` are the sources to compile.
std::string fmi_description(const FmiModel& model, FmiVersion version, const std::string& token, const std::vector<std::string>& files);

/// sources/buildDescription.xml of version 3.
std::string fmi_build_description(const FmiModel& model, const std::vector<std::string>& files);

}  // namespace dalembert
