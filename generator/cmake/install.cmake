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
