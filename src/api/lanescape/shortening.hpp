#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lanescape/landscape.hpp>
#include <lanescape/model.hpp>
#include <lanescape/path.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// How a path is made as short as it can be. The random numbers of two starts differ.
struct ShortenSettings {
  std::string method{};      // a word of shorten_method_names(); empty: the first
  std::uint64_t starts = 1;  // independent runs, of which the shortest path is kept
  std::uint64_t seed = 1;
  // How the path to start from and those in between are found, with the threads, precision, instruction set and landscape energy of
  // all of it. Its frames have no effect, and its reverse must be false. Its progress is called with the number of
  // iterations or trials made so far, 0 while the path to start from is found, from the thread that calls.
  PathSettings search{};
};

struct ShortPath {
  std::string outcome;             // reached where the method ended by its own rule; else step_limit, stalled, interrupted
  std::string reason;              // why it is not reached
  double length_before = 0.0;      // in 3N space, of mass-weighted coordinates where masses differ
  double length = 0.0;             // of the shortest path, 0 where there was none to start from
  double distance = 0.0;           // of its ends
  double ratio_squared = 0.0;      // (distance / length)^2, 0 without a path
  double landscape_energy = 0.0;   // E_L of soft models
  double largest_violation = 0.0;  // largest V - E_L along it, or deepest overlap; at least 0
  std::optional<double> kuhn_tucker_residual{};  // as in PathCertificate; none where the frames are only some points of the path
  std::vector<double> multipliers{};             // likewise, of each frame; or none
  std::vector<double> start_lengths{};           // of the path that each start found
  std::uint64_t evaluations = 0;                 // that found the path, not those of trials that failed
  double seconds = 0.0;
  std::vector<std::vector<double>> frames{};  // 3N each, from the start to the finish
  bool reached() const { return outcome == "reached"; }
};

// The words of the methods; the first is the default.
LANESCAPE_API std::vector<std::string> shorten_method_names();

// Shortens a path between two configurations of a model: that through `frames`, or where there are none the one that the search
// finds. `frames`: at least three, 3N each, which begin and end at the two ends in either order and are allowed. Other arguments:
// as for find_path(), which says what is thrown; and Error(bad_input) for frames that are no such path.
LANESCAPE_API ShortPath shorten_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                                     std::span<const double> start, std::span<const double> finish, const ShortenSettings& settings,
                                     std::span<const double> diameters = {}, const std::vector<std::vector<double>>& frames = {});
// On a landscape of the host's own, on one thread. On a Potential: as find_path().
LANESCAPE_API ShortPath shorten_path(Landscape& landscape, std::span<const double> start, std::span<const double> finish,
                                     const ShortenSettings& settings, std::span<const double> masses = {},
                                     const std::vector<std::vector<double>>& frames = {});

// How far a path of straight segments leaves the allowed region, and how far it is from the Kuhn-Tucker condition of a shortest
// one. A small residual shows that it is stationary, not that no other is shorter.
struct PathCertificate {
  double length = 0.0;             // in 3N space, of mass-weighted coordinates where masses differ
  double distance = 0.0;           // of its ends, likewise
  double ratio_squared = 0.0;      // (distance / length)^2
  double landscape_energy = 0.0;   // E_L of soft models
  double largest_violation = 0.0;  // of V - E_L, or of overlaps, over frames and segments; at least 0
  // max_k |tau_k - lambda_k n_k| / max_k |tau_k| over the bends tau_k of the path; 0 for a path that is straight up to rounding.
  double kuhn_tucker_residual = 0.0;
  std::vector<double> multipliers{};  // lambda_k >= 0 of each frame; of hard spheres the sum over contacts
  std::vector<double> excess{};       // of each frame: V - E_L; of hard spheres the smallest gap, infinity for a single one
  // Of each segment, frames - 1: the largest V - E_L; of hard spheres minus the smallest gap.
  std::vector<double> segment_violation{};
};

struct CheckSettings {
  std::optional<double> landscape_energy{};  // E_L; nothing: the higher of the two ends
  int threads = 1;                           // no effect on any result
  std::string instruction_set = "auto";      // or a name of instruction_sets()
};

// Of a path of a model, at least three frames of 3N coordinates, unwrapped. Throws Error(bad_input) for fewer, other sizes,
// coordinates that are not finite, neighbouring frames that coincide, and energies that are not finite.
LANESCAPE_API PathCertificate check_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                                         const std::vector<std::vector<double>>& frames, const CheckSettings& settings,
                                         std::span<const double> diameters = {});
// On a landscape of the host's own, on one thread. On a Potential: as find_path().
LANESCAPE_API PathCertificate check_path(Landscape& landscape, const std::vector<std::vector<double>>& frames,
                                         const CheckSettings& settings, std::span<const double> masses = {});

LANESCAPE_ABI_END
}  // namespace lanescape
