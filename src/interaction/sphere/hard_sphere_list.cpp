#include "interaction/sphere/hard_sphere_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/float_environment.hpp"
#include "core/padded.hpp"

namespace lanescape {
namespace {

// The list knows one image of each pair. Any other image is at least half a box away when the list is built and approaches by less
// than the skin: it must not reach contact before the list is rebuilt.
double allowed_skin(double wanted, const HardSphereOverlap& spheres) {
  return std::max(0.0, std::min(wanted, 0.5 * spheres.box().shortest() - 2.0 * spheres.largest_radius()));
}

}  // namespace

HardSphereList::HardSphereList(HardSphereOverlap& spheres, double skin)
    : spheres_(&spheres), half_skin_(allowed_skin(skin, spheres), spheres.table()) {}

void HardSphereList::update(const AlignedArray& positions) {
  if (half_skin_.is_due(positions)) rebuild(positions);
}

void HardSphereList::make_room(std::size_t count) {
  if (!first_.empty() && first_.size() >= count) return;
  const std::size_t room = 2 * count + kernels::slot_padding;
  for (auto* array : {&first_, &second_}) array->resize(room);
  for (auto* arrays : {&shift_, &separation_, &force_})
    for (AlignedArray& array : *arrays) array.resize(room);
  for (auto* array : {&contact_, &squared_}) array->resize(room);
  offsets_.resize(room + 2 * kernels::slot_padding);
  list_ = {first_.data(), second_.data(), shift_[0].data(), shift_[1].data(), shift_[2].data(), contact_.data(), 0};
  contacts_ = {offsets_.data(), separation_[0].data(), separation_[1].data(), separation_[2].data(),
               squared_.data(), force_[0].data(),      force_[1].data(),      force_[2].data()};
}

void HardSphereList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  half_skin_.rebuilt_at(positions);
  const auto& pairs = spheres_->pairs_within(positions, half_skin_.skin());
  const AlignedArray& radii = spheres_->radii();
  const std::size_t slots = radii.size(), count = padded(pairs.size());
  make_room(count);
  list_.count = count;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto i = static_cast<std::size_t>(pairs[k].first), j = static_cast<std::size_t>(pairs[k].second);
    first_[k] = pairs[k].first;
    second_[k] = pairs[k].second;
    contact_[k] = radii[i] + radii[j];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double length = spheres_->box().length[axis];
      shift_[axis][k] = length * std::nearbyint((positions[axis * slots + j] - positions[axis * slots + i]) / length);
    }
  }
  for (std::size_t k = pairs.size(); k < count; ++k) {
    first_[k] = second_[k] = 0;
    contact_[k] = std::numeric_limits<double>::quiet_NaN();
    for (auto& shift : shift_) shift[k] = 0.0;
  }
}

bool HardSphereList::any_overlap(const AlignedArray& positions) {
  const FloatEnvironment environment;
  update(positions);
  return spheres_->table().sphere_list_any_overlap(list_, positions.data(), positions.size() / 3);
}

ContactPairs HardSphereList::find_contacts(const AlignedArray& positions) {
  const FloatEnvironment environment;
  update(positions);
  contact_count_ = spheres_->table().sphere_list_contacts(list_, positions.data(), positions.size() / 3, contacts_);
  return {offsets_.data(), first_.data(), second_.data(), contact_count_};
}

void HardSphereList::add_contact_forces(kernels::ContactPotential potential, AlignedArray& force) {
  const FloatEnvironment environment;
  spheres_->table().sphere_contact_forces(list_, contacts_, contact_count_, potential, force.data(), force.size() / 3);
}

std::size_t HardSphereList::avoidance_trial(AlignedArray& trial, const AlignedArray& position, AlignedArray& sum,
                                            AlignedArray& force, double step) const {
  return spheres_->table().sphere_avoidance_trial(trial.data(), position.data(), sum.data(), force.data(), step, trial.size() / 3);
}

}  // namespace lanescape
