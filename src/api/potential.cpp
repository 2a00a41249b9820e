#include <lanescape/potential.hpp>

#include <fmt/format.h>

#include <utility>

#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "api/pair_models.hpp"
#include "configuration/space_order.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_moves.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

struct Potential::Implementation {
  Implementation(Model given, std::span<const int> species_given, const std::array<double, 3>& box_given, Options with)
      : model(std::move(given)),
        species(species_given.begin(), species_given.end()),
        box{box_given},
        options(std::move(with)),
        order(species, checked_diameters(pair_model(model, "a Potential"), options.diameters, species.size()),
              model.species_count()),
        arrays(order.layout()),
        interaction(make()) {}

  PairInteraction make() const {
    return {pair_model(model, "a Potential"),
            box,
            arrays.layout(),
            kernel_table(choose_isa(options.instruction_set)),
            {.threads = checked_threads(options.threads), .precision = parse_precision(options.precision)}};
  }

  // Positions in the order of the interaction, which is made anew where the order in space has changed.
  const AlignedArray& slots_of(const Vectors<const double>& host) {
    if (species.size() >= ParticleLayout::sorted_from) {
      check_positions(host, species.size());
      if (order.renew(interleaved(host), box, interaction.rebuilds())) {
        arrays = HostArrays(order.layout());
        interaction = make();
        if (!exclusions.empty()) interaction.set_exclusions(exclusions);
      }
    }
    return arrays.positions(host);
  }

  std::span<const double> interleaved(const Vectors<const double>& host) {
    if (host.stride == 3 && host.y == host.x + 1 && host.z == host.x + 2) return {host.x, 3 * host.count};
    copy.resize(3 * host.count);
    for (std::size_t i = 0; i < host.count; ++i) {
      const auto k = static_cast<std::ptrdiff_t>(i) * host.stride;
      copy[3 * i] = host.x[k];
      copy[3 * i + 1] = host.y[k];
      copy[3 * i + 2] = host.z[k];
    }
    return copy;
  }

  Model model;
  std::vector<int> species;
  Box box;
  Options options;
  SpaceOrder order;
  HostArrays arrays;
  PairInteraction interaction;
  std::vector<std::array<std::size_t, 2>> exclusions{};
  std::vector<double> copy{};  // of positions in arrays of their own
};

Potential::Potential(Model model, std::span<const int> species, const std::array<double, 3>& box)
    : Potential(std::move(model), species, box, Options{}) {}

Potential::Potential(Model model, std::span<const int> species, const std::array<double, 3>& box, Options options)
    : implementation_(std::make_unique<Implementation>(std::move(model), species, box, std::move(options))) {}

Potential::~Potential() = default;
Potential::Potential(Potential&&) noexcept = default;
Potential& Potential::operator=(Potential&&) noexcept = default;
Potential::Potential(const Potential& other) : Potential(other.model(), other.species(), other.box(), other.options()) {
  if (!other.implementation_->exclusions.empty()) set_exclusions(other.implementation_->exclusions);
}
Potential& Potential::operator=(const Potential& other) { return *this = Potential(other); }

std::size_t Potential::particles() const { return implementation_->species.size(); }
const Model& Potential::model() const { return implementation_->model; }
const std::vector<int>& Potential::species() const { return implementation_->species; }
const Potential::Options& Potential::options() const { return implementation_->options; }
const std::array<double, 3>& Potential::box() const { return implementation_->box.length; }

void Potential::set_box(const std::array<double, 3>& box) {
  implementation_->interaction.set_box(Box{box});
  implementation_->box = Box{box};
}

void Potential::set_exclusions(std::span<const std::array<std::size_t, 2>> pairs) {
  implementation_->interaction.set_exclusions(pairs);
  implementation_->exclusions.assign(pairs.begin(), pairs.end());
}

bool Potential::has_exclusions() const { return !implementation_->exclusions.empty(); }

double Potential::energy(std::span<const double> positions) {
  check_positions(positions.size(), particles());
  return implementation_->interaction.energy(implementation_->slots_of(Vectors<const double>::interleaved(positions)));
}

