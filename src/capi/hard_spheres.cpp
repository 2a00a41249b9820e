#include <lanescape/hard_spheres.hpp>

#include "capi/arguments.hpp"
#include "capi/handles.hpp"

namespace lanescape::capi {

struct Spheres {
  HardSpheres spheres;
  std::vector<std::int64_t> first{}, second{};  // what the caller reads until the next call
  std::vector<double> gap{};
};

}  // namespace lanescape::capi

using namespace lanescape;
using namespace lanescape::capi;

namespace {

HardSpheres::Options options_of(const lanescape_hard_sphere_options* given) {
  HardSpheres::Options options;
  if (given == nullptr) return options;
  const auto& o = sized(given, "options", "lanescape_hard_sphere_options");
  options.instruction_set = word(o.instruction_set, options.instruction_set.c_str());
  options.skin = o.skin;
  return options;
}

}  // namespace

struct lanescape_hard_spheres : Handle<Spheres> {};

lanescape_status lanescape_hard_sphere_options_init(lanescape_hard_sphere_options* options, size_t size) {
  return guarded([&] {
    lanescape_hard_sphere_options presets{};
    presets.skin = HardSpheres::Options{}.skin;
    initialise(options, size, "options", "lanescape_hard_sphere_options", presets);
  });
}

lanescape_status lanescape_hard_spheres_create(size_t particles, const double* radii, const double box[3],
                                               const lanescape_hard_sphere_options* options, lanescape_hard_spheres** spheres) {
  return guarded([&] {
    create(spheres, "spheres",
           [&] { return Spheres{HardSpheres(array(radii, particles, "radii"), three(box, "box"), options_of(options))}; });
  });
}

lanescape_status lanescape_hard_spheres_any_overlap(lanescape_hard_spheres* spheres, const double* positions, int* any) {
  return alone(spheres, "spheres", [&](Spheres& s) {
    HardSpheres& checked = s.spheres;
    int& out = given(any, "any");
    out = checked.any_overlap(vectors(positions, checked.particles(), "positions")) ? 1 : 0;
  });
}

lanescape_status lanescape_hard_spheres_overlaps(lanescape_hard_spheres* spheres, const double* positions,
                                                 lanescape_overlaps* overlaps) {
  return alone(spheres, "spheres", [&](Spheres& s) {
    auto& [checked, first, second, gap] = s;
    auto& out = sized(overlaps, "overlaps", "lanescape_overlaps");
    const auto found = checked.overlaps(vectors(positions, checked.particles(), "positions"));
    first.clear();
    second.clear();
    gap.clear();
    for (const Overlap& overlap : found) {
      first.push_back(overlap.first);
      second.push_back(overlap.second);
      gap.push_back(overlap.gap);
    }
    out = {out.size, found.size(), first.data(), second.data(), gap.data()};
  });
}

lanescape_status lanescape_hard_spheres_smallest_gap(lanescape_hard_spheres* spheres, const double* positions, double* gap) {
  return alone(spheres, "spheres", [&](Spheres& s) {
    HardSpheres& checked = s.spheres;
    double& out = given(gap, "gap");
    out = checked.smallest_gap(vectors(positions, checked.particles(), "positions"));
  });
}

lanescape_status lanescape_hard_spheres_destroy(lanescape_hard_spheres* spheres) { return destroy(spheres, "spheres"); }
