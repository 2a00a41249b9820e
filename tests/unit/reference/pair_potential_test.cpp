#include "reference/pair_potential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "pair_cases.hpp"

namespace {

using namespace lanescape::reference;

PairValue at(const PairForm& form, double r) { return value({form, 10.0, Truncation::plain}, r); }

TEST(ReferencePairPotential, FirstAndSecondDerivativesAreThoseOfTheValue) {
  for_each_potential([](const PairPotential& potential, const std::string& name) {
    for (const double x : {0.6, 0.8, 0.95}) {
      const double r = x * cutoff(potential);
      const PairValue here = value(potential, r);
      const auto u = [&](double h) { return value(potential, r + h).u; };
      const auto slope = [&](double h) { return value(potential, r + h).slope; };
      // r^-64 has the largest error, h^4 times its fifth derivative.
      EXPECT_NEAR(here.slope, derivative(u, 1e-4), 1e-8 * here.slope_magnitude) << name << " at " << r;
      EXPECT_NEAR(here.curvature, derivative(slope, 1e-4), 1e-7 * here.slope_magnitude) << name << " at " << r;
    }
  });
}

TEST(ReferencePairPotential, TheTruncationDecidesWhatIsContinuousAtTheCutoff) {
  for_each_potential([](const PairPotential& potential, const std::string& name) {
    const double r_c = cutoff(potential);
    const PairValue edge = value(potential, r_c);
    const PairValue plain = value({potential.form, r_c, Truncation::plain}, r_c);
    const bool smooth = potential.truncation == Truncation::smooth;
    const bool slope = smooth || potential.truncation == Truncation::shifted_force;
    const bool shifted = slope || potential.truncation == Truncation::shifted;
    EXPECT_NEAR(edge.u, shifted ? 0.0 : plain.u, 1e-14 * edge.u_magnitude) << name;
    EXPECT_NEAR(edge.slope, slope ? 0.0 : plain.slope, 1e-14 * edge.slope_magnitude) << name;
    EXPECT_NEAR(edge.curvature, smooth ? 0.0 : plain.curvature, 1e-13 * edge.slope_magnitude / r_c) << name;
  });
}

TEST(ReferencePairPotential, ATruncationChangesTheValueOnlyByWhatItIsNamedFor) {
  for (const NamedForm& form : all_forms()) {
    const double r_c = cutoff({form.form, form.cutoff, Truncation::plain}), r = 0.7 * r_c;
    const auto of = [&](Truncation truncation) { return value({form.form, form.cutoff, truncation}, r); };
    const PairValue plain = of(Truncation::plain), edge = value({form.form, form.cutoff, Truncation::plain}, r_c);
    const double tolerance = 1e-14 * of(Truncation::smooth).u_magnitude;
    EXPECT_EQ(of(Truncation::tail).u, plain.u) << form.name;
    EXPECT_NEAR(of(Truncation::shifted).u, plain.u - edge.u, tolerance) << form.name;
    EXPECT_EQ(of(Truncation::shifted).slope, plain.slope) << form.name;
    EXPECT_NEAR(of(Truncation::shifted_force).u, plain.u - edge.u - (r - r_c) * edge.slope, tolerance) << form.name;
    // What smooth adds is p = a + b r^2 + c r^4: (p'/r)'/r does not depend on r.
    const auto second = [&](double x) {
      const PairPotential smooth{form.form, form.cutoff, Truncation::smooth}, cut{form.form, form.cutoff, Truncation::plain};
      const double slope = value(smooth, x).slope - value(cut, x).slope;
      const double curvature = value(smooth, x).curvature - value(cut, x).curvature;
      return (curvature - slope / x) / (x * x);
    };
    EXPECT_NEAR(second(r), second(0.9 * r_c), 1e-11 * of(Truncation::smooth).slope_magnitude) << form.name;
  }
}

/// Integral of r^2 f from r_c to infinity by Simpson's rule in t = r_c/r. The integrand at t = 0 is taken at 1e-8: it is finite for
/// f = r^-4 and vanishes for all others.
template <class Function>
double integral_beyond(double r_c, const Function& f) {
  constexpr int intervals = 20000;
  const auto integrand = [&](double t) { return std::pow(r_c / t, 2) * f(r_c / t) * r_c / (t * t); };
  double sum = integrand(1e-8) + integrand(1.0);
  for (int k = 1; k < intervals; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * integrand(static_cast<double>(k) / intervals);
  return sum / (3.0 * intervals);
}

TEST(ReferencePairPotential, TailIntegralsAreThoseOfQuadrature) {
  for (const NamedForm& form : all_forms()) {
    if (!has_tail(form)) continue;
    const PairPotential potential{form.form, form.cutoff, Truncation::tail};
    const TailIntegrals tail = tail_integrals(potential);
    if (form.cutoff == unlimited) {
      EXPECT_EQ(tail.energy, 0.0) << form.name;
      EXPECT_EQ(tail.virial, 0.0) << form.name;
      continue;
    }
    const double energy = integral_beyond(form.cutoff, [&](double r) { return at(form.form, r).u; });
    const double virial = integral_beyond(form.cutoff, [&](double r) { return -r * at(form.form, r).slope; });
    EXPECT_NE(energy, 0.0);
    EXPECT_NEAR(tail.energy, energy, 1e-9 * std::abs(energy)) << form.name;
    EXPECT_NEAR(tail.virial, virial, 1e-9 * std::abs(virial)) << form.name;
  }
}

void expect_equal(const PairPotential& a, const PairPotential& b) {
  ASSERT_EQ(cutoff(a), cutoff(b));
  for (const double x : {0.5, 0.8, 0.99}) {
    const PairValue first = value(a, x * cutoff(a)), second = value(b, x * cutoff(b));
    EXPECT_NEAR(first.u, second.u, 1e-14 * first.u_magnitude) << x;
    EXPECT_NEAR(first.slope, second.slope, 1e-14 * first.slope_magnitude) << x;
    EXPECT_NEAR(first.u_magnitude, second.u_magnitude, 1e-13 * first.u_magnitude) << x;
  }
}

TEST(ReferencePairPotential, MieTwelveSixIsLennardJones) {
  for (const Truncation truncation : kAllTruncations)
    expect_equal({Mie{1.3, 0.9, 12, 6}, 2.3, truncation}, {LennardJones{1.3, 0.9}, 2.3, truncation});
}

TEST(ReferencePairPotential, SmoothInversePowerTwelveIsPolydisperse) {
  expect_equal({Polydisperse{1.3, 0.9}, unlimited, Truncation::plain},
               {InversePower{1.3, 0.9, 12}, 1.25 * 0.9, Truncation::smooth});
}

TEST(ReferencePairPotential, YukawaWithoutScreeningIsCoulombsLaw) {
  expect_equal({Yukawa{1.3, 0.9, 1e-18}, 2.0, Truncation::plain}, {InversePower{1.3 * 0.9, 1.0, 1}, 2.0, Truncation::plain});
}

TEST(ReferencePairPotential, FormsHaveTheirTextbookValues) {
  EXPECT_NEAR(at(LennardJones{2.0, 1.5}, 1.5 * std::pow(2.0, 1.0 / 6.0)).u, -2.0, 1e-14);
  for (const auto& [n, m] : {std::pair{12, 6}, {36, 4}, {8, 2}, {14, 8}}) {
    const PairValue minimum = at(Mie{2.0, 1.5, n, m}, 1.5 * std::pow(double(n) / m, 1.0 / (n - m)));
    EXPECT_NEAR(minimum.u, -2.0, 1e-14 * minimum.u_magnitude) << n << ' ' << m;
    EXPECT_NEAR(minimum.slope, 0.0, 1e-14 * minimum.slope_magnitude) << n << ' ' << m;
  }
  EXPECT_DOUBLE_EQ(at(InversePower{3.0, 2.0, 10}, 1.0).u, 3.0 * 1024.0);
  EXPECT_DOUBLE_EQ(at(Yukawa{3.0, 2.0, 0.5}, 2.0).u, 3.0);
  EXPECT_DOUBLE_EQ(at(Yukawa{3.0, 2.0, 0.5}, 4.0).u, 1.5 * std::exp(-1.0));
  EXPECT_DOUBLE_EQ(at(Harmonic{3.0, 2.0}, 1.0).u, 0.375);
  EXPECT_DOUBLE_EQ(at(Hertzian{5.0, 2.0}, 1.5).u, 0.0625);
  EXPECT_DOUBLE_EQ(at(Hertzian{5.0, 2.0}, 1.5).slope, -0.3125);
  // 1.25^-12 (1.25^12 - 28 + 48 x^2 - 21 x^4), x = 0.8, at r = sigma
  EXPECT_NEAR(at(Polydisperse{1.0, 1.0}, 1.0).u, 1.0 + std::pow(0.8, 12) * (-28.0 + 48.0 * 0.64 - 21.0 * 0.4096), 1e-15);
}

TEST(ReferencePairPotential, DiametersCombineNonAdditively) {
  const PairPotential potential = between({Polydisperse{}}, 0.8, 1.4);
  EXPECT_DOUBLE_EQ(std::get<Polydisperse>(potential.form).sigma, 1.1 * (1.0 - 0.2 * 0.6));
  EXPECT_DOUBLE_EQ(cutoff(potential), 1.25 * 1.1 * 0.88);
  EXPECT_DOUBLE_EQ(std::get<Polydisperse>(between({Polydisperse{1.0, 1.0, 0.0}}, 0.8, 1.4).form).sigma, 1.1);
  EXPECT_EQ(cutoff(between({LennardJones{}, 2.5}, 0.8, 1.4)), 2.5);
}

TEST(ReferencePairPotential, WhatIsNotAllowedIsRefused) {
  const auto refused = [](const PairForm& form, double cutoff, Truncation truncation) {
    EXPECT_THROW(check({form, cutoff, truncation}), std::invalid_argument) << form.index() << ' ' << cutoff;
  };
  refused(LennardJones{1.0, 0.0}, 2.5, Truncation::plain);
  refused(LennardJones{}, unlimited, Truncation::plain);
  refused(LennardJones{}, 0.0, Truncation::plain);
  for (const auto& [n, m] : {std::pair{6, 12}, {6, 6}, {12, 0}, {12, 5}, {11, 6}})
    refused(Mie{1.0, 1.0, n, m}, 2.5, Truncation::plain);
  for (const int n : {0, 3, 66}) refused(InversePower{1.0, 1.0, n}, 2.5, Truncation::plain);
  for (const double kappa : {0.0, -1.0}) refused(Yukawa{1.0, 1.0, kappa}, 2.5, Truncation::plain);
  refused(Polydisperse{1.0, 1.0, -0.1}, unlimited, Truncation::plain);
  refused(InversePower{1.0, 1.0, 2}, 2.5, Truncation::tail);
  refused(Mie{1.0, 1.0, 8, 2}, 2.5, Truncation::tail);
  refused(Polydisperse{}, unlimited, Truncation::tail);
  refused(Harmonic{}, 0.9, Truncation::tail);  // a part of the potential would be left out
  for_each_potential([](const PairPotential& potential, const std::string& name) { EXPECT_NO_THROW(check(potential)) << name; });
}

}  // namespace
