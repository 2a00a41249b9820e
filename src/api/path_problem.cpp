#include "api/path_problem.hpp"

#include <algorithm>
#include <utility>

#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "api/pair_models.hpp"
#include "configuration/model_traits.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"

namespace lanescape {
namespace {

void refuse_no_particles(std::size_t particles) {
  if (particles == 0) throw_bad_input("a path of no particles is not possible: at least one is needed");
}

MassMixture checked_masses(const Landscape& landscape, std::span<const double> masses) {
  refuse_no_particles(landscape.particles());
  return MassMixture(masses, landscape.particles());
}

// Stands for the host's particles where the finder asks for a model: soft, of these masses, with a length unit of 1.
AnyModel stand_in_for(const Mixture& mixture) {
  PairModel model = lennard_jones();
  static_cast<Mixture&>(model) = mixture;
  return model;
}

PathRunOptions checked_options(const PathSettings& settings, const AnyModel& model) {
  PathRunOptions options;
  options.method = settings.method.empty() ? &default_path_method(is_hard(model)) : &path_method(settings.method);
  options.stepping = settings.adaptive ? Stepping::adaptive : Stepping::faithful;
  if (settings.step != 0.0) options.direct_step = settings.step;
  if (settings.avoidance_step != 0.0) options.avoidance_step = settings.avoidance_step;
  options.fictitious = parse_contact_potential(settings.fictitious);
  options.landscape_energy = settings.landscape_energy;
  options.reverse = settings.reverse;
  options.finder = {settings.max_steps, settings.patience, settings.frames};
  options.threads = checked_threads(settings.threads);
  options.precision = parse_precision(settings.precision);
  options.check(model);
  check_method(*options.method, model);
  return options;
}

ConfigurationPair pair_of(const Configuration& particles, std::span<const double> start, std::span<const double> finish) {
  return {placed(particles, start), placed(particles, finish)};
}

PreparedPair prepared_on(const HostParticles& host, const SoftLandscapeMaker& landscape, const ConfigurationPair& pair,
                         const PathRunOptions& options, Isa isa) {
  if (pair.start.positions == pair.finish.positions) throw_bad_input("end points: the two end points coincide");
  return prepare_pair_on(landscape, host.mixture(), host.layout(), pair, "end points", options, isa);
}

}  // namespace

Configuration particles_of(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                           std::span<const double> diameters) {
  refuse_no_particles(species.size());
  Configuration particles{Box{box}, {species.begin(), species.end()}, {}};
  check_species(particles.species, model.species_count());
  if (const auto* spheres = std::get_if<HardSphereModel>(&detail::Access::of(model)))
    particles.radii = spheres->radii_of(particles.species);
  if (model.is_hard()) return particles;
  check_diameters(model.name(), model.has_diameters(), diameters.size(), species.size());
  particles.diameters.assign(diameters.begin(), diameters.end());
  return particles;
}

Configuration placed(const Configuration& particles, std::span<const double> positions) {
  check_positions(positions.size(), particles.size());
  check_finite_particles(positions);
  Configuration here = particles;
  here.positions.assign(positions.begin(), positions.end());
  return here;
}

HostParticles::HostParticles(Landscape& landscape, std::span<const double> masses)
    : landscape_(&landscape),
      masses_(checked_masses(landscape, masses)),
      layout_(masses_.species, masses_.mixture.species.size()) {}

PathProblem::PathProblem(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                         std::span<const double> start, std::span<const double> finish, const PathSettings& settings,
                         std::span<const double> diameters)
    : model_(detail::Access::of(model)),
      options_(checked_options(settings, model_)),
      isa_(choose_isa(settings.instruction_set)),
      pair_(pair_of(particles_of(model, species, box, diameters), start, finish)),
      prepared_(prepare_pair(model_, pair_, "end points", options_, isa_)) {}

PathProblem::PathProblem(Landscape& landscape, std::span<const double> start, std::span<const double> finish,
                         const PathSettings& settings, std::span<const double> masses)
    : host_(std::make_unique<const HostParticles>(landscape, masses)),
      model_(stand_in_for(host_->mixture())),
      options_(checked_options(settings, model_)),
      isa_(choose_isa(settings.instruction_set)),
      landscape_(host_->maker(isa_)),
      pair_(pair_of(host_->particles(), start, finish)),
      prepared_(prepared_on(*host_, landscape_, pair_, options_, isa_)) {}

SearchSetup PathProblem::setup() const { return {model_, pair_, prepared_, options_, isa_, options_.threads, false, landscape_}; }

const Potential* model_potential(const Landscape& landscape, std::span<const double> masses) {
  const auto* potential = dynamic_cast<const Potential*>(&landscape);
  if (potential == nullptr || !masses.empty() || potential->has_exclusions()) return nullptr;
  return mixture_of(detail::Access::of(potential->model())).has_equal_masses() ? potential : nullptr;
}

PathSettings with_options_of(const Potential& potential, PathSettings settings) {
  settings.threads = potential.options().threads;
  settings.precision = potential.options().precision;
  settings.instruction_set = potential.options().instruction_set;
  return settings;
}

void ProgressMonitor::progress(std::string_view stage, double done, double total) {
  if (!*progress_ || std::this_thread::get_id() != thread_) return;
  try {
    if (!(*progress_)(told(stage, done, total))) stop_ = true;
  } catch (...) {
    stop_ = true;
    throw;
  }
}

bool run_for_host(ResumableWork& work, RunMonitor& monitor) {
  const FloatEnvironment environment;
  while (!work.finished() && !monitor.stop_requested()) work.advance(monitor);
  return !work.finished();
}

}  // namespace lanescape
