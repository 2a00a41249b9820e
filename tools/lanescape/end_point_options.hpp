#pragma once

#include <optional>
#include <string>
#include <variant>

#include "program.hpp"
#include "run/end_point_run.hpp"

namespace lanescape::program {

// The protocol of either family.
using EndPointProtocol = std::variant<EndPointOptions, HardEndPointOptions>;

// Overlaps in a file of at most this relative depth count as rounding.
inline constexpr double default_overlap_tolerance = 1e-7;

// The options that end points are made with, for `endpoints` and for `path` without --pair.
class EndPointSetup {
 public:
  void add_to(Options& options);
  // Of hard spheres whose positions come from a file.
  void add_tolerance_to(Options& options);
  // Where the start comes from; with pairs of files no start is made.
  RunKinds kinds(bool has_pair_files) const;
  bool generates_start() const { return start_file_.empty(); }

  // The protocol to run; throws Error(bad_input) for options out of range.
  EndPointProtocol resolve(const AnyModel& model, std::size_t particles, std::uint64_t seed) const;
  // Fills in a state point that was not given, so that the resolved run file has it.
  void settle(const AnyModel& model);
  // The initial configuration: --start FILE, else an fcc crystal; for dense hard spheres the result of --start-method. Remembers
  // the radius factor of a file.
  Configuration start(const AnyModel& model, const CommonOptions& common, Isa isa);
  // The factor that scaled the radii of --start FILE; empty without such a file.
  const std::optional<double>& radius_factor() const { return radius_factor_; }
  double overlap_tolerance() const { return overlap_tolerance_; }

 private:
  void add_soft_protocol_to(Options& options);
  HardEndPointOptions hard_protocol(HardEndPointOptions options) const;
  EndPointOptions soft_protocol(EndPointOptions options) const;
  Configuration hard_start(const HardSphereModel& hard, const CommonOptions& common, Isa isa);

  std::uint64_t particles_ = 108;
  std::optional<double> density_, temperature_, packing_fraction_, distance_;
  std::optional<std::string> start_method_;
  std::optional<double> radius_factor_;
  double overlap_tolerance_ = default_overlap_tolerance;
  std::string start_file_, distance_species_;
  bool quick_ = false;
  // Counts and tolerances that were given; --quick decides the others.
  std::optional<std::uint64_t> pairs_, melt_steps_, cooling_steps_, rescale_interval_, check_steps_, check_interval_, max_checks_,
      settle_steps_, between_steps_, max_pair_steps_, equilibration_collisions_, between_collisions_, max_pair_collisions_;
  std::optional<double> time_step_, melt_temperature_, check_tolerance_;
};

// Runs the protocol and writes DIR/pair-0001.extxyz ..., the traces, and the start of the JSON result.
struct EndPoints {
  EndPointRunResult run;
  Json json;     // {"pairs": ..., "temperature" or "compressibility": ...}
  bool reached;  // all pairs were made
};
EndPoints make_end_points(const AnyModel& model, const Configuration& start, const EndPointProtocol& protocol, Isa isa,
                          OutputFolder& folder, const CommonOptions& common, Precision precision);

// In the comment line of a kept pair whose radii were scaled.
inline constexpr const char* radius_factor_key = "radius_factor";
// In the comment lines of pairs of soft particles: the temperature of the liquid, where it is known.
inline constexpr const char* temperature_key = "temperature";
// Likewise of all pairs: the distance that was asked for, which theirs exceeds a little, and the one species that counts for it.
struct AskedDistance {
  std::optional<double> distance;  // [sigma]
  std::string species;             // empty: all count
};
inline constexpr const char* asked_distance_key = "asked_distance";
inline constexpr const char* distance_species_key = "distance_species";
// "pair-0001.extxyz"
std::string pair_file_name(std::size_t number);
void write_pair(OutputFolder& folder, std::size_t number, const ConfigurationPair& pair, const Mixture& model,
                const AskedDistance& asked);

}  // namespace lanescape::program
