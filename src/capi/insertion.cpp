#include <lanescape/insertion.hpp>

#include "capi/arguments.hpp"
#include "capi/model.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_inserter : Handle<Inserter> {};

namespace {

Inserter::Options options_of(const lanescape_inserter_options* given, std::size_t particles) {
  Inserter::Options options;
  if (given == nullptr) return options;
  const auto& o = sized(given, "options", "lanescape_inserter_options");
  options.species = o.species;
  options.diameter = o.diameter;
  const auto diameters = optional_array(o.diameters, particles, "diameters");
  options.diameters.assign(diameters.begin(), diameters.end());
  options.instruction_set = word(o.instruction_set, options.instruction_set.c_str());
  return options;
}

InsertionSettings settings_of(const lanescape_insertion_settings* given) {
  InsertionSettings settings;
  if (given == nullptr) return settings;
  const auto& s = sized(given, "settings", "lanescape_insertion_settings");
  settings.energy = s.energy;
  settings.tolerance = s.tolerance;
  settings.measure = word(s.measure, settings.measure.c_str());
  settings.method = word(s.method, settings.method.c_str());
  settings.largest_step = s.largest_step;
  settings.most_trials = s.most_trials;
  if (s.region != nullptr) settings.region = {three(s.region, "region"), three(s.region + 3, "region")};
  settings.seed = s.seed;
  settings.threads = s.threads;
  return settings;
}

using Search = std::vector<InsertedParticle> (Inserter::*)(const InsertionSettings&, std::size_t);

lanescape_status search(Search how, lanescape_inserter* inserter, const lanescape_insertion_settings* settings, std::size_t count,
                        const lanescape_insertions* insertions) {
  return alone(inserter, "inserter", [&](Inserter& fluid) {
    const auto& out = sized(insertions, "insertions", "lanescape_insertions");
    const std::vector<InsertedParticle> particles = (fluid.*how)(settings_of(settings), count);
    for (std::size_t k = 0; k < particles.size(); ++k) {
      const InsertedParticle& one = particles[k];
      if (out.found != nullptr) out.found[k] = one.found ? 1 : 0;
      if (out.positions != nullptr) copy_out(one.position, out.positions + 3 * k);
      if (out.energies != nullptr) out.energies[k] = one.energy;
      if (out.errors != nullptr) out.errors[k] = one.error;
      if (out.evaluations != nullptr) out.evaluations[k] = one.evaluations;
      if (out.trials != nullptr) out.trials[k] = one.trials;
    }
  });
}

}  // namespace

lanescape_status lanescape_inserter_options_init(lanescape_inserter_options* options, size_t size) {
  return guarded([&] {
    const Inserter::Options own;
    lanescape_inserter_options presets{};
    presets.species = own.species;
    presets.diameter = own.diameter;
    initialise(options, size, "options", "lanescape_inserter_options", presets);
  });
}

lanescape_status lanescape_insertion_settings_init(lanescape_insertion_settings* settings, size_t size) {
  return guarded([&] {
    const InsertionSettings own;
    lanescape_insertion_settings presets{};
    presets.energy = own.energy;
    presets.tolerance = own.tolerance;
    presets.largest_step = own.largest_step;
    presets.most_trials = own.most_trials;
    presets.seed = own.seed;
    presets.threads = own.threads;
    initialise(settings, size, "settings", "lanescape_insertion_settings", presets);
  });
}

lanescape_status lanescape_inserter_create(const lanescape_model* model, size_t particles, const int* species,
                                           const double* positions, const double box[3], const lanescape_inserter_options* options,
                                           lanescape_inserter** inserter) {
  return guarded([&] {
    create(inserter, "inserter", [&] {
      return Inserter(object_of(model, "model").model, array(species, particles, "species"),
                      vectors(positions, particles, "positions"), three(box, "box"), options_of(options, particles));
    });
  });
}

lanescape_status lanescape_inserter_particles(const lanescape_inserter* inserter, size_t* particles) {
  return guarded([&] { given(particles, "particles") = object_of(inserter, "inserter").particles(); });
}

lanescape_status lanescape_inserter_energy(const lanescape_inserter* inserter, const double position[3], double* energy,
                                           double* force) {
  return guarded([&] {
    const Inserter& fluid = object_of(inserter, "inserter");
    const std::array<double, 3> there = three(position, "position");
    double& out = given(energy, "energy");
    if (force == nullptr) {
      out = fluid.energy(there);
      return;
    }
    std::array<double, 3> pull{};
    out = fluid.energy_and_force(there, pull);
    copy_out(pull, force);
  });
}

lanescape_status lanescape_inserter_energies(const lanescape_inserter* inserter, size_t count, const double* positions,
                                             double* energies) {
  return guarded([&] {
    object_of(inserter, "inserter").energies(vectors(positions, count, "positions"), array(energies, count, "energies"));
  });
}

lanescape_status lanescape_inserter_find(lanescape_inserter* inserter, const lanescape_insertion_settings* settings, size_t count,
                                         const lanescape_insertions* insertions) {
  return search(&Inserter::find, inserter, settings, count, insertions);
}

lanescape_status lanescape_inserter_insert(lanescape_inserter* inserter, const lanescape_insertion_settings* settings, size_t count,
                                           const lanescape_insertions* insertions) {
  return search(&Inserter::insert, inserter, settings, count, insertions);
}

lanescape_status lanescape_inserter_add(lanescape_inserter* inserter, const double position[3]) {
  return alone(inserter, "inserter", [&](Inserter& fluid) { fluid.add(three(position, "position")); });
}

lanescape_status lanescape_inserter_remove(lanescape_inserter* inserter, const double position[3], int* removed) {
  return alone(inserter, "inserter", [&](Inserter& fluid) {
    const bool was_there = fluid.remove(three(position, "position"));
    if (removed != nullptr) *removed = was_there ? 1 : 0;
  });
}

lanescape_status lanescape_inserter_destroy(lanescape_inserter* inserter) { return destroy(inserter, "inserter"); }
