# Instruction sets: reads cmake/instruction_sets.txt, writes the header dispatch/instruction_sets.hpp for C++, and compiles sources
# once per instruction set. LANESCAPE_ISAS lists those to compile; processors other than x86 have only the portable one.
set(LANESCAPE_INSTRUCTION_SETS_FILE ${PROJECT_SOURCE_DIR}/cmake/instruction_sets.txt)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${LANESCAPE_INSTRUCTION_SETS_FILE})
file(STRINGS ${LANESCAPE_INSTRUCTION_SETS_FILE} lines REGEX "^[a-z]")
set(LANESCAPE_ALL_ISAS "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE " *\\| *" ";" fields "${line};")
  list(GET fields 0 isa)
  list(GET fields 1 flags)
  list(GET fields 2 features)
  separate_arguments(LANESCAPE_ISA_FLAGS_${isa} UNIX_COMMAND "${flags}")
  separate_arguments(features UNIX_COMMAND "${features}")
  set(LANESCAPE_ISA_SUPPORTED_${isa} true)  # a condition in C++
  foreach(feature IN LISTS features)
    string(APPEND LANESCAPE_ISA_SUPPORTED_${isa} " && __builtin_cpu_supports(\"${feature}\")")
  endforeach()
  list(APPEND LANESCAPE_ALL_ISAS ${isa})
endforeach()

string(TOLOWER "${CMAKE_SYSTEM_PROCESSOR}" processor)  # systems write x86_64, amd64 or AMD64
set(LANESCAPE_ON_X86_64 OFF)
if(processor MATCHES "^(x86_64|amd64)$")
  set(LANESCAPE_ON_X86_64 ON)
endif()

set(LANESCAPE_ISAS "" CACHE STRING
    "Instruction sets to compile the kernels for (${LANESCAPE_ALL_ISAS}); empty: all of this architecture; native: the best of this machine")
if(NOT LANESCAPE_ISAS)
  if(LANESCAPE_ON_X86_64)
    set(LANESCAPE_ISAS ${LANESCAPE_ALL_ISAS})
    if(NOT LANESCAPE_BUILD_TESTS)
      list(REMOVE_ITEM LANESCAPE_ISAS generic)  # on x86-64 the portable one is only for tests
    endif()
  else()
    set(LANESCAPE_ISAS generic)
  endif()
endif()
if(LANESCAPE_ISAS STREQUAL "native")
  include(NativeIsa)
  lanescape_native_isa(LANESCAPE_ISAS)
  message(STATUS "LANESCAPE_ISAS: native is ${LANESCAPE_ISAS}")
endif()
foreach(isa IN LISTS LANESCAPE_ISAS)
  if(NOT isa IN_LIST LANESCAPE_ALL_ISAS)
    message(FATAL_ERROR "LANESCAPE_ISAS: unknown instruction set '${isa}': allowed are ${LANESCAPE_ALL_ISAS}")
  endif()
endforeach()

# Targets that include dispatch/instruction_sets.hpp link this.
set(LANESCAPE_ALL_ENTRIES "")
set(LANESCAPE_BUILT_ENTRIES "")
foreach(isa IN LISTS LANESCAPE_ALL_ISAS)
  string(APPEND LANESCAPE_ALL_ENTRIES " ENTRY(${isa})")
  if(isa IN_LIST LANESCAPE_ISAS)
    string(APPEND LANESCAPE_BUILT_ENTRIES " ENTRY(${isa}, ${LANESCAPE_ISA_SUPPORTED_${isa}})")
  endif()
endforeach()
set(LANESCAPE_INTERNAL_HEADERS ${PROJECT_BINARY_DIR}/generated_internal)
configure_file(${PROJECT_SOURCE_DIR}/cmake/instruction_sets.hpp.in ${LANESCAPE_INTERNAL_HEADERS}/dispatch/instruction_sets.hpp @ONLY)

# lanescape_add_isa_objects(<name> <sources>): an object library <name>_<isa> per instruction set. The kernels' come first: the others
# take their precompiled header.
function(lanescape_add_isa_objects name)
  foreach(isa IN LISTS LANESCAPE_ISAS)
    set(target ${name}_${isa})
    add_library(${target} OBJECT ${ARGN})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/kernels)
    target_compile_definitions(${target} PRIVATE LANESCAPE_ISA=${isa})
    if(name STREQUAL "lanescape_kernels")
      target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/kernels/simd/simd.hpp)  # all that xsimd and intrinsics declare
    else()
      target_precompile_headers(${target} REUSE_FROM lanescape_kernels_${isa})
    endif()
    # No contraction: a product and a sum are fused where the source says so and nowhere else, so that the energies of two
    # kernels agree to the bit. Hidden symbols: code compiled for one processor must not leak into the rest of the program.
    target_compile_options(
      ${target} PRIVATE ${LANESCAPE_ISA_FLAGS_${isa}} -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti
                        -fvisibility=hidden -fvisibility-inlines-hidden)
    if(isa STREQUAL "generic" AND NOT LANESCAPE_ISAS STREQUAL "generic")
      # If other instruction sets are built, the portable one is only for tests: at -O3 its forms take minutes to compile.
      target_compile_options(${target} PRIVATE -O1)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC 12's own AVX-512 headers initialise a vector with itself (GCC bug 105593). The notes on passing wide vectors are about
      # calls between objects; these objects have no such calls.
      target_compile_options(${target} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized -Wno-psabi -Wno-ignored-attributes)
    endif()
    if(LANESCAPE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # Force-inlined row loops take GCC 12 long: pair_lennard_jones for AVX2 more than 150 s with checks of addresses alone, Clang
      # 19, which the presets use, 16 s with those of undefined behaviour too.
      target_compile_options(${target} PRIVATE -fno-sanitize=all)
    elseif(LANESCAPE_SANITIZE)
      # Instrumented loops are not vectorised, whatever their pragma says.
      target_compile_options(${target} PRIVATE -Wno-pass-failed)
      if(LANESCAPE_SANITIZE MATCHES "address")
        # Checks of addresses as calls: inline they make the row loops several times longer to compile.
        target_compile_options(${target} PRIVATE "SHELL:-mllvm -asan-instrumentation-with-call-threshold=0")
      endif()
    endif()
    if(NOT isa STREQUAL "generic")
      target_link_libraries(${target} PRIVATE xsimd)
    endif()
    target_link_libraries(${target} PRIVATE lanescape_warnings)
    # Whatever a host asks for: never one source, since each potential takes long enough, and never optimised together with code for
    # other processors.
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF INTERPROCEDURAL_OPTIMIZATION OFF)
  endforeach()
endfunction()

# lanescape_link_isa_objects(<target> <name>): links the objects of all instruction sets into <target>.
function(lanescape_link_isa_objects target name)
  foreach(isa IN LISTS LANESCAPE_ISAS)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${name}_${isa}>)
  endforeach()
endfunction()
