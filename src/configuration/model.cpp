#include "configuration/model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace lanescape {

namespace {

struct NamedModel {
  std::string_view name;
  AnyModel (*make)();
};

constexpr NamedModel named_models[] = {{"kob-andersen", [] { return AnyModel(kob_andersen()); }},
                                       {"lennard-jones", [] { return AnyModel(lennard_jones()); }},
                                       {"wca", [] { return AnyModel(wca()); }},
                                       {"wahnstrom", [] { return AnyModel(wahnstrom()); }},
                                       {"hard-sphere", [] { return AnyModel(hard_sphere()); }},
                                       {"hard-sphere-binary", [] { return AnyModel(hard_sphere_binary()); }},
                                       {"ucg", [] { return AnyModel(liquid_vapour()); }}};

// A potential is a model of one component under its own word, if no number of it has to be given.
bool is_named(const PairForm& form) {
  return &form != &lennard_jones_form() &&
         std::all_of(form.numbers.begin(), form.numbers.end(), [](const FormNumber& number) { return number.preset.has_value(); });
}

}  // namespace

std::vector<std::string> known_models() {
  std::vector<std::string> names;
  for (const NamedModel& model : named_models) names.emplace_back(model.name);
  for (const PairForm& form : pair_forms())
    if (is_named(form)) names.emplace_back(form.word);
  return names;
}

AnyModel named_model(std::string_view name) {
  for (const NamedModel& model : named_models)
    if (name == model.name) return model.make();
  for (const PairForm& form : pair_forms())
    if (name == form.word && is_named(form)) return one_component(form);
  throw_bad_input(fmt::format("unknown model '{}': allowed are {}", name, fmt::join(known_models(), ", ")));
}

const Mixture& mixture_of(const AnyModel& model) {
  return std::visit([](const Mixture& mixture) -> const Mixture& { return mixture; }, model);
}

double largest_size(const AnyModel& model) {
  return std::visit([](const auto& of_kind) { return of_kind.largest_size(); }, model);
}

double length_unit(const AnyModel& model) {
  return std::visit([](const auto& of_kind) { return of_kind.length_unit(); }, model);
}

}  // namespace lanescape
