#include "api/pair_models.hpp"

#include <fmt/format.h>

#include "api/access.hpp"
#include "api/host_arrays.hpp"
#include "configuration/model_traits.hpp"
#include "core/error.hpp"

namespace lanescape {

const PairModel& pair_model(const Model& model, const char* user) {
  if (const auto* pairs = std::get_if<PairModel>(&detail::Access::of(model))) return *pairs;
  throw_bad_input(fmt::format("model {} is made of {}: {} needs a model of a pair potential; {}", model.name(),
                              traits_of(detail::Access::of(model)).particles, user,
                              model.has_states() ? "StateSystem is for sites in states" : "HardSpheres is for hard spheres"));
}

const std::vector<double>& checked_diameters(const PairModel& model, const std::vector<double>& given, std::size_t particles) {
  if (model.form->has_diameters) check_room("diameters", given.size(), particles);
  if (!model.form->has_diameters && !given.empty())
    throw_bad_input(fmt::format("model {} has no diameters of particles: none are allowed", model.name));
  return given;
}

}  // namespace lanescape
