#include "run/slab_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/langevin.hpp"
#include "landscape/state_mixture_landscape.hpp"

namespace lanescape {
namespace {

// So many that neighbours along no axis are nearer than they have to be: a lattice that is squeezed flies apart.
std::size_t cells_across(const SlabOptions& options) {
  const auto nearest = [&](double cells) {
    const double step = options.width / cells;
    return std::min(step, 1.0 / (options.start_density * step * step));
  };
  const double few = std::max(1.0, std::floor(options.width * std::cbrt(options.start_density)));
  return static_cast<std::size_t>(nearest(few) < nearest(few + 1.0) ? few + 1.0 : few);
}

// A simple lattice in the middle of the box, as long as it has to be; species in turn.
Configuration lattice_slab(const SlabOptions& options, std::size_t species) {
  Configuration slab{{{options.width, options.width, options.length}}, {}, {}};
  const std::size_t across = cells_across(options);
  const double step = options.width / static_cast<double>(across), rise = 1.0 / (options.start_density * step * step);
  const std::size_t layers = (options.particles + across * across - 1) / (across * across);
  if (static_cast<double>(layers) * rise > options.length)
    throw_bad_input(fmt::format("{} particles at density {} do not fit into a box of {} x {} x {}", options.particles,
                                options.start_density, options.width, options.width, options.length));
  const double bottom = 0.5 * (options.length - static_cast<double>(layers) * rise);
  for (std::size_t i = 0; i < options.particles; ++i) {
    const std::size_t layer = i / (across * across), in_layer = i % (across * across);
    slab.species.push_back(static_cast<int>(i % species));
    slab.positions.push_back((static_cast<double>(in_layer % across) + 0.5) * step);
    slab.positions.push_back((static_cast<double>(in_layer / across) + 0.5) * step);
    slab.positions.push_back(bottom + (static_cast<double>(layer) + 0.5) * rise);
  }
  return slab;
}

// Where the slab is: the phase of the density's longest wave, which no boundary of the box disturbs.
double centre_of(const std::vector<double>& positions, double length) {
  double sine = 0.0, cosine = 0.0;
  for (std::size_t k = 2; k < positions.size(); k += 3) {
    sine += std::sin(2.0 * std::numbers::pi * positions[k] / length);
    cosine += std::cos(2.0 * std::numbers::pi * positions[k] / length);
  }
  return std::atan2(sine, cosine) * length / (2.0 * std::numbers::pi);
}

void add_sample(SlabProfiles& profiles, const std::vector<double>& positions, const Box& box, const ParticleLayout& layout,
                const StateMixture& interaction) {
  const double length = box.length[2], centre = centre_of(positions, length);
  const auto bins = static_cast<double>(profiles.z.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const double z = box.wrapped(2, positions[3 * i + 2] - centre + 0.5 * length);
    const std::size_t bin = std::min(profiles.z.size() - 1, static_cast<std::size_t>(z / length * bins)), slot = layout.slot_of(i);
    profiles.sites[bin] += 1.0;
    profiles.local_density[bin] += interaction.order_parameters()[slot];
    for (std::size_t a = 0; a < profiles.probability.size(); ++a) profiles.probability[a][bin] += interaction.states().of(slot)[a];
  }
  ++profiles.samples;
}

void take_means(SlabProfiles& profiles, const Box& box) {
  const double volume = box.volume() / static_cast<double>(profiles.z.size());
  for (std::size_t bin = 0; bin < profiles.z.size(); ++bin) {
    if (profiles.samples > 0) profiles.density[bin] = profiles.sites[bin] / (volume * static_cast<double>(profiles.samples));
    if (profiles.sites[bin] == 0.0) continue;
    profiles.local_density[bin] /= profiles.sites[bin];
    for (auto& probability : profiles.probability) probability[bin] /= profiles.sites[bin];
  }
}

SlabProfiles empty_profiles(const SlabOptions& options, std::size_t states) {
  const std::vector<double> zeros(options.bins, 0.0);
  SlabProfiles profiles{zeros, zeros, zeros, std::vector<std::vector<double>>(states, zeros), zeros};
  for (std::size_t bin = 0; bin < options.bins; ++bin)
    profiles.z[bin] = ((static_cast<double>(bin) + 0.5) / static_cast<double>(options.bins) - 0.5) * options.length;
  return profiles;
}

}  // namespace

void SlabOptions::check() const {
  const auto need = [](const char* what, double value, double most) {
    if (!(value > 0.0 && value <= most))
      throw_bad_input(fmt::format("{} {} is not allowed: above 0 and at most {}", what, value, most));
  };
  need("width", width, 1e4);
  need("length", length, 1e5);
  need("start density", start_density, 1.5);
  if (particles == 0 || particles > 4'000'000)
    throw_bad_input(fmt::format("{} particles are not allowed: from 1 to 4000000", particles));
  if (interval == 0) throw_bad_input("interval 0 is not allowed: at least one step between samples");
  if (bins == 0 || bins > 100'000) throw_bad_input(fmt::format("{} bins are not allowed: from 1 to 100000", bins));
  LangevinOptions{temperature, friction, time_step, seed}.check();
}

SlabProfiles run_slab(const StateMixtureModel& model, const SlabOptions& options, Isa isa, RunMonitor& monitor) {
  options.check();
  const Configuration start = lattice_slab(options, model.species.size());
  check_cutoff(model, start.box);
  check_separations(start, model);
  const ParticleLayout layout = ParticleLayout::in_space_order(start, model.species.size());
  StateMixture::Options with;
  with.threads = options.threads;
  StateMixtureLandscape landscape(model, start.box, layout, isa, with);
  Langevin dynamics(landscape, model, layout, layout.to_slots(start.positions),
                    {options.temperature, options.friction, options.time_step, options.seed});
  SlabProfiles profiles = empty_profiles(options, model.most_states());
  const std::uint64_t total = options.equilibration_steps + options.sampling_steps;
  for (std::uint64_t step = 1; step <= total && !profiles.interrupted; ++step) {
    dynamics.step();
    if (step > options.equilibration_steps && step % options.interval == 0) {
      add_sample(profiles, layout.to_user(dynamics.position()), start.box, layout, landscape.interaction());
      profiles.temperature += dynamics.temperature();
    }
    if (step % 100 != 0) continue;
    monitor.progress("slab", static_cast<double>(step), static_cast<double>(total));
    profiles.interrupted = monitor.stop_requested();
  }
  if (profiles.samples > 0) profiles.temperature /= static_cast<double>(profiles.samples);
  take_means(profiles, start.box);
  profiles.last = {start.box, start.species, layout.to_user(dynamics.position())};
  profiles.last.wrap();
  return profiles;
}

}  // namespace lanescape
