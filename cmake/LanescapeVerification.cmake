# lanescape_add_verification(<name> <library> <symbol> [PRECISION single]): a test <name> that runs `lanescape verify` on the function
# <symbol> of a shared library: a target, or the path of a file. docs/HOST_KERNELS.md describes the function, lanescape/host_kernel.h
# declares it. The program is that of this build or installation; the cache variable LANESCAPE_PROGRAM names another.
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
  _lanescape_find_program()
  add_test(NAME ${name} COMMAND ${LANESCAPE_PROGRAM} verify --library ${library} --symbol ${symbol} --precision ${ARG_PRECISION})
endfunction()

# Sets LANESCAPE_PROGRAM in the caller's scope.
macro(_lanescape_find_program)
  if(NOT LANESCAPE_PROGRAM AND TARGET lanescape_program)
    set(LANESCAPE_PROGRAM $<TARGET_FILE:lanescape_program>)
  endif()
  # From <prefix>/lib/cmake/lanescape or <prefix>/lib/<architecture>/cmake/lanescape.
  set(_lanescape_above ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../..)
  find_program(LANESCAPE_PROGRAM lanescape HINTS ${_lanescape_above}/bin ${_lanescape_above}/../bin
               DOC "The program that lanescape_add_verification runs")
  if(NOT LANESCAPE_PROGRAM)
    message(FATAL_ERROR "lanescape_add_verification: there is no program lanescape: set LANESCAPE_PROGRAM to its path, or build it "
                        "(LANESCAPE_BUILD_PROGRAM=ON)")
  endif()
endmacro()
