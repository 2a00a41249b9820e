#pragma once

#include <string>  // defines the standard library's ABI macros

// What the library exports; everything else in it is hidden.
#if defined(__GNUC__)
#define LANESCAPE_API __attribute__((visibility("default")))
#else
#define LANESCAPE_API
#endif

// Public names carry a tag of the standard library's layout: a host whose strings and vectors differ from the library's
// (-D_GLIBCXX_DEBUG, the string ABI before C++11) fails to link instead of crashing.
#if defined(_GLIBCXX_DEBUG)
#define LANESCAPE_ABI_BEGIN inline namespace v0_debug_containers {
#elif defined(_GLIBCXX_USE_CXX11_ABI) && !_GLIBCXX_USE_CXX11_ABI
#define LANESCAPE_ABI_BEGIN inline namespace v0_old_strings {
#else
#define LANESCAPE_ABI_BEGIN inline namespace v0 {
#endif
#define LANESCAPE_ABI_END }
