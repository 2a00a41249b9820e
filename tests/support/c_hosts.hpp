#pragma once

#include <lanescape/lanescape.h>
#include <lanescape/lanescape.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "configuration/configuration.hpp"

namespace lanescape::testing {

// What a host gets of a system of soft particles; refused: bad_input, at whatever call.
struct HostAnswer {
  bool refused = true;
  double energy = 0.0, virial = 0.0;
  std::array<double, 6> stress{};
  std::vector<double> forces{}, energies{};
  bool operator==(const HostAnswer&) const = default;
};

// Of hard spheres.
struct SphereAnswer {
  bool refused = true, any = false;
  double smallest_gap = 0.0;
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs{};
  std::vector<double> gaps{};
  bool operator==(const SphereAnswer&) const = default;
};

// Calls of the C interface, one after the other; after one that is refused no other is made. Any status but LANESCAPE_OK and
// LANESCAPE_BAD_INPUT is kept as a fault.
class CCalls {
 public:
  template <class Call>
  bool operator()(Call call) {
    if (!all_well_) return false;
    const lanescape_status status = call();
    all_well_ = status == LANESCAPE_OK;
    if (status != LANESCAPE_OK && status != LANESCAPE_BAD_INPUT) fault_ = lanescape_last_error();
    return all_well_;
  }
  bool all_well() const { return all_well_; }
  const std::string& fault() const { return fault_; }

 private:
  bool all_well_ = true;
  std::string fault_;
};

inline HostAnswer soft_through_c(const std::string& toml, const Configuration& c, const char* precision, const char* isa,
                                 std::string& fault) {
  HostAnswer answer;
  answer.forces.resize(3 * c.size());
  answer.energies.resize(c.size());
  lanescape_model* model = nullptr;
  lanescape_potential* potential = nullptr;
  lanescape_potential_options options;
  CCalls calls;
  calls([&] { return lanescape_model_from_toml(toml.c_str(), &model); });
  calls([&] { return lanescape_potential_options_init(&options, sizeof options); });
  options.precision = precision;
  options.instruction_set = isa;
  options.diameters = c.diameters.empty() ? nullptr : c.diameters.data();
  calls([&] { return lanescape_potential_create(model, c.size(), c.species.data(), c.box.length.data(), &options, &potential); });
  const lanescape_outputs outputs{sizeof outputs,       &answer.energy,       &answer.virial,
                                  answer.stress.data(), answer.forces.data(), answer.energies.data()};
  calls([&] { return lanescape_potential_evaluate(potential, c.positions.data(), &outputs); });
  if (potential != nullptr) lanescape_potential_destroy(potential);
  if (model != nullptr) lanescape_model_destroy(model);
  fault = calls.fault();
  answer.refused = false;
  return calls.all_well() ? answer : HostAnswer{};
}

inline SphereAnswer spheres_through_c(const Configuration& c, const char* isa, std::string& fault) {
  SphereAnswer answer;
  lanescape_hard_spheres* spheres = nullptr;
  lanescape_hard_sphere_options options;
  lanescape_overlaps overlaps{};
  overlaps.size = sizeof overlaps;
  int any = 0;
  CCalls calls;
  calls([&] { return lanescape_hard_sphere_options_init(&options, sizeof options); });
  options.instruction_set = isa;
  calls([&] { return lanescape_hard_spheres_create(c.size(), c.radii.data(), c.box.length.data(), &options, &spheres); });
  calls([&] { return lanescape_hard_spheres_any_overlap(spheres, c.positions.data(), &any); });
  calls([&] { return lanescape_hard_spheres_smallest_gap(spheres, c.positions.data(), &answer.smallest_gap); });
  if (calls([&] { return lanescape_hard_spheres_overlaps(spheres, c.positions.data(), &overlaps); }))
    for (std::size_t k = 0; k < overlaps.count; ++k) {
      answer.pairs.emplace_back(overlaps.first[k], overlaps.second[k]);
      answer.gaps.push_back(overlaps.gap[k]);
    }
  if (spheres != nullptr) lanescape_hard_spheres_destroy(spheres);
  fault = calls.fault();
  answer.any = any != 0;
  answer.refused = false;
  return calls.all_well() ? answer : SphereAnswer{};
}

}  // namespace lanescape::testing
