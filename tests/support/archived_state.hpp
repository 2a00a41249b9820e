#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"

namespace lanescape::testing {

// One field of every type, inside and outside groups.
struct ArchivedState {
  double time = 0.0;
  std::uint64_t step = 0;
  std::string name;
  std::vector<double> positions;
  AlignedArray velocities;
  std::vector<std::uint64_t> order;

  void exchange(Archive& archive) {
    archive.field("time", time);
    archive.enter("dynamics");
    archive.field("step", step);
    archive.enter("particles");
    archive.field("positions", positions);
    archive.field("velocities", velocities);
    archive.leave();
    archive.field("order", order);
    archive.leave();
    archive.field("name", name);
  }
};

}  // namespace lanescape::testing
