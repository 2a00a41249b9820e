#include "configuration/model.hpp"

#include <fmt/format.h>

#include <string>

#include "core/error.hpp"

namespace lanescape {

namespace {

struct NamedModel {
  std::string_view name;
  Model (*make)();
};

constexpr NamedModel named_models[] = {{"kob-andersen", [] { return Model(kob_andersen()); }},
                                       {"lennard-jones", [] { return Model(lennard_jones()); }},
                                       {"wca", [] { return Model(wca()); }},
                                       {"wahnstrom", [] { return Model(wahnstrom()); }},
                                       {"polydisperse", [] { return Model(one_component(pair_form("polydisperse"))); }},
                                       {"mie", [] { return Model(one_component(pair_form("mie"))); }},
                                       {"inverse-power", [] { return Model(one_component(pair_form("inverse-power"))); }},
                                       {"harmonic", [] { return Model(one_component(pair_form("harmonic"))); }},
                                       {"hertzian", [] { return Model(one_component(pair_form("hertzian"))); }},
                                       {"hard-sphere", [] { return Model(hard_sphere()); }},
                                       {"hard-sphere-binary", [] { return Model(hard_sphere_binary()); }},
                                       {"ucg", [] { return Model(liquid_vapour()); }}};

}  // namespace

Model named_model(std::string_view name) {
  std::string names;
  for (const NamedModel& model : named_models) {
    if (name == model.name) return model.make();
    names += fmt::format("{}{}", names.empty() ? "" : ", ", model.name);
  }
  throw_bad_input(fmt::format("unknown model '{}': allowed are {}", name, names));
}

const Mixture& mixture_of(const Model& model) {
  return std::visit([](const Mixture& mixture) -> const Mixture& { return mixture; }, model);
}

}  // namespace lanescape
