# Compiler warnings of every target of this project; users of the library do not inherit them.
add_library(lanescape_warnings INTERFACE)
target_compile_options(lanescape_warnings INTERFACE -Wall -Wextra $<$<BOOL:${LANESCAPE_WERROR}>:-Werror>)
# Clang forgets what precompiled headers of the standard library say about their own warnings: std::stable_sort of libstdc++ 12 has one.
target_compile_options(lanescape_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>)
