#include <fmt/format.h>

#include <algorithm>

#include <lanescape/dynamics.hpp>
#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "configuration/lattice.hpp"
#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "core/overloaded.hpp"
#include "core/run_monitor.hpp"
#include "dynamics/end_points.hpp"
#include "dynamics/hard_end_points.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/state/state_mixture.hpp"
#include "landscape/make_landscape.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

Configuration configuration_of(const AnyModel& model, const Start& start) {
  check_positions(start.positions.size(), start.species.size());
  Configuration configuration{Box{start.box}, start.species, start.positions};
  if (traits_of(model).sizes == SizeColumn::diameter) configuration.diameters = start.diameters;
  if (const auto* spheres = std::get_if<HardSphereModel>(&model)) configuration.radii = spheres->radii_of(start.species);
  return configuration;
}

// Steps a generator to its end. The part done is that of the pairs, in the last of which the distance counts.
template <class Generator>
void run_protocol(Generator& generator, const EndPointSettings& settings, double distance) {
  const FloatEnvironment environment;
  constexpr int steps_between_reports = 1000;
  while (!generator.ended()) {
    for (int k = 0; k < steps_between_reports && !generator.ended(); ++k) generator.step();
    if (!settings.progress) continue;
    const double pairs = static_cast<double>(generator.pairs().size()) + std::min(1.0, generator.distance_so_far() / distance);
    if (!settings.progress(std::min(1.0, pairs / static_cast<double>(settings.pairs))) && !generator.ended())
      throw Error(ErrorCode::interrupted, "interrupted before all end points were made");
  }
  if (generator.phase() != Generator::Phase::done)
    throw Error(ErrorCode::goal_not_reached, fmt::format("no end points: {}", Generator::name(generator.phase())));
}

std::vector<EndPoints> to_public(const std::vector<EndPointPair>& pairs, const ParticleLayout& layout) {
  std::vector<EndPoints> ends;
  for (const EndPointPair& pair : pairs)
    ends.push_back({layout.to_user(pair.start), layout.to_user(pair.finish), pair.distance, pair.steps, pair.time});
  return ends;
}

double distance_of(const AnyModel& model, const Start& start, const EndPointSettings& settings) {
  return settings.distance != 0.0 ? settings.distance : default_distance(start.species.size()) * length_unit(model);
}

EndPointOptions soft_options(const AnyModel& model, const Start& start, const EndPointSettings& settings) {
  EndPointOptions options;
  if (settings.quick) options.make_quick();
  options.temperature = settings.temperature;
  options.distance = distance_of(model, start, settings);
  options.pairs = settings.pairs;
  options.length_unit = length_unit(model);
  options.time_step *= options.length_unit;
  if (settings.equilibration != 0)
    options.melt_steps = options.cooling_steps = options.check_steps = options.settle_steps = settings.equilibration;
  if (settings.between != 0) options.between_steps = settings.between;
  options.seed = settings.seed;
  options.threads = checked_threads(settings.threads);
  options.precision = parse_precision(settings.precision);
  options.check();
  return options;
}

std::vector<EndPoints> soft_end_points(const AnyModel& model, const Start& start, const EndPointSettings& settings) {
  const EndPointOptions options = soft_options(model, start, settings);
  const Configuration configuration = configuration_of(model, start);
  check_soft_separations(configuration, model);
  const Mixture& mixture = mixture_of(model);
  const ParticleLayout layout = ParticleLayout::in_space_order(configuration, mixture.species.size());
  const auto landscape = make_landscape(model, configuration.box, layout, choose_isa(settings.instruction_set),
                                        {.threads = options.threads, .precision = options.precision});
  EndPointGenerator generator(*landscape, mixture, layout, layout.to_slots(configuration.positions), options);
  run_protocol(generator, settings, options.distance);
  return to_public(generator.pairs(), layout);
}

std::vector<EndPoints> hard_end_points(const HardSphereModel& model, const Start& start, const EndPointSettings& settings) {
  checked_threads(settings.threads);  // has no effect here; a wrong value is refused all the same
  parse_precision(settings.precision);
  HardEndPointOptions options;
  if (settings.quick) options.make_quick();
  options.distance = distance_of(model, start, settings);
  options.pairs = settings.pairs;
  if (settings.equilibration != 0) options.equilibration_collisions = settings.equilibration;
  if (settings.between != 0) options.between_collisions = settings.between;
  options.seed = settings.seed;
  options.check();
  const Isa isa = choose_isa(settings.instruction_set);
  const Configuration configuration = configuration_of(model, start);
  check_no_overlap(configuration, kernel_table(isa));
  const ParticleLayout layout = ParticleLayout::in_space_order(configuration, model.species.size());
  HardEndPointGenerator generator(model, layout, configuration, options, isa);
  run_protocol(generator, settings, options.distance);
  return to_public(generator.pairs(), layout);
}

}  // namespace

Start make_start(const Model& model, std::size_t particles, double density, std::uint64_t seed) {
  SilentMonitor monitor;
  const Configuration made =
      std::visit(Overloaded{[&](const PairModel& pairs) { return fcc_start(pairs, particles, density, seed); },
                            [&](const StateMixtureModel& sites) { return fcc_start(sites, particles, density, seed); },
                            [&](const HardSphereModel& spheres) {
                              return *make_hard_sphere_start(spheres, particles, density, StartMethod::automatic, seed,
                                                             choose_isa("auto"), monitor);
                            }},
                 detail::Access::of(model));
  Start start{made.species, made.positions, made.box.length, made.diameters};
  for (const double radius : made.radii) start.diameters.push_back(2.0 * radius);
  return start;
}

std::vector<EndPoints> make_end_points(const Model& model, const Start& start, const EndPointSettings& settings) {
  const AnyModel& any = detail::Access::of(model);
  if (const auto* spheres = std::get_if<HardSphereModel>(&any)) return hard_end_points(*spheres, start, settings);
  return soft_end_points(any, start, settings);
}

LANESCAPE_ABI_END
}  // namespace lanescape
