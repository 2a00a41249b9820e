#include "api/host_landscape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace lanescape {

MassMixture::MassMixture(std::span<const double> masses, std::size_t particles) : species(particles, 0) {
  if (!masses.empty() && masses.size() != particles)
    throw_bad_input(fmt::format("{} masses were given for {} particles: one for each, or none", masses.size(), particles));
  mixture.name = "host";
  std::map<double, int> known;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (!(masses[i] > 0.0) || !std::isfinite(masses[i]))
      throw_bad_input(fmt::format("mass {} of particle {} (from 0) is not allowed: it must be finite and above 0", masses[i], i));
    species[i] = known.try_emplace(masses[i], static_cast<int>(known.size())).first->second;
  }
  if (masses.empty()) known.emplace(1.0, 0);
  mixture.species.resize(known.size());
  for (const auto& [mass, s] : known) mixture.species[static_cast<std::size_t>(s)] = {fmt::format("mass-{}", mass), mass};
}

HostLandscape::HostLandscape(Landscape& host, const ParticleLayout& layout, Isa isa)
    : host_(&host), layout_(&layout), algebra_(kernel_table(isa)), positions_(3 * layout.size()), gradient_(3 * layout.size()) {}

std::span<const double> HostLandscape::to_host(const AlignedArray& position) {
  const std::size_t slots = layout_->slots();
  for (std::size_t i = 0; i < layout_->size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) positions_[3 * i + axis] = position[axis * slots + layout_->slot_of(i)];
  return positions_;
}

double HostLandscape::energy(const AlignedArray& position) { return host_->energy(to_host(position)); }

double HostLandscape::energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) {
  const double energy = host_->energy_and_gradient(to_host(position), gradient_);
  const std::size_t slots = layout_->slots();
  double nothing = 0.0;  // g - g is 0, or not a number
  for (std::size_t i = 0; i < layout_->size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double g = gradient_[3 * i + axis];
      gradient[axis * slots + layout_->slot_of(i)] = g;
      nothing += g - g;
    }
  if (nothing != 0.0) refuse_gradient();
  return energy;
}

void HostLandscape::refuse_gradient() const {
  const auto bad = std::find_if(gradient_.begin(), gradient_.end(), [](double g) { return !std::isfinite(g); });
  throw_bad_input(fmt::format("landscape: gradient component {} of particle {} (from 0) is not allowed: it must be finite", *bad,
                              (bad - gradient_.begin()) / 3));
}

}  // namespace lanescape
