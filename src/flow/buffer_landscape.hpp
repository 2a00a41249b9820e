#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flow/outside.hpp"
#include "flow/slab_geometry.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape {

// What passes the planes between slices in some steps.
struct PlanePassages {
  std::vector<double> particles;  // net number along +x
  std::vector<double> momentum;   // x component carried along +x, counted positive in both directions

  explicit PlanePassages(std::size_t planes) : particles(planes, 0.0), momentum(planes, 0.0) {}
};

// The landscape of an open slab of one species: its gradients include the force of the outside on the buffers. That of a face is p
// A inwards and the shear along it, shared among the buffer's particles in proportion to their weights, so that the total is exact
// in every step. This force is no gradient: its work is counted, as the integrator takes steps, and so are passages of planes. V is
// that of the pairs alone.
class BufferLandscape final : public SoftLandscape {
 public:
  // `pairs` must outlive this object. `mass`: of a particle.
  BufferLandscape(PairLandscape& pairs, const ParticleLayout& layout, const SlabGeometry& geometry, const Outside::Demands& demands,
                  double mass, double time_step);

  std::size_t dimension() const override { return pairs_->dimension(); }
  std::size_t particles() const override { return pairs_->particles(); }
  const VectorAlgebra& algebra() const override { return pairs_->algebra(); }
  double energy(const AlignedArray& position) override { return pairs_->energy(position); }
  // The first positions, those that steps start from.
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override;
  // A step.
  void gradient_after(const SlotWork& move, const AlignedArray& position, AlignedArray& gradient) override;
  bool has_history() const override { return pairs_->has_history(); }
  void exchange(Archive& archive) override { pairs_->exchange(archive); }

  // Impulses and work of the forces of the outside in the steps so far.
  const Outside::Reports& reports() const { return reports_; }
  const PlanePassages& passages() const { return passages_; }
  // The force of a face on its buffer, summed over the particles that bear it, at the last positions.
  Point force(std::size_t face) const;
  // Whether a buffer had no particle to bear its force in some step. The force was then zero.
  bool emptied() const { return emptied_; }
  // At the first positions: the total force of the particles before each plane between slices on those beyond it, along x; the last
  // plane is the face at L.
  const std::vector<double>& forces_across() const { return forces_across_; }

 private:
  struct Bearer {
    std::uint32_t slot;
    double weight;
    Point force;
  };
  // What a range of slots contributes.
  struct Range {
    std::array<std::vector<Bearer>, 2> bearers;
    std::vector<std::uint32_t> passing;  // slots that passed a plane
  };

  void find_bearers(const AlignedArray& position, std::size_t range);
  void share_forces(AlignedArray& gradient);
  void add_half_of_work(const AlignedArray& position);
  void count_passages(const AlignedArray& position);
  void sum_forces_across(const AlignedArray& position, const AlignedArray& gradient);
  template <class Visit>
  void for_each_range(Visit visit);

  PairLandscape* pairs_;
  std::size_t count_, slots_;
  SlabGeometry geometry_;
  std::array<Point, 2> total_;  // force of each face
  double mass_, time_step_;
  std::vector<Range> ranges_;
  AlignedArray before_;  // positions of the last evaluation
  Outside::Reports reports_{};
  PlanePassages passages_;
  std::vector<double> forces_across_;
  bool sheared_ = false, emptied_ = false;
};

}  // namespace lanescape
