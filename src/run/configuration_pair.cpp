#include "run/configuration_pair.hpp"

#include <fmt/format.h>

#include <cmath>

#include "configuration/model_traits.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/state/state_mixture.hpp"

namespace lanescape {

void check_end_points(const ConfigurationPair& pair, const AnyModel& model, const std::string& where) {
  if (!(pair.start.box == pair.finish.box)) throw_bad_input(where + ": the two end points have different boxes");
  if (pair.start.species != pair.finish.species)
    throw_bad_input(where + ": the two end points differ in composition or in the order of their particles");
  if (pair.start.radii != pair.finish.radii) throw_bad_input(where + ": the two end points have different radii");
  if (pair.start.diameters != pair.finish.diameters) throw_bad_input(where + ": the two end points have different diameters");
  if (pair.start.positions == pair.finish.positions) throw_bad_input(where + ": the two end points coincide");
  for (const Configuration* end : {&pair.start, &pair.finish}) {
    try {
      check_periodic(end->box, "paths");
      if (is_hard(model))
        check_no_overlap(*end, kernel_table(available_isas().front()));
      else
        check_soft_separations(*end, model);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}, {} end: {}", where, end == &pair.start ? "first" : "last", error.what()));
    }
  }
}

bool looks_wrapped(const ConfigurationPair& pair) {
  bool crosses = false;
  for (std::size_t k = 0; k < pair.start.positions.size(); ++k) {
    const double edge = pair.start.box.length[k % 3], from = pair.start.positions[k], to = pair.finish.positions[k];
    if (!(from >= 0.0 && from <= edge && to >= 0.0 && to <= edge)) return false;
    crosses = crosses || std::abs(to - from) > 0.5 * edge;
  }
  return crosses;
}

}  // namespace lanescape
