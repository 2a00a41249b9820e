#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "path/path_check.hpp"
#include "run/path_run.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

struct SearchSetup;

// Of a path that methods start from, as in the source.
inline constexpr std::size_t recorded_configurations = 1000;

// One trial of a method that shortens by trials.
struct ShortenTrial {
  double distance_left;          // of the point that was changed from the end of the path [sigma]
  std::optional<double> length;  // of the path found; none where none was found [sigma]
  bool accepted;
};

// How a path was made stationary.
struct CurveReport {
  double length_change = 0.0;  // by the last refinement, relative to the length
  std::uint64_t levels = 0, iterations = 0;
};

struct ShortenedPath {
  PathResult path;                   // frames: the nodes, ends included
  std::optional<PathCheck> check;    // certificate of the nodes; none where the nodes alone are no path
  std::vector<ShortenTrial> trials;  // of methods that make trials
  std::optional<CurveReport> curve;  // of curve shortening
};

// What shortening starts from. All of it must outlive the work.
struct ShortenSetup {
  const SearchSetup& search;  // between the ends of the pair
  const PathResult& initial;  // the path to shorten, from R_i to R_f
  std::uint64_t seed;
  std::uint32_t start;  // number of this run among those of other random numbers
};

class ShortenWork : public ResumableWork {
 public:
  // The path as short as it is by now.
  virtual ShortenedPath result() = 0;
  virtual double length() const = 0;
  // Whether the method ended by its own rule.
  virtual bool succeeded() const = 0;
};

// A method of shortening paths.
struct ShortenMethod {
  const char* word;   // of --method
  const char* units;  // what its progress counts
  std::unique_ptr<ShortenWork> (*begin)(const ShortenSetup& setup);
};

// All methods; the first is the default.
std::span<const ShortenMethod> shorten_methods();
const ShortenMethod& default_shorten_method();
// Throws Error(bad_input) naming the allowed words.
const ShortenMethod& shorten_method(std::string_view word);
// "curve, montecarlo"
std::string shorten_method_words();

}  // namespace lanescape
