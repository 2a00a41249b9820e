#include "interaction/state/state_mixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/overloaded.hpp"
#include "interaction/pair/closest_pair.hpp"
#include "interaction/state/local_density.hpp"
#include "interaction/state/state_potentials.hpp"

namespace lanescape {
namespace {

constexpr double allowed_ratio = 0.3;

int no_scratch() { return 0; }

// What every part needs to see, of both sites of a pair.
std::vector<double> joint_reaches(const StateMixtureParts& parts, std::size_t species) {
  std::vector<double> joint(species * species, 0.0);
  const auto widen = [&](const std::vector<double>& reaches) {
    for (std::size_t k = 0; k < reaches.size(); ++k) {
      const std::size_t mirrored = k % species * species + k / species;
      joint[k] = std::max({joint[k], reaches[k], reaches[mirrored]});
    }
  };
  if (parts.order_parameter) widen(parts.order_parameter->reaches());
  for (const auto& potential : parts.potentials) widen(potential->reaches());
  return joint;
}

NeighbourList::Members members(PairSearch search) {
  return search == PairSearch::all_pairs ? NeighbourList::Members::every_point : NeighbourList::Members::with_own_images;
}

// The Lennard-Jones potentials and the tables of a model; each has empty entries where the other applies.
std::vector<std::unique_ptr<StatePotential>> potentials_of(const StateMixtureModel& model) {
  const StatePairs order{model.species.size(), model.most_states()};
  std::vector<LennardJonesStates::Pair> pairs(order.size());
  std::vector<TabulatedStates::Table> tables(order.size());
  bool any_pair = false, any_table = false;
  for (std::size_t s = 0; s < order.species; ++s)
    for (std::size_t t = 0; t < order.species; ++t)
      for (std::size_t a = 0; a < model.states_of(s); ++a)
        for (std::size_t b = 0; b < model.states_of(t); ++b) {
          const auto& u = model.potentials[model.potential_at(s, a, t, b)];
          const std::size_t place = order.at(s, a, t, b);
          std::visit(Overloaded{[&](const StateMixtureModel::LennardJones& lj) {
                                  pairs[place] = {lj.epsilon, lj.sigma};
                                  any_pair = true;
                                },
                                [&](const StateMixtureModel::Table& table) {
                                  const double intervals = static_cast<double>(table.values.size() - 1);
                                  tables[place] = {table.first, (table.last - table.first) / intervals, table.values};
                                  any_table = true;
                                }},
                     u);
        }
  std::vector<std::unique_ptr<StatePotential>> potentials;
  if (any_pair)
    potentials.push_back(
        std::make_unique<LennardJonesStates>(order, pairs, std::vector<double>(order.species * order.species, model.cutoff)));
  if (any_table) potentials.push_back(std::make_unique<TabulatedStates>(order, tables));
  return potentials;
}

}  // namespace

StateMixtureParts make_parts(const StateMixtureModel& given) {
  given.check();
  const double unit = given.length_unit();
  const StateMixtureModel model = given.in_unit(unit);
  std::vector<SwitchingFunction> switching;
  std::vector<std::vector<TanhCascade::Step>> steps;
  OneBodyTerms one_body{std::vector<double>(model.species.size() * model.most_states(), 0.0), model.entropy_temperature};
  for (std::size_t s = 0; s < model.states.size(); ++s) {
    const auto& of_species = model.states[s];
    switching.push_back(
        SwitchingFunction::tapered_tanh(of_species.switching.threshold, of_species.switching.width, of_species.switching.cutoff));
    steps.emplace_back();
    for (const auto& step : of_species.steps) steps.back().push_back({step.threshold, step.width});
    std::copy(of_species.mu.begin(), of_species.mu.end(),
              one_body.mu.begin() + static_cast<std::ptrdiff_t>(s * model.most_states()));
  }
  return {std::make_unique<LocalDensity>(std::move(switching), model.filter), std::make_unique<TanhCascade>(std::move(steps)),
          potentials_of(model), std::move(one_body), unit};
}

void check_cutoff(const StateMixtureModel& model, const Box& box) {
  check_periodic(box, "sites in states");
  double reach = 0.0;
  for (std::size_t s = 0; s < model.species.size(); ++s)
    for (std::size_t t = 0; t < model.species.size(); ++t) reach = std::max(reach, model.reach(s, t));
  check_reach(box, reach);
}

void check_separations(const Configuration& configuration, const StateMixtureModel& model) {
  check_species(configuration.species, model.species.size());
  check_finite_particles(configuration.positions);
  double largest = 0.0;
  for (std::size_t s = 0; s < model.species.size(); ++s)
    for (std::size_t t = 0; t < model.species.size(); ++t) largest = std::max(largest, model.size_of(s, t));
  const ClosePair closest = closest_pair(configuration, allowed_ratio * largest, [&](std::size_t i, std::size_t j) {
    const auto& species = configuration.species;
    return model.size_of(static_cast<std::size_t>(species[i]), static_cast<std::size_t>(species[j]));
  });
  if (closest.ratio_squared < allowed_ratio * allowed_ratio)
    throw_bad_input(fmt::format("particles {} and {} overlap: their distance is {:.6g} of their size, at least {} is needed",
                                closest.i, closest.j, std::sqrt(closest.ratio_squared), allowed_ratio));
}

void check_soft_separations(const Configuration& configuration, const AnyModel& model) {
  std::visit(
      Overloaded{[&](const PairModel& pairs) { check_separations(configuration, pairs); },
                 [&](const StateMixtureModel& states) { check_separations(configuration, states); }, [](const HardSphereModel&) {}},
      model);
}

StateMixture::StateMixture(StateMixtureParts parts, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
                           const Options& options)
    : parts_(std::move(parts)),
      reduced_(parts_.length_unit),
      sites_(reduced_.box(box), layout, joint_reaches(parts_, layout.blocks().size()), parts_.response->states(), table,
             {options.threads, options.skin, members(options.search)}),
      values_(layout.slots(), 0.0),
      multipliers_(layout.slots(), 0.0),
      slopes_(layout.slots() * parts_.response->states(), 0.0),
      probability_slopes_(layout.slots() * parts_.response->states(), 0.0),
      unused_(layout.dimension(), 0.0) {
  check_periodic(box, "sites in states");
  if (parts_.one_body.mu.empty()) parts_.one_body.mu.assign(layout.blocks().size() * parts_.response->states(), 0.0);
}

void StateMixture::set_box(const Box& box) {
  check_periodic(box, "sites in states");
  check_reach(box, sites_.furthest() * reduced_.unit());
  sites_.set_box(reduced_.box(box));
}

double StateMixture::find_states() {
  const auto& list = sites_.list();
  const std::size_t states = sites_.states();
  const double temperature = parts_.one_body.entropy_temperature;
  std::vector<double> energies(list.block_count(), 0.0);
  const auto scratch = [states] { return std::vector<StateProbability>(states); };
  sites_.for_each_block(scratch, [&](std::size_t b, const kernels::NeighbourRows& rows, std::vector<StateProbability>& of_site) {
    const double* mu = parts_.one_body.mu.data() + list.species_of(b) * states;
    for_each_row(list, rows, [&](std::size_t, std::size_t slot) {
      parts_.response->evaluate(list.species_of(b), values_[slot], of_site);
      double multiplier = 0.0;
      for (std::size_t a = 0; a < states; ++a) {
        const auto& [p, slope, logarithm] = of_site[a];
        sites_.site_states().p[slot * states + a] = p;
        probability_slopes_[slot * states + a] = slope;
        // p ln p vanishes with p, and so does what follows from it with dp.
        energies[b] += mu[a] * p + (p > 0.0 ? temperature * p * logarithm : 0.0);
        if (slope != 0.0) multiplier += slope * (mu[a] + temperature * (logarithm + 1.0));
      }
      multipliers_[slot] = multiplier;
    });
  });
  double energy = 0.0;
  for (const double of_block : energies) energy += of_block;
  return energy;
}

// dU/d(order parameter) = sum_a dU/dp_a dp_a/d(order parameter).
void StateMixture::add_multipliers_of_potentials() {
  const auto& list = sites_.list();
  const std::size_t states = sites_.states();
  sites_.for_each_block(no_scratch, [&](std::size_t, const kernels::NeighbourRows& rows, int) {
    for_each_row(list, rows, [&](std::size_t, std::size_t slot) {
      for (std::size_t a = 0; a < states; ++a)
        multipliers_[slot] += probability_slopes_[slot * states + a] * slopes_[slot * states + a];
    });
  });
}

double StateMixture::move_to(const AlignedArray& positions) {
  sites_.move_to(reduced_.of(positions));
  if (by_order()) parts_.order_parameter->evaluate(sites_, values_);
  const double one_body_energy = find_states();
  sites_.put_states();
  return one_body_energy;
}

// A term is linear in the probabilities of each of its sites: sum_a p_a dU/dp_a of a site is the energy of all its terms.
void StateMixture::energies(const AlignedArray& positions, AlignedArray& energies) {
  const FloatEnvironment environment;
  move_to(positions);
  std::fill(energies.begin(), energies.end(), 0.0);
  const std::size_t states = sites_.states();
  const AlignedArray& p = sites_.site_states().p;
  for (const auto& potential : parts_.potentials) {
    std::fill(slopes_.begin(), slopes_.end(), 0.0);
    StateSums sums{StateSums::Wanted::gradient, unused_, slopes_};
    potential->add(sites_, sums);
    for (std::size_t k = 0; k < p.size(); ++k) energies[k / states] += p[k] * slopes_[k] / potential->factors();
  }
  const auto& blocks = sites_.layout().blocks();
  for (std::size_t s = 0; s < blocks.size(); ++s)
    for (std::size_t k = states * blocks[s].begin; k < states * (blocks[s].begin + blocks[s].count); ++k)
      energies[k / states] += parts_.one_body.mu[s * states + k % states] * p[k] +
                              (p[k] > 0.0 ? parts_.one_body.entropy_temperature * p[k] * std::log(p[k]) : 0.0);
}

StateMixture::Evaluation StateMixture::evaluate(const AlignedArray& positions, AlignedArray& gradient, StateSums::Wanted wanted) {
  const FloatEnvironment environment;
  const bool forces = wanted != StateSums::Wanted::energy;
  const double one_body_energy = move_to(positions);
  std::fill(gradient.begin(), gradient.end(), 0.0);
  std::fill(slopes_.begin(), slopes_.end(), 0.0);
  StateSums sums{wanted, gradient, slopes_};
  for (const auto& potential : parts_.potentials) potential->add(sites_, sums);
  if (by_order() && forces) {
    add_multipliers_of_potentials();
    parts_.order_parameter->add_gradient(sites_, multipliers_, sums);
  }
  if (forces) reduced_.restore(gradient);
  return {sums.energy + one_body_energy, one_body_energy, sums.virial, sums.virial_tensor};
}

double StateMixture::energy(const AlignedArray& positions) {
  return evaluate(positions, unused_, StateSums::Wanted::energy).energy;
}

StateMixture::Evaluation StateMixture::energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient) {
  return evaluate(positions, gradient, StateSums::Wanted::gradient);
}

StateMixture::Evaluation StateMixture::energy_and_stress(const AlignedArray& positions, AlignedArray& gradient) {
  return evaluate(positions, gradient, StateSums::Wanted::stress);
}

}  // namespace lanescape
