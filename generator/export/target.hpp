// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that take a model. To add one: a file with its function, and a row in targets.cpp.
#pragma once

#include <span>

#include "pipeline.hpp"
#include "text/files.hpp"

namespace dalembert {

/// What every export is made of. After generate, in C99.
struct ExportSubject {
    const Machine& machine;
    const Plant& plant;                      ///< names, units, sizes, patterns of all states
    std::string name;                        ///< NAME_SCENE: stands before the names in C
    std::vector<double> start_values;        ///< of x, for the default parameters
    std::vector<double> parameter_defaults;
    /// NAME_SCENE.h, dalembert_plant.h and NAME_SCENE_plant.h: the functions of the model and their table, see plant_in_c.hpp.
    FileContents c_files;
};

/// What the command line asks for besides.
struct ExportWish {
    bool sources_only = false;
    std::string mode;  ///< of a machine that switches, which has it; empty: all of them
};

struct Exported {
    FileContents files;              ///< below the folder of the export
    std::vector<std::string> notes;  ///< for the user: names that were mapped, what was left out
};

struct Target {
    const char* name;  ///< on the command line
    const char* doc;
    /// Throws Failure for what the tool cannot take.
    Exported (*make)(const ExportSubject& subject, const ExportWish& wish);
    bool takes_mode = false;     ///< a machine that switches is exported in one mode, which --mode chooses
    std::span<const Function> wishes = {};  ///< functions that the C header gets where it can, the largest first
};

std::span<const Target> targets();

}  // namespace dalembert
