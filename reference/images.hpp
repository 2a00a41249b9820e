#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "reference/vector.hpp"

/// Periodic images of a separation in an orthorhombic box.
namespace lanescape::reference {

enum class ImageRule {
  all,      // every periodic image within the cutoff, a particle's own images with weight 1/2
  minimum,  // per axis the nearest image only, whatever the ratio of cutoff and box
};

/// Along which axes the box is periodic. Along an open axis there are no images.
using Periodic = std::array<bool, 3>;
inline constexpr Periodic all_periodic{true, true, true};

struct Image {
  Vector separation;  // the separation asked for less `shift`
  Vector shift;       // whole boxes
  bool nearest;       // the nearest image; for a particle and itself, the particle
};

/// Calls visit(Image) for the images of `separation` that can be nearer than `reach`, and for others that are farther. With
/// ImageRule::minimum it calls once, for the nearest image.
template <class Visit>
void for_each_image(const Vector& separation, const Vector& box, const Periodic& periodic, double reach, ImageRule rule,
                    const Visit& visit) {
  Vector home{};
  std::array<int, 3> most{};  // the nearest image is at most L/2 away, so one within reach is at most this many boxes from it
  for (std::size_t k = 0; k < 3; ++k) {
    if (!periodic[k]) continue;
    home[k] = box[k] * std::nearbyint(separation[k] / box[k]);
    most[k] = rule == ImageRule::minimum ? 0 : static_cast<int>(std::ceil(reach / box[k] + 0.5));
  }
  for (int x = -most[0]; x <= most[0]; ++x)
    for (int y = -most[1]; y <= most[1]; ++y)
      for (int z = -most[2]; z <= most[2]; ++z) {
        const Vector boxes{x * box[0], y * box[1], z * box[2]};
        Image image{{}, {}, x == 0 && y == 0 && z == 0};
        for (std::size_t k = 0; k < 3; ++k) {
          image.separation[k] = (separation[k] - home[k]) + boxes[k];
          image.shift[k] = home[k] - boxes[k];
        }
        visit(image);
      }
}

}  // namespace lanescape::reference
