#include "api/pair_models.hpp"

#include <fmt/format.h>

#include "api/access.hpp"
#include "configuration/model_traits.hpp"
#include "core/error.hpp"

namespace lanescape {

const PairModel& pair_model(const Model& model, const char* user) {
  if (const auto* pairs = std::get_if<PairModel>(&detail::Access::of(model))) return *pairs;
  throw_bad_input(fmt::format("model {} is made of {}: {} needs a model of a pair potential; {}", model.name(),
                              traits_of(detail::Access::of(model)).particles, user,
                              model.has_states() ? "StateSystem is for sites in states" : "HardSpheres is for hard spheres"));
}

void check_diameters(const std::string& model, bool has_diameters, std::size_t given, std::size_t particles) {
  if (!has_diameters && given != 0) throw_bad_input(fmt::format("model {} has no diameters of particles: none are allowed", model));
  if (has_diameters && given != particles)
    throw_bad_input(fmt::format("{} diameters were given for {} particles: one for each is needed", given, particles));
}

const std::vector<double>& checked_diameters(const PairModel& model, const std::vector<double>& given, std::size_t particles) {
  check_diameters(model.name, model.form->has_diameters, given.size(), particles);
  return given;
}

}  // namespace lanescape
