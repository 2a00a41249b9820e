#include <lanescape/states.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/images.hpp"
#include "interaction/state/state_mixture.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

const StateMixtureModel& state_model(const Model& model) {
  if (const auto* sites = std::get_if<StateMixtureModel>(&detail::Access::of(model))) return *sites;
  throw_bad_input(fmt::format("model {} has no states: a StateSystem needs one of sites in states, such as ucg", model.name()));
}

// A host's order parameter as the three passes see it. The library's lengths are in `unit`, its sites in the layout's order.
class HostOrderParameter final : public OrderParameter {
 public:
  HostOrderParameter(std::shared_ptr<SiteOrderParameter> host, std::vector<int> species, std::size_t species_count, double unit)
      : host_(std::move(host)), species_(std::move(species)), species_count_(species_count), unit_(unit) {}

  std::vector<double> reaches() const override {
    std::vector<double> reaches;
    for (std::size_t s = 0; s < species_count_; ++s)
      for (std::size_t t = 0; t < species_count_; ++t)
        reaches.push_back(host_->reach(static_cast<int>(s), static_cast<int>(t)) / unit_);
    return reaches;
  }

  void evaluate(Sites& sites, AlignedArray& values) override {
    collect(sites);
    numbers_.assign(species_.size(), 0.0);
    host_->evaluate(pairs(), species_, numbers_);
    for (std::size_t i = 0; i < numbers_.size(); ++i) values[sites.layout().slot_of(i)] = numbers_[i];
  }

  // Called after evaluate() at the same positions.
  void add_gradient(Sites& sites, const AlignedArray& multipliers, StateSums& sums) override {
    const ParticleLayout& layout = sites.layout();
    for (std::size_t i = 0; i < numbers_.size(); ++i) numbers_[i] = multipliers[layout.slot_of(i)];
    gradient_.assign(3 * numbers_.size(), 0.0);
    std::array<double, 6> virial{};
    host_->add_gradient(pairs(), species_, numbers_, gradient_, virial);
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        sums.gradient[axis * layout.slots() + layout.slot_of(i)] += unit_ * gradient_[3 * i + axis];
    sums.virial += virial[0] + virial[1] + virial[2];
    for (std::size_t k = 0; k < 6; ++k) sums.virial_tensor[k] += virial[k];
  }

 private:
  SitePairs pairs() const { return {first_, second_, separation_}; }

  void collect(const Sites& sites) {
    if (particle_of_.empty()) {
      particle_of_.resize(sites.layout().slots());
      for (std::size_t i = 0; i < species_.size(); ++i) particle_of_[sites.layout().slot_of(i)] = static_cast<std::int64_t>(i);
    }
    first_.clear();
    second_.clear();
    separation_.clear();
    sites.for_each_pair([&](std::size_t i, std::size_t j, const Point& d) {
      first_.push_back(particle_of_[i]);
      second_.push_back(particle_of_[j]);
      separation_.push_back({unit_ * d[0], unit_ * d[1], unit_ * d[2]});
    });
  }

  std::shared_ptr<SiteOrderParameter> host_;
  std::vector<int> species_;
  std::size_t species_count_;
  double unit_;
  std::vector<std::int64_t> particle_of_, first_, second_;
  std::vector<Point> separation_;
  std::vector<double> numbers_, gradient_;
};

class HostResponse final : public StateResponse {
 public:
  explicit HostResponse(std::shared_ptr<SiteResponse> host) : host_(std::move(host)), states_(host_->states()) {}

  std::size_t states() const override { return states_; }
  void evaluate(std::size_t species, double value, std::span<StateProbability> states) const override {
    thread_local std::vector<SiteProbability> scratch;
    scratch.assign(states_, {});
    host_->evaluate(static_cast<int>(species), value, scratch);
    for (std::size_t a = 0; a < states.size(); ++a) states[a] = {scratch[a].p, scratch[a].slope, scratch[a].logarithm};
  }

 private:
  std::shared_ptr<SiteResponse> host_;
  std::size_t states_;
};

StateMixtureParts parts_of(const StateMixtureModel& model, const std::vector<int>& species, const StateSystem::Options& options) {
  StateMixtureParts parts = make_parts(model);
  if ((options.order_parameter == nullptr) != (options.response == nullptr))
    throw_bad_input("an order parameter and a response go together: both or none are needed");
  if (options.order_parameter == nullptr) return parts;
  if (options.threads > 1)
    throw_bad_input(fmt::format("{} threads are not allowed with an order parameter of the host: 1 is needed", options.threads));
  if (options.response->states() != model.most_states())
    throw_bad_input(fmt::format("the response has {} states: the {} of model {} are needed", options.response->states(),
                                model.most_states(), model.name));
  parts.order_parameter =
      std::make_unique<HostOrderParameter>(options.order_parameter, species, model.species.size(), parts.length_unit);
  parts.response = std::make_unique<HostResponse>(options.response);
  return parts;
}

