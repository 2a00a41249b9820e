#pragma once

#include <memory>
#include <vector>

#include "path/shortening/curve_relaxation.hpp"
#include "path/shortening/gap_constraints.hpp"
#include "path/shortening/interior_point.hpp"

namespace lanescape {

struct HardCurveOptions {
  double length_unit = 1.0;  // of the system [sigma]
  int threads = 1;
};

// Shortens a path of hard spheres by sequential quadratic programming: an iteration linearises all gaps that its moves could close
// (GapConstraints) and minimises the energy of the string, half the sum of w_k |R_{k+1} - R_k|^2 with w_k ~ 1/|R_{k+1} - R_k| of
// the last nodes, as far as they allow (InteriorPoint). Linearised gaps are larger than those of the moved spheres by the square of
// a move only.
//
// On each level the path relaxes: the barrier of the gaps stays high, so that contacts form and open while they are soft, and
// iterations start from nodes ahead of the last ones (Nesterov's momentum), as only long moves along contacts are left. On the last
// level the barrier then falls under a damping that keeps moves short, and tighten() ends overlaps by moves that hardly count.
class HardCurve final : public CurveRelaxation {
 public:
  // `path` gives the system, and is copied.
  HardCurve(const HardSpherePath& path, const HardCurveOptions& options);

  // The most nodes whose matrices fit into the memory this may take, 4 GiB.
  std::size_t most_nodes() const;

  void begin(Polyline nodes) override;
  Relaxation iterate() override;
  bool tighten() override;

  const Polyline& nodes() const override { return now_; }
  double residual() const override { return residual_; }
  std::uint64_t evaluations() const override { return gaps_.evaluations(); }
  void exchange(Archive& archive) override;

 private:
  // In this order; all but the first are of the last level.
  enum class Phase : std::uint64_t { relaxes, settles, tightens, clears };

  HardSpherePath path() const { return {box_, layout_, radii_, metric_, isa_}; }
  void allocate(std::size_t nodes);
  void begin_phase(Phase phase);
  void set_string();
  void solve();
  void move();
  void look_ahead();
  void judge();
  bool is_calm();
  Relaxation next_phase();
  Relaxation cleared() const;

  Box box_;
  ParticleLayout layout_;
  std::vector<double> radii_;
  KinematicMetric metric_;
  Isa isa_;
  HardCurveOptions options_;
  VectorAlgebra algebra_;
  double contact_;  // gap of a pair that touches [sigma]
  GapConstraints gaps_;
  std::unique_ptr<InteriorPoint> interior_;

  Polyline now_, from_, last_;  // the path, where the next iteration starts, and the path before
  double residual_ = 1.0;
  double barrier_ = 0.0;      // [mean segment squared]
  double longest_ = 0.0;      // move of a sphere in the last iteration
  double last_length_ = 0.0;  // of the path, when its progress was looked at last
  Phase phase_ = Phase::relaxes;
  std::uint64_t levels_ = 0, phase_iterations_ = 0, onward_ = 0;  // onward: iterations since one turned back
  double mean_ = 0.0;                                             // length of a segment of from_
  std::vector<double> tensions_;
  std::vector<AlignedArray> gradient_, tangents_;
};

}  // namespace lanescape
