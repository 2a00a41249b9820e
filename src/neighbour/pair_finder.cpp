#include "neighbour/pair_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "core/parallel.hpp"

namespace lanescape {
namespace {

// Beyond these limits volumes are not numbers.
constexpr double least_cutoff = 1e-100, most_cutoff = 1e100;
// What the kernels may read or write beyond the end of a list.
constexpr std::size_t beyond = 32;

// Groups end at multiples of it, and so do the parts of threads: the order of unsorted pairs is that of one thread.
constexpr std::size_t rows_together = 64;

// The number of species of a table of cutoffs; throws Error(bad_input) for a table that cannot be used.
std::size_t species_of(const std::vector<double>& cutoffs) {
  const auto species = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(cutoffs.size()))));
  if (cutoffs.empty() || species * species != cutoffs.size())
    throw_bad_input(fmt::format("{} cutoffs were given: one is needed, or species x species of them", cutoffs.size()));
  double greatest = 0.0;
  for (std::size_t a = 0; a < species; ++a)
    for (std::size_t b = 0; b < species; ++b) {
      const double cutoff = cutoffs[a * species + b];
      if (!(cutoff >= least_cutoff && cutoff <= most_cutoff) && (cutoff != 0.0 || species == 1))
        throw_bad_input(fmt::format("cutoff {} is not allowed: it must be from {} to {}{}", cutoff, least_cutoff, most_cutoff,
                                    species > 1 ? ", or 0 for species whose pairs are not listed" : ""));
      if (cutoff != cutoffs[b * species + a])
        throw_bad_input(fmt::format("cutoffs {} of species {} with {} and {} of {} with {} are not allowed: they must be equal",
                                    cutoff, a, b, cutoffs[b * species + a], b, a));
      greatest = std::max(greatest, cutoff);
    }
  if (greatest == 0.0) throw_bad_input("cutoffs that are all 0 are not allowed: one must be above 0");
  return species;
}

}  // namespace

PairFinder::PairFinder(PairFinderOptions options, const kernels::KernelTable& table)
    : options_(std::move(options)), table_(&table), species_(species_of(options_.cutoffs)) {
  cutoff_ = *std::max_element(options_.cutoffs.begin(), options_.cutoffs.end());
  checked_threads(options_.threads);
  if (options_.segments && !options_.sorted)
    throw_bad_input("segments of unsorted pairs are not allowed: only sorted pairs have them");
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(std::abs(options_.origin[axis]) <= greatest_edge))
      throw_bad_input(fmt::format("{} coordinate {} of the box's origin is not allowed: it must be from {} to {}", "xyz"[axis],
                                  options_.origin[axis], -greatest_edge, greatest_edge));
  space_.periodic = options_.periodic;
  space_.origin = options_.origin;
  parts_.resize(static_cast<std::size_t>(options_.threads));
}

void PairFinder::exclude(std::span<const std::pair<std::int64_t, std::int64_t>> pairs) {
  for (const auto& [i, j] : pairs)
    if (i < 0 || j < 0) throw_bad_input(fmt::format("excluded pair {} {} is not allowed: particles are numbered from 0", i, j));
  exclusions_.clear();
  first_excluded_.clear();
  for (const auto& [i, j] : pairs) {
    exclusions_.emplace_back(i, j);
    exclusions_.emplace_back(j, i);
  }
  std::sort(exclusions_.begin(), exclusions_.end());
  exclusions_.erase(std::unique(exclusions_.begin(), exclusions_.end()), exclusions_.end());
  excluded_.clear();
  for (const auto& [i, j] : exclusions_) excluded_.push_back(j);
}

void PairFinder::check_space(const Point& edges) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!options_.periodic[axis]) continue;
    check_edges({&edges[axis], 1});
    if (cutoff_ > max_boxes_in_cutoff * edges[axis])
      throw_bad_input(fmt::format("cutoff {} is not allowed in a periodic box with an edge of {}: at most {} is, {} edges", cutoff_,
                                  edges[axis], max_boxes_in_cutoff * edges[axis], max_boxes_in_cutoff));
  }
}

