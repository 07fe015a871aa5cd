# SPDX-License-Identifier: BSL-1.0
# dalembert_add_model(TARGET MODEL file.toml [SCENE scene] [SIZES N=5 ...] [FIX parameters | NAME[=VALUE] ...] [TRIG combined] [TAYLOR] [TOGETHER]
#                     [LANGUAGE C] [EXPORT fmi2 ...])
#
# Generates the header of one scene of a model at build time, as TARGET.hpp (TARGET.h with LANGUAGE C), and makes an interface library TARGET for those who
# include it. FIX makes parameters numbers; TRIG combined takes sine and cosine in float from one reduction; with TAYLOR it has Taylor
# series of the motion, with TOGETHER one function for rates, Jacobian, outputs and energies. The header is generated again when the model
# file or the generator changes. EXPORT names tools (see `dalembert export`): what they take is written to the folder TARGET.exported/TOOL by
# the target all; the property DALEMBERT_EXPORTS of TARGET is the folder TARGET.exported.
function(dalembert_add_model target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TAYLOR;TOGETHER" "MODEL;SCENE;TRIG;LANGUAGE" "SIZES;FIX;EXPORT")
  if(NOT arg_MODEL)
    message(FATAL_ERROR "dalembert_add_model(${target}): MODEL is missing")
  endif()
  get_filename_component(model ${arg_MODEL} ABSOLUTE)
  if(NOT EXISTS ${model})
    message(FATAL_ERROR "dalembert_add_model(${target}): there is no model ${model}")
  endif()
  set(options "")
  if(arg_SCENE)
    list(APPEND options --scene ${arg_SCENE})
  endif()
  foreach(size IN LISTS arg_SIZES)
    list(APPEND options --size ${size})
  endforeach()
  if(arg_FIX)
    list(JOIN arg_FIX "," fixed)
    list(APPEND options --fix ${fixed})
  endif()
  if(arg_TRIG)
    list(APPEND options --trig ${arg_TRIG})
  endif()
  set(export_options ${options})
  if(arg_TAYLOR)
    list(APPEND options --taylor)
  endif()
  if(arg_TOGETHER)
    list(APPEND options --together)
  endif()
  if(NOT arg_LANGUAGE OR arg_LANGUAGE STREQUAL "CXX")
    set(ending hpp)
    set(standard cxx_std_17)
  elseif(arg_LANGUAGE STREQUAL "C")
    set(ending h)
    set(standard c_std_99)
    list(APPEND options --language c)
  else()
    message(FATAL_ERROR "dalembert_add_model(${target}): LANGUAGE is CXX or C, not ${arg_LANGUAGE}")
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.generated)
  set(header ${folder}/${target}.${ending})
  # A program that is named runs on this machine; one that is built or installed may be for another.
  if(DALEMBERT_PROGRAM)
    set(program ${DALEMBERT_PROGRAM})
  elseif(TARGET dalembert::dalembert)
    set(program $<TARGET_FILE:dalembert::dalembert>)
  else()
    get_property(missing GLOBAL PROPERTY DALEMBERT_MISSING)
    message(FATAL_ERROR "dalembert_add_model(${target}) needs the program dalembert: set DALEMBERT_PROGRAM to its path, or install what "
                        "its build misses: ${missing}")
  endif()
  # Files that the model names, beside it: points of curves, and parts with what they name themselves.
  set(model_and_files ${model})
  set(unread ${model})
  while(unread)
    list(POP_FRONT unread one)
    if(NOT EXISTS ${one})
      continue()
    endif()
    get_filename_component(beside ${one} DIRECTORY)
    file(STRINGS ${one} lines REGEX "file[ ]*=[ ]*\"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^.*file[ ]*=[ ]*\"([^\"]*)\".*" "\\1" named "${line}")
      get_filename_component(named "${beside}/${named}" ABSOLUTE)
      if(EXISTS ${named} AND NOT named IN_LIST model_and_files)
        list(APPEND model_and_files ${named})
        if(named MATCHES "\\.toml$")
          list(APPEND unread ${named})
        endif()
      endif()
    endforeach()
  endwhile()
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${program} generate ${model} ${options} -o ${folder} --header ${target}.${ending}
    DEPENDS ${model_and_files} ${program}
    COMMENT "Generating ${target} from ${arg_MODEL}"
    VERBATIM)
  add_custom_target(${target}_generated DEPENDS ${header})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_generated)
  target_include_directories(${target} INTERFACE ${folder})
  target_compile_features(${target} INTERFACE ${standard})
  set(exports ${CMAKE_CURRENT_BINARY_DIR}/${target}.exported)
  foreach(tool IN LISTS arg_EXPORT)
    add_custom_command(
      OUTPUT ${exports}/${tool}.written
      COMMAND ${program} export ${model} --to ${tool} ${export_options} -o ${exports}/${tool}
      COMMAND ${CMAKE_COMMAND} -E touch ${exports}/${tool}.written
      DEPENDS ${model_and_files} ${program}
      COMMENT "Exporting ${target} to ${tool}"
      VERBATIM)
    add_custom_target(${target}_${tool} ALL DEPENDS ${exports}/${tool}.written)
  endforeach()
  set_target_properties(${target} PROPERTIES DALEMBERT_EXPORTS ${exports})
endfunction()
