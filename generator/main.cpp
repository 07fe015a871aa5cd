// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "command/command_line.hpp"

int main(int argc, char** argv) { return dalembert::run_program({argv + 1, argv + argc}, {std::cout, std::cerr}); }
