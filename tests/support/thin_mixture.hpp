#pragma once

#include <array>
#include <string>

#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"
#include "io/extended_xyz.hpp"

namespace lanescape::testing {

using Point = std::array<double, 3>;

inline const kernels::KernelTable& table() { return kernel_table(choose_isa("auto")); }

inline constexpr InsertionMethod every_method[] = {InsertionMethod::usher, InsertionMethod::usher_indirect,
                                                   InsertionMethod::usher_near, InsertionMethod::screened,
                                                   InsertionMethod::descent};

// A molten Kob-Andersen mixture with a third of its particles removed, so that there is room for more.
inline Configuration thin_mixture() {
  Configuration fluid =
      read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka_melted_144.extxyz", kob_andersen()).front().configuration;
  Configuration thin{fluid.box, {}, {}};
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (i % 3 == 0) continue;
    thin.species.push_back(fluid.species[i]);
    for (const double x : fluid.position(i)) thin.positions.push_back(x);
  }
  return thin;
}

inline InsertionOptions options_with(double target, InsertionMethod method = InsertionMethod::usher) {
  InsertionOptions options;
  options.target = target;
  options.method = method;
  return options;
}

}  // namespace lanescape::testing
