#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "path/shortening/curve_relaxation.hpp"

namespace lanescape {

struct CurveOptions {
  double coarse_spacing = 0.5;           // of the nodes at first, at most [sigma]
  double length_tolerance = 1e-4;        // refinement ends where doubling the nodes changes the length by less than this part
  std::size_t most_nodes = 100'000;      // of the finest level
  std::uint64_t most_iterations = 3000;  // of all levels together
};

// Constrained curve shortening from coarse to fine (PHYSICS 4): the path is relaxed with few nodes, then with twice as many, until
// its length no longer changes; then its segments are made to keep to the allowed region. Long moves are made where they are cheap.
class CurveShortening {
 public:
  CurveShortening(const VectorAlgebra& algebra, std::unique_ptr<CurveRelaxation> relaxation, const CurveOptions& options);

  // Starts from the nodes of any path whose ends are allowed. Throws Error(goal_not_reached) where its nodes cannot be moved into
  // the allowed region. All else needs this first, or exchange() that reads.
  void begin(const Polyline& start);

  bool finished() const { return finished_ != 0; }
  // Why it ended without a stationary path; empty otherwise.
  const std::string& reason() const { return reason_; }
  // One iteration.
  void advance();

  const Polyline& nodes() const { return relaxation_->nodes(); }
  double length() const { return polyline_length(*algebra_, nodes()); }
  double length_change() const { return length_change_; }  // relative, of the last refinement
  double residual() const { return relaxation_->residual(); }
  std::uint64_t levels() const { return levels_; }
  std::uint64_t iterations() const { return iterations_; }
  std::uint64_t evaluations() const { return relaxation_->evaluations(); }
  void exchange(Archive& archive);

 private:
  void begin_level(Polyline nodes);
  void end_level();
  void finish(std::string reason);

  const VectorAlgebra* algebra_;
  std::unique_ptr<CurveRelaxation> relaxation_;
  CurveOptions options_;
  std::uint64_t finished_ = 0, levels_ = 0, iterations_ = 0, tightenings_ = 0;
  double last_length_ = 0.0, length_change_ = 1.0;
  std::string reason_;
};

}  // namespace lanescape
