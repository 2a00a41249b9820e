#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/box.hpp"
#include "core/segment_bound.hpp"
#include "interaction/pair/pair_loss.hpp"

namespace lanescape {

// Bounds of a mixture's energy by a pass over all pairs (src/interaction/README.md, "Bounds along a segment").
class PairSegmentBound final : public SegmentBound {
 public:
  // Nothing where PairLoss has no bound. Holds along segments up to `longest` in 3N space [sigma].
  static std::unique_ptr<SegmentBound> make(const PairModel& model, const Box& box, const ParticleLayout& layout, double longest);

  double reach() const override { return reach_; }
  SegmentLoss around(const AlignedArray& centre) override;

 private:
  // A particle's share of the sums over pairs.
  struct Share {
    double curvature = 0.0, kink = 0.0;

    void add(const PairLoss::Entry& entry) {
      curvature += entry.curvature;
      kink += entry.kink;
    }
  };
  struct Total {
    double energy = 0.0, slope = 0.0, pairs = 0.0;
  };

  PairSegmentBound(const PairModel& model, const Box& box, const ParticleLayout& layout, double longest);
  PairLoss::Entry flip(const PairLoss& loss, double change) const;
  void wrap(const AlignedArray& centre);
  void add_pairs(std::size_t a, std::size_t b, Total& total);
  void add_row(std::size_t slot, std::size_t begin, std::size_t end, std::size_t ab, Total& total);
  void find_separations(std::size_t slot, std::size_t begin, std::size_t end, float steps_per_area);
  Point separation(std::size_t i, std::size_t j) const;
  PairLoss::Entry other_images(const PairLoss& loss, const Point& nearest, double& pairs) const;

  Box box_;
  ImageRule images_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t species_, slots_, particles_;
  double reach_;
  std::vector<PairLoss> losses_;        // of each pair of species
  std::vector<PairLoss::Entry> flips_;  // of each: the jump of the slope where the nearest image changes
  double flip_difference_ = 0.0;        // [sigma^2]
  // Single precision is enough for separations: their rounding is part of the tables' reach.
  std::vector<float> wrapped_;
  std::vector<float> squared_, next_squared_;  // of a row [sigma^2]
  std::vector<std::int32_t> steps_;            // of a row, in a PairLoss
  std::vector<Share> shares_;
};

}  // namespace lanescape
