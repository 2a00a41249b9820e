#include "verification/host_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/enum_words.hpp"
#include "verification/check.hpp"
#include "verification/pair_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

constexpr EnumWord<HostPrecision> precisions[] = {{HostPrecision::double_precision, "double"},
                                                  {HostPrecision::single_precision, "single"}};

// One quantity of one case.
struct Comparison {
  double worst = -1.0;
  std::size_t component = 0;
  double expected = 0.0, got = 0.0;

  void add(double value, double wanted, double scale, double allowance, std::size_t k) {
    const double deviation = relative(value, wanted, scale) / allowance;
    if (deviation > worst) *this = {deviation, k, wanted, value};
  }
};

Comparison compare_scalar(double value, double expected, double scale, double allowance) {
  Comparison comparison;
  comparison.add(value, expected, scale, allowance, 0);
  return comparison;
}

// The sum of the absolute forces between a particle and its own images, which cancel but for rounding where a kernel adds them up.
// At most 2 w / L, with w the sum of r |u'| over them, each with weight 1/2, and L the shortest edge.
double own_image_forces(const PairCase& one, std::size_t i) {
  if (one.model.images == ImageRule::minimum) return 0.0;
  const Configuration& all = one.configuration;
  Configuration alone{all.box, {all.species[i]}, {0.0, 0.0, 0.0}};
  if (!all.diameters.empty()) alone.diameters = {all.diameters[i]};
  PairModel model = one.model;
  if (model.truncation == Truncation::tail) model.truncation = Truncation::plain;
  return 2.0 * evaluate_reference(model, alone).virial_magnitude / all.box.shortest();
}

// Per particle, relative to its largest component, as for our own kernels.
Comparison compare_forces(const PairCase& one, const std::vector<double>& forces, const reference::Evaluation& expected,
                          double allowance) {
  Comparison comparison{.worst = 0.0};
  for (std::size_t i = 0; i < one.configuration.size(); ++i) {
    const double* scales = &expected.gradient_magnitude[3 * i];
    const double scale = *std::max_element(scales, scales + 3) + own_image_forces(one, i);
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) comparison.add(forces[k], 0.0 - expected.gradient[k], scale, allowance, k);
  }
  return comparison;
}

std::string name_of(const HostDeviation& quantity, std::size_t component) {
  if (!quantity.is_vector()) return quantity.quantity;
  return fmt::format("force on particle {} (from 0), {}", component / 3, "xyz"[component % 3]);
}

std::string describe(const HostDeviation& quantity, const Comparison& found) {
  return fmt::format("{}: expected {}, got {}: deviation {:.3g}, allowed {:.3g}", name_of(quantity, found.component),
                     found.expected, found.got, found.worst, quantity.tolerance);
}

// Takes a comparison into the worst of its quantity. The message of a wrong one, else nothing.
std::string take(HostDeviation& quantity, const std::string& name, const Comparison& found) {
  ++quantity.cases;
  if (found.worst > quantity.worst) {
    quantity.worst = found.worst;
    quantity.worst_case = name;
    quantity.component = found.component;
    quantity.expected = found.expected;
    quantity.got = found.got;
  }
  return found.worst <= quantity.tolerance ? std::string() : describe(quantity, found);
}

// Empty if all that is given is right.
std::string fault_of(HostReport& report, const PairCase& one, const HostResult& result) {
  if (!result.energy && !result.forces && !result.virial) return "neither energy nor forces nor virial are given";
  const reference::Evaluation expected = evaluate_reference(one.model, one.configuration);
  const double allowance = rounding_allowance(one.configuration);
  std::string fault;
  const auto add = [&](std::size_t quantity, const Comparison& found) {
    const std::string more = take(report.quantities[quantity], one.name, found);
    if (!more.empty()) fault += (fault.empty() ? "" : "; ") + more;
  };
  if (result.energy) add(0, compare_scalar(*result.energy, expected.energy, expected.magnitude, allowance));
  if (result.forces) add(1, compare_forces(one, *result.forces, expected, allowance));
  if (result.virial) add(2, compare_scalar(*result.virial, expected.virial, expected.virial_magnitude, allowance));
  return fault;
}

bool is_left_out(const PairCase& one, HostPrecision precision) {
  return precision == HostPrecision::single_precision &&
         has_pair_at_cutoff(one, tolerance::single_cutoff * rounding_allowance(one.configuration));
}

HostVerdict judge(HostReport& report, const PairCase& one, const HostResult& result, HostPrecision precision) {
  using Kind = HostResult::Kind;
  if (result.kind == Kind::broken) return {one.name, HostOutcome::failed, result.fault};
  if (result.kind == Kind::declined) return {one.name, HostOutcome::declined, ""};
  if (result.kind == Kind::missing) return {one.name, HostOutcome::missing, ""};
  if (is_left_out(one, precision)) return {one.name, HostOutcome::left_out, ""};
  std::string fault = fault_of(report, one, result);
  const HostOutcome outcome = fault.empty() ? HostOutcome::passed : HostOutcome::failed;
  return {one.name, outcome, std::move(fault)};
}

}  // namespace

HostPrecision parse_host_precision(std::string_view word) { return parse_word(precisions, "precision of a host's kernel", word); }
const char* to_string(HostPrecision precision) { return word_of(precisions, precision); }

std::size_t HostReport::count(HostOutcome outcome) const {
  return static_cast<std::size_t>(
      std::count_if(verdicts.begin(), verdicts.end(), [=](const HostVerdict& v) { return v.outcome == outcome; }));
}

bool HostReport::passed() const { return count(HostOutcome::failed) == 0 && count(HostOutcome::passed) > 0; }

std::string HostReport::summary() const {
  const std::size_t failed = count(HostOutcome::failed), compared = failed + count(HostOutcome::passed);
  if (compared == 0)
    return fmt::format("no case of {} is left to compare: {} declined, {} missing, {} left out in single precision",
                       verdicts.size(), count(HostOutcome::declined), count(HostOutcome::missing), count(HostOutcome::left_out));
  if (failed == 0) return fmt::format("{} of {} cases compared, none is wrong", compared, verdicts.size());
  // The worst in units of its tolerance. A case that gave no result at all comes after every wrong number.
  const auto excess = [](const HostDeviation& d) { return d.worst / d.tolerance; };
  const auto worst = std::max_element(quantities.begin(), quantities.end(),
                                      [&](const HostDeviation& a, const HostDeviation& b) { return excess(a) < excess(b); });
  const auto shown = std::find_if(verdicts.begin(), verdicts.end(), [&](const HostVerdict& v) {
    return v.outcome == HostOutcome::failed && (excess(*worst) <= 1.0 || v.name == worst->worst_case);
  });
  return fmt::format("{} of {} cases are wrong, the worst is '{}': {}", failed, compared, shown->name, shown->message);
}

HostReport compare_with_reference(const std::vector<PairCase>& cases, const std::vector<HostResult>& results,
                                  HostPrecision precision) {
  const bool single = precision == HostPrecision::single_precision;
  const double sums = single ? tolerance::single_sums : tolerance::host_sums;
  HostReport report;
  report.quantities = {
      {"energy", sums}, {"forces", single ? tolerance::single_gradient : tolerance::pair_gradient}, {"virial", sums}};
  for (std::size_t k = 0; k < cases.size(); ++k) report.verdicts.push_back(judge(report, cases[k], results[k], precision));
  return report;
}

}  // namespace lanescape
