#include <lanescape/insertion.hpp>

#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "api/pair_models.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"
#include "interaction/pair/probe_field.hpp"
#include "interaction/pair/separations.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

Configuration fluid_of(const PairModel& model, std::span<const int> species, std::span<const double> positions,
                       const std::array<double, 3>& box, const std::vector<double>& diameters) {
  check_positions(positions.size(), species.size());
  Configuration fluid{Box{box},
                      {species.begin(), species.end()},
                      {positions.begin(), positions.end()},
                      {},
                      checked_diameters(model, diameters, species.size())};
  check_separations(fluid, model);
  return fluid;
}

InsertionOptions options_of(const InsertionSettings& settings, const Box& box) {
  InsertionOptions options;
  options.target = settings.energy;
  options.tolerance = settings.tolerance;
  options.measure = parse_error_measure(settings.measure);
  options.method = parse_insertion_method(settings.method);
  if (settings.largest_step != 0.0) options.largest_step = settings.largest_step;
  options.most_trials = settings.most_trials;
  if (settings.region) options.region = Region{(*settings.region)[0], (*settings.region)[1]};
  options.seed = settings.seed;
  options.check(box);
  return options;
}

std::vector<InsertedParticle> to_public(const std::vector<Insertion>& insertions) {
  std::vector<InsertedParticle> particles;
  for (const Insertion& one : insertions)
    particles.push_back({one.found, one.position, one.energy, one.error, one.evaluations, one.trials});
  return particles;
}

}  // namespace

struct Inserter::Implementation {
  ProbeField field;
  int species;
  InsertionHistory history{};
};

Inserter::Inserter(const Model& model, std::span<const int> species, std::span<const double> positions,
                   const std::array<double, 3>& box)
    : Inserter(model, species, positions, box, Options{}) {}

Inserter::Inserter(const Model& model, std::span<const int> species, std::span<const double> positions,
                   const std::array<double, 3>& box, const Options& options) {
  const PairModel& pairs = pair_model(model, "an Inserter");
  implementation_ = std::make_unique<Implementation>(
      Implementation{ProbeField(pairs, fluid_of(pairs, species, positions, box, options.diameters), options.species,
                                kernel_table(choose_isa(options.instruction_set)), options.diameter),
                     options.species});
}

Inserter::~Inserter() = default;
Inserter::Inserter(Inserter&&) noexcept = default;
Inserter& Inserter::operator=(Inserter&&) noexcept = default;

std::size_t Inserter::particles() const { return implementation_->field.size(); }
double Inserter::energy(const std::array<double, 3>& position) const { return implementation_->field.energy(position); }

double Inserter::energy_and_force(const std::array<double, 3>& position, std::array<double, 3>& force) const {
  const ProbeField::Sample sample = implementation_->field.sample(position);
  for (std::size_t axis = 0; axis < 3; ++axis) force[axis] = 0.0 - sample.gradient[axis];
  return sample.energy;
}

void Inserter::energies(std::span<const double> positions, std::span<double> energies) const {
  check_positions(positions.size(), energies.size());
  implementation_->field.energies(positions, energies);
}

std::vector<InsertedParticle> Inserter::find(const InsertionSettings& settings, std::size_t count) {
  const InsertionOptions options = options_of(settings, implementation_->field.box());
  return to_public(
      find_places(implementation_->field, options, count, implementation_->history, checked_threads(settings.threads)));
}

std::vector<InsertedParticle> Inserter::insert(const InsertionSettings& settings, std::size_t count) {
  const InsertionOptions options = options_of(settings, implementation_->field.box());
  return to_public(
      insert_particles(implementation_->field, options, count, implementation_->history, checked_threads(settings.threads)));
}

void Inserter::add(const std::array<double, 3>& position) {
  check_finite(position);
  implementation_->field.insert(position, implementation_->species);
}

bool Inserter::remove(const std::array<double, 3>& position) {
  check_finite(position);
  return implementation_->field.remove(position, implementation_->species);
}

LANESCAPE_ABI_END
}  // namespace lanescape
