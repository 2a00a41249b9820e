#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

reference::Truncation translate(Truncation truncation) {
  switch (truncation) {
    case Truncation::shifted:
      return reference::Truncation::shifted;
    case Truncation::plain:
      return reference::Truncation::plain;
    case Truncation::tail:
      return reference::Truncation::tail;
    case Truncation::shifted_force:
      return reference::Truncation::shifted_force;
    case Truncation::smooth:
      return reference::Truncation::smooth;
  }
  return reference::Truncation::shifted;
}

reference::PairForm form_of(const PairModel& model, std::size_t ab) {
  const PairNumbers numbers = model.numbers(ab);
  return reference::pair_form(model.form->word, numbers.epsilon, numbers.sigma, numbers.form);
}

reference::PairMixture translate(const PairModel& model) {
  reference::PairMixture mixture{model.species.size(), {}};
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    const double cutoff = model.form->has_diameters ? reference::unlimited : model.cutoff_of(ab);
    mixture.potentials.push_back({form_of(model, ab), cutoff, translate(model.truncation)});
  }
  return mixture;
}

reference::Particles translate(const Configuration& configuration) {
  return {configuration.positions, configuration.species, configuration.box.length, configuration.diameters,
          configuration.box.periodic};
}

}  // namespace

reference::Evaluation evaluate_reference(const PairModel& model, const Configuration& configuration) {
  const auto images = model.images == ImageRule::all ? reference::ImageRule::all : reference::ImageRule::minimum;
  return reference::pair_sum(translate(configuration), translate(model), images);
}

reference::Probe probe_reference(const PairModel& model, const Configuration& fluid, const std::array<double, 3>& position,
                                 int species, double diameter) {
  return reference::probe({position, species, diameter}, translate(fluid), translate(model));
}

}  // namespace lanescape
