#include "run/given_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "run/path_search.hpp"
#include "stepper/escape.hpp"

namespace lanescape {
namespace {

// Files of others carry six decimals or more.
constexpr double end_tolerance = 1e-4;     // |R - R_end| in 3N space, in units of length
constexpr double radius_tolerance = 1e-6;  // relative

double distance(const Configuration& a, const Configuration& b) {
  double squared = 0.0;
  for (std::size_t k = 0; k < a.positions.size(); ++k) squared += std::pow(a.positions[k] - b.positions[k], 2);
  return std::sqrt(squared);
}

bool nearly_equal(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) <= radius_tolerance * std::abs(y); });
}

void check_system(const Configuration& node, const Configuration& end, const std::string& where) {
  if (!(node.box == end.box)) throw_bad_input(where + ": its box is not that of the pair");
  if (node.species != end.species)
    throw_bad_input(where + ": its composition or the order of its particles is not that of the pair");
  if (!nearly_equal(node.radii, end.radii)) throw_bad_input(where + ": its radii are not those of the pair");
  if (!nearly_equal(node.diameters, end.diameters)) throw_bad_input(where + ": its diameters are not those of the pair");
}

void check_allowed(const std::vector<Configuration>& nodes, const SearchSetup& setup, const std::string& where) {
  const double energy = setup.prepared.landscape_energy;
  const auto landscape = is_hard(setup.model) ? nullptr : path_landscape(setup);
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const std::string frame = fmt::format("{}, frame {}", where, k + 1);
    if (!landscape) {
      try {
        check_no_overlap(nodes[k], kernel_table(setup.isa));
      } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", frame, error.what()));
      }
      continue;
    }
    const double here = landscape->energy(setup.prepared.metric.coordinates(setup.prepared.layout, nodes[k].positions));
    if (!(here <= energy + EscapeStepper::Options{}.tolerance))
      throw_bad_input(fmt::format("{}: its energy {} is above the landscape energy {} of the pair", frame, here, energy));
  }
}

}  // namespace

void match_ends(std::vector<Configuration>& nodes, const AnyModel& model, const ConfigurationPair& pair, const std::string& where) {
  if (nodes.size() < 3) throw_bad_input(fmt::format("{}: holds {} frames: a path has at least 3", where, nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k) check_system(nodes[k], pair.start, fmt::format("{}, frame {}", where, k + 1));
  if (distance(nodes.front(), pair.finish) < distance(nodes.front(), pair.start)) std::reverse(nodes.begin(), nodes.end());
  const double unit = length_unit(model);
  if (distance(nodes.front(), pair.start) > end_tolerance * unit || distance(nodes.back(), pair.finish) > end_tolerance * unit)
    throw_bad_input(where + ": its first and last frame are not the end points of the pair");
}

std::vector<Configuration> fit_path(std::vector<Configuration> nodes, const AnyModel& model, const ConfigurationPair& pair,
                                    const std::string& where, const PathRunOptions& options, Isa isa) {
  const PreparedPair prepared = prepare_pair(model, pair, where, options, isa);
  return fit_path(std::move(nodes), {model, pair, prepared, options, isa, options.threads, false, {}}, where);
}

std::vector<Configuration> fit_path(std::vector<Configuration> nodes, const SearchSetup& search, const std::string& where) {
  const ConfigurationPair& pair = search.pair;
  match_ends(nodes, search.model, pair, where);
  nodes.front() = pair.start;
  nodes.back() = pair.finish;
  for (Configuration& node : nodes) {
    node.radii = pair.start.radii;
    node.diameters = pair.start.diameters;
  }
  check_allowed(nodes, search, where);
  return nodes;
}

}  // namespace lanescape
