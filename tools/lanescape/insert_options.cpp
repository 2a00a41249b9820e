#include "insert_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lanescape::program {

void InsertionSetup::add_to(Options& options) {
  options.add("--energy", energy,
              "of a place: a number, or mean: the fluid's mean excess energy per particle; in a scan also mu, the excess chemical "
              "potential");
  options.add("--tolerance", tolerance, "largest error of the energy");
  options.add("--measure", measure, "of the error: relative, absolute, or running-mean: relative, over thirty insertions");
  options.add("--method", method,
              "usher, usher-indirect, usher-near, screened, or descent, the reference scheme that USHER was published with");
  options.add("--largest-step", largest_step, "[0.1 density^(-3/2)]");
  options.add("--traverse-step", traverse_step, "of descent, after a line minimisation [1.5]");
  options.add("--clear-energy", clear_energy, "of screened: no particle alone repels a start by more");
  options.add("--region", region, "x0,x1,y0,y1,z0,z1: a part of the box to search in, also across its faces [all of it]");
  options.add("--wall", wall, "of the region: reflect, or well: a force back");
  options.add("--species", species, "of the inserted particles [the first]");
  options.add("--most-trials", most_trials, "starts of a search until it is given up");
  options.add("--most-iterations", most_iterations, "of a trial [four times the running mean, at least 100]");
}

InsertionOptions InsertionSetup::resolve(std::uint64_t seed) const {
  InsertionOptions options;
  options.tolerance = tolerance;
  options.measure = parse_error_measure(measure);
  options.method = parse_insertion_method(method);
  options.largest_step = largest_step;
  options.traverse_step = traverse_step;
  options.clear_energy = clear_energy;
  options.most_iterations = most_iterations;
  options.most_trials = most_trials;
  options.wall = parse_region_wall(wall);
  options.seed = seed;
  if (region.empty()) return options;
  const std::vector<std::string> edges = list_of(region, "--region");
  if (edges.size() != 6)
    throw_bad_input(fmt::format("--region: '{}' is not allowed: six numbers x0,x1,y0,y1,z0,z1 are needed", region));
  options.region.emplace();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    options.region->low[axis] = number_of(edges[2 * axis], "--region");
    options.region->high[axis] = number_of(edges[2 * axis + 1], "--region");
  }
  return options;
}

int InsertionSetup::species_index(const Mixture& mixture) const { return species.empty() ? 0 : mixture.find_species(species); }

std::optional<double> InsertionSetup::number(const std::vector<std::string_view>& words) const {
  if (std::find(words.begin(), words.end(), energy) != words.end()) return std::nullopt;
  if (const std::optional<double> value = number_in(energy)) return value;
  throw_bad_input(fmt::format("--energy: '{}' is not allowed: a number or {} is needed", energy, fmt::join(words, " or ")));
}

}  // namespace lanescape::program
