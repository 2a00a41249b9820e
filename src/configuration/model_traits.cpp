#include "configuration/model_traits.hpp"

#include "core/overloaded.hpp"

namespace lanescape {

ModelTraits traits_of(const AnyModel& model) {
  return std::visit(Overloaded{[](const PairModel& pairs) {
                                 return ModelTraits{.family = Family::soft,
                                                    .particles = "soft particles",
                                                    .images = pairs.images,
                                                    .sizes = pairs.form->has_diameters ? SizeColumn::diameter : SizeColumn::ignored,
                                                    .has_precision = true,
                                                    .has_states = false};
                               },
                               [](const HardSphereModel&) {
                                 return ModelTraits{.family = Family::hard,
                                                    .particles = "hard spheres",
                                                    .images = ImageRule::minimum,
                                                    .sizes = SizeColumn::radius,
                                                    .has_precision = false,
                                                    .has_states = false};
                               },
                               [](const StateMixtureModel&) {
                                 return ModelTraits{.family = Family::soft,
                                                    .particles = "sites with states",
                                                    .images = ImageRule::all,
                                                    .sizes = SizeColumn::ignored,
                                                    .has_precision = false,
                                                    .has_states = true};
                               }},
                    model);
}

}  // namespace lanescape
