// SPDX-License-Identifier: GPL-3.0-or-later
// A page that shows a machine, its equations and proofs, and runs it.
#pragma once

#include "report/check.hpp"
#include "report/run_formulas.hpp"
#include "run/simulation.hpp"

namespace dalembert {

/// A scene, ready for the page.
struct ScenePage {
    std::optional<PreparedRun> run;  ///< nothing: the page does not run it
    RunFormulas formulas;            ///< of that
    std::optional<Machine> machine;  ///< of one that is not run
    std::string named_run;           ///< that commands have to name; empty: the usual one
    std::string reason;              ///< why not, a sentence
    CheckedScene proofs;

    const Machine& derived() const { return run ? run->machine : *machine; }
};

/// What is to be told of a page.
struct ReportedPage {
    struct Scene {
        std::string name;
        bool runs;
        std::string reason;  ///< why it does not
        std::size_t drawn;   ///< bodies of the drawing
        VerdictCounts proofs;
    };
    std::string model, title, doc;
    std::string first_scene;  ///< that the page shows first
    std::filesystem::path page;
    std::size_t bytes = 0;
    std::vector<Scene> scenes;
    VerdictCounts printed;

    std::size_t running_scenes() const;
    VerdictCounts proofs() const;  ///< of all scenes
};

/// Writes the page and what is to be told of it. `file`: the name of the model file, for commands. `watching`: a script that makes the
/// page ask where it came from for the next one. The code of the machines grows.
std::string machine_page(const Model& model, const std::string& file, std::vector<ScenePage>& scenes,
                         const std::vector<PrintedRow>& printed, ReportedPage& result, const std::string& watching = {});

}  // namespace dalembert
