#include <fmt/format.h>

#include "configuration/model_traits.hpp"
#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/state/state_mixture.hpp"
#include "program.hpp"
#include "verification/reference_bridge.hpp"
#include "verification/state_mixture_checks.hpp"

namespace lanescape::program {
namespace {

struct EnergyResult {
  double energy, virial;
  std::array<double, 6> virial_tensor;
  std::vector<double> gradient{};  // 3N, user's order
  // Of models with states.
  std::optional<double> one_body_energy{};
  std::vector<double> densities{};                   // N, where there are several states
  std::vector<std::vector<double>> probabilities{};  // N, one for each state of the species
};

EnergyResult by_kernels(const PairModel& model, const Configuration& configuration, Isa isa, const PairSearchOptions& options) {
  const ParticleLayout layout = ParticleLayout::in_space_order(configuration, model.species.size());
  PairInteraction interaction(model, configuration.box, layout, kernel_table(isa), options);
  AlignedArray gradient(layout.dimension(), 0.0);
  const AlignedArray positions = layout.to_slots(configuration.positions);
  const auto with_stress = interaction.energy_and_stress(positions, gradient);
  // The stress is always in double precision; all else has the precision of a run.
  const auto e = options.precision == Precision::mixed ? interaction.energy_and_gradient(positions, gradient) : with_stress;
  return {e.energy, e.virial, with_stress.virial_tensor, layout.to_user(gradient)};
}

EnergyResult by_reference(const PairModel& model, const Configuration& configuration) {
  const auto e = evaluate_reference(model, configuration);
  return {e.energy, e.virial, e.virial_tensor, e.gradient};
}

// One entry for each state that the species has.
std::vector<double> states_of(const StateMixtureModel& model, int species, const double* probabilities) {
  return {probabilities, probabilities + model.states_of(static_cast<std::size_t>(species))};
}

EnergyResult by_kernels(const StateMixtureModel& model, const Configuration& configuration, Isa isa,
                        const PairSearchOptions& options) {
  const ParticleLayout layout = ParticleLayout::in_space_order(configuration, model.species.size());
  StateMixture::Options with;
  with.threads = options.threads;
  StateMixture interaction(model, configuration.box, layout, kernel_table(isa), with);
  AlignedArray gradient(layout.dimension(), 0.0);
  const auto e = interaction.energy_and_stress(layout.to_slots(configuration.positions), gradient);
  EnergyResult result{e.energy, e.virial, e.virial_tensor, layout.to_user(gradient), e.one_body_energy};
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const std::size_t slot = layout.slot_of(i);
    if (model.most_states() > 1) result.densities.push_back(interaction.order_parameters()[slot]);
    result.probabilities.push_back(states_of(model, configuration.species[i], interaction.states().of(slot).data()));
  }
  return result;
}

EnergyResult by_reference(const StateMixtureModel& model, const Configuration& configuration) {
  const auto e = evaluate_reference(model, configuration, SwitchingForm::exact);
  EnergyResult result{e.energy, e.virial, e.virial_tensor, e.gradient, e.one_body_energy};
  if (model.most_states() > 1) result.densities = e.densities;
  for (std::size_t i = 0; i < configuration.size(); ++i)
    result.probabilities.push_back(states_of(model, configuration.species[i], e.probabilities.data() + i * model.most_states()));
  return result;
}

Json to_json(const EnergyResult& e, const Configuration& configuration, const AnyModel& model, const std::string& isa,
             bool with_forces, bool with_states) {
  Json result;
  result["energy"] = e.energy;
  result["energy_per_particle"] = e.energy / static_cast<double>(configuration.size());
  if (e.one_body_energy) result["one_body_energy"] = *e.one_body_energy;
  result["virial"] = e.virial;
  // The sign and order of ASE and of solid-state physics: pressure is minus a third of its trace.
  for (const double w : e.virial_tensor) result["stress"].push_back(-w / configuration.box.volume());
  if (with_forces)
    for (std::size_t i = 0; i < configuration.size(); ++i)
      result["forces"].push_back({-e.gradient[3 * i], -e.gradient[3 * i + 1], -e.gradient[3 * i + 2]});
  if (with_states) {
    if (!e.densities.empty()) result["densities"] = e.densities;
    result["probabilities"] = e.probabilities;
  }
  result["particles"] = configuration.size();
  result["model"] = mixture_of(model).name;
  result["isa"] = isa;
  result["images"] = to_string(traits_of(model).images);
  return result;
}

constexpr Scope models_with_states{"states", "models of kind ucg, which have states"};

struct EnergyState {
  CommonOptions common;
  SystemOptions system;
  std::string file, backend = "simd";
  bool forces = false, states = false;
};

[[noreturn]] void refuse_hard_spheres(const AnyModel& model) {
  throw_bad_input(fmt::format(
      "energy: model {} is made of hard spheres: allowed are models of pair potentials (kob-andersen, lennard-jones, ...) and ucg",
      mixture_of(model).name));
}

Json run_energy(EnergyState& state, Options& options) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const AnyModel model = state.system.resolve();
  options.settle(joined({state.system.kinds(model, false),
                         {kind_if(traits_of(model).has_states, models_with_states, "with states",
                                  fmt::format("with model {}", mixture_of(model).name))}}));
  if (is_hard(model)) refuse_hard_spheres(model);
  if (state.backend != "simd" && state.backend != "reference")
    throw_bad_input(fmt::format("--backend: '{}' is not allowed: simd or reference", state.backend));
  const Precision precision = state.system.resolve_precision();
  if (state.backend == "reference" && precision == Precision::mixed)
    throw_bad_input("--precision: mixed is not allowed with the reference, which is in double precision");
  const Configuration configuration = read_first_frame(state.file, model, OpenAxes::allowed);
  state.system.check_precision_in(model, configuration.box);
  const bool simd = state.backend == "simd";
  const PairSearchOptions search{.threads = state.common.threads, .precision = precision};
  const auto evaluate = [&](const auto& soft) {
    check_cutoff(soft, configuration.box);
    return simd ? by_kernels(soft, configuration, isa, search) : by_reference(soft, configuration);
  };
  const EnergyResult e = std::visit(Overloaded{[&](const PairModel& pairs) { return evaluate(pairs); },
                                               [&](const StateMixtureModel& sites) { return evaluate(sites); },
                                               [&](const HardSphereModel&) -> EnergyResult { refuse_hard_spheres(model); }},
                                    model);
  OutputFolder folder = open_folder(state.common);
  Json result = to_json(e, configuration, model, simd ? to_string(isa) : "reference", state.forces, state.states);
  result["precision"] = to_string(precision);
  write_result(folder, "energy", options.resolved(), result);
  return result;
}

}  // namespace

Subcommand add_energy(CLI::App& app) {
  const auto options = std::make_shared<Options>(app, "energy", "Potential energy, virial, stress and forces of a configuration");
  const auto state = std::make_shared<EnergyState>();
  options->add_positional("FILE", state->file, "extended XYZ; of several frames the first is used").required();
  options->add_flag("--forces", state->forces, "list the forces too");
  options->add_flag("--states", state->states, "list local densities and state probabilities too (ucg)")
      .only_for({models_with_states});
  options->add("--backend", state->backend, "simd, or the scalar reference");
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {&options->app(), [=](int&) { return run_energy(*state, *options); }};
}

}  // namespace lanescape::program
