#pragma once

#include <cstddef>

#include "core/aligned_array.hpp"
#include "dispatch/vector_algebra.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"

namespace lanescape {

// The set of configurations R without overlaps: the interface of a hard system for steppers. As in SoftLandscape, one call is a
// whole evaluation, R is stored as all x, all y, all z, and each thread needs its own object.
class HardLandscape {
 public:
  virtual ~HardLandscape() = default;

  virtual std::size_t dimension() const = 0;
  virtual std::size_t particles() const = 0;
  virtual const VectorAlgebra& algebra() const = 0;

  virtual bool allowed(const AlignedArray& position) = 0;
  // The overlapping pairs, valid until the next call.
  virtual ContactPairs find_contacts(const AlignedArray& position) = 0;
  // Adds the fictitious forces of the pairs found last to `force`.
  virtual void add_contact_forces(kernels::ContactPotential potential, AlignedArray& force) = 0;
  // See HardSphereList::avoidance_trial().
  virtual std::size_t avoidance_trial(AlignedArray& trial, const AlignedArray& position, AlignedArray& sum, AlignedArray& force,
                                      double step) const = 0;
  // The depth of the deepest overlap, 0 if there is none [sigma]. Checks all pairs, so it is slow.
  virtual double violation(const AlignedArray& position) = 0;
};

}  // namespace lanescape
