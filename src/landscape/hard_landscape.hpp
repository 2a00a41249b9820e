#pragma once

#include <cstddef>

#include "core/aligned_array.hpp"
#include "dispatch/vector_algebra.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"

namespace lanescape {

// Whether R is allowed: all that a stepper sees of a hard system. As with SoftLandscape one call is a
// whole evaluation, R is all x, all y, all z, and each thread has its own.
class HardLandscape {
 public:
  virtual ~HardLandscape() = default;

  virtual std::size_t dimension() const = 0;
  virtual std::size_t particles() const = 0;
  virtual const VectorAlgebra& algebra() const = 0;

  virtual bool allowed(const AlignedArray& position) = 0;
  // The overlapping pairs, valid until the next call.
  virtual ContactPairs find_contacts(const AlignedArray& position) = 0;
  // Adds the fictitious forces between them to `force`.
  virtual void add_contact_forces(kernels::ContactPotential potential, AlignedArray& force) = 0;
  // HardSphereList::avoidance_trial().
  virtual std::size_t avoidance_trial(AlignedArray& trial, const AlignedArray& position, AlignedArray& sum, AlignedArray& force,
                                      double step) const = 0;
  // The deepest overlap, at least 0 [sigma]; over all pairs, and slower.
  virtual double violation(const AlignedArray& position) = 0;
};

}  // namespace lanescape
