# SPDX-License-Identifier: GPL-3.0-or-later
# The program, from its sources. Where another project includes this one, a missing library is an error only for those who need the program:
# DALEMBERT_MISSING says then what is missing.
if(PROJECT_IS_TOP_LEVEL)
  set(needed REQUIRED)
else()
  set(needed QUIET)
endif()
find_package(PkgConfig ${needed})
if(PkgConfig_FOUND)
  pkg_check_modules(GINAC ${needed} IMPORTED_TARGET ginac)
  pkg_check_modules(CLN ${needed} IMPORTED_TARGET cln)
  pkg_check_modules(TOMLPLUSPLUS ${needed} IMPORTED_TARGET tomlplusplus)
  pkg_check_modules(ZIP ${needed} IMPORTED_TARGET libzip)
  pkg_check_modules(MATIO ${needed} IMPORTED_TARGET matio)
  pkg_check_modules(PUGIXML ${needed} IMPORTED_TARGET pugixml)
endif()
find_package(fmt ${needed})
find_package(nlohmann_json ${needed})
find_package(CLI11 ${needed})
find_package(Ceres ${needed})
set(libraries PkgConfig::GINAC PkgConfig::CLN PkgConfig::TOMLPLUSPLUS PkgConfig::PUGIXML PkgConfig::ZIP PkgConfig::MATIO fmt::fmt nlohmann_json::nlohmann_json CLI11::CLI11 Ceres::ceres Boost::headers Eigen3::Eigen)
set(missing "")
foreach(library IN LISTS libraries)
  if(NOT TARGET ${library})
    list(APPEND missing ${library})
  endif()
endforeach()
if(missing)
  list(JOIN missing ", " missing)
  set_property(GLOBAL PROPERTY DALEMBERT_MISSING "${missing}")
  return()
endif()

