#include "configuration/state_mixture_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/length_unit.hpp"
#include "core/overloaded.hpp"

namespace lanescape {
namespace {

using Model = StateMixtureModel;

void need(bool condition, const std::string& message) {
  if (!condition) throw_bad_input(message);
}

bool positive(double x) { return std::isfinite(x) && x > 0.0; }

void check_states(const std::string& name, const Model::States& states) {
  const Model::Switching& w = states.switching;
  need(positive(w.threshold) && positive(w.width) && positive(w.cutoff),
       fmt::format("species {}: threshold {}, width {} and cutoff {} of the density must be finite and above 0", name, w.threshold,
                   w.width, w.cutoff));
  need(w.threshold < w.cutoff,
       fmt::format("species {}: threshold {} of the density must be below its cutoff {}", name, w.threshold, w.cutoff));
  // The switching function is a spline of 1024 intervals in r^2.
  need(w.width >= 0.01 * w.cutoff,
       fmt::format("species {}: width {} of the density is not allowed: at least a hundredth of its cutoff {}", name, w.width,
                   w.cutoff));
  for (const Model::Step& step : states.steps)
    need(std::isfinite(step.threshold) && positive(step.width),
         fmt::format("species {}: threshold {} and width {} of a state must be finite, the width above 0", name, step.threshold,
                     step.width));
  need(states.mu.size() == states.steps.size() + 1,
       fmt::format("species {}: {} states need {} values of mu", name, states.steps.size() + 1, states.steps.size() + 1));
  for (const double mu : states.mu) need(std::isfinite(mu), fmt::format("species {}: mu {} must be finite", name, mu));
}

void check_potential(const std::string& pair, const Model::LennardJones& u) {
  need(std::isfinite(u.epsilon) && u.epsilon >= 0.0 && positive(u.sigma),
       fmt::format("pair {}: epsilon {} and sigma {} must be finite, epsilon at least 0 and sigma above 0", pair, u.epsilon,
                   u.sigma));
}

void check_potential(const std::string& pair, const Model::Table& u) {
  need(u.values.size() >= 4,
       fmt::format("pair {}: {} values of a table are not allowed: at least 4 are needed", pair, u.values.size()));
  need(std::isfinite(u.first) && u.first >= 0.0 && std::isfinite(u.last) && u.last > u.first,
       fmt::format("pair {}: a table from {} to {} is not allowed: from 0 or more to more", pair, u.first, u.last));
  need(std::all_of(u.values.begin(), u.values.end(), [](double x) { return std::isfinite(x); }),
       fmt::format("pair {}: values of a table must be finite", pair));
  need(u.values.back() == 0.0,
       fmt::format("pair {}: the last value of a table is {}: it must be 0, or energy is not conserved", pair, u.values.back()));
}

const Model::Table* table_of(const Model::Potential& potential) {
  return std::visit(Overloaded{[](const Model::LennardJones&) -> const Model::Table* { return nullptr; },
                               [](const Model::Table& table) { return &table; }},
                    potential);
}

}  // namespace

std::size_t StateMixtureModel::most_states() const {
  std::size_t most = 1;
  for (const States& of_species : states) most = std::max(most, of_species.steps.size() + 1);
  return most;
}

double StateMixtureModel::size_of(std::size_t s, std::size_t t) const {
  double size = cutoff;
  // A table may begin at zero distance, which is no size.
  for (std::size_t a = 0; a < states_of(s); ++a)
    for (std::size_t b = 0; b < states_of(t); ++b) {
      const double closest = std::visit(Overloaded{[](const LennardJones& lj) { return lj.sigma; },
                                                   [](const Table& table) { return std::max(table.first, 4e-4 * table.last); }},
                                        potentials[potential_at(s, a, t, b)]);
      size = std::min(size, closest);
    }
  return size;
}

double StateMixtureModel::reach(std::size_t s, std::size_t t) const {
  double reach = 0.0;
  if (filter[pair(s, t)] != 0.0) reach = states[s].switching.cutoff;
  if (filter[pair(t, s)] != 0.0) reach = std::max(reach, states[t].switching.cutoff);
  for (std::size_t a = 0; a < states_of(s); ++a)
    for (std::size_t b = 0; b < states_of(t); ++b) reach = std::max(reach, end_of(potentials[potential_at(s, a, t, b)], cutoff));
  return reach;
}

// That of the largest Lennard-Jones sigma; where there are tables only, of a sigma whose usual cutoff is the largest reach. Entries
// of states that a species does not have are no sizes.
double StateMixtureModel::largest_size() const {
  constexpr double usual_cutoff = 2.5;
  double largest = 0.0, reach_of_any = 0.0;
  for (std::size_t s = 0; s < species.size(); ++s)
    for (std::size_t t = 0; t < species.size(); ++t) {
      reach_of_any = std::max(reach_of_any, reach(s, t));
      for (std::size_t a = 0; a < states_of(s); ++a)
        for (std::size_t b = 0; b < states_of(t); ++b)
          if (const auto* lj = std::get_if<LennardJones>(&potentials[potential_at(s, a, t, b)]))
            largest = std::max(largest, lj->sigma);
    }
  return largest > 0.0 ? largest : reach_of_any / usual_cutoff;
}

double StateMixtureModel::length_unit() const { return length_unit_of(largest_size()); }

StateMixtureModel StateMixtureModel::in_unit(double unit) const {
  StateMixtureModel model = *this;
  for (States& of_species : model.states)
    for (double* length : {&of_species.switching.threshold, &of_species.switching.width, &of_species.switching.cutoff})
      *length /= unit;
  for (Potential& potential : model.potentials)
    std::visit(Overloaded{[unit](LennardJones& lj) { lj.sigma /= unit; },
                          [unit](Table& table) {
                            table.first /= unit;
                            table.last /= unit;
                          }},
               potential);
  model.cutoff /= unit;
  return model;
}

double StateMixtureModel::end_of(const Potential& potential, double cutoff) {
  return std::visit(Overloaded{[&](const LennardJones&) { return cutoff; }, [](const Table& table) { return table.last; }},
                    potential);
}

void StateMixtureModel::check() const {
  check_species();
  const std::size_t n = species.size();
  need(states.size() == n, fmt::format("model {}: {} species need states", name, n));
  need(filter.size() == n * n, fmt::format("model {}: {} species need {} density filters", name, n, n * n));
  need(potentials.size() == n * n * most_states() * most_states(),
       fmt::format("model {}: {} species of up to {} states need {} potentials", name, n, most_states(),
                   n * n * most_states() * most_states()));
  need(positive(cutoff), fmt::format("cutoff {} is not allowed: it must be finite and above 0 [sigma]", cutoff));
  need(std::isfinite(entropy_temperature) && entropy_temperature >= 0.0,
       fmt::format("entropy temperature {} is not allowed: it must be finite and at least 0", entropy_temperature));
  for (std::size_t s = 0; s < n; ++s) check_states(species[s].name, states[s]);
  for (const double c : filter)
    need(std::isfinite(c) && c >= 0.0, fmt::format("density filter {} must be finite and at least 0", c));
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = 0; t < n; ++t) {
      const std::string names = fmt::format("{}-{}", species[s].name, species[t].name);
      const Table* first = nullptr;
      for (std::size_t a = 0; a < states_of(s); ++a)
        for (std::size_t b = 0; b < states_of(t); ++b) {
          const Potential& u = potentials[potential_at(s, a, t, b)];
          std::visit([&](const auto& form) { check_potential(names, form); }, u);
          need(u == potentials[potential_at(t, b, s, a)], fmt::format("pair {} differs from its mirror image", names));
          const Table* table = table_of(u);
          if (!first) first = table;
          need(!table ||
                   (table->first == first->first && table->last == first->last && table->values.size() == first->values.size()),
               fmt::format("pair {}: tables at different distances are not allowed: one set for all states of a pair", names));
        }
    }
}

StateMixtureModel liquid_vapour() {
  StateMixtureModel model;
  model.name = "ucg";
  model.species = {{"Ar", 1.0, 1.0}};
  // A liquid site has about 9 neighbours within 1.5 sigma, a vapour site hardly any.
  model.states = {{{1.5, 0.15, 2.5}, {{4.0, 1.5}}, {0.0, 0.0}}};
  model.filter = {1.0};
  using LennardJones = StateMixtureModel::LennardJones;
  model.potentials = {LennardJones{1.0, 1.0}, LennardJones{0.8, 1.0}, LennardJones{0.8, 1.0}, LennardJones{0.6, 1.0}};
  return model;
}

}  // namespace lanescape
