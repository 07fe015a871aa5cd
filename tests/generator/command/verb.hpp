// SPDX-License-Identifier: GPL-3.0-or-later
// A verb of the program, called as on the command line, and a folder for what it reads and writes.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "command/command_line.hpp"
#include "text/process.hpp"

struct Answer {
    int code;
    std::string out, err;
    nlohmann::json json() const { return nlohmann::json::parse(out); }
};

inline Answer ask(const std::string& verb, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), verb);
    std::ostringstream out, err;
    const int code = dalembert::run_program(arguments, {out, err});
    return {code, out.str(), err.str()};
}

/// Gone with the object.
class Folder {
public:
    std::filesystem::path path() const { return scratch_.path(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path() / name) << text;
        return path() / name;
    }

private:
    dalembert::ScratchFolder scratch_;
};
