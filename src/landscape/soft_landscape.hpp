#pragma once

#include <cstddef>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "dispatch/vector_algebra.hpp"

namespace lanescape {

// A potential-energy landscape V(R): all that a stepper sees of a soft system. One call takes microseconds, so that its virtual
// dispatch costs nothing; there is none per pair. Not thread-safe: each thread has its own. R is an array of dimension() doubles in
// three equal parts, all x, all y, all z; entries that belong to no particle stay zero.
class SoftLandscape {
 public:
  virtual ~SoftLandscape() = default;

  virtual std::size_t dimension() const = 0;
  virtual std::size_t particles() const = 0;
  virtual const VectorAlgebra& algebra() const = 0;

  // V(R) [epsilon]; bit-equal to what energy_and_gradient returns.
  virtual double energy(const AlignedArray& position) = 0;
  // V(R) and grad V(R) [epsilon/sigma].
  virtual double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) = 0;
  // The same grad V(R), to the bit, without V.
  virtual void gradient(const AlignedArray& position, AlignedArray& gradient) { energy_and_gradient(position, gradient); }

  // What the bits of V depend on besides R, such as the positions at which a neighbour list was built. It is part of the state of
  // whatever moves on this landscape.
  virtual void exchange(Archive&) {}
};

}  // namespace lanescape
