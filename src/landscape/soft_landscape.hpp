#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/segment_bound.hpp"
#include "core/slot_work.hpp"
#include "dispatch/vector_algebra.hpp"

namespace lanescape {

// A potential-energy landscape V(R): the interface of a soft system for steppers and dynamics. One call takes microseconds, so the
// cost of its virtual dispatch is negligible; there is no virtual call per pair. Not thread-safe: each thread needs its own object.
// R is an array of dimension() doubles in three equal parts, all x, all y, all z. Padding entries, which belong to no particle,
// stay zero.
class SoftLandscape {
 public:
  virtual ~SoftLandscape() = default;

  virtual std::size_t dimension() const = 0;
  virtual std::size_t particles() const = 0;
  virtual const VectorAlgebra& algebra() const = 0;

  // V(R) [epsilon], with the same bits as energy_and_gradient().
  virtual double energy(const AlignedArray& position) = 0;
  // Returns V(R) and overwrites `gradient` with grad V(R) [epsilon/sigma].
  virtual double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) = 0;
  // grad V(R) with the same bits as energy_and_gradient().
  virtual void gradient(const AlignedArray& position, AlignedArray& gradient) { energy_and_gradient(position, gradient); }
  // The same at the positions to which `move` brings the particles. A landscape with threads does both in as few loops as it can.
  virtual void gradient_after(const SlotWork& move, const AlignedArray& position, AlignedArray& gradient) {
    algebra().for_all_slots(dimension() / 3, move);
    this->gradient(position, gradient);
  }

  // Bounds of V along segments up to `longest` [sigma]; null where none is known.
  virtual std::unique_ptr<SegmentBound> segment_bound(double) const { return nullptr; }
  // Whether the bits of V depend on more than R.
  virtual bool has_history() const { return false; }
  // Leaves the hidden state that an evaluation at R would, so that a landscape with bounds can go without that evaluation.
  virtual void pass_over(const AlignedArray&) {}

  // Archives hidden state besides R that affects the bits of V, such as the positions at which a neighbour list was built. It
  // belongs to the state of any dynamics or path on this landscape.
  virtual void exchange(Archive&) {}
};

// Makes landscapes of one system, for threads and for parts of a path that must not share lists.
using SoftLandscapeMaker = std::function<std::unique_ptr<SoftLandscape>()>;

}  // namespace lanescape
