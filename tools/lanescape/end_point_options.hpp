#pragma once

#include <optional>
#include <string>

#include "program.hpp"
#include "run/end_point_run.hpp"

namespace lanescape::program {

// The options from which end points are made, for `endpoints` and for `path` without --pair.
class EndPointSetup {
 public:
  void add_to(Options& options);

  // A pair's distance where --distance is not given: 108 at N = 108, else 10 sqrt(N) [sigma].
  static double default_distance(std::size_t particles);
  // What to run; throws Error(bad_input) for anything out of range.
  EndPointOptions resolve(const Mixture& model, std::size_t particles, std::uint64_t seed) const;
  // The configuration that molecular dynamics starts from: --start FILE, or an fcc crystal.
  Configuration start(const LennardJonesModel& model, std::uint64_t seed) const;

 private:
  std::uint64_t particles_ = 108;
  double density_ = 1.2;
  double temperature_ = 1.0;
  std::optional<double> distance_;
  std::string start_file_, distance_species_;
  bool quick_ = false;
  // Counts and tolerances, only where they are given: the rest follows from --quick.
  std::optional<std::uint64_t> pairs_, melt_steps_, cooling_steps_, rescale_interval_, check_steps_, check_interval_, max_checks_,
      settle_steps_, between_steps_, max_pair_steps_;
  std::optional<double> time_step_, melt_temperature_, check_tolerance_;
};

// Runs the protocol and writes DIR/pair-0001.extxyz ..., the traces, and the start of the JSON result.
struct EndPoints {
  EndPointRunResult run;
  Json json;     // {"pairs": ..., "temperature": ...}
  bool reached;  // all pairs were made
};
EndPoints make_end_points(const LennardJonesModel& model, const Configuration& start, const EndPointOptions& options, Isa isa,
                          OutputFolder& folder, const CommonOptions& common);

// "pair-0001.extxyz"
std::string pair_file_name(std::size_t number);
void write_pair(OutputFolder& folder, std::size_t number, const ConfigurationPair& pair, const Mixture& model);

}  // namespace lanescape::program
