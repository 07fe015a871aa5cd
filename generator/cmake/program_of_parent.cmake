# SPDX-License-Identifier: BSL-1.0
# The program that writes headers in another project, as dalembert::dalembert: the one that DALEMBERT_PROGRAM names, or else one that is
# built from source. It must run on this machine, so that a project for another machine takes one that is installed here, or
# configures a build of its own for it.
if(CMAKE_CROSSCOMPILING AND NOT DALEMBERT_PROGRAM)
  find_program(DALEMBERT_INSTALLED dalembert NO_CMAKE_FIND_ROOT_PATH)
  if(DALEMBERT_INSTALLED)
    execute_process(COMMAND ${DALEMBERT_INSTALLED} --version OUTPUT_VARIABLE installed ERROR_QUIET)
    if(installed MATCHES "^dalembert ${PROJECT_VERSION_MAJOR}[.]${PROJECT_VERSION_MINOR}[.]")
      set(DALEMBERT_PROGRAM ${DALEMBERT_INSTALLED})
    endif()
  endif()
endif()

if(DALEMBERT_PROGRAM)
  add_executable(dalembert IMPORTED GLOBAL)
  set_target_properties(dalembert PROPERTIES IMPORTED_LOCATION ${DALEMBERT_PROGRAM})
elseif(CMAKE_CROSSCOMPILING)
  include(ExternalProject)
  set(build ${CMAKE_CURRENT_BINARY_DIR}/program)
  set(no_toolchain ${CMAKE_COMMAND} -E env --unset=CC --unset=CXX --unset=CFLAGS --unset=CXXFLAGS --unset=LDFLAGS ${CMAKE_COMMAND})
  ExternalProject_Add(dalembert_program
    SOURCE_DIR ${CMAKE_CURRENT_SOURCE_DIR}
    BINARY_DIR ${build}
    PREFIX ${build}-steps
    CONFIGURE_COMMAND ${no_toolchain} -S ${CMAKE_CURRENT_SOURCE_DIR} -B ${build} -G ${CMAKE_GENERATOR} -DCMAKE_BUILD_TYPE=Release
                      -DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM} -DDALEMBERT_TESTS=OFF -DDALEMBERT_INSTALL=OFF
    BUILD_COMMAND ${CMAKE_COMMAND} --build ${build} --target dalembert
    INSTALL_COMMAND ""
    BUILD_BYPRODUCTS ${build}/dalembert
    BUILD_ALWAYS ON
    EXCLUDE_FROM_ALL ON)
  add_executable(dalembert IMPORTED GLOBAL)
  set_target_properties(dalembert PROPERTIES IMPORTED_LOCATION ${build}/dalembert)
  add_dependencies(dalembert dalembert_program)
else()
  include(${CMAKE_CURRENT_LIST_DIR}/program.cmake)
endif()
