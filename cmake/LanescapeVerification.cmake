# Checks of a host's own kernel, for hosts that find the installed package and for those that take this project in by add_subdirectory.
# The target lanescape::host_kernel has the C header lanescape/host_kernel.h and nothing to link.
if(NOT TARGET lanescape::host_kernel)
  add_library(lanescape::host_kernel INTERFACE IMPORTED GLOBAL)
  # In the source tree, or below <prefix>/lib/cmake/lanescape or <prefix>/lib/<architecture>/cmake/lanescape.
  foreach(folder IN ITEMS ../src/api ../../../include ../../../../include)
    cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${CMAKE_CURRENT_LIST_DIR} NORMALIZE)
    if(EXISTS ${folder}/lanescape/host_kernel.h)
      target_include_directories(lanescape::host_kernel INTERFACE ${folder})
      break()
    endif()
  endforeach()
endif()

# lanescape_add_verification(<name> <library> <symbol> [PRECISION single]): a test <name> that runs `lanescape verify` on the function
# <symbol> of a shared library: a target, or the path of a file. docs/HOST_KERNELS.md describes the function. The program is that of this
# build or installation, or the one that the cache variable LANESCAPE_PROGRAM names.
function(lanescape_add_verification name library symbol)
  cmake_parse_arguments(PARSE_ARGV 3 ARG "" "PRECISION" "")
  if(ARG_UNPARSED_ARGUMENTS OR ARG_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "lanescape_add_verification: '${ARG_UNPARSED_ARGUMENTS}${ARG_KEYWORDS_MISSING_VALUES}' is not allowed: "
                        "<name> <library> <symbol> [PRECISION double|single] are")
  endif()
  if(TARGET ${library})
    get_target_property(type ${library} TYPE)
    if(NOT type MATCHES "^(SHARED|MODULE)_LIBRARY$")
      message(FATAL_ERROR "lanescape_add_verification: target ${library} is a ${type}: a SHARED or MODULE library is needed")
    endif()
    set(library $<TARGET_FILE:${library}>)
  endif()
  if(NOT ARG_PRECISION)
    set(ARG_PRECISION double)
  endif()
  foreach(target IN ITEMS lanescape::program lanescape_program)
    if(NOT LANESCAPE_PROGRAM AND TARGET ${target})
      set(LANESCAPE_PROGRAM $<TARGET_FILE:${target}>)
    endif()
  endforeach()
  if(NOT LANESCAPE_PROGRAM)
    set(above ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../..)
    find_program(LANESCAPE_PROGRAM lanescape HINTS ${above}/bin ${above}/../bin DOC "The program that lanescape_add_verification runs")
  endif()
  if(NOT LANESCAPE_PROGRAM)
    message(FATAL_ERROR "lanescape_add_verification: there is no program lanescape: set LANESCAPE_PROGRAM to its path, or build it "
                        "(LANESCAPE_BUILD_PROGRAM=ON)")
  endif()
  add_test(NAME ${name} COMMAND ${LANESCAPE_PROGRAM} verify --library ${library} --symbol ${symbol} --precision ${ARG_PRECISION})
endfunction()
