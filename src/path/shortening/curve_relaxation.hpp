#pragma once

#include <cstddef>
#include <cstdint>

#include "core/archive.hpp"
#include "path/polyline.hpp"

namespace lanescape {

// How far one iteration has brought a path.
enum class Relaxation : std::uint64_t {
  continues,
  stationary,  // the Kuhn-Tucker residual has come below the limit of the relaxation
  stopped      // no step makes the path shorter any more
};

// Shortens a path with a fixed number of nodes in the allowed region: what curve shortening needs of soft and of hard systems.
class CurveRelaxation {
 public:
  virtual ~CurveRelaxation() = default;

  // Starts from these nodes; those outside the allowed region are moved into it. Throws Error(goal_not_reached) where that fails.
  virtual void begin(Polyline nodes) = 0;
  virtual Relaxation iterate() = 0;
  // Makes the segments keep to the allowed region, not only the nodes. True if that took changes, and the path must be relaxed
  // again.
  virtual bool tighten() = 0;

  virtual const Polyline& nodes() const = 0;
  virtual double residual() const = 0;  // of PHYSICS 4, after the last iteration
  virtual std::uint64_t evaluations() const = 0;
  // The whole state, once begin() has been called; reading it takes its place.
  virtual void exchange(Archive& archive) = 0;
};

}  // namespace lanescape
