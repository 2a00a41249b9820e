#include "verification/kernel_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "verification/event_driven_checks.hpp"
#include "verification/hard_sphere_cases.hpp"
#include "verification/hard_sphere_checks.hpp"
#include "verification/neighbour_checks.hpp"
#include "verification/pair_checks.hpp"
#include "verification/state_mixture_checks.hpp"

namespace lanescape {

double rounding_allowance(const Configuration& configuration) {
  double largest = tolerance::position_extent;
  for (const double x : configuration.positions) largest = std::max(largest, std::abs(x));
  return largest / tolerance::position_extent;
}

std::string describe(const Deviation& d) {
  return fmt::format("{} on {}: worst deviation {:.3g}, allowed {:.3g}, of {} cases the worst is '{}'", d.kernel, d.isa, d.worst,
                     d.tolerance, d.cases, d.worst_case);
}

std::vector<Deviation> verify_kernels(Isa isa, const std::vector<PairCase>& cases) {
  const kernels::KernelTable& table = kernel_table(isa);
  std::vector<Deviation> deviations = verify_pairs(table, cases, "lennard_jones");
  const auto append = [&](std::vector<Deviation> more) { std::move(more.begin(), more.end(), std::back_inserter(deviations)); };
  for (const PairForm& form : pair_forms().subspan(1)) append(verify_pairs(table, form_cases(form), name_in_results(form)));
  append(verify_neighbour_pairs(table, cases));
  append(verify_vector_algebra(table));
  append(verify_panel_algebra(table));
  append(verify_state_mixtures(table, state_mixture_cases()));
  append(verify_hard_spheres(table, hard_sphere_cases()));
  append(verify_event_driven(table));
  return deviations;
}

}  // namespace lanescape
