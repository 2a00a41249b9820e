# lanescape_add_kernels(<target>): compiles every kernel source once per instruction set and links the objects into <target>.
# LANESCAPE_ISAS lists the instruction sets; the portable leg is the only one off x86 and can be asked for on x86 to test it.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(LANESCAPE_ISAS "sse2;avx2;avx512" CACHE STRING "Instruction sets to compile the kernels for (generic, sse2, avx2, avx512)")
else()
  set(LANESCAPE_ISAS "generic" CACHE STRING "Instruction sets to compile the kernels for (generic)")
endif()

set(LANESCAPE_ISA_FLAGS_generic "")
set(LANESCAPE_ISA_FLAGS_sse2 -msse2)
set(LANESCAPE_ISA_FLAGS_avx2 -mavx2 -mfma)
set(LANESCAPE_ISA_FLAGS_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mavx512cd -mavx2 -mfma)

function(lanescape_add_kernels target)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/*.cpp)
  foreach(isa IN LISTS LANESCAPE_ISAS)
    if(NOT DEFINED LANESCAPE_ISA_FLAGS_${isa})
      message(FATAL_ERROR "LANESCAPE_ISAS: unknown instruction set '${isa}': allowed are generic, sse2, avx2, avx512")
    endif()
    string(TOUPPER ${isa} upper)
    add_library(lanescape_kernels_${isa} OBJECT ${sources})
    target_include_directories(lanescape_kernels_${isa} PRIVATE ${PROJECT_SOURCE_DIR}/kernels)
    target_compile_definitions(lanescape_kernels_${isa} PRIVATE LANESCAPE_ISA=${isa} LANESCAPE_ISA_${upper})
    # No contraction: a product and a sum are fused where the source says so and nowhere else, so that the energies of two
    # kernels agree to the bit. Hidden symbols: code compiled for one processor must not leak into the rest of the program.
    target_compile_options(
      lanescape_kernels_${isa} PRIVATE ${LANESCAPE_ISA_FLAGS_${isa}} -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions
                                       -fno-rtti -fvisibility=hidden -fvisibility-inlines-hidden)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC 12's own AVX-512 headers set a vector from itself (GCC bug 105593).
      # The notes on passing wide vectors concern calls between objects, of which these have none.
      target_compile_options(lanescape_kernels_${isa} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized -Wno-psabi -Wno-ignored-attributes)
    endif()
    if(LANESCAPE_SANITIZE)
      # Instrumented, the forcibly inlined row loops take the compiler a quarter of an hour. The parity tests check the kernels;
      # the sanitizers check what calls them.
      target_compile_options(lanescape_kernels_${isa} PRIVATE -fno-sanitize=all)
    endif()
    if(NOT isa STREQUAL "generic")
      target_link_libraries(lanescape_kernels_${isa} PRIVATE xsimd)
    endif()
    target_link_libraries(lanescape_kernels_${isa} PRIVATE lanescape_warnings)
    set_target_properties(lanescape_kernels_${isa} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:lanescape_kernels_${isa}>)
    target_compile_definitions(${target} PRIVATE LANESCAPE_HAS_${upper})
  endforeach()
endfunction()
