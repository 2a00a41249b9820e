#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "configuration/model.hpp"

namespace lanescape {

class PathSearch;
struct SearchSetup;

// A method of finding paths: a stepper, the family of models it is for, and its defaults.
struct PathMethod {
  const char* word;                   // of --method
  bool is_hard;                       // for hard spheres; else for soft particles
  std::optional<double> direct_step;  // default length of a direct step in 3N space [sigma]; none where steps have no length
  std::uint64_t patience_factor;      // FinderOptions::patience is multiplied by it
  std::unique_ptr<PathSearch> (*begin)(const SearchSetup& setup);
  std::unique_ptr<PathSearch> (*begin_adaptive)(const SearchSetup& setup);  // nullptr: the method has no adaptive steps
};

// All methods; the first of each family is its default.
std::span<const PathMethod> path_methods();
const PathMethod& default_path_method(bool is_hard);
// Throws Error(bad_input) naming the allowed words.
const PathMethod& path_method(std::string_view word);
// The words of a family: "contour, escape".
std::string path_method_words(bool is_hard, std::string_view separator = ", ");
// The words of the methods that have adaptive steps.
std::string adaptive_method_words();
// Throws Error(bad_input), naming the methods that have them, if the method has no adaptive steps.
void check_adaptive(const PathMethod& method);
// Throws Error(bad_input) if the method is not for this kind of model.
void check_method(const PathMethod& method, const AnyModel& model);

}  // namespace lanescape
