// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/gnuplot.hpp"

#include <fmt/format.h>

#include "text/files.hpp"
#include "text/process.hpp"

namespace dalembert {

std::string gnuplot_quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        result += c == '\''                                          ? std::string("\xE2\x80\x99")
                  : static_cast<unsigned char>(c) < 0x20 || c == '`' ? std::string(" ")
                                                                     : std::string(1, c);
    return result + "'";
}

std::vector<std::pair<std::string, std::string>> gnuplot_pictures(const std::string& script, const std::string& draw, int width,
                                                                  int height) {
    const ScratchFolder folder;
    std::vector<std::pair<std::string, std::string>> pictures;
    std::string text = "set encoding utf8\n" + script;
    for (const auto& [ending, terminal] :
         {std::pair(".svg", fmt::format("svg size {},{} font 'DejaVu Sans,12' background '#ffffff'", width, height)),
          std::pair(".png", fmt::format("png size {},{} font 'DejaVu Sans,10'", width, height))})
        text += fmt::format("set terminal {}\nset output '{}/plot{}'\n", terminal, folder.path(), ending) + draw;
    const std::string file = folder.path() + "/plot.gp";
    write_files({{file, text + "unset output\n"}});
    if (run_process({"gnuplot", file}).exit_code != 0) return pictures;
    for (const char* ending : {".svg", ".png"}) pictures.emplace_back(ending, read_file(folder.path() + "/plot" + ending));
    return pictures;
}

}  // namespace dalembert
