#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <lanescape/error.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// A potential-energy landscape V(R). Path finders and dynamics take any: implement it to let them run on a host's own energies.
// Positions are x0 y0 z0 x1 ..., 3N numbers, unwrapped. Calls come from the thread that calls the finder. Exceptions pass through.
// A gradient that is not finite ends the work with Error(bad_input); an energy that is not a number is above every limit.
class LANESCAPE_API Landscape {
 public:
  virtual ~Landscape() = default;
  virtual std::size_t particles() const = 0;
  virtual double energy(std::span<const double> positions) = 0;
  // Returns V and overwrites `gradient`, 3N numbers, with dV/dR.
  virtual double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) = 0;
};

LANESCAPE_ABI_END
}  // namespace lanescape