void PairFinder::check_particles(std::span<const double> positions, std::span<const std::int32_t> species, const char* what) const {
  if (positions.size() % 3 != 0)
    throw_bad_input(fmt::format("{} coordinates were given: 3 for each {} are needed", positions.size(), what));
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const double most = space_.periodic[k % 3] ? max_boxes_away * space_.edges[k % 3] : std::numeric_limits<double>::max();
    if (!(std::abs(positions[k] - space_.origin[k % 3]) <= most))
      throw_bad_input(fmt::format("{} coordinate {} of {} {} (from 0) is not allowed: it must be finite{}", "xyz"[k % 3],
                                  positions[k], what, k / 3,
                                  space_.periodic[k % 3] ? fmt::format(" and at most {} boxes away", max_boxes_away) : ""));
  }
  if (species.size() != positions.size() / 3 && !(species.empty() && species_ == 1))
    throw_bad_input(
        fmt::format("{} species were given for {} {}s: one for each is needed", species.size(), positions.size() / 3, what));
  for (const std::int32_t s : species)
    if (s < 0 || static_cast<std::size_t>(s) >= species_)
      throw_bad_input(fmt::format("species {} of a {} is not allowed: there are cutoffs for 0 to {}", s, what, species_ - 1));
}

Point PairFinder::greatest_of(std::span<const double> positions) const {
  Point greatest{};
  for (std::size_t k = 0; k < positions.size(); k += 3)
    for (std::size_t axis = 0; axis < 3; ++axis) greatest[axis] = std::max(greatest[axis], std::abs(positions[k + axis]));
  return greatest;
}

void PairFinder::set_particles(std::span<const double> positions, const Point& edges, std::span<const std::int32_t> species) {
  const FloatEnvironment environment;
  is_ready_ = false;
  check_space(edges);
  for (std::size_t axis = 0; axis < 3; ++axis) space_.edges[axis] = space_.periodic[axis] ? edges[axis] : 0.0;
  check_particles(positions, species, "particle");
  const std::size_t particles = positions.size() / 3;
  if (!exclusions_.empty() && first_excluded_.size() != particles + 1) {
    if (exclusions_.back().first >= static_cast<std::int64_t>(particles))
      throw_bad_input(fmt::format("excluded pair {} {} is not allowed: there are {} particles, numbered from 0",
                                  exclusions_.back().first, exclusions_.back().second, particles));
    first_excluded_.assign(particles + 1, 0);
    for (const auto& [i, j] : exclusions_) ++first_excluded_[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 0; i < particles; ++i) first_excluded_[i + 1] += first_excluded_[i];
  }
  try {
    positions_.assign(positions.begin(), positions.end());
    particle_species_.assign(species.begin(), species.end());
    points_.sort(space_, positions_, particle_species_, cutoff_, greatest_of(positions_));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::internal, fmt::format("no memory for {} particles and their images within {}", particles, cutoff_));
  }
  is_ready_ = true;
}

PairRule PairFinder::rule(bool between_particles) const {
  PairRule rule;
  rule.edges = space_.edges;
  rule.cutoffs = options_.cutoffs;
  rule.species = species_;
  if (!between_particles) return rule;
  if (!exclusions_.empty()) {
    rule.first_excluded = first_excluded_;
    rule.excluded = excluded_;
  }
  return rule;
}

FoundPairs PairFinder::pairs() { return find(points_.own_rows(), points_.particles(), rule(true), options_.half); }

FoundPairs PairFinder::neighbours(std::span<const double> positions, std::span<const std::int32_t> species) {
  const FloatEnvironment environment;
  if (!is_ready_) throw_bad_input("neighbours of points are not known yet: the particles must be set first");
  check_particles(positions, species, "query point");
  const Point greatest = greatest_of(positions);
  if (!points_.allows(greatest)) points_.sort(space_, positions_, particle_species_, cutoff_, greatest);
  PairRow* rows = query_rows_.room_for(positions.size() / 3);
  points_.make_rows(positions, species, rows);
  return find(rows, positions.size() / 3, rule(false), false);
}

