#include "end_point_options.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "io/extended_xyz.hpp"

namespace lanescape::program {

namespace {

constexpr Scope made_starts{"start", "runs that make their start, without --start"};
constexpr Scope sphere_files{"sphere file", "spheres of a file"};

}  // namespace

void EndPointSetup::add_to(Options& options) {
  options.add("--particles", particles_, "number of particles N").only_for({made_starts});
  options.add("--density", density_, "number density of a soft model [sigma^-3] [1.2]")
      .only_for({soft_models})
      .only_for({made_starts});
  options.add("--temperature", temperature_, "temperature of a soft model [epsilon/k_B] [1]").only_for({soft_models});
  options.add("--packing-fraction", packing_fraction_, "of hard spheres [0.5]").only_for({hard_spheres}).only_for({made_starts});
  options.add("--start-method", start_method_, "of hard spheres: auto, lattice, contraction or growth [auto]")
      .only_for({hard_spheres})
      .only_for({made_starts});
  options.add("--distance", distance_, "distance between the ends of a pair [sigma] [108 at N = 108, else 10 sqrt(N)]");
  options.add("--distance-species", distance_species_, "count only this species' motion towards the distance");
  options.add("--pairs", pairs_, "number of pairs [1]");
  options.add("--start", start_file_, "start from this configuration instead of an fcc crystal (its first frame)");
  options.add_flag("--quick", quick_, "short equilibration, to try things out");
  add_soft_protocol_to(options);
  options.add("--equilibration-collisions", equilibration_collisions_, "of hard spheres [10000000; quick 200000]")
      .only_for({hard_spheres});
  options.add("--between-collisions", between_collisions_, "of hard spheres between pairs [100000; quick 20000]")
      .only_for({hard_spheres});
  options.add("--max-pair-collisions", max_pair_collisions_, "of one pair of hard spheres before giving up [1000000000000]")
      .only_for({hard_spheres});
}

void EndPointSetup::add_soft_protocol_to(Options& options) {
  const auto add = [&](const char* name, auto& value, const char* description) {
    options.add(name, value, description).only_for({soft_models});
  };
  add("--time-step", time_step_, "of molecular dynamics [0.001]");
  add("--melt-temperature", melt_temperature_, "temperature at which the crystal melts [5]");
  add("--melt-steps", melt_steps_, "steps at the melt temperature [200000; quick 20000]");
  add("--cooling-steps", cooling_steps_, "steps from the melt temperature to --temperature [1000000; quick 50000]");
  add("--rescale-interval", rescale_interval_, "steps between velocity scalings while melting and cooling [1000]");
  add("--check-steps", check_steps_, "of the temperature check, without thermostat [1000000; quick 50000]");
  add("--check-interval", check_interval_, "steps between temperature samples [100]");
  add("--check-tolerance", check_tolerance_, "largest deviation of the mean temperature [0.005; quick 0.02]");
  add("--max-checks", max_checks_, "temperature checks before giving up [100]");
  add("--settle-steps", settle_steps_, "before the first pair [1000000; quick 50000]");
  add("--between-steps", between_steps_, "between pairs [100000; quick 20000]");
  add("--max-pair-steps", max_pair_steps_, "of one pair before giving up [1000000000]");
}

void EndPointSetup::add_tolerance_to(Options& options) {
  options.add("--overlap-tolerance", overlap_tolerance_, "of hard spheres in files, in units of s_ij: up to it radii are scaled")
      .only_for({hard_spheres})
      .only_for({sphere_files});
}

RunKinds EndPointSetup::kinds(bool has_pair_files) const {
  return {kind_if(start_file_.empty(), made_starts, "without --start", "with --start"),
          kind_if(has_pair_files || !start_file_.empty(), sphere_files, "with a file", "without a file")};
}

namespace {

template <class Target, class Given>
void take(Target& target, const std::optional<Given>& given) {
  if (given) target = *given;
}

}  // namespace

EndPointProtocol EndPointSetup::resolve(const AnyModel& model, std::size_t particles, std::uint64_t seed) const {
  // What both families share.
  const auto shared = [&](auto options) {
    if (quick_) options.make_quick();
    options.distance = distance_.value_or(default_distance(particles) * length_unit(model));
    if (!distance_species_.empty()) options.distance_species = mixture_of(model).find_species(distance_species_);
    options.seed = seed;
    take(options.pairs, pairs_);
    return options;
  };
  if (is_hard(model)) return hard_protocol(shared(HardEndPointOptions{}));
  EndPointOptions options;
  options.length_unit = length_unit(model);
  return soft_protocol(shared(options));
}

HardEndPointOptions EndPointSetup::hard_protocol(HardEndPointOptions options) const {
  take(options.equilibration_collisions, equilibration_collisions_);
  take(options.between_collisions, between_collisions_);
  take(options.max_pair_collisions, max_pair_collisions_);
  options.check();
  return options;
}

EndPointOptions EndPointSetup::soft_protocol(EndPointOptions options) const {
  options.temperature = temperature_.value_or(1.0);
  options.time_step = time_step_.value_or(options.time_step * options.length_unit);
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

void EndPointSetup::settle(const AnyModel& model) {
  if (!is_hard(model)) {
    if (!temperature_) temperature_ = 1.0;
    if (!density_ && start_file_.empty()) density_ = 1.2 * std::pow(length_unit(model), -3);
  } else if (start_file_.empty()) {
    if (!packing_fraction_) packing_fraction_ = 0.5;
    if (!start_method_) start_method_ = "auto";
  }
}

Configuration EndPointSetup::start(const AnyModel& model, const CommonOptions& common, Isa isa) {
  // Refuses values out of range before any work; the start refuses 0 particles, which have no distance to speak of.
  resolve(model, std::max<std::uint64_t>(particles_, 1), common.seed);
  const auto soft_start = [&](const auto& soft) {
    return start_file_.empty() ? fcc_start(soft, particles_, *density_, common.seed) : read_first_frame(start_file_, model);
  };
  return std::visit(Overloaded{[&](const PairModel& soft) { return soft_start(soft); },
                               [&](const StateMixtureModel& soft) { return soft_start(soft); },
                               [&](const HardSphereModel& hard) { return hard_start(hard, common, isa); }},
                    model);
}

Configuration EndPointSetup::hard_start(const HardSphereModel& hard, const CommonOptions& common, Isa isa) {
  if (!start_file_.empty()) {
    Configuration start = read_hard_frame(start_file_, hard);
    radius_factor_ = remove_rounding_overlaps_in(start_file_, start, overlap_tolerance_);
    return start;
  }
  TerminalMonitor monitor(common.quiet);
  const auto made = make_hard_sphere_start(hard, particles_, packing_fraction_.value_or(0.5),
                                           parse_start_method(start_method_.value_or("auto")), common.seed, isa, monitor);
  if (!made) throw Error(ErrorCode::interrupted, "interrupted while the start was made");
  return *made;
}

std::string pair_file_name(std::size_t number) { return fmt::format("pair-{:04}.extxyz", number + 1); }

void write_pair(OutputFolder& folder, std::size_t number, const ConfigurationPair& pair, const Mixture& model,
                const AskedDistance& asked) {
  folder.write(pair_file_name(number), [&](std::ostream& out) {
    std::map<std::string, std::string> info{{"distance", fmt::format("{}", pair.distance)},
                                            {"steps", fmt::format("{}", pair.steps)}};
    if (pair.radius_factor != 1.0) info[radius_factor_key] = fmt::format("{}", pair.radius_factor);
    if (pair.temperature) info[temperature_key] = fmt::format("{}", *pair.temperature);
    if (asked.distance) info[asked_distance_key] = fmt::format("{}", *asked.distance);
    if (!asked.species.empty()) info[distance_species_key] = asked.species;
    info["end"] = "first";
    write_frame(out, pair.start, model, info);
    info["end"] = "last";
    write_frame(out, pair.finish, model, info);
  });
}

namespace {

void write_equilibration(OutputFolder& folder, const EndPointRunResult& run, const Mixture& model) {
  folder.write("endpoints-trace.csv", [&](std::ostream& out) {
    const std::size_t last = run.trace_columns.size() - 1;
    for (std::size_t c = 0; c <= last; ++c) out << run.trace_columns[c] << (c < last ? "," : "\n");
    for (std::size_t r = 0; r < run.trace.rows(); ++r) {
      for (std::size_t c = 0; c < last; ++c) fmt::print(out, "{},", run.trace.at(r, c));
      out << run.phase_names[static_cast<std::size_t>(run.trace.at(r, last))] << '\n';
    }
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

EndPointRunResult run_protocol(const AnyModel& model, const Configuration& start, const EndPointProtocol& protocol, Isa isa,
                               const CheckpointOptions& checkpoint, RunMonitor& monitor, int threads, Precision precision) {
  const auto run_soft = [&] {
    EndPointOptions options = std::get<EndPointOptions>(protocol);
    options.threads = threads;
    options.precision = precision;
    return run_end_points(model, start, options, isa, checkpoint, monitor);
  };
  return std::visit(Overloaded{[&](const HardSphereModel& hard) {
                                 return run_hard_end_points(hard, start, std::get<HardEndPointOptions>(protocol), isa, checkpoint,
                                                            monitor);
                               },
                               [&](const PairModel&) { return run_soft(); }, [&](const StateMixtureModel&) { return run_soft(); }},
                    model);
}

AskedDistance asked_distance(const EndPointProtocol& protocol, const Mixture& model) {
  return std::visit(
      [&](const auto& options) {
        const auto& species = options.distance_species;
        return AskedDistance{options.distance, species ? model.species[static_cast<std::size_t>(*species)].name : std::string()};
      },
      protocol);
}

}  // namespace

EndPoints make_end_points(const AnyModel& model, const Configuration& start, const EndPointProtocol& protocol, Isa isa,
                          OutputFolder& folder, const CommonOptions& common, Precision precision) {
  TerminalMonitor monitor(common.quiet);
  EndPoints result{
      run_protocol(model, start, protocol, isa, {folder.checkpoints(), !common.resume.empty()}, monitor, common.threads, precision),
      Json::object(), false};
  const EndPointRunResult& run = result.run;
  const bool hard = is_hard(model);
  const AskedDistance asked = asked_distance(protocol, mixture_of(model));
  result.json["pairs"] = Json::array();
  for (std::size_t k = 0; k < run.pairs.size(); ++k) {
    const ConfigurationPair& pair = run.pairs[k];
    write_pair(folder, k, pair, mixture_of(model), asked);
    result.json["pairs"].push_back({{"file", folder.exists() ? Json((folder.path() / pair_file_name(k)).string()) : Json()},
                                    {"distance", pair.distance},
                                    {hard ? "collisions" : "steps", pair.steps},
                                    {"time", pair.time},
                                    {"seconds", run.pair_seconds[k]}});
  }
  if (hard) {
    result.json["compressibility"] = number_or_null(run.compressibility);  // no time may have passed since equilibrium
    result.json["compressibility_convention"] = "3N - 3";
    result.json["packing_fraction"] = packing_fraction(start);
  } else {
    result.json["temperature"] = run.temperature;
    result.json["temperature_convention"] = "3N";
  }
  result.json["outcome"] = run.interrupted ? "interrupted" : run.ended_as;
  result.json["seconds"] = run.seconds;
  if (folder.exists()) write_equilibration(folder, run, mixture_of(model));
  result.reached = run.done;
  if (!result.reached && !run.interrupted) say(common, fmt::format("{}: pairs made: {}", run.ended_as, run.pairs.size()));
  return result;
}

}  // namespace lanescape::program
