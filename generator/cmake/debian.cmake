# SPDX-License-Identifier: GPL-3.0-or-later
# `cpack` in the build folder writes a Debian package. Licences and changes come from the files of the repository.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dalembert)
set(CPACK_PACKAGE_CONTACT "dalembert maintainers <maintainers@users.noreply.github.com>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# To derive and generate, the program needs its libraries alone; to simulate, a compiler; to plot, gnuplot. The runtime is made of headers.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++ | c++-compiler, gcc | c-compiler, gnuplot-nox | gnuplot, libboost-dev, libeigen3-dev")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS cmake)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "equations of machines: derived, proven and written as C++ or C")
set(CPACK_PACKAGE_DESCRIPTION
"dalembert reads a description of a machine, derives its equations of motion
symbolically, proves what can be proven about them, and writes a header with
the state derivative, its Jacobians, energies and powers. The header needs
nothing but the standard library, in a controller as well as on a desk.
.
The package holds the program, the header-only runtime that integrates such
headers, CMake functions, and models of machines as examples.")

set(debian ${CMAKE_CURRENT_BINARY_DIR}/debian)
# The copyright file: the overview, the one licence in full, and where Debian has the other.
file(READ LICENSE overview)
file(READ LICENSE.BSL-1.0 boost)
string(REPLACE "see LICENSE.GPL-3.0" "see /usr/share/common-licenses/GPL-3" overview "${overview}")
file(CONFIGURE OUTPUT ${debian}/copyright CONTENT "Copyright (C) 2026 the authors of dalembert\n\n@overview@\nLICENSE.BSL-1.0:\n\n@boost@" @ONLY)

# The changelog in the form of Debian: a block for each heading "## VERSION, DATE", a line for each "- " below it.
file(STRINGS CHANGELOG.md lines)
set(changes "")
set(end "")
foreach(line IN LISTS lines)
  if(line MATCHES "^## ([0-9.]+), ([0-9-]+)$")
    set(version ${CMAKE_MATCH_1})
    execute_process(COMMAND date -u -R -d ${CMAKE_MATCH_2} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND changes "${end}dalembert (${version}) stable; urgency=medium\n\n")
    set(end "\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n\n")
  elseif(line MATCHES "^- (.*)")
    string(APPEND changes "  * ${CMAKE_MATCH_1}\n")
  elseif(line MATCHES "^  ")
    string(APPEND changes "  ${line}\n")
  endif()
endforeach()
file(WRITE ${debian}/changelog "${changes}${end}")
execute_process(COMMAND ${GZIP} -9nf ${debian}/changelog COMMAND_ERROR_IS_FATAL ANY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md LICENSE LICENSE.BSL-1.0)
install(FILES ${debian}/copyright ${debian}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
include(CPack)