FoundPairs PairFinder::find(const PairRow* rows, std::size_t count, const PairRule& rule, bool half) {
  std::size_t pairs = 0;
  try {
    counts_.room_for(count);
    doubtful_.room_for(count);
    for_each_part(options_.threads, [&](int part) { search(part, rows, count, rule, half); });
    place_rows(rows, count);
    pairs = static_cast<std::size_t>(segments_[count]);
    arrays_ = make_room(pairs);
    for_each_part(options_.threads, [&](int part) { write(part, rows, count, rule); });
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::internal, fmt::format("no memory for all pairs of {} particles within {}: {} were found so far",
                                                 points_.particles(), cutoff_, pairs));
  }
  const auto view = [&](const auto* data, std::size_t each) { return std::span(data, data != nullptr ? each * pairs : 0); };
  FoundPairs found{pairs,
                   view(arrays_.first, 1),
                   view(arrays_.second, 1),
                   view(arrays_.shifts, 3),
                   view(arrays_.separations, 3),
                   view(arrays_.distances, 1),
                   {}};
  if (options_.segments) found.segments = {segments_.data(), count + 1};
  return found;
}

PairArrays PairFinder::make_room(std::size_t pairs) {
  PairArrays arrays;
  if (options_.first) arrays.first = first_.room_for(pairs);
  if (options_.second) arrays.second = second_.room_for(pairs);
  if (options_.shifts) arrays.shifts = shifts_.room_for(3 * pairs);
  if (options_.separations) arrays.separations = separations_.room_for(3 * pairs);
  if (options_.distances) arrays.distances = distances_.room_for(pairs);
  return arrays;
}

std::size_t PairFinder::first_row(std::size_t count, int part) const {
  return std::min(count, rows_together * part_begin((count + rows_together - 1) / rows_together, part, options_.threads));
}

std::size_t PairFinder::group_end(const PairRow* rows, std::size_t begin, std::size_t end) const {
  const kernels::PointGrid& grid = points_.grid();
  const double* from = rows[begin].place.position;
  const auto is_near = [&](const PairRow& row) {
    const double* at = row.place.position;
    return std::abs(at[0] - from[0]) <= grid.edge[0] && std::abs(at[1] - from[1]) <= grid.edge[1] &&
           std::abs(at[2] - from[2]) <= 0.5 * points_.reach();
  };
  const std::size_t last = std::min({end, begin + kernels::most_group_rows, (begin / rows_together + 1) * rows_together});
  std::size_t next = begin + 1;
  while (next < last && is_near(rows[next]) && points_.is_on_grid(rows[next])) ++next;
  return next;
}

void PairFinder::search_group(Part& part, const PairRow* rows, std::size_t begin, std::size_t end, std::size_t used) {
  kernels::GroupRow places[kernels::most_group_rows];
  for (std::size_t r = begin; r < end; ++r) places[r - begin] = rows[r].place;
  const std::uint32_t* numbers = options_.sorted ? points_.ranks() : points_.numbers();
  for (;;) {
    const kernels::GroupQuery query{places,
                                    end - begin,
                                    points_.reach(),
                                    points_.certain(cutoff_),
                                    numbers,
                                    part.columns[0].data(),
                                    part.columns[1].data(),
                                    part.columns[2].data(),
                                    part.found.data(),
                                    part.group_room};
    const kernels::GroupOutput out{part.numbers.data() + used, part.room - used, counts_.data() + begin, doubtful_.data() + begin};
    const std::size_t found = table_->points_within_group(points_.grid(), query, out);
    if (found <= out.capacity) return;
    if (part.room - used < (end - begin + 1) * (part.group_room + beyond)) {
      part.room = 2 * part.room + (end - begin + 1) * (part.group_room + beyond);
      part.numbers.grow(part.room + beyond, used);
    } else {
      part.group_room *= 2;
      for (auto& column : part.columns) column.room_for(part.group_room + beyond);
      part.found.room_for(part.group_room + beyond);
    }
  }
}

// Of (i, j, S) and (j, i, -S) the one whose point is later in the order of particles and images.
void PairFinder::keep_later(const PairRow& row, std::uint32_t* numbers, std::uint32_t& count) const {
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t number = numbers[k], rank = options_.sorted ? number : points_.ranks()[number];
    numbers[kept] = number;
    kept += rank > row.particle.rank;
  }
  count = kept;
}

