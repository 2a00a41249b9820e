#include <fmt/format.h>
#include <fmt/ostream.h>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "end_point_options.hpp"
#include "plot.hpp"
#include "relaxation_report.hpp"
#include "run/diffusion_run.hpp"

namespace lanescape::program {
namespace {

struct DiffusionState {
  CommonOptions common;
  SystemOptions system;
  EndPointSetup setup;
  std::optional<double> interval;
  std::optional<std::uint64_t> lags, records, trajectories, between;
  RelaxationSetup relaxation;
  bool plot = false;
};

DiffusionRunOptions run_options(const DiffusionState& state, const AnyModel& model, const Configuration& start) {
  const EndPointProtocol protocol = state.setup.resolve(model, start.size(), state.common.seed);
  DiffusionRunOptions options;
  if (const auto* hard = std::get_if<HardEndPointOptions>(&protocol)) {
    options = source_diffusion_options(mixture_of(model).species.size(), packing_fraction(start));
    options.equilibration_collisions = hard->equilibration_collisions;
  } else {
    options = soft_diffusion_options();
    options.window.interval *= length_unit(model);
    options.equilibration = std::get<EndPointOptions>(protocol);
  }
  options.seed = state.common.seed;
  const std::uint64_t origins = options.window.origins();
  options.window.interval = state.interval.value_or(options.window.interval);
  options.window.lags = state.lags.value_or(options.window.lags);
  options.window.records = state.records.value_or(origins + options.window.lags);
  options.trajectories = state.trajectories.value_or(options.trajectories);
  options.between = state.between.value_or(options.between);
  options.relaxation = state.relaxation.resolve();
  options.check();
  relaxation_window(model, options);  // refuses numbers out of range before anything is written
  return options;
}

const char* to_string(DiffusionRegime regime) {
  switch (regime) {
    case DiffusionRegime::diffusive:
      return "diffusive";
    case DiffusionRegime::ballistic:
      return "ballistic: t_max is too short for diffusion";
    case DiffusionRegime::caged:
      return "caged: t_max is too short for diffusion";
  }
  return "";
}

Json to_json(const DiffusionRunResult& run, const AnyModel& model) {
  const Mixture& mixture = mixture_of(model);
  const bool hard = is_hard(model);
  Json json;
  const DiffusionAccumulator& d = run.diffusion;
  json["species"] = Json::object();
  if (d.trajectories() > 0)
    for (std::size_t s = 0; s < d.species(); ++s) {
      Json& species = json["species"][mixture.species[s].name];
      const auto add = [&](const std::string& name, const Estimate& estimate) {
        species[name] = estimate.value;
        species[name + "_error"] = error_of(estimate);
      };
      add("diffusion_vacf", d.vacf_diffusion(s));
      add("diffusion_msd", d.msd_diffusion(s));
      add("diffusion_long_time", d.long_time_diffusion(s));
      species["displacement_exponent"] = d.displacement_exponent(s);
      species["regime"] = to_string(d.regime(s, length_unit(model)));
      add_relaxation(species, run.relaxation, s);
    }
  if (hard) {
    json["compressibility"] = run.compressibility;
    json["compressibility_convention"] = "3N - 3";
  } else {
    json["pressure"] = run.pressure;
    json["temperature"] = run.temperature;
  }
  json["temperature_convention"] = "3N";
  json["trajectories"] = d.trajectories();
  json["longest_time"] = d.window().longest_time();
  json["longest_relaxation_time"] = run.relaxation.time(run.relaxation.points() - 1);
  json["overlap_length"] = run.relaxation.window().overlap_length;
  json["outcome"] = run.interrupted ? "interrupted" : run.equilibrated ? "done" : "temperature not held";
  json["seconds"] = run.seconds;
  return json;
}

void write_curves(OutputFolder& folder, const DiffusionAccumulator& d, const Mixture& mixture) {
  if (d.trajectories() == 0) return;
  folder.write("diffusion.csv", [&](std::ostream& out) {
    out << "time";
    for (std::size_t s = 0; s < d.species(); ++s)
      for (const char* what : {"velocity_correlation", "diffusion_integral", "squared_displacement"})
        out << ',' << what << '_' << mixture.species[s].name;
    out << '\n';
    for (std::size_t k = 0; k < d.points(); ++k) {
      fmt::print(out, "{}", d.time(k));
      for (std::size_t s = 0; s < d.species(); ++s)
        fmt::print(out, ",{},{},{}", d.velocity_correlation(s, k).value, d.diffusion_integral(s, k).value,
                   d.squared_displacement(s, k).value);
      out << '\n';
    }
  });
}

Json run_diffusion_command(DiffusionState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const AnyModel model = state.system.resolve();
  options.settle(
      joined({state.system.kinds(model, state.setup.generates_start()), state.setup.kinds(false), {state.common.folder_kind()}}));
  state.setup.settle(model);
  const Configuration start = state.setup.start(model, state.common, isa);
  state.system.check_precision_in(model, start.box);
  DiffusionRunOptions run_with = run_options(state, model, start);
  run_with.equilibration.threads = state.common.threads;
  run_with.equilibration.precision = state.system.resolve_precision();
  if (state.plot) check_plots();
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("diffusion", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const DiffusionRunResult run =
      run_diffusion(model, start, run_with, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  const bool hard = is_hard(model);
  Json result = to_json(run, model);
  result["model"] = mixture_of(model).name;
  if (hard)
    result["packing_fraction"] = packing_fraction(start);
  else
    result["density"] = static_cast<double>(start.size()) / start.box.volume();
  if (state.setup.radius_factor()) result["radius_factor"] = *state.setup.radius_factor();
  result["particles"] = start.size();
  result["isa"] = to_string(isa);
  if (traits_of(model).has_precision) result["precision"] = to_string(state.system.resolve_precision());
  status = status_of_run(run.equilibrated, run.interrupted);
  if (folder.exists()) {
    write_curves(folder, run.diffusion, mixture_of(model));
    write_relaxation(folder, run.relaxation, mixture_of(model));
  }
  write_result(folder, "diffusion", options.resolved(), result, status);
  if (state.plot) draw_plots(folder.path(), status);
  return result;
}

}  // namespace

Subcommand add_diffusion(CLI::App& app) {
  const auto options = std::make_shared<Options>(
      app, "diffusion", "Self-diffusion from velocity correlations and displacements; scattering function, alpha_2 and chi_4");
  const auto state = std::make_shared<DiffusionState>();
  options->add("--interval", state->interval,
               "time between records [hard spheres: those published for this packing fraction; soft 0.01]");
  options->add("--lags", state->lags, "records in a window: t_max is so many intervals [source's; soft 1000]");
  options->add("--records", state->records, "of a trajectory [source's; soft 11000]");
  options->add("--trajectories", state->trajectories, "[5; mixtures of hard spheres 10]");
  options->add("--between", state->between, "steps or collisions between trajectories [100000; mixtures of hard spheres 200000]");
  state->relaxation.add_to(*options);
  options->add_flag("--plot", state->plot, "draw the curves (needs --out)").only_for({runs_with_a_folder});
  state->setup.add_to(*options);
  state->setup.add_tolerance_to(*options);
  for (const char* of_pairs : {"--distance", "--distance-species", "--pairs", "--between-steps", "--max-pair-steps",
                               "--between-collisions", "--max-pair-collisions"})
    options->at(of_pairs).refused("with diffusion, which makes no pairs: it is for endpoints and path");
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_diffusion_command(*state, *options, status); }};
}

}  // namespace lanescape::program
