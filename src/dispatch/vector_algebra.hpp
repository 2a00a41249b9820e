#pragma once

#include <cmath>

#include "core/aligned_array.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// Algebra on whole coordinate arrays (ParticleLayout order) in a fixed order of summation: the kernels' vector operations for
// the stages that are not allowed to see the kernel table. All arrays have the same length.
class VectorAlgebra {
 public:
  explicit VectorAlgebra(const kernels::KernelTable& table) : table_(&table) {}

  double dot(const AlignedArray& a, const AlignedArray& b) const { return table_->dot(a.data(), b.data(), a.size()); }
  double norm(const AlignedArray& a) const { return std::sqrt(dot(a, a)); }
  double distance(const AlignedArray& a, const AlignedArray& b) const {
    return std::sqrt(table_->distance_squared(a.data(), b.data(), a.size()));
  }
  // out = a - b
  void difference(AlignedArray& out, const AlignedArray& a, const AlignedArray& b) const {
    table_->difference(out.data(), a.data(), b.data(), out.size());
  }
  // out = x + a u
  void axpy(AlignedArray& out, const AlignedArray& x, double a, const AlignedArray& u) const {
    table_->axpy(out.data(), x.data(), a, u.data(), out.size());
  }
  // out = x + a u + b v
  void combine(AlignedArray& out, const AlignedArray& x, double a, const AlignedArray& u, double b, const AlignedArray& v) const {
    table_->combine(out.data(), x.data(), a, u.data(), b, v.data(), out.size());
  }
  // The same on elements [begin, begin + length) only, whole vectors of them: out += a u, and the dot product.
  void add_scaled(AlignedArray& out, double a, const AlignedArray& u, std::size_t begin, std::size_t length) const {
    table_->axpy(out.data() + begin, out.data() + begin, a, u.data() + begin, length);
  }
  double dot(const AlignedArray& a, const AlignedArray& b, std::size_t begin, std::size_t length) const {
    return table_->dot(a.data() + begin, b.data() + begin, length);
  }
  // Sums over particles of |to - from|^2 and |to - from|^4.
  kernels::DisplacementMoments displacement_moments(const AlignedArray& from, const AlignedArray& to) const {
    return table_->displacement_moments(from.data(), to.data(), from.size() / 3);
  }
  // Adds |to_j - from_j| to lengths[j], one per slot.
  void add_particle_lengths(AlignedArray& lengths, const AlignedArray& from, const AlignedArray& to) const {
    table_->add_particle_lengths(lengths.data(), from.data(), to.data(), lengths.size());
  }
  // Of a collision-avoidance step: kernels::KernelTable::sphere_avoidance_trial.
  std::size_t avoidance_trial(AlignedArray& trial, const AlignedArray& position, AlignedArray& sum, AlignedArray& force,
                              double step) const {
    return table_->sphere_avoidance_trial(trial.data(), position.data(), sum.data(), force.data(), step, trial.size() / 3);
  }

 private:
  const kernels::KernelTable* table_;
};

}  // namespace lanescape
