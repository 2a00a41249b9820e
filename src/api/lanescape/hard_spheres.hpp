#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <lanescape/error.hpp>
#include <lanescape/owned.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// Two spheres that overlap: gap = r_ij - s_ij < 0.
struct Overlap {
  std::int64_t first = 0, second = 0;
  double gap = 0.0;
};

// Overlaps of hard spheres in a periodic orthorhombic box. Touching is not overlapping. Decisions are exact: they do not depend on
// the instruction set. Not thread-safe: one object per thread. Coordinates that are not finite throw Error(bad_input).
class LANESCAPE_API HardSpheres {
 public:
  struct Options {
    std::string instruction_set = "auto";  // or a name of instruction_sets()
    // Above 0, any_overlap() keeps a list of pairs with gaps below `skin` smallest diameters, for configurations that follow each
    // other in small steps; it is rebuilt when a sphere has moved half of that.
    double skin = 0.0;
  };

  // Edges of `box` are at least two of the largest diameters.
  HardSpheres(std::span<const double> radii, const std::array<double, 3>& box);
  HardSpheres(std::span<const double> radii, const std::array<double, 3>& box, const Options& options);
  ~HardSpheres();
  HardSpheres(HardSpheres&&) noexcept;
  HardSpheres& operator=(HardSpheres&&) noexcept;

  std::size_t particles() const;
  bool any_overlap(std::span<const double> positions);
  // All overlapping pairs, first < second, in rising order; valid until the next call.
  std::span<const Overlap> overlaps(std::span<const double> positions);
  // The smallest r_ij - s_ij; infinity for a single sphere.
  double smallest_gap(std::span<const double> positions);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
