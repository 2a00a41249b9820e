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

}  // namespace

reference::Evaluation evaluate_reference(const LennardJonesModel& model, const Configuration& configuration) {
  reference::Mixture mixture{model.species.size(), model.epsilon, model.sigma, {}};
  for (const double sigma : model.sigma) mixture.cutoff.push_back(model.cutoff * sigma);
  const auto images = model.images == ImageRule::all ? reference::ImageRule::all : reference::ImageRule::minimum;
  return reference::lennard_jones(configuration.positions, configuration.species, configuration.box.length, mixture, images,
                                  translate(model.truncation));
}

}  // namespace lanescape
