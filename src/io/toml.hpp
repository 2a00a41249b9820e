#pragma once

// toml++ 3.3 asserts, and tells compilers to assume, what does not hold for every input: it ends the process at a table named
// [[{a]]. Without these it refuses such input, as it should. Sources that include it directly bring both back.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
