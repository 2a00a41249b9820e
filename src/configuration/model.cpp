#include "configuration/model.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace lanescape {

Model named_model(std::string_view name) {
  if (name == "kob-andersen") return kob_andersen();
  if (name == "lennard-jones") return lennard_jones();
  if (name == "hard-sphere") return hard_sphere();
  if (name == "hard-sphere-binary") return hard_sphere_binary();
  if (name == "ucg") return liquid_vapour();
  throw_bad_input(
      fmt::format("unknown model '{}': allowed are kob-andersen, lennard-jones, hard-sphere, hard-sphere-binary, ucg", name));
}

const Mixture& mixture_of(const Model& model) {
  return std::visit([](const Mixture& mixture) -> const Mixture& { return mixture; }, model);
}

}  // namespace lanescape
