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
  }
  return reference::Truncation::shifted;
}

reference::Mixture translate(const PairModel& model) {
  reference::Mixture mixture{model.species.size(), model.epsilon, model.sigma, {}};
  for (const double sigma : model.sigma) mixture.cutoff.push_back(model.cutoff * sigma);
  return mixture;
}

}  // namespace

reference::Evaluation evaluate_reference(const PairModel& model, const Configuration& configuration) {
  const auto images = model.images == ImageRule::all ? reference::ImageRule::all : reference::ImageRule::minimum;
  return reference::lennard_jones(configuration.positions, configuration.species, configuration.box.length, translate(model),
                                  images, translate(model.truncation));
}

reference::Probe probe_reference(const PairModel& model, const Configuration& fluid, const std::array<double, 3>& position,
                                 int species) {
  return reference::probe(position, species, fluid.positions, fluid.species, fluid.box.length, translate(model),
                          translate(model.truncation));
}

}  // namespace lanescape
