# SPDX-License-Identifier: BSL-1.0
# dalembert_add_model(TARGET MODEL file.toml [SCENE scene] [SIZES N=5 ...] [FIX parameters | NAME[=VALUE] ...] [TRIG combined] [TAYLOR] [TOGETHER])
#
# Generates the header of one scene of a model at build time, as TARGET.hpp, and makes an interface library TARGET for those who
# include it. FIX makes parameters numbers; TRIG combined takes sine and cosine in float from one reduction; with TAYLOR it has Taylor
# series of the motion, with TOGETHER one function for rates, Jacobian, outputs and energies. The header is generated again when the model file or the generator changes.
function(dalembert_add_model target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TAYLOR;TOGETHER" "MODEL;SCENE;TRIG" "SIZES;FIX")
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
  if(arg_TAYLOR)
    list(APPEND options --taylor)
  endif()
  if(arg_TOGETHER)
    list(APPEND options --together)
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.generated)
  set(header ${folder}/${target}.hpp)
  if(TARGET dalembert::dalembert)
    set(program dalembert::dalembert)
  else()
    set(program dalembert)
  endif()
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${program} generate ${model} ${options} -o ${folder} --header ${target}.hpp
    DEPENDS ${model} ${program}
    COMMENT "Generating ${target} from ${arg_MODEL}"
    VERBATIM)
  add_custom_target(${target}_generated DEPENDS ${header})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_generated)
  target_include_directories(${target} INTERFACE ${folder})
  target_compile_features(${target} INTERFACE cxx_std_17)
endfunction()
