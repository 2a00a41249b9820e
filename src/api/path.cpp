#include <lanescape/path.hpp>
#include <lanescape/potential.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "api/host_landscape.hpp"
#include "configuration/model_traits.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "run/path_search.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

class ProgressMonitor final : public RunMonitor {
 public:
  ProgressMonitor(const Progress& progress, double offset, double share) : progress_(&progress), offset_(offset), share_(share) {}
  void progress(std::string_view, double done, double) override {
    if (*progress_ && !(*progress_)(offset_ + share_ * done)) stop_ = true;
  }
  bool stop_requested() const override { return stop_; }

 private:
  const Progress* progress_;
  double offset_, share_;
  bool stop_ = false;
};

PathRunOptions options_of(const PathSettings& settings, const AnyModel& model) {
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

void refuse_no_particles(std::size_t particles) {
  if (particles == 0) throw_bad_input("a path of no particles is not possible: at least one is needed");
}

PathResult one_way(const SearchSetup& setup, const Progress& progress) {
  const FloatEnvironment environment;
  const double share = setup.options.reverse ? 0.5 : 1.0;
  ProgressMonitor monitor(progress, setup.reversed ? share : 0.0, share);
  const auto search = begin_path(setup);
  while (!search->finished() && !monitor.stop_requested()) search->advance(monitor);
  return search->result();
}

Path to_public(PathResult found, double seconds) {
  Path path;
  path.outcome = to_string(found.outcome);
  path.reason = std::move(found.reason);
  path.length = found.length;
  path.distance = found.distance;
  path.ratio_squared = found.ratio_squared();
  path.participation_ratio = found.participation_number / static_cast<double>(found.particle_lengths.size());
  path.direct_steps = found.direct_steps;
  path.detour_steps = found.detour_steps;
  path.evaluations = found.evaluations;
  path.landscape_energy = found.landscape_energy;
  path.largest_violation = found.largest_violation;
  path.reversed = found.reversed;
  path.seconds = seconds;
  for (Configuration& frame : found.frames) path.frames.push_back(std::move(frame.positions));
  return path;
}

// Whether paths on it are those of its model, which go without a host's arrays.
bool is_its_model(const Potential& potential) {
  return !potential.has_exclusions() && mixture_of(detail::Access::of(potential.model())).has_equal_masses();
}

PathSettings with_options_of(const Potential& potential, PathSettings settings) {
  settings.threads = potential.options().threads;
  settings.precision = potential.options().precision;
  settings.instruction_set = potential.options().instruction_set;
  return settings;
}

Path search(const SearchSetup& setup, const Progress& progress) {
  const auto began = std::chrono::steady_clock::now();
  PathResult found = one_way(setup, progress);
  if (setup.options.reverse && found.outcome != Outcome::interrupted) {
    SearchSetup backwards = setup;
    backwards.reversed = true;
    found = shorter_way(std::move(found), one_way(backwards, progress));
  }
  return to_public(std::move(found), std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
}

}  // namespace

Path find_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box, std::span<const double> start,
               std::span<const double> finish, const PathSettings& settings, std::span<const double> diameters) {
  const AnyModel& any = detail::Access::of(model);
  refuse_no_particles(species.size());
  check_positions(start.size(), species.size());
  check_positions(finish.size(), species.size());
  ConfigurationPair pair{{Box{box}, {species.begin(), species.end()}, {start.begin(), start.end()}}, {}};
  check_species(pair.start.species, model.species_count());
  if (const auto* spheres = std::get_if<HardSphereModel>(&any)) pair.start.radii = spheres->radii_of(pair.start.species);
  if (!diameters.empty() && !model.has_diameters() && !model.is_hard())
    throw_bad_input(fmt::format("model {} has no diameters of particles: none are allowed", model.name()));
  if (model.has_diameters()) pair.start.diameters.assign(diameters.begin(), diameters.end());
  pair.finish = pair.start;
  pair.finish.positions.assign(finish.begin(), finish.end());
  const PathRunOptions options = options_of(settings, any);
  const Isa isa = choose_isa(settings.instruction_set);
  const PreparedPair prepared = prepare_pair(any, pair, "end points", options, isa);
  return search({any, pair, prepared, options, isa, options.threads}, settings.progress);
}

Path find_path(Landscape& landscape, std::span<const double> start, std::span<const double> finish, const PathSettings& settings,
               std::span<const double> masses) {
  if (const auto* potential = dynamic_cast<const Potential*>(&landscape);
      potential != nullptr && masses.empty() && is_its_model(*potential))
    return find_path(potential->model(), potential->species(), potential->box(), start, finish,
                     with_options_of(*potential, settings), potential->options().diameters);
  refuse_no_particles(landscape.particles());
  check_positions(start.size(), landscape.particles());
  check_positions(finish.size(), landscape.particles());
  check_finite_particles(start);
  check_finite_particles(finish);
  if (std::equal(start.begin(), start.end(), finish.begin())) throw_bad_input("end points: the two end points coincide");
  const MassMixture particles(masses, landscape.particles());
  // Stands for the host's particles where the finder asks for a model: soft, of these masses, with a length unit of 1.
  PairModel stand_in = lennard_jones();
  static_cast<Mixture&>(stand_in) = particles.mixture;
  const AnyModel model = std::move(stand_in);
  const PathRunOptions options = options_of(settings, model);
  const Isa isa = choose_isa(settings.instruction_set);
  const ConfigurationPair pair{{{}, particles.species, {start.begin(), start.end()}},
                               {{}, particles.species, {finish.begin(), finish.end()}}};
  const ParticleLayout layout(particles.species, particles.mixture.species.size());
  const auto make = [&]() -> std::unique_ptr<SoftLandscape> { return std::make_unique<HostLandscape>(landscape, layout, isa); };
  const PreparedPair prepared = prepare_pair_on(make, particles.mixture, layout, pair, "end points", options, isa);
  return search({model, pair, prepared, options, isa, options.threads, false, make}, settings.progress);
}

LANESCAPE_ABI_END
}  // namespace lanescape
