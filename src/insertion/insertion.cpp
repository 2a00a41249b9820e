#include "insertion/insertion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/enum_words.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "core/parallel.hpp"
#include "insertion/search.hpp"

namespace lanescape {
namespace {

constexpr std::size_t remembered_iterations = 100;
constexpr std::size_t remembered_errors = 30;
// Below this |U0| errors are absolute.
constexpr double least_relative_target = 1e-6;
// Number of searches that may run at the same time. It is a constant, because no result may depend on the number of threads.
constexpr std::size_t batch = 32;
// Of a region, from the box: beyond, too few digits are left.
constexpr double farthest_edges = 1000.0;

constexpr EnumWord<InsertionMethod> methods[] = {{InsertionMethod::usher, "usher"},
                                                 {InsertionMethod::usher_indirect, "usher-indirect"},
                                                 {InsertionMethod::usher_near, "usher-near"},
                                                 {InsertionMethod::screened, "screened"},
                                                 {InsertionMethod::descent, "descent"}};
constexpr EnumWord<ErrorMeasure> measures[] = {
    {ErrorMeasure::relative, "relative"}, {ErrorMeasure::absolute, "absolute"}, {ErrorMeasure::running_mean, "running-mean"}};
constexpr EnumWord<RegionWall> walls[] = {{RegionWall::reflect, "reflect"}, {RegionWall::well, "well"}};

void remember(std::vector<double>& values, double value, std::size_t most) {
  values.push_back(value);
  if (values.size() > most) values.erase(values.begin());
}

}  // namespace

const char* to_string(InsertionMethod method) { return word_of(methods, method); }
InsertionMethod parse_insertion_method(std::string_view word) { return parse_word(methods, "method", word); }
const char* to_string(ErrorMeasure measure) { return word_of(measures, measure); }
ErrorMeasure parse_error_measure(std::string_view word) { return parse_word(measures, "measure of the error", word); }
const char* to_string(RegionWall wall) { return word_of(walls, wall); }
RegionWall parse_region_wall(std::string_view word) { return parse_word(walls, "wall of a region", word); }

void Region::check(const Box& box) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.periodic[axis] && !(low[axis] >= 0.0 && high[axis] <= (1.0 + 1e-12) * box.length[axis]))
      throw_bad_input(fmt::format("region from {} to {} along {} is not allowed: the box is open along {}, from 0 to {} is",
                                  low[axis], high[axis], "xyz"[axis], "xyz"[axis], box.length[axis]));
    // Halves of an edge that was read from few digits may add up to a little more.
    if (!(low[axis] < high[axis] && high[axis] - low[axis] <= (1.0 + 1e-12) * box.length[axis] &&
          std::max(-low[axis], high[axis]) <= farthest_edges * box.length[axis]))
      throw_bad_input(
          fmt::format("region from {} to {} along {} is not allowed: from < to <= from + {} in this box, at most {} edges away",
                      low[axis], high[axis], "xyz"[axis], box.length[axis], farthest_edges));
  }
}

bool Region::contains(const std::array<double, 3>& position) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(position[axis] >= low[axis] && position[axis] <= high[axis])) return false;
  return true;
}

std::array<double, 3> Region::image(const Box& box, std::array<double, 3> position) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.periodic[axis]) continue;
    const double centre = 0.5 * (low[axis] + high[axis]);
    position[axis] -= box.length[axis] * std::nearbyint((position[axis] - centre) / box.length[axis]);
  }
  return position;
}

