#pragma once

#include <memory>
#include <vector>

#include "path/shortening/curve_relaxation.hpp"
#include "path/shortening/hard_nodes.hpp"
#include "path/shortening/string_laplacian.hpp"

namespace lanescape {

struct HardCurveOptions {
  double length_unit = 1.0;  // of the system [sigma]
  int threads = 1;
};

// Shortens a path of hard spheres in corridors free of overlaps (HardNodes), by a truncated nonsmooth Newton method (Graeser and
// Kornhuber 2009). The length is bounded from above by the energy of a string, half the sum of w_k |R_{k+1} - R_k|^2 with
// w_k ~ 1/|R_{k+1} - R_k| of the last nodes. An iteration minimises it at one node after the other, then in the directions along
// all planes that act (conjugate gradients), and moves the corridors along. The length never grows, nor do overlaps appear.
class HardCurve final : public CurveRelaxation {
 public:
  // `path` gives the system, and is copied.
  HardCurve(const HardSpherePath& path, const HardCurveOptions& options);

  void begin(Polyline nodes) override;
  Relaxation iterate() override;
  // Segments never leave the allowed region.
  bool tighten() override;

  const Polyline& nodes() const override { return now_; }
  double residual() const override { return residual_; }
  std::uint64_t evaluations() const override { return earlier_evaluations_ + (nodes_ ? nodes_->evaluations() : 0); }
  void exchange(Archive& archive) override;

 private:
  void allocate(Polyline nodes);
  void follow();
  void set_tensions();
  void sweep(std::size_t colour);
  void find_step();
  void correct();
  void restore();
  void pull_at(std::size_t k, AlignedArray& pull) const;
  void apply(const Polyline& field, std::size_t k, AlignedArray& out) const;
  double product(const Polyline& a, const Polyline& b) const;
  double measured_residual();

  Box box_;
  ParticleLayout layout_;
  std::vector<double> radii_;
  KinematicMetric metric_;
  Isa isa_;
  HardCurveOptions options_;
  double residual_ = 1.0;
  std::uint64_t earlier_evaluations_ = 0, tight_iterations_ = 0;

  std::unique_ptr<HardNodes> nodes_;
  StringLaplacian laplacian_;
  std::vector<double> tensions_;  // of segments, 1 at the mean length
  Polyline now_, moved_;          // where the corridors are, and the nodes since
  Polyline rest_, conditioned_, direction_, applied_, step_;
};

}  // namespace lanescape