set(dalembert_options -Wall -Wextra -Wpedantic -Wconversion -Wshadow $<$<CONFIG:Release>:-O2>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # false alarms of GCC 12 inside std::shared_ptr

# Templates, and the runtime files from which headers take helpers, become part of the program: it needs no files to generate.
set(embedded
    templates/header.hpp.in
    templates/system.hpp.in
    templates/fields.hpp.in
    templates/field_sums.hpp.in
    templates/series.hpp.in
    templates/constraint_tables.hpp.in
    templates/constraint_types.hpp.in
    templates/constraint_choice.hpp.in
    templates/meet_constraints.hpp.in
    templates/meet_constraints.h.in
    templates/plant.h.in
    templates/quantities.hpp.in
    templates/quantities.h.in
    templates/controller.hpp.in
    templates/controller.h.in
    templates/controller_plant.cpp.in
    templates/header.h.in
    templates/module.js.in
    templates/series.h.in
    templates/fields.h.in
    templates/field_sums.h.in
    templates/mode_tables.hpp.in
    templates/mode_types.hpp.in
    templates/mode_events_apart.hpp.in
    templates/plant.cpp.in
    templates/plant_table.h.in
    templates/plant_table_modes.h.in
    templates/work_precision.cpp.in
    templates/cost.cpp.in
    templates/accuracy.cpp.in
    templates/book.html.in
    templates/gallery.html.in
    templates/identify.html.in
    templates/reference.html.in
    templates/report.html.in
    templates/report.css
    templates/report_index.html.in
    templates/report_errors.html.in
    templates/report_watch.js
    templates/report_player.html
    templates/report_numbers.js
    templates/report_plot.js
    templates/report_drawing.js
    templates/report_shapes.js
    templates/report_network.js
    templates/report_network_parts.js
    templates/report_field.js
    templates/report_start.js
    templates/report_times.js
    templates/report_runs.js
    templates/report_player.js
    templates/report_print.js
    runtime/dalembert/compiler.h
    runtime/dalembert/scalar_functions.hpp
    runtime/dalembert/angle_functions.hpp
    runtime/dalembert/fluid_functions.hpp
    runtime/dalembert/heat_functions.hpp
    runtime/dalembert/curve_functions.hpp
    runtime/dalembert/heat_networks.hpp
    runtime/dalembert/junctions.hpp
    runtime/dalembert/series_functions.hpp
    runtime/dalembert/ldlt.hpp
    runtime/dalembert/plant.h
    runtime/dalembert/unroll.hpp
    runtime/export/derivatives.h.in
    runtime/export/pattern_of_entries.h.in
    runtime/export/casadi.c.in
    runtime/export/acados.c.in
    runtime/export/acados_explicit.c.in
    runtime/export/acados_model.py.in
    runtime/c/math_functions.h.in
    runtime/c/scalar_functions.h.in
    runtime/c/angle_functions.h.in
    runtime/c/fluid_functions.h.in
    runtime/c/heat_functions.h.in
    runtime/c/curve_functions.h.in
    runtime/c/heat_networks.h.in
    runtime/c/junctions.h.in
    runtime/c/series_functions.h.in
    runtime/c/ldlt.h.in)
# And what exports carry: runs and modes over a plant, the adapters of FMI, and packages.
file(GLOB exported RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS runtime/js/*.js runtime/export/*.h runtime/export/fmi*.c runtime/export/python/* runtime/export/octave/*)
list(APPEND embedded ${exported})
# And the projects that `dalembert new` writes.
file(GLOB projects RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS templates/new/*/*.in)
list(APPEND embedded ${projects})
# And the examples of the error reference: golden texts of tests/errors that the table of ids names.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS generator/text/diagnostic_kinds.cpp)
file(STRINGS generator/text/diagnostic_kinds.cpp examples REGEX "tests/errors/")
string(REGEX MATCHALL "tests/errors/[a-z_]+[.]txt" examples "${examples}")
list(REMOVE_DUPLICATES examples)
list(APPEND embedded ${examples})
set(embedded_source ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
add_custom_command(
  OUTPUT ${embedded_source}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${embedded_source} "-DFILES=${embedded}" -DROOT=${CMAKE_CURRENT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/generator/cmake/embed.cmake
  DEPENDS ${embedded} generator/cmake/embed.cmake
  VERBATIM)

file(GLOB_RECURSE generator_sources CONFIGURE_DEPENDS generator/*.cpp)
set(mpi_source ${CMAKE_CURRENT_SOURCE_DIR}/generator/study/mpi_library.cpp)
list(REMOVE_ITEM generator_sources ${CMAKE_CURRENT_SOURCE_DIR}/generator/main.cpp ${mpi_source})
# Layers that read, check and write take no time worth speaking of in a run, but the compiler: with less optimisation, six tenths of it.
set(light_sources ${generator_sources})
list(FILTER light_sources INCLUDE REGEX "/generator/(text|language|elements|read|check|emit|export|identify|study|book|report|reference|command)/")
list(REMOVE_ITEM generator_sources ${light_sources})
add_library(dalembert_light OBJECT ${light_sources} ${embedded_source})
add_library(dalembert_core STATIC ${generator_sources} $<TARGET_OBJECTS:dalembert_light>)
foreach(part dalembert_light dalembert_core)
  target_include_directories(${part} PUBLIC generator runtime)
  target_link_libraries(${part} PUBLIC ${libraries} ${CMAKE_DL_LIBS})
  # Which forms keep digits is judged in double: by the same roundings on every machine.
  target_compile_options(${part} PRIVATE ${dalembert_options} -ffp-contract=off)
  target_precompile_headers(${part} PRIVATE <ginac/ginac.h> <fmt/format.h>)
endforeach()
target_compile_options(dalembert_light PRIVATE -O1)
# Plants that run by themselves carry C headers, of which the program uses some.
configure_file(runtime/dalembert/plant.h ${CMAKE_CURRENT_BINARY_DIR}/exported/dalembert_plant.h COPYONLY)
target_include_directories(dalembert_core SYSTEM PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/exported runtime/export)
# Up to ten files of a layer at once: a quarter of the time. With -DDALEMBERT_TOGETHER=OFF each on its own, for work on a few of them.
option(DALEMBERT_TOGETHER "Compile many files at once" ON)
set_target_properties(dalembert_light dalembert_core PROPERTIES UNITY_BUILD ${DALEMBERT_TOGETHER} UNITY_BUILD_MODE GROUP)
foreach(source ${light_sources} ${generator_sources})
  file(RELATIVE_PATH layer ${CMAKE_CURRENT_SOURCE_DIR}/generator ${source})
  string(REGEX REPLACE "/.*|[.]cpp" "" layer ${layer})
  math(EXPR place "${files_of_${layer}} + 0")
  math(EXPR group "${place} / 10")
  math(EXPR files_of_${layer} "${place} + 1")
  set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${layer}_${group})
endforeach()
# Integrators and matrices take the compiler seconds each: side by side.
file(GLOB plant_sources generator/plant/simulation_*.cpp generator/plant/sensitivities_*.cpp generator/plant/equilibrium.cpp generator/plant/modal.cpp)
set_source_files_properties(${plant_sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
set_source_files_properties(generator/plant/equilibrium.cpp generator/plant/modal.cpp PROPERTIES COMPILE_OPTIONS -O1)  # once a call

# The state of the checkout is looked at in every build. It is told by --version alone: headers are the same for the same input.
set(version_source ${CMAKE_CURRENT_BINARY_DIR}/version.cpp)
add_custom_target(dalembert_version BYPRODUCTS ${version_source}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${version_source} -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/generator/cmake/version.cmake
  VERBATIM)
add_executable(dalembert generator/main.cpp ${version_source})
add_dependencies(dalembert dalembert_version)
target_link_libraries(dalembert PRIVATE dalembert_core)
target_compile_options(dalembert PRIVATE ${dalembert_options})
set_target_properties(dalembert_light dalembert_core dalembert PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
                      RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
# Studies under mpirun: loaded by the program then only. Not part of packages, which would need MPI: cmake --install build --component mpi.
# By pkg-config: CMake's own search stops with an error where mpirun is installed without the headers.
pkg_check_modules(OMPI QUIET IMPORTED_TARGET ompi-c)
if(OMPI_FOUND AND PROJECT_IS_TOP_LEVEL)
  add_library(dalembert_mpi MODULE ${mpi_source})
  target_include_directories(dalembert_mpi PRIVATE generator)
  target_link_libraries(dalembert_mpi PRIVATE PkgConfig::OMPI)
  set_target_properties(dalembert_mpi PROPERTIES PREFIX "" CXX_STANDARD 20 LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  install(TARGETS dalembert_mpi LIBRARY DESTINATION lib/dalembert COMPONENT mpi EXCLUDE_FROM_ALL)
endif()
# Where another project includes this one, the program is built when a model needs it.
if(NOT PROJECT_IS_TOP_LEVEL)
  set_target_properties(dalembert_light dalembert_core dalembert PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
# Where the program looks for the runtime: beside itself, as in an installation.
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/include)
file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/runtime/dalembert ${CMAKE_CURRENT_BINARY_DIR}/include/dalembert SYMBOLIC)
