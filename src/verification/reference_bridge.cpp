#include "verification/reference_bridge.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/error.hpp"

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

// By the word of the form in model files.
reference::PairForm translate(std::string_view form, const PairNumbers& p) {
  const auto whole = [&](std::size_t k) { return static_cast<int>(p.form[k]); };
  if (form == "lennard-jones") return reference::LennardJones{p.epsilon, p.sigma};
  if (form == "mie") return reference::Mie{p.epsilon, p.sigma, whole(0), whole(1)};
  if (form == "inverse-power") return reference::InversePower{p.epsilon, p.sigma, whole(0)};
  if (form == "yukawa") return reference::Yukawa{p.epsilon, p.sigma, p.form[0]};
  if (form == "harmonic") return reference::Harmonic{p.epsilon, p.sigma};
  if (form == "hertzian") return reference::Hertzian{p.epsilon, p.sigma};
  if (form == "polydisperse") return reference::Polydisperse{p.epsilon, p.sigma, p.form[0]};
  throw_bad_input(fmt::format("the reference has no pair potential '{}'", form));
}

reference::PairMixture translate(const PairModel& model) {
  reference::PairMixture mixture{model.species.size(), {}};
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    const double cutoff = model.form->has_diameters ? reference::unlimited : model.cutoff_of(ab);
    mixture.potentials.push_back({translate(model.form->word, model.numbers(ab)), cutoff, translate(model.truncation)});
  }
  return mixture;
}

reference::Particles translate(const Configuration& configuration) {
  return {configuration.positions, configuration.species, configuration.box.length, configuration.diameters};
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
