#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lanescape/dynamics.hpp>
#include <lanescape/landscape.hpp>
#include <lanescape/model.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// How a path is searched between two configurations that never leaves the allowed region V(R) <= E_L, or overlaps.
struct PathSettings {
  std::string method{};  // contour or escape (soft), avoidance or away (hard spheres); empty: the first of the family
  // contour: steps as long as an estimate of their error allows, the limit of short steps in fewer evaluations; avoidance: slides
  // along contacts in long steps, shorter paths
  bool adaptive = false;
  double step = 0.0;  // not adaptive: length of a direct step in 3N space; 0: the method's own, in the model's unit of length
  double avoidance_step = 0.0;               // of each sphere that an avoidance step moves; 0: 1e-4 of that unit
  std::string fictitious = "harmonic";       // force between overlapping spheres in an avoidance step; or linear, cubic
  std::optional<double> landscape_energy{};  // E_L; nothing: the higher of the two ends
  bool reverse = false;                      // search from the far end too and keep the shorter path
  std::uint64_t max_steps = 1'000'000'000;
  std::uint64_t patience = 1000;         // steps without progress after which a path is stalled, times a factor of the method
  std::size_t frames = 100;              // configurations kept between the two ends
  int threads = 1;                       // no effect on any result
  std::string precision = "double";      // or mixed
  std::string instruction_set = "auto";  // or a name of instruction_sets()
  Progress progress{};
};

struct Path {
  std::string outcome;               // reached, step_limit, stalled, interrupted
  std::string reason;                // why it ended where it did not reach its goal
  double length = 0.0;               // g in 3N space, of mass-weighted coordinates where masses differ
  double distance = 0.0;             // of its ends, likewise
  double ratio_squared = 0.0;        // (distance / length)^2, 0 for a path that did not move
  double participation_ratio = 0.0;  // n/N: share of the particles that move at a time
  std::uint64_t direct_steps = 0, detour_steps = 0, evaluations = 0;
  double landscape_energy = 0.0;   // E_L of soft models
  double largest_violation = 0.0;  // largest V - E_L of accepted points, along adaptive steps too, or deepest overlap; at least 0
  bool reversed = false;           // frames run from the finish to the start
  double seconds = 0.0;
  std::vector<std::vector<double>> frames;  // 3N each, ends included
  bool reached() const { return outcome == "reached"; }
};

// Between two configurations of a model, unwrapped, in a periodic box. `diameters`: of each particle, for models that have them;
// hard spheres have those of their species.
// Throws Error(bad_input) for ends that differ or coincide, overlap, or lie above the landscape energy.
LANESCAPE_API Path find_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                             std::span<const double> start, std::span<const double> finish, const PathSettings& settings,
                             std::span<const double> diameters = {});
// On a landscape of the host's own. On a Potential with its model's equal masses it is the path of that model, with the potential's
// threads, precision and instruction set, and unit of length. `masses`: one per particle, or empty for equal ones. Steps are in the
// landscape's unit of length. An exception of the landscape ends the search and passes through.
LANESCAPE_API Path find_path(Landscape& landscape, std::span<const double> start, std::span<const double> finish,
                             const PathSettings& settings, std::span<const double> masses = {});

LANESCAPE_ABI_END
}  // namespace lanescape
