# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ file that holds the contents of FILES (relative to ROOT) as string literals.
set(entries "")
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} content)
  get_filename_component(name ${file} NAME)
  string(APPEND entries "    if (name == \"${name}\")\n        return R\"embedded(${content})embedded\";\n")
endforeach()
file(WRITE ${OUTPUT}
"// Written by embed.cmake.
#include <stdexcept>
#include <string>

#include \"text/template.hpp\"

namespace dalembert {

std::string_view embedded_file(std::string_view name) {
${entries}    throw std::logic_error(\"no embedded file \" + std::string(name));
}

}  // namespace dalembert
")
