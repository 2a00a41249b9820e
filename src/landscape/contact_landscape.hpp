#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "dispatch/isa.hpp"
#include "dispatch/vector_algebra.hpp"
#include "interaction/sphere/gap_list.hpp"
#include "landscape/kinematic_landscape.hpp"

namespace lanescape {

// Hard spheres as steps along contacts see them: gaps and normals of all pairs near contact. Points of a path are in kinematic
// coordinates q, gaps and displacements of spheres in positions r; with equal masses both are the same.
class ContactLandscape {
 public:
  // `radii` per particle in the user's order; reach and skin as for GapList [sigma].
  ContactLandscape(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii, KinematicMetric metric, Isa isa,
                   double reach, double skin);
  // The list refers to the spheres.
  ContactLandscape(const ContactLandscape&) = delete;
  ContactLandscape& operator=(const ContactLandscape&) = delete;

  std::size_t dimension() const { return positions_.size(); }
  const VectorAlgebra& algebra() const { return algebra_; }
  const KinematicMetric& metric() const { return metric_; }
  const AlignedArray& inverse_masses() const { return inverse_masses_; }  // <m>/m per slot

  // See GapList::at().
  const std::vector<PairGap>& gaps(const AlignedArray& q);
  double reach() const { return list_.reach(); }
  std::uint64_t rebuilds() const { return list_.rebuilds(); }
  // The depth of the deepest overlap, 0 if there is none [sigma]. Checks all pairs, so it is slow.
  double violation(const AlignedArray& q);

  void exchange(Archive& archive) { list_.exchange(archive); }

 private:
  const AlignedArray& positions(const AlignedArray& q);

  VectorAlgebra algebra_;
  KinematicMetric metric_;
  AlignedArray positions_, inverse_masses_;
  HardSphereOverlap spheres_;
  GapList list_;
};

}  // namespace lanescape
