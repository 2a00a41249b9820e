#include "capi/potential.hpp"

#include <type_traits>

#include "capi/arguments.hpp"
#include "capi/model.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_moves : Handle<ParticleMoves> {};

namespace lanescape::capi {

Potential::Options options_of(const lanescape_potential_options* given, std::size_t particles) {
  Potential::Options options;
  if (given == nullptr) return options;
  const auto& o = sized(given, "options", "lanescape_potential_options");
  options.threads = o.threads;
  options.precision = word(o.precision, options.precision.c_str());
  options.instruction_set = word(o.instruction_set, options.instruction_set.c_str());
  const auto diameters = optional_array(o.diameters, particles, "diameters");
  options.diameters.assign(diameters.begin(), diameters.end());
  return options;
}

std::shared_ptr<SoftPotential> make_states(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                                           const Potential::Options& options, std::shared_ptr<SiteOrderParameter> order_parameter,
                                           std::shared_ptr<SiteResponse> response) {
  if (options.precision != Potential::Options{}.precision)
    refuse("precision " + options.precision + " is not possible for sites in states: double is needed");
  return std::make_shared<SoftPotential>(StateSystem(
      model, species, box, {options.threads, options.instruction_set, std::move(order_parameter), std::move(response)}));
}

}  // namespace lanescape::capi

namespace {

std::shared_ptr<SoftPotential> make_potential(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                                              const Potential::Options& options) {
  if (!model.has_states()) return std::make_shared<SoftPotential>(Potential(model, species, box, options));
  return make_states(model, species, box, options, nullptr, nullptr);
}

// Does the work of a function that only potentials of this kind have.
template <class Kind, class Work>
void with_kind(const lanescape_potential* potential, const char* needed, const Work& work) {
  with(*shared_of(potential), [&]<class Given>(Given& p) {
    if constexpr (std::is_same_v<Given, Kind>)
      work(p);
    else
      refuse("argument potential is of the other kind: one of " + std::string(needed) + " is needed");
  });
}

template <class Work>
void with_pairs(const lanescape_potential* potential, const Work& work) {
  with_kind<Potential>(potential, "pairs", work);
}

template <class Number, class Given>
Vectors<Number> strided(const Given& vectors, std::size_t particles, const std::string& argument) {
  const std::pair<const char*, Number*> columns[] = {{"->x", vectors.x}, {"->y", vectors.y}, {"->z", vectors.z}};
  for (const auto& [name, column] : columns) array(column, particles, (argument + name).c_str());
  if (vectors.stride == 0) refuse("argument " + argument + "->stride is 0: 1, 3 or another number is needed");
  return {vectors.x, vectors.y, vectors.z, particles, vectors.stride};
}

void evaluate(auto& potential, const Vectors<const double>& positions, const Vectors<double>& forces,
              const lanescape_outputs& out) {
  Outputs wanted;
  wanted.forces = forces;
  if (out.energies != nullptr) wanted.energies = {out.energies, potential.particles()};
  wanted.stress = out.stress != nullptr || (out.virial != nullptr && forces.x == nullptr);
  const Evaluation e = potential.evaluate(positions, wanted);
  if (out.energy != nullptr) *out.energy = e.energy;
  if (out.virial != nullptr) *out.virial = e.virial;
  copy_out(e.stress, out.stress);
}

}  // namespace

lanescape_status lanescape_potential_options_init(lanescape_potential_options* options, size_t size) {
  return guarded([&] {
    lanescape_potential_options presets{};
    presets.threads = Potential::Options{}.threads;
    initialise(options, size, "options", "lanescape_potential_options", presets);
  });
}

lanescape_status lanescape_potential_create(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                            const lanescape_potential_options* options, lanescape_potential** potential) {
  return guarded([&] {
    create(potential, "potential", [&] {
      return make_potential(object_of(model, "model").model, array(species, particles, "species"), three(box, "box"),
                            options_of(options, particles));
    });
  });
}

lanescape_status lanescape_potential_copy(const lanescape_potential* potential, lanescape_potential** copy) {
  return guarded([&] {
    create(copy, "copy", [&] {
      std::shared_ptr<SoftPotential> made;
      with_pairs(potential, [&](const Potential& pairs) { made = std::make_shared<SoftPotential>(Potential(pairs)); });
      return made;
    });
  });
}

