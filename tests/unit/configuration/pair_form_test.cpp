// The host side of each pair potential: u(r) compared with its own derivatives, truncations at the cutoff, and refused input.

#include "configuration/pair_form.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "configuration/pair_model.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

// One species with epsilon and sigma different from 1, so that a missing unit shows. Parameters without a default are set to 3.
PairModel model_of(const PairForm& form, double sigma = 0.9) {
  PairModel model = lennard_jones();
  model.form = &form;
  for (const FormNumber& number : form.numbers) model.form_numbers.push_back(number.preset.value_or(3.0));
  model.epsilon = {1.3};
  model.sigma = {form.has_diameters ? 1.0 : sigma};
  if (std::isfinite(form.range)) model.cutoff = form.range;
  return model;
}

std::string refusal(const PairModel& model) {
  return testing::refusal([&] { model.check(); });
}

TEST(PairForm, DerivativesAreThoseOfTheEnergy) {
  for (const PairForm& form : pair_forms()) {
    const PairModel model = model_of(form);
    for (const double x : {0.75, 0.9, 0.97}) {
      const double r = x * model.sigma[0], h = 1e-5 * r;
      const auto at = [&](double distance) { return form.derivatives(model.numbers(0), distance); };
      const PairDerivatives here = at(r), above = at(r + h), below = at(r - h);
      const double slope = r * (above.u - below.u) / (2.0 * h);
      const double curvature = r * (above.first - below.first) / (2.0 * h) - here.first;  // (r u')' = u' + r u''
      EXPECT_NEAR(here.first, slope, 1e-7 * (1.0 + std::abs(slope))) << form.word << " at " << r;
      EXPECT_NEAR(here.second, curvature, 1e-7 * (1.0 + std::abs(curvature))) << form.word << " at " << r;
    }
  }
}

TEST(PairForm, TruncationsVanishAtTheCutoffToTheirOrder) {
  for (const PairForm& form : pair_forms()) {
    PairModel model = model_of(form);
    const double rc = model.cutoff_of(0);
    const auto at_cutoff = [&](Truncation truncation) {
      model.truncation = truncation;
      return model.derivatives(model.numbers(0), rc);
    };
    EXPECT_NEAR(at_cutoff(Truncation::shifted).u, 0.0, 1e-14) << form.word;
    EXPECT_NEAR(at_cutoff(Truncation::shifted_force).u, 0.0, 1e-14) << form.word;
    EXPECT_NEAR(at_cutoff(Truncation::shifted_force).first, 0.0, 1e-14) << form.word;
    // For Hertzian spheres the second derivative is a square root that vanishes at the cutoff itself; their correction is zero as
    // well.
    const PairDerivatives smooth = at_cutoff(Truncation::smooth);
    for (const double value : {smooth.u, smooth.first, smooth.second}) EXPECT_NEAR(value, 0.0, 1e-12) << form.word;
  }
}

TEST(PairForm, RepulsionHasTheGivenEnergyAtItsDistance) {
  // In these forms the repulsion is the whole u(r); in the others it leaves out an attraction.
  for (const char* word : {"inverse-power", "yukawa", "harmonic", "hertzian"}) {
    const PairModel model = model_of(pair_form(word));
    for (const double energy : {0.01, 0.3}) {
      const double r = model.form->repulsive_distance(model.numbers(0), energy);
      EXPECT_NEAR(model.form->derivatives(model.numbers(0), r).u, energy, 1e-11 * energy) << word;
    }
  }
}

TEST(PairForm, RepulsionOfASteepYukawaIsFound) {
  PairModel model = model_of(pair_form("yukawa"));
  for (const double kappa : {1e-6, 1.0, 1000.0, 1e5}) {
    model.form_numbers = {kappa};
    const double r = model.form->repulsive_distance(model.numbers(0), 2.0);
    EXPECT_NEAR(model.form->derivatives(model.numbers(0), r).u, 2.0, 1e-8) << kappa;
  }
}

TEST(PairForm, RepulsiveDistanceIsZeroForAnEnergyThatASoftSphereNeverHas) {
  for (const char* word : {"harmonic", "hertzian"}) {
    const PairModel model = model_of(pair_form(word));
    EXPECT_EQ(model.form->repulsive_distance(model.numbers(0), 1e6), 0.0) << word;
  }
}

TEST(PairForm, UnknownWordIsRefusedWithTheWordsThereAre) {
  const std::string message = testing::refusal([] { pair_form("morse"); });
  for (const PairForm& form : pair_forms()) EXPECT_NE(message.find(form.word), std::string::npos) << message;
}

TEST(PairModel, EveryFormIsAllowedWithItsPresets) {
  for (const PairForm& form : pair_forms()) EXPECT_NO_THROW(model_of(form).check()) << form.word;
}

TEST(PairModel, RefusesNumbersOutOfRange) {
  PairModel model = model_of(pair_form("mie"));
  model.form_numbers = {11.0, 6.0};
  EXPECT_NE(refusal(model).find("repulsive_exponent 11 is not allowed: an even number from 4 to 64"), std::string::npos);
  model.form_numbers = {6.0, 12.0};
  EXPECT_NE(refusal(model).find("more than attractive_exponent"), std::string::npos);
  model.form_numbers = {12.0};
  EXPECT_NE(refusal(model).find("2 numbers of the potential mie are needed"), std::string::npos);
}

TEST(PairModel, RefusesACutoffOtherThanTheRangeOfTheForm) {
  for (const char* word : {"harmonic", "hertzian", "polydisperse"}) {
    PairModel model = model_of(pair_form(word));
    model.cutoff = 2.5;
    EXPECT_NE(refusal(model).find("cutoff 2.5 is not allowed with the potential"), std::string::npos) << word;
  }
}

TEST(PairModel, RefusesATailWithoutAnIntegral) {
  PairModel model = model_of(pair_form("polydisperse"));
  model.truncation = Truncation::tail;
  EXPECT_NE(refusal(model).find("truncation tail is not allowed"), std::string::npos);
  model = model_of(pair_form("inverse-power"));
  model.truncation = Truncation::tail;
  model.form_numbers = {2.0};
  EXPECT_NE(refusal(model).find("truncation tail is not allowed"), std::string::npos);
  model.form_numbers = {4.0};
  EXPECT_NO_THROW(model.check());
}

TEST(PairModel, RefusesASigmaBesideDiameters) {
  PairModel model = model_of(pair_form("polydisperse"));
  model.sigma = {0.9};
  EXPECT_NE(refusal(model).find("particles have diameters"), std::string::npos);
}

TEST(PairModel, LennardJonesIsSummedBy1264WithACorrectionThatIsMoreThanAShift) {
  PairModel model = lennard_jones();
  EXPECT_EQ(std::string(model.kernel_form().word), "lennard-jones");
  model.truncation = Truncation::smooth;
  const PairForm& equivalent = model.kernel_form();
  EXPECT_NE(equivalent.word, model.form->word);
  const PairNumbers numbers{1.0, 1.0, model.kernel_numbers()};
  for (const double r : {0.95, 1.3, 2.0}) {
    const PairDerivatives own = model.form->derivatives(model.numbers(0), r), other = equivalent.derivatives(numbers, r);
    EXPECT_NEAR(own.u, other.u, 1e-13);
    EXPECT_NEAR(own.first, other.first, 1e-12);
  }
}

}  // namespace
}  // namespace lanescape
