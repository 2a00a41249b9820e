#pragma once

#include <optional>
#include <vector>

#include "path/shortening/boundary_problem.hpp"
#include "path/shortening/curve_relaxation.hpp"
#include "path/shortening/soft_nodes.hpp"

namespace lanescape {

struct SoftCurveOptions {
  double length_unit = 1.0;  // of the system [sigma]
  int threads = 1;
};

// Shortens a path under V <= E_L by a projected Newton method with a trust region. The energy of a string through the nodes, half
// the sum of squared segments, is least for a geodesic with equally spaced nodes. An iteration finds which nodes belong on the
// boundary (BoundaryProblem), and improves that step by conjugate gradients along the boundary with the curvature of V, from
// differences of gradients (Gould, Hribar and Nocedal 2001, doi 10.1137/S1064827598345667). It then moves the nodes, puts
// those above their level back, and takes the step if the energy fell.
class SoftCurve final : public CurveRelaxation {
 public:
  SoftCurve(SoftLandscapeMaker make_landscape, double landscape_energy, const SoftCurveOptions& options);

  void begin(Polyline nodes) override;
  Relaxation iterate() override;
  bool tighten() override;

  const Polyline& nodes() const override { return now_->nodes; }
  double residual() const override { return residual_; }
  std::uint64_t evaluations() const override { return earlier_evaluations_ + nodes_->evaluations(); }
  void exchange(Archive& archive) override;

 private:
  void allocate(Polyline nodes);
  void find_boundary_step();
  void improve_step();
  double apply_curved(const Polyline& direction, Polyline& out);
  double string_energy(const Polyline& nodes) const;
  double longest(const Polyline& field) const;
  double product(const Polyline& a, const Polyline& b) const;
  double measured_residual() const;

  SoftLandscapeMaker make_landscape_;
  double landscape_energy_;
  SoftCurveOptions options_;
  double scale_ = 1.0;   // lengths in 3N space at which normals turn, for the system's size [sigma]
  double trust_ = 0.0;   // longest step of a node [sigma]
  bool is_cut_ = false;  // whether the step that was found last ends at it
  double residual_ = 1.0;
  std::uint64_t earlier_evaluations_ = 0;

  std::unique_ptr<SoftNodes> nodes_;
  std::optional<SoftNodes::Field> now_, trial_;
  std::optional<BoundaryProblem> boundary_;
  std::vector<double> levels_;   // V that each node may have [epsilon]
  std::vector<double> curving_;  // mu_k/|grad V|, by which the curvature of V counts
  double shift_ = 0.0;
  Polyline pull_, step_, rest_, conditioned_, direction_, applied_;
};

}  // namespace lanescape
