# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ file that holds the contents of FILES (relative to ROOT) as string literals, by their paths below the folders named here,
# and VERSION.
set(entries "")
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} content)
  string(REGEX REPLACE "^(templates|runtime/dalembert|runtime/c|runtime/js|runtime/export)/" "" name ${file})
  string(APPEND entries "    {\"${name}\", R\"embedded(${content})embedded\"sv},\n")
endforeach()
file(WRITE ${OUTPUT}
"// Written by embed.cmake.
#include \"text/template.hpp\"
#include \"text/version.hpp\"

namespace dalembert {

const char* const program_version = \"${VERSION}\";

namespace {
using namespace std::string_view_literals;
constexpr EmbeddedFile table[]{
${entries}};
}

std::span<const EmbeddedFile> embedded_files() { return table; }

}  // namespace dalembert
")
