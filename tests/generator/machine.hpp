// SPDX-License-Identifier: GPL-3.0-or-later
// Machines from model text, for tests.
#pragma once

#include <doctest/doctest.h>

#include "read/reader.hpp"
#include "pipeline.hpp"

namespace dalembert {

inline std::shared_ptr<const LoadedModel> model_from(const std::string& text) {
    Diagnostics diagnostics;
    const auto source = std::make_shared<const Source>("test.toml", "[model]\nformat = 1\nname = \"test\"\n" + text);
    return std::make_shared<LoadedModel>(read_model(source, diagnostics));
}

inline Machine machine_from(const std::string& text, const std::string& scene = "", const std::map<std::string, int>& sizes = {}) {
    return derive_machine(model_from(text), scene, sizes);
}

/// A shipped system; of mechanics unless the name says another folder: "hydraulics/torricelli".
inline Machine machine_of(const std::string& system, const std::string& scene = "", const std::map<std::string, int>& sizes = {}) {
    Diagnostics diagnostics;
    const std::string name = system.find('/') == std::string::npos ? "mechanics/" + system : system;
    return derive_machine(load(std::string(SOURCE_DIR) + "/systems/" + name + ".toml", diagnostics), scene, sizes);
}

/// A chain or tree of bodies of tests/physics/chains.
inline Machine chain_of(const std::string& name, const std::map<std::string, int>& sizes = {}) {
    Diagnostics diagnostics;
    return derive_machine(load(std::string(SOURCE_DIR) + "/tests/physics/chains/" + name + ".toml", diagnostics), "", sizes);
}

inline GiNaC::ex symbol_named(const System& system, SymbolKind kind, const char* name) {
    return system.symbols.find(kind, name, 0)->symbol;
}

/// A machine with one coordinate and one body, to which a test adds what it is about.
inline const std::string block =
    "[parameters]\n"
    "m = { value = 2, unit = \"kg\", range = [0.1, 10] }\n"
    "c = { value = 5, unit = \"N/m\" }\n"
    "l = { value = 0.5, unit = \"m\", range = [0.1, 10] }\n"
    "d = { value = 1, unit = \"N*s/m\" }\n"
    "[coordinates]\n"
    "x = { unit = \"m\", start = 0.1 }\n"
    "[bodies.block]\n"
    "mass = \"m\"\n"
    "position = [\"x\", 0, 0]\n";

}  // namespace dalembert
