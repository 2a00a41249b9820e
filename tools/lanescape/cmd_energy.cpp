#include <fmt/format.h>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "interaction/lennard_jones.hpp"
#include "program.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::program {
namespace {

struct EnergyResult {
  double energy, virial;
  std::array<double, 6> virial_tensor;
  std::vector<double> gradient;  // 3N, user's order
};

EnergyResult by_kernels(const LennardJonesModel& model, const Configuration& configuration, Isa isa,
                        const PairSearchOptions& options) {
  const ParticleLayout layout = ParticleLayout::in_space_order(configuration, model.species.size());
  LennardJones interaction(model, configuration.box, layout, kernel_table(isa), options);
  AlignedArray gradient(layout.dimension(), 0.0);
  const AlignedArray positions = layout.to_slots(configuration.positions);
  const auto with_stress = interaction.energy_and_stress(positions, gradient);
  // The stress is in double precision at any rate; all else is what a run would see.
  const auto e = options.precision == Precision::mixed ? interaction.energy_and_gradient(positions, gradient) : with_stress;
  return {e.energy, e.virial, with_stress.virial_tensor, layout.to_user(gradient)};
}

EnergyResult by_reference(const LennardJonesModel& model, const Configuration& configuration) {
  const auto e = evaluate_reference(model, configuration);
  return {e.energy, e.virial, e.virial_tensor, e.gradient};
}

Json to_json(const EnergyResult& e, const Configuration& configuration, const LennardJonesModel& model, const std::string& isa,
             bool with_forces) {
  Json result;
  result["energy"] = e.energy;
  result["energy_per_particle"] = e.energy / static_cast<double>(configuration.size());
  result["virial"] = e.virial;
  // The sign and order of ASE and of solid-state physics: pressure is minus a third of its trace.
  for (const double w : e.virial_tensor) result["stress"].push_back(-w / configuration.box.volume());
  if (with_forces)
    for (std::size_t i = 0; i < configuration.size(); ++i)
      result["forces"].push_back({-e.gradient[3 * i], -e.gradient[3 * i + 1], -e.gradient[3 * i + 2]});
  result["particles"] = configuration.size();
  result["model"] = model.name;
  result["isa"] = isa;
  result["images"] = to_string(model.images);
  return result;
}

}  // namespace

Subcommand add_energy(CLI::App& app) {
  struct State {
    CommonOptions common;
    SystemOptions system;
    std::string file, backend = "simd";
    bool forces = false;
  };
  CLI::App* sub = app.add_subcommand("energy", "Potential energy, virial, stress and forces of a configuration");
  const auto options = std::make_shared<Options>(*sub);
  const auto state = std::make_shared<State>();
  options->add_positional("FILE", state->file, "extended XYZ; of several frames the first is used")->required();
  options->add_flag("--forces", state->forces, "list the forces too");
  options->add("--backend", state->backend, "simd, or the scalar reference");
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {sub, [=](int&) {
            state->common.check();
            const Isa isa = state->common.resolve_isa();
            const LennardJonesModel model = state->system.resolve_soft("energy");
            if (state->backend != "simd" && state->backend != "reference")
              throw_bad_input(fmt::format("--backend: '{}' is not allowed: simd or reference", state->backend));
            const Precision precision = state->system.resolve_precision();
            if (state->backend == "reference" && precision == Precision::mixed)
              throw_bad_input("--precision: mixed is not allowed with the reference, which is in double precision");
            const Configuration configuration = read_first_frame(state->file, model);
            check_cutoff(model, configuration.box);
            state->system.check_precision_in(model, configuration.box);
            const bool simd = state->backend == "simd";
            OutputFolder folder = open_folder(state->common);
            const PairSearchOptions search{.threads = state->common.threads, .precision = precision};
            const EnergyResult e = simd ? by_kernels(model, configuration, isa, search) : by_reference(model, configuration);
            Json result = to_json(e, configuration, model, simd ? to_string(isa) : "reference", state->forces);
            result["precision"] = to_string(precision);
            write_result(folder, "energy", options->resolved(), result);
            return result;
          }};
}

}  // namespace lanescape::program
