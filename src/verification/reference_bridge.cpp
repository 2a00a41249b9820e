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
    case Truncation::smooth:
      break;
  }
  return reference::Truncation::shifted;
}

reference::PairMixture translate(const PairModel& model) {
  reference::PairMixture mixture{model.species.size(), {}};
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    const reference::LennardJones form{model.epsilon[ab], model.sigma[ab]};
    mixture.potentials.push_back({form, model.cutoff * model.sigma[ab], translate(model.truncation)});
  }
  return mixture;
}

reference::Particles translate(const Configuration& configuration) {
  return {configuration.positions, configuration.species, configuration.box.length, {}};
}

}  // namespace

reference::Evaluation evaluate_reference(const PairModel& model, const Configuration& configuration) {
  const auto images = model.images == ImageRule::all ? reference::ImageRule::all : reference::ImageRule::minimum;
  return reference::pair_sum(translate(configuration), translate(model), images);
}

reference::Probe probe_reference(const PairModel& model, const Configuration& fluid, const std::array<double, 3>& position,
                                 int species) {
  return reference::probe({position, species}, translate(fluid), translate(model));
}

}  // namespace lanescape
