// A liquid-vapour slab of a model with states: state_slab --model-file FILE --out DIR [--temperature T] ...
//
// Writes DIR/profiles.csv (density, local density and probability of each state along z, means over samples) and DIR/last.extxyz.
// tools/plot_slab.py DIR draws them. Exit status 0; 2 with one line on stderr for bad input.

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <string>

#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "io/atomic_file.hpp"
#include "io/extended_xyz.hpp"
#include "io/model_file.hpp"
#include "run/slab_run.hpp"

namespace {

using namespace lanescape;

void write_profiles(std::ostream& out, const SlabProfiles& profiles) {
  out << "z,density,local_density";
  for (std::size_t a = 0; a < profiles.probability.size(); ++a) fmt::print(out, ",probability_{}", a);
  out << ",sites\n";
  for (std::size_t bin = 0; bin < profiles.z.size(); ++bin) {
    fmt::print(out, "{},{},{}", profiles.z[bin], profiles.density[bin], profiles.local_density[bin]);
    for (const auto& probability : profiles.probability) fmt::print(out, ",{}", probability[bin]);
    fmt::print(out, ",{}\n", profiles.sites[bin]);
  }
}

StateMixtureModel read_model(const std::string& file) {
  if (file.empty()) return liquid_vapour();
  const auto refuse = [&]() -> StateMixtureModel { throw_bad_input(fmt::format("{}: a model of kind ucg is needed", file)); };
  return std::visit(Overloaded{[](const StateMixtureModel& states) { return states; }, [&](const PairModel&) { return refuse(); },
                               [&](const HardSphereModel&) { return refuse(); }},
                    read_model_file(file));
}

void run(const std::string& model_file, const SlabOptions& options, const std::filesystem::path& folder) {
  const StateMixtureModel states = read_model(model_file);
  options.check();
  prepare_output_folder(folder);
  SilentMonitor monitor;
  const SlabProfiles profiles = run_slab(states, options, choose_isa("auto"), monitor);
  write_atomically(folder / "profiles.csv", [&](std::ostream& out) { write_profiles(out, profiles); });
  write_atomically(folder / "last.extxyz", [&](std::ostream& out) {
    write_frame(out, profiles.last, states, {{"temperature", fmt::format("{}", options.temperature)}});
  });
  fmt::print("{} samples at a kinetic temperature of {:.4f}\n", profiles.samples, profiles.temperature);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A liquid-vapour slab of sites with states: profiles along z");
  std::string model_file, folder;
  lanescape::SlabOptions options;
  app.add_option("--model-file", model_file, "model file of kind ucg [the named model ucg]");
  app.add_option("--out", folder, "folder for profiles.csv and last.extxyz")->required();
  app.add_option("--particles", options.particles, "sites")->capture_default_str();
  app.add_option("--width", options.width, "of the box along x and y [sigma]")->capture_default_str();
  app.add_option("--length", options.length, "of the box along z [sigma]")->capture_default_str();
  app.add_option("--start-density", options.start_density, "of the lattice in the middle; too low, and it tears")
      ->capture_default_str();
  app.add_option("--temperature", options.temperature, "[epsilon]")->capture_default_str();
  app.add_option("--friction", options.friction, "of the thermostat")->capture_default_str();
  app.add_option("--time-step", options.time_step, "")->capture_default_str();
  app.add_option("--equilibration-steps", options.equilibration_steps, "before the first sample")->capture_default_str();
  app.add_option("--sampling-steps", options.sampling_steps, "during which samples are taken")->capture_default_str();
  app.add_option("--bins", options.bins, "along z")->capture_default_str();
  app.add_option("--seed", options.seed, "of all random numbers")->capture_default_str();
  app.add_option("--threads", options.threads, "of one evaluation")->capture_default_str();
  try {
    app.parse(argc, argv);
    run(model_file, options, folder);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : (std::cerr << "state_slab: " << error.what() << '\n', 2);
  } catch (const lanescape::Error& error) {
    std::cerr << "state_slab: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
