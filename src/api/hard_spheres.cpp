#include <lanescape/hard_spheres.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "api/host_arrays.hpp"
#include "api/host_spheres.hpp"
#include "configuration/configuration.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

struct HardSpheres::Implementation {
  Implementation(std::span<const double> radii, const std::array<double, 3>& box, const Options& options)
      : configuration(host_spheres(radii, box)),
        arrays(ParticleLayout(configuration.species, 1)),
        spheres(configuration.box, arrays.layout(), configuration.radii, kernel_table(choose_isa(options.instruction_set))) {
    if (options.skin == 0.0) return;
    check_positive("skin", options.skin);
    list.emplace(spheres, options.skin * 2.0 * *std::min_element(radii.begin(), radii.end()));
  }

  const AlignedArray& positions(std::span<const double> host) {
    check_positions(host.size(), configuration.size());
    return arrays.positions(Vectors<const double>::interleaved(host));
  }

  Configuration configuration;  // of one species, so that slots are particles
  HostArrays arrays;
  HardSphereOverlap spheres;
  std::optional<HardSphereList> list;
  std::vector<Overlap> overlaps;
};

HardSpheres::HardSpheres(std::span<const double> radii, const std::array<double, 3>& box) : HardSpheres(radii, box, Options{}) {}
HardSpheres::HardSpheres(std::span<const double> radii, const std::array<double, 3>& box, const Options& options)
    : implementation_(std::make_unique<Implementation>(radii, box, options)) {}
HardSpheres::~HardSpheres() = default;
HardSpheres::HardSpheres(HardSpheres&&) noexcept = default;
HardSpheres& HardSpheres::operator=(HardSpheres&&) noexcept = default;

std::size_t HardSpheres::particles() const { return implementation_->configuration.size(); }

bool HardSpheres::any_overlap(std::span<const double> positions) {
  const AlignedArray& slots = implementation_->positions(positions);
  return implementation_->list ? implementation_->list->any_overlap(slots) : implementation_->spheres.any_overlap(slots);
}

std::span<const Overlap> HardSpheres::overlaps(std::span<const double> positions) {
  auto& [configuration, arrays, spheres, list, overlaps] = *implementation_;
  const AlignedArray& slots = implementation_->positions(positions);
  configuration.positions.assign(positions.begin(), positions.end());
  overlaps.clear();
  for (const auto& pair : spheres.pairs_within(slots, 0.0)) {
    const double gap = sphere_gap(configuration, static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
    overlaps.push_back({pair.first, pair.second, gap});
  }
  std::sort(overlaps.begin(), overlaps.end(),
            [](const Overlap& a, const Overlap& b) { return std::pair(a.first, a.second) < std::pair(b.first, b.second); });
  return overlaps;
}

double HardSpheres::smallest_gap(std::span<const double> positions) {
  return implementation_->spheres.smallest_gap(implementation_->positions(positions));
}

LANESCAPE_ABI_END
}  // namespace lanescape