void InsertionOptions::check(const Box& box) const {
  if (!std::isfinite(target)) throw_bad_input(fmt::format("target energy {} is not allowed: it must be finite", target));
  check_positive("tolerance", tolerance);
  if (largest_step) check_positive("largest step", *largest_step);
  if (traverse_step) check_positive("traverse step", *traverse_step);
  check_positive("overlap energy", overlap_energy);
  check_positive("clear energy", clear_energy);
  // Otherwise a step out of an overlap would go the wrong way.
  if (const double least = std::pow(4.0 / overlap_energy, 1.0 / 12.0); !(contact > least) || !std::isfinite(contact))
    throw_bad_input(fmt::format("contact distance {} is not allowed: above {}, where r^-12 repulsion equals the overlap energy",
                                contact, least));
  if (most_iterations) check_at_least_one("most iterations", *most_iterations);
  if (most_trials == 0 || most_trials > 1'000'000'000)
    throw_bad_input(fmt::format("most trials {} is not allowed: from 1 to 1000000000", most_trials));
  if (region) region->check(box);
}

ErrorMeasure InsertionOptions::measure_in_force() const {
  return std::abs(target) < least_relative_target ? ErrorMeasure::absolute : measure;
}

void InsertionHistory::add(const Insertion& insertion) {
  if (!insertion.found) return;
  remember(iterations_, static_cast<double>(insertion.iterations), remembered_iterations);
  remember(errors_, std::abs(insertion.error), remembered_errors);
}

double InsertionHistory::mean_iterations() const {
  if (iterations_.empty()) return 0.0;
  return std::accumulate(iterations_.begin(), iterations_.end(), 0.0) / static_cast<double>(iterations_.size());
}

double InsertionHistory::allowed_error(double tolerance) const {
  const std::size_t before = std::min(errors_.size(), remembered_errors - 1);
  const double sum = std::accumulate(errors_.end() - static_cast<std::ptrdiff_t>(before), errors_.end(), 0.0);
  // 1 % of the tolerance is reserved for insertions after the rest is used up: the mean over thirty of them stays within the
  // tolerance.
  return std::max(0.99 * tolerance * static_cast<double>(before + 1) - sum, 0.01 * tolerance);
}

void InsertionHistory::exchange(Archive& archive) {
  archive.field("searches", searches_);
  archive.field("recent_iterations", iterations_);
  archive.field("recent_errors", errors_);
}

namespace {

std::uint64_t iteration_limit(const InsertionOptions& options, const InsertionHistory& history) {
  return options.most_iterations.value_or(
      std::max<std::uint64_t>(100, static_cast<std::uint64_t>(4.0 * history.mean_iterations())));
}

double allowed_difference(const InsertionOptions& options, const InsertionHistory& history) {
  switch (options.measure_in_force()) {
    case ErrorMeasure::absolute:
      return options.tolerance;
    case ErrorMeasure::relative:
      return options.tolerance * std::abs(options.target);
    case ErrorMeasure::running_mean:
      return history.allowed_error(options.tolerance) * std::abs(options.target);
  }
  return 0.0;
}

void check_fluid(const ProbeField& fluid, const InsertionOptions& options) {
  options.check(fluid.box());
  if (fluid.size() == 0) throw_bad_input("insertion into an empty fluid is not allowed: at least one particle is needed");
}

// Runs the next searches independently of each other.
std::vector<InsertionSearch> search_batch(const ProbeField& fluid, const InsertionOptions& options, std::size_t left,
                                          InsertionHistory& history, int threads) {
  // The running mean needs the results of all earlier insertions.
  const std::size_t count = std::min(left, options.measure_in_force() == ErrorMeasure::running_mean ? 1 : batch);
  std::vector<InsertionSearch> searches;
  for (std::size_t k = 0; k < count; ++k)
    searches.emplace_back(fluid, options, history.next_search(), allowed_difference(options, history),
                          iteration_limit(options, history));
  for_each_block(threads, count, [&](std::size_t k) { searches[k].run(); });
  return searches;
}

}  // namespace

std::vector<Insertion> find_places(const ProbeField& fluid, const InsertionOptions& options, std::size_t count,
                                   InsertionHistory& history, int threads) {
  check_fluid(fluid, options);
  std::vector<Insertion> insertions;
  while (insertions.size() < count)
    for (const InsertionSearch& search : search_batch(fluid, options, count - insertions.size(), history, threads)) {
      insertions.push_back(search.result());
      history.add(insertions.back());
    }
  return insertions;
}

std::vector<Insertion> insert_particles(ProbeField& fluid, const InsertionOptions& options, std::size_t count,
                                        InsertionHistory& history, int threads) {
  check_fluid(fluid, options);
  std::vector<Insertion> insertions;
  std::vector<std::array<double, 3>> inserted;  // positions inserted in the current batch
  while (insertions.size() < count) {
    inserted.clear();
    const double constant = fluid.constant();
    for (InsertionSearch& search : search_batch(fluid, options, count - insertions.size(), history, threads)) {
      search.follow(inserted, fluid.constant() - constant);
      insertions.push_back(search.result());
      history.add(insertions.back());
      if (!insertions.back().found) continue;
      fluid.insert(insertions.back().position, fluid.species());
      inserted.push_back(insertions.back().position);
    }
  }
  return insertions;
}

std::array<double, 3> maxwellian_velocity(const CounterRandom& random, std::uint64_t search, double temperature, double mass,
                                          const std::array<double, 3>& mean) {
  // The positions of the search's trials use draws 0 to 2.
  std::array<double, 3> velocity = random.velocity(std::sqrt(temperature / mass), search, 0, 3);
  for (std::size_t axis = 0; axis < 3; ++axis) velocity[axis] += mean[axis];
  return velocity;
}

}  // namespace lanescape
