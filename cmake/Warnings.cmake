# Warnings of every target of this project; not passed on to those who link the library.
add_library(lanescape_warnings INTERFACE)
target_compile_options(lanescape_warnings INTERFACE -Wall -Wextra $<$<BOOL:${LANESCAPE_WERROR}>:-Werror>)