double Potential::energy_and_gradient(std::span<const double> positions, std::span<double> gradient) {
  check_positions(positions.size(), particles());
  check_room("gradient components", gradient.size(), positions.size());
  const AlignedArray& slots = implementation_->slots_of(Vectors<const double>::interleaved(positions));
  HostArrays& arrays = implementation_->arrays;
  const double energy = implementation_->interaction.energy_and_gradient(slots, arrays.gradient()).energy;
  arrays.write_gradient(gradient);
  return energy;
}

double Potential::energy_and_forces(std::span<const double> positions, std::span<double> forces, double* virial) {
  check_room("force components", forces.size(), 3 * particles());
  const Evaluation e = evaluate(positions, {.forces = Vectors<double>::interleaved(forces)});
  if (virial != nullptr) *virial = e.virial;
  return e.energy;
}

Evaluation Potential::evaluate(std::span<const double> positions, const Outputs& outputs) {
  check_positions(positions.size(), particles());
  return evaluate(Vectors<const double>::interleaved(positions), outputs);
}

Evaluation Potential::evaluate(const Vectors<const double>& positions, const Outputs& outputs) {
  implementation_->arrays.check_room_of(outputs);
  const AlignedArray& slots = implementation_->slots_of(positions);
  HostArrays& arrays = implementation_->arrays;
  PairInteraction& interaction = implementation_->interaction;
  if (!outputs.energies.empty()) {
    interaction.energies(slots, arrays.energies());
    arrays.write_energies(outputs.energies);
  }
  const bool forces = outputs.forces.x != nullptr;
  if (!forces && !outputs.stress) return {.energy = interaction.energy(slots)};
  // Stresses are in double precision always; the rest has the precision that was asked for.
  const bool mixed = options().precision == to_string(Precision::mixed);
  Evaluation result;
  if (outputs.stress) {
    const auto e = interaction.energy_and_stress(slots, arrays.gradient());
    result = {e.energy, e.virial, {}};
    for (std::size_t k = 0; k < 6; ++k) result.stress[k] = 0.0 - e.virial_tensor[k] / implementation_->box.volume();
  }
  if (!outputs.stress || mixed) {
    const auto e = interaction.energy_and_gradient(slots, arrays.gradient());
    result.energy = e.energy;
    result.virial = e.virial;
  }
  if (forces) arrays.write_forces(outputs.forces);
  return result;
}

struct ParticleMoves::Implementation {
  PairMoves moves;
};

ParticleMoves::ParticleMoves(const Model& model, std::span<const int> species, std::span<const double> positions,
                             const std::array<double, 3>& box)
    : ParticleMoves(model, species, positions, box, Options{}) {}

ParticleMoves::ParticleMoves(const Model& model, std::span<const int> species, std::span<const double> positions,
                             const std::array<double, 3>& box, const Options& options) {
  const PairModel& pairs = pair_model(model, "ParticleMoves");
  check_positions(positions.size(), species.size());
  check_species(species, pairs.species.size());
  const Configuration fluid{Box{box},
                            {species.begin(), species.end()},
                            {positions.begin(), positions.end()},
                            {},
                            checked_diameters(pairs, options.diameters, species.size())};
  implementation_ =
      std::make_unique<Implementation>(Implementation{PairMoves(pairs, fluid, kernel_table(choose_isa(options.instruction_set)))});
}

ParticleMoves::~ParticleMoves() = default;
ParticleMoves::ParticleMoves(ParticleMoves&&) noexcept = default;
ParticleMoves& ParticleMoves::operator=(ParticleMoves&&) noexcept = default;

double ParticleMoves::energy_change(std::size_t particle, const std::array<double, 3>& to) {
  if (particle >= implementation_->moves.size())
    throw_bad_input(
        fmt::format("particle {} is not allowed: there are {}, numbered from 0", particle, implementation_->moves.size()));
  return implementation_->moves.energy_change(particle, to);
}

void ParticleMoves::accept() { implementation_->moves.accept(); }
std::span<const double> ParticleMoves::positions() const { return implementation_->moves.positions(); }

LANESCAPE_ABI_END
}  // namespace lanescape
