# Compiler warnings of every target of this project; users of the library do not inherit them.
add_library(lanescape_warnings INTERFACE)
target_compile_options(lanescape_warnings INTERFACE -Wall -Wextra $<$<BOOL:${LANESCAPE_WERROR}>:-Werror>)
