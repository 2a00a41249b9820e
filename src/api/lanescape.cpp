#include <lanescape/lanescape.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "configuration/particle_layout.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "neighbour/neighbour_pairs.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

const char* version() noexcept { return LANESCAPE_VERSION; }

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Isa isa : available_isas()) names.emplace_back(to_string(isa));
  return names;
}

struct LennardJonesPotential::Implementation {
  ParticleLayout layout;
  PairInteraction interaction;
  AlignedArray gradient;

  AlignedArray to_slots(std::span<const double> positions) const {
    if (positions.size() != 3 * layout.size())
      throw_bad_input(fmt::format("{} coordinates were given for {} particles: {} are needed", positions.size(), layout.size(),
                                  3 * layout.size()));
    check_finite_particles(positions);
    return layout.to_slots(positions);
  }
};

LennardJonesPotential::LennardJonesPotential(std::span<const int> species, const std::array<double, 3>& box,
                                             const Options& options) {
  PairModel model = named_pair_model(options.model);
  model.cutoff = options.cutoff;
  model.truncation = parse_truncation(options.truncation);
  model.images = parse_image_rule(options.images);
  model.check();
  const int count = static_cast<int>(model.species.size());
  for (const int s : species)
    if (s < 0 || s >= count)
      throw_bad_input(fmt::format("species {} is not allowed: model {} has 0 to {}", s, model.name, count - 1));
  ParticleLayout layout(std::vector<int>(species.begin(), species.end()), model.species.size());
  PairInteraction interaction(model, Box{box}, layout, kernel_table(choose_isa(options.isa)));
  AlignedArray gradient(layout.dimension(), 0.0);
  implementation_ =
      std::make_unique<Implementation>(Implementation{std::move(layout), std::move(interaction), std::move(gradient)});
}

LennardJonesPotential::~LennardJonesPotential() = default;
LennardJonesPotential::LennardJonesPotential(LennardJonesPotential&&) noexcept = default;
LennardJonesPotential& LennardJonesPotential::operator=(LennardJonesPotential&&) noexcept = default;

double LennardJonesPotential::energy(std::span<const double> positions) {
  return implementation_->interaction.energy(implementation_->to_slots(positions));
}

double LennardJonesPotential::energy_and_forces(std::span<const double> positions, std::span<double> forces, double* virial) {
  const AlignedArray slots = implementation_->to_slots(positions);
  if (forces.size() != positions.size())
    throw_bad_input(fmt::format("room for {} force components was given: {} are needed", forces.size(), positions.size()));
  const auto evaluation = implementation_->interaction.energy_and_gradient(slots, implementation_->gradient);
  const std::vector<double> gradient = implementation_->layout.to_user(implementation_->gradient);
  std::transform(gradient.begin(), gradient.end(), forces.begin(), [](double g) { return -g; });
  if (virial != nullptr) *virial = evaluation.virial;
  return evaluation.energy;
}

NeighbourPairs neighbour_pairs(std::span<const double> positions, const std::array<double, 3>& box, double cutoff) {
  OrderedPairs pairs = ordered_pairs(Box{box}, positions, cutoff, kernel_table(choose_isa("auto")));
  return {.first = std::move(pairs.first),
          .second = std::move(pairs.second),
          .shift = std::move(pairs.shift),
          .separation = std::move(pairs.separation),
          .distance = std::move(pairs.distance)};
}

LANESCAPE_ABI_END
}  // namespace lanescape