void PairFinder::keep(const PairRule& rule, const PairRow& row, std::uint32_t* numbers, std::uint32_t& count) const {
  if (options_.sorted)
    for (std::uint32_t k = 0; k < count; ++k) numbers[k] = points_.by_rank()[numbers[k]];
  count = static_cast<std::uint32_t>(keep_neighbours(rule, row, points_.points(), numbers, count));
  if (options_.sorted)
    for (std::uint32_t k = 0; k < count; ++k) numbers[k] = points_.ranks()[numbers[k]];
}

void PairFinder::search(int index, const PairRow* rows, std::size_t count, const PairRule& rule, bool half) {
  const FloatEnvironment environment;
  Part& part = parts_[static_cast<std::size_t>(index)];
  const std::size_t begin = first_row(count, index), end = first_row(count, index + 1);
  if (part.group_room == 0) {
    part.group_room = 2048;
    for (auto& column : part.columns) column.room_for(part.group_room + beyond);
    part.found.room_for(part.group_room + beyond);
  }
  const auto expected = static_cast<std::size_t>(1.1 * static_cast<double>(end - begin) * points_.mean_neighbours());
  part.room = std::max(part.room, std::min(expected, std::size_t{1} << 32) + 16 * (part.group_room + beyond));
  part.numbers.room_for(part.room + beyond);
  part.longest = 0;
  std::size_t used = 0;
  for (std::size_t first = begin, last = begin; first < end; first = last) {
    last = group_end(rows, first, end);
    if (!points_.is_on_grid(rows[first])) {
      counts_[first] = 0;
      last = first + 1;
      continue;
    }
    search_group(part, rows, first, last, used);
    const std::uint32_t* from = part.numbers.data() + used;
    for (std::size_t r = first; r < last; ++r) {
      const std::uint32_t found = counts_[r];
      std::uint32_t* numbers = part.numbers.data() + used;
      if (numbers != from) std::copy(from, from + found, numbers);
      if (half) keep_later(rows[r], numbers, counts_[r]);
      if (doubtful_[r] || !rule.is_plain()) keep(rule, rows[r], numbers, counts_[r]);
      from += found;
      used += counts_[r];
      part.longest = std::max<std::size_t>(part.longest, counts_[r]);
    }
  }
}

// Where the pairs of each row begin: sorted rows in the order of particles, others in that of rows.
void PairFinder::place_rows(const PairRow* rows, std::size_t count) {
  std::int64_t* segments = segments_.room_for(count + 1);
  const auto place = [&](std::size_t r) { return options_.sorted ? static_cast<std::size_t>(rows[r].particle.particle) : r; };
  for (std::size_t r = 0; r < count; ++r) segments[place(r)] = counts_[r];
  std::int64_t begin = 0;
  for (std::size_t k = 0; k <= count; ++k) {
    const std::int64_t length = k < count ? segments[k] : 0;
    segments[k] = begin;
    begin += length;
  }
}

void PairFinder::write(int index, const PairRow* rows, std::size_t count, const PairRule& rule) {
  const FloatEnvironment environment;
  Part& part = parts_[static_cast<std::size_t>(index)];
  const std::size_t begin = first_row(count, index), end = first_row(count, index + 1);
  std::uint32_t* spare = part.spare.room_for(part.longest + beyond);
  double* separations = part.separations.room_for(3 * part.longest);
  std::uint32_t* numbers = part.numbers.data();
  for (std::size_t r = begin; r < end; ++r) {
    const std::size_t found = counts_[r];
    const std::uint32_t* list = numbers;
    std::size_t place = r;
    if (options_.sorted) {
      place = static_cast<std::size_t>(rows[r].particle.particle);
      sort_numbers(numbers, found, spare, *table_);
      for (std::size_t k = 0; k < found; ++k) numbers[k] = points_.by_rank()[numbers[k]];
    }
    write_pairs(rule, rows[r], points_.points(), {list, found}, arrays_, static_cast<std::size_t>(segments_[place]), separations);
    numbers += found;
  }
}

}  // namespace lanescape
