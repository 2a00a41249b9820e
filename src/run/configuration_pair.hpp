#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"

namespace lanescape {

// One pair of end points as its user sees it: both ends unwrapped, in the user's order.
struct ConfigurationPair {
  Configuration start, finish;
  double distance = 0.0;                // [sigma]
  std::uint64_t steps = 0;              // of molecular dynamics between the two, or collisions; 0 if not known
  double time = 0.0;                    // likewise
  double radius_factor = 1.0;           // by which radii of a file were scaled, where its rounding made spheres overlap
  std::optional<double> temperature{};  // of the liquid that soft ends are taken from [epsilon/k_B], where known
};

// Throws Error(bad_input) where the ends of a pair differ in box, composition or radii, coincide or overlap; the message starts
// with `where`.
void check_end_points(const ConfigurationPair& pair, const AnyModel& model, const std::string& where);

// Whether both ends look wrapped, and a wrong distance is the likely consequence. Ends of a pair are unwrapped: the distance and
// the path follow plain differences of positions. Two signs together make the pair suspicious. All coordinates of both frames lie
// within 0 <= x <= L, faces included, since files with few digits round up to them; unwrapped positions leave that box once
// particles have diffused. And some particle moves by more than half an edge along an axis, which in wrapped frames is the trace of
// a crossed face; without such a particle, wrapping has changed nothing that shows.
bool looks_wrapped(const ConfigurationPair& pair);

}  // namespace lanescape
