# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` puts where. The CMake package serves every architecture: its headers are text, and its program is for the machine
# that builds.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/dalembert)
install(TARGETS dalembert EXPORT dalembert_targets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS dalembert_runtime EXPORT dalembert_targets)
install(DIRECTORY runtime/dalembert DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT dalembert_targets NAMESPACE dalembert:: DESTINATION ${package_dir})
configure_package_config_file(generator/cmake/dalembert-config.cmake.in dalembert-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(dalembert-config-version.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dalembert-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/dalembert-config-version.cmake
              generator/cmake/dalembert_add_model.cmake DESTINATION ${package_dir})
# The same package in the build tree: a project finds it without an installation, with CMAKE_PREFIX_PATH.
export(EXPORT dalembert_targets NAMESPACE dalembert:: FILE ${CMAKE_CURRENT_BINARY_DIR}/dalembert_targets.cmake)
configure_file(generator/cmake/dalembert_add_model.cmake ${CMAKE_CURRENT_BINARY_DIR}/dalembert_add_model.cmake COPYONLY)
install(FILES LICENSE LICENSE.GPL-3.0 LICENSE.BSL-1.0 DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY systems DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)

# Man page and completion are written by the program, whenever it is built.
if(DALEMBERT_PROGRAM)
  set(writer ${DALEMBERT_PROGRAM})
elseif(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
  set(writer dalembert)
endif()
find_program(GZIP gzip)
if(writer AND GZIP)
  set(texts ${CMAKE_CURRENT_BINARY_DIR}/texts)
  file(MAKE_DIRECTORY ${texts})
  add_custom_command(TARGET dalembert POST_BUILD BYPRODUCTS ${texts}/dalembert.1.gz ${texts}/dalembert ${texts}/_dalembert
    COMMAND ${writer} help --format man | ${GZIP} -9n > ${texts}/dalembert.1.gz
    COMMAND ${writer} help --format bash > ${texts}/dalembert
    COMMAND ${writer} help --format zsh > ${texts}/_dalembert)
  install(FILES ${texts}/dalembert.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${texts}/dalembert DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  # zsh looks into the first for /usr/local, and on Debian into the second for packages.
  foreach(folder site-functions vendor-completions)
    install(FILES ${texts}/_dalembert DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder})
  endforeach()
else()
  message(STATUS "Without man page and completion: they need gzip, and DALEMBERT_PROGRAM where the program does not run on this machine")
endif()

find_program(DPKG dpkg)
if(DPKG AND GZIP)
  include(generator/cmake/debian.cmake)
endif()