lanescape_status lanescape_potential_set_exclusions(lanescape_potential* potential, size_t pairs, const size_t* particles) {
  return guarded([&] {
    const auto indices = array(particles, times(2, pairs), "particles");
    std::vector<std::array<std::size_t, 2>> excluded(pairs);
    for (std::size_t k = 0; k < pairs; ++k) excluded[k] = {indices[2 * k], indices[2 * k + 1]};
    with_pairs(potential, [&](Potential& p) { p.set_exclusions(excluded); });
  });
}

lanescape_status lanescape_potential_set_box(lanescape_potential* potential, const double box[3]) {
  return guarded([&] { with(*shared_of(potential), [&](auto& p) { p.set_box(three(box, "box")); }); });
}

lanescape_status lanescape_potential_particles(const lanescape_potential* potential, size_t* particles) {
  return guarded([&] { given(particles, "particles") = with(*shared_of(potential), [](const auto& p) { return p.particles(); }); });
}

lanescape_status lanescape_potential_evaluate(lanescape_potential* potential, const double* positions,
                                              const lanescape_outputs* outputs) {
  return guarded([&] {
    with(*shared_of(potential), [&](auto& evaluated) {
      const auto& out = sized(outputs, "outputs", "lanescape_outputs");
      const std::size_t n = evaluated.particles();
      Vectors<double> forces;
      if (out.forces != nullptr) forces = Vectors<double>::interleaved({out.forces, 3 * n});
      evaluate(evaluated, Vectors<const double>::interleaved(vectors(positions, n, "positions")), forces, out);
    });
  });
}

lanescape_status lanescape_potential_evaluate_strided(lanescape_potential* potential, const lanescape_positions* positions,
                                                      const lanescape_outputs* outputs, const lanescape_forces* forces) {
  return guarded([&] {
    with(*shared_of(potential), [&](auto& evaluated) {
      const auto& out = sized(outputs, "outputs", "lanescape_outputs");
      if (out.forces != nullptr) refuse("argument outputs->forces must be NULL: forces have an argument of their own");
      const std::size_t n = evaluated.particles();
      Vectors<double> to;
      if (forces != nullptr) to = strided<double>(sized(forces, "forces", "lanescape_forces"), n, "forces");
      evaluate(evaluated, strided<const double>(sized(positions, "positions", "lanescape_positions"), n, "positions"), to, out);
    });
  });
}

lanescape_status lanescape_potential_states(const lanescape_potential* potential, size_t* states, double* order_parameters,
                                            double* probabilities) {
  return guarded([&] {
    with_kind<StateSystem>(potential, "sites in states", [&](const StateSystem& sites) {
      if (states != nullptr) *states = sites.states();
      if (order_parameters != nullptr) copy_out(sites.order_parameters(), order_parameters);
      if (probabilities != nullptr) copy_out(sites.probabilities(), probabilities);
    });
  });
}

lanescape_status lanescape_potential_destroy(lanescape_potential* potential) { return destroy(potential, "potential"); }

lanescape_status lanescape_moves_create(const lanescape_model* model, size_t particles, const int* species, const double* positions,
                                        const double box[3], const lanescape_potential_options* options, lanescape_moves** moves) {
  return guarded([&] {
    create(moves, "moves", [&] {
      const Potential::Options wanted = options_of(options, particles);
      return ParticleMoves(object_of(model, "model").model, array(species, particles, "species"),
                           vectors(positions, particles, "positions"), three(box, "box"),
                           {wanted.instruction_set, wanted.diameters});
    });
  });
}

lanescape_status lanescape_moves_energy_change(lanescape_moves* moves, size_t particle, const double to[3], double* change) {
  return alone(moves, "moves", [&](ParticleMoves& m) {
    double& out = given(change, "change");
    out = m.energy_change(particle, three(to, "to"));
  });
}

lanescape_status lanescape_moves_accept(lanescape_moves* moves) {
  return alone(moves, "moves", [&](ParticleMoves& m) { m.accept(); });
}

lanescape_status lanescape_moves_positions(const lanescape_moves* moves, double* positions) {
  return alone(moves, "moves", [&](const ParticleMoves& m) { copy_out(m.positions(), &given(positions, "positions")); });
}

lanescape_status lanescape_moves_destroy(lanescape_moves* moves) { return destroy(moves, "moves"); }
