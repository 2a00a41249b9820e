#include "end_point_options.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "io/extended_xyz.hpp"

namespace lanescape::program {

void EndPointSetup::add_to(Options& options) {
  options.add("--particles", particles_, "number of particles N");
  options.add("--density", density_, "number density [sigma^-3]");
  options.add("--temperature", temperature_, "temperature [epsilon/k_B]");
  options.add("--distance", distance_, "distance between the ends of a pair [sigma] [108 at N = 108, else 10 sqrt(N)]");
  options.add("--distance-species", distance_species_, "count only this species' motion towards the distance");
  options.add("--pairs", pairs_, "number of pairs [1]");
  options.add("--start", start_file_, "start from this configuration instead of an fcc crystal (its first frame)");
  options.add_flag("--quick", quick_, "short equilibration, to try things out");
  options.add("--time-step", time_step_, "of molecular dynamics [0.001]");
  options.add("--melt-temperature", melt_temperature_, "[5]");
  options.add("--melt-steps", melt_steps_, "[200000; quick 20000]");
  options.add("--cooling-steps", cooling_steps_, "[1000000; quick 50000]");
  options.add("--rescale-interval", rescale_interval_, "steps between velocity scalings while melting and cooling [1000]");
  options.add("--check-steps", check_steps_, "of the temperature check, without thermostat [1000000; quick 50000]");
  options.add("--check-interval", check_interval_, "steps between temperature samples [100]");
  options.add("--check-tolerance", check_tolerance_, "largest deviation of the mean temperature [0.005; quick 0.02]");
  options.add("--max-checks", max_checks_, "temperature checks before giving up [100]");
  options.add("--settle-steps", settle_steps_, "before the first pair [1000000; quick 50000]");
  options.add("--between-steps", between_steps_, "between pairs [100000; quick 20000]");
  options.add("--max-pair-steps", max_pair_steps_, "of one pair before giving up [1000000000]");
}

double EndPointSetup::default_distance(std::size_t particles) {
  return particles == 108 ? 108.0 : 10.0 * std::sqrt(static_cast<double>(particles));
}

EndPointOptions EndPointSetup::resolve(const Mixture& model, std::size_t particles, std::uint64_t seed) const {
  EndPointOptions options;
  if (quick_) options.make_quick();
  options.temperature = temperature_;
  options.distance = distance_.value_or(default_distance(particles));
  options.seed = seed;
  if (!distance_species_.empty()) options.distance_species = model.find_species(distance_species_);
  const auto take = [](auto& target, const auto& given) {
    if (given) target = *given;
  };
  take(options.pairs, pairs_);
  take(options.time_step, time_step_);
  take(options.melt_temperature, melt_temperature_);
  take(options.melt_steps, melt_steps_);
  take(options.cooling_steps, cooling_steps_);
  take(options.rescale_interval, rescale_interval_);
  take(options.check_steps, check_steps_);
  take(options.check_interval, check_interval_);
  take(options.check_tolerance, check_tolerance_);
  take(options.max_checks, max_checks_);
  take(options.settle_steps, settle_steps_);
  take(options.between_steps, between_steps_);
  take(options.max_pair_steps, max_pair_steps_);
  options.check();
  return options;
}

Configuration EndPointSetup::start(const LennardJonesModel& model, std::uint64_t seed) const {
  if (start_file_.empty()) return fcc_start(model, particles_, density_, seed);
  return read_first_frame(start_file_, model);
}

std::string pair_file_name(std::size_t number) { return fmt::format("pair-{:04}.extxyz", number + 1); }

void write_pair(OutputFolder& folder, std::size_t number, const ConfigurationPair& pair, const Mixture& model) {
  folder.write(pair_file_name(number), [&](std::ostream& out) {
    const std::string distance = fmt::format("{}", pair.distance), steps = fmt::format("{}", pair.steps);
    write_frame(out, pair.start, model, {{"end", "first"}, {"distance", distance}, {"steps", steps}});
    write_frame(out, pair.finish, model, {{"end", "last"}, {"distance", distance}, {"steps", steps}});
  });
}

namespace {

void write_equilibration(OutputFolder& folder, const EndPointRunResult& run, const EndPointOptions& options, const Mixture& model) {
  folder.write("endpoints-trace.csv", [&](std::ostream& out) {
    out << "step,time,temperature,potential_energy_per_particle,energy_per_particle,phase\n";
    for (std::size_t r = 0; r < run.trace.rows(); ++r)
      fmt::print(out, "{:.0f},{},{},{},{},{}\n", run.trace.at(r, 0), run.trace.at(r, 0) * options.time_step, run.trace.at(r, 1),
                 run.trace.at(r, 2), run.trace.at(r, 3),
                 EndPointGenerator::name(static_cast<EndPointGenerator::Phase>(static_cast<std::uint64_t>(run.trace.at(r, 4)))));
  });
  const RadialDistribution& g = run.radial_distribution;
  folder.write("radial-distribution.csv", [&](std::ostream& out) {
    out << "r";
    for (std::size_t a = 0; a < g.species(); ++a)
      for (std::size_t b = a; b < g.species(); ++b) out << ",g_" << model.species[a].name << '_' << model.species[b].name;
    out << '\n';
    for (std::size_t bin = 0; bin < g.bins(); ++bin) {
      fmt::print(out, "{}", g.radius(bin));
      for (std::size_t a = 0; a < g.species(); ++a)
        for (std::size_t b = a; b < g.species(); ++b) fmt::print(out, ",{}", g.value(a, b, bin));
      out << '\n';
    }
  });
}

}  // namespace

EndPoints make_end_points(const LennardJonesModel& model, const Configuration& start, const EndPointOptions& options, Isa isa,
                          OutputFolder& folder, const CommonOptions& common) {
  TerminalMonitor monitor(common.quiet);
  EndPoints result{run_end_points(model, start, options, isa, {folder.checkpoints(), !common.resume.empty()}, monitor),
                   Json::object(), false};
  const EndPointRunResult& run = result.run;
  result.json["pairs"] = Json::array();
  for (std::size_t k = 0; k < run.pairs.size(); ++k) {
    const ConfigurationPair& pair = run.pairs[k];
    write_pair(folder, k, pair, model);
    result.json["pairs"].push_back({{"file", folder.exists() ? Json((folder.path() / pair_file_name(k)).string()) : Json()},
                                    {"distance", pair.distance},
                                    {"steps", pair.steps},
                                    {"time", static_cast<double>(pair.steps) * options.time_step},
                                    {"seconds", run.pair_seconds[k]}});
  }
  result.json["temperature"] = run.temperature;
  result.json["temperature_convention"] = "3N";
  result.json["outcome"] = run.interrupted ? "interrupted" : EndPointGenerator::name(run.phase);
  result.json["seconds"] = run.seconds;
  if (folder.exists()) write_equilibration(folder, run, options, model);
  result.reached = run.phase == EndPointGenerator::Phase::done;
  if (!result.reached && !run.interrupted)
    say(common, fmt::format("{}: {} of {} pairs were made", EndPointGenerator::name(run.phase), run.pairs.size(), options.pairs));
  return result;
}

}  // namespace lanescape::program