// The model's, and those of a host's order parameter.
void check_reaches(const StateMixtureModel& model, const SiteOrderParameter* order_parameter, const Box& box) {
  check_cutoff(model, box);
  const int count = static_cast<int>(model.species.size());
  for (int s = 0; order_parameter != nullptr && s < count; ++s)
    for (int t = 0; t < count; ++t) {
      const double reach = order_parameter->reach(s, t);
      if (!(reach >= 0.0) || !std::isfinite(reach))
        throw_bad_input(fmt::format(
            "order parameter: reach {} of species {} and {} is not allowed: it must be finite and at least 0", reach, s, t));
      check_reach(box, reach);
    }
}

ParticleLayout layout_in(const StateMixtureModel& model, const std::vector<int>& species, const StateSystem::Options& options,
                         const Box& box) {
  check_reaches(model, options.order_parameter.get(), box);
  return ParticleLayout(species, model.species.size());
}

}  // namespace

struct StateSystem::Implementation {
  Implementation(Model given, std::span<const int> species_given, const std::array<double, 3>& box_given, const Options& options)
      : model(std::move(given)),
        species(species_given.begin(), species_given.end()),
        box{box_given},
        arrays(layout_in(state_model(model), species, options, box)),
        interaction(parts_of(state_model(model), species, options), box, arrays.layout(),
                    kernel_table(choose_isa(options.instruction_set)), {.threads = checked_threads(options.threads)}) {}

  const AlignedArray& positions(std::span<const double> host) {
    check_positions(host.size(), species.size());
    return arrays.positions(Vectors<const double>::interleaved(host));
  }

  Model model;
  std::vector<int> species;
  Box box;
  HostArrays arrays;
  StateMixture interaction;
};

StateSystem::StateSystem(Model model, std::span<const int> species, const std::array<double, 3>& box)
    : StateSystem(std::move(model), species, box, Options{}) {}
StateSystem::StateSystem(Model model, std::span<const int> species, const std::array<double, 3>& box, const Options& options)
    : implementation_(std::make_unique<Implementation>(std::move(model), species, box, options)) {}
StateSystem::~StateSystem() = default;
StateSystem::StateSystem(StateSystem&&) noexcept = default;
StateSystem& StateSystem::operator=(StateSystem&&) noexcept = default;

void StateSystem::set_box(const std::array<double, 3>& box) {
  implementation_->interaction.set_box(Box{box});
  implementation_->box = Box{box};
}

std::size_t StateSystem::particles() const { return implementation_->species.size(); }

double StateSystem::energy(std::span<const double> positions) {
  return implementation_->interaction.energy(implementation_->positions(positions));
}

double StateSystem::energy_and_gradient(std::span<const double> positions, std::span<double> gradient) {
  check_room("gradient components", gradient.size(), positions.size());
  HostArrays& arrays = implementation_->arrays;
  const double energy =
      implementation_->interaction.energy_and_gradient(implementation_->positions(positions), arrays.gradient()).energy;
  arrays.write_gradient(gradient);
  return energy;
}

Evaluation StateSystem::evaluate(std::span<const double> positions, const Outputs& outputs) {
  check_positions(positions.size(), particles());
  return evaluate(Vectors<const double>::interleaved(positions), outputs);
}

Evaluation StateSystem::evaluate(const Vectors<const double>& positions, const Outputs& outputs) {
  auto& [model, species, box, arrays, interaction] = *implementation_;
  arrays.check_room_of(outputs);
  const AlignedArray& slots = arrays.positions(positions);
  if (!outputs.energies.empty()) {
    interaction.energies(slots, arrays.energies());
    arrays.write_energies(outputs.energies);
  }
  const bool forces = outputs.forces.x != nullptr;
  if (!forces && !outputs.stress) return {.energy = interaction.energy(slots)};
  const StateMixture::Evaluation e = outputs.stress ? interaction.energy_and_stress(slots, arrays.gradient())
                                                    : interaction.energy_and_gradient(slots, arrays.gradient());
  if (forces) arrays.write_forces(outputs.forces);
  Evaluation result{.energy = e.energy, .virial = e.virial};
  for (std::size_t k = 0; outputs.stress && k < 6; ++k) result.stress[k] = 0.0 - e.virial_tensor[k] / box.volume();
  return result;
}

std::size_t StateSystem::states() const { return implementation_->interaction.states().states; }

std::vector<double> StateSystem::order_parameters() const {
  const auto& [model, species, box, arrays, interaction] = *implementation_;
  std::vector<double> values;
  for (std::size_t i = 0; i < species.size(); ++i) values.push_back(interaction.order_parameters()[arrays.layout().slot_of(i)]);
  return values;
}

std::vector<double> StateSystem::probabilities() const {
  const auto& [model, species, box, arrays, interaction] = *implementation_;
  std::vector<double> values;
  for (std::size_t i = 0; i < species.size(); ++i) {
    const std::span<const double> p = interaction.states().of(arrays.layout().slot_of(i));
    values.insert(values.end(), p.begin(), p.end());
  }
  return values;
}

LANESCAPE_ABI_END
}  // namespace lanescape
