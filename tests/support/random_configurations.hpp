#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "interaction/pair/pair_search.hpp"

namespace lanescape::testing {

// A model and a configuration as nobody would write them down: any unit of length, shape of box, clusters, faces, coordinates boxes
// away. Everything follows from the number.
struct RandomConfiguration {
  PairModel model;
  Configuration configuration;
  PairSearchOptions options;
  double unit;          // [sigma]
  double box_in_units;  // the longest edge
};

class RandomConfigurations {
 public:
  explicit RandomConfigurations(std::uint64_t number) : generator_(number) {}

  RandomConfiguration make() {
    RandomConfiguration made{{}, {}, {}, std::pow(10.0, between(-12.0, 12.0)), 0.0};
    made.model = model(made.unit);
    made.configuration = configuration(made.model, made.unit);
    for (const double edge : made.configuration.box.length) made.box_in_units = std::max(made.box_in_units, edge / made.unit);
    const double kind = between(0.0, 1.0);
    made.options.precision = kind < 0.3 ? Precision::mixed : Precision::double_precision;
    if (kind >= 0.3 && kind < 0.6) made.options.search = PairSearch::list;
    if (kind >= 0.6 && kind < 0.8) made.options.search = PairSearch::all_pairs;
    open_axes(made);
    return made;
  }

 private:
  // Particles that are boxes away are then truly far. What open axes cannot have is refused; here and there that is wanted too.
  void open_axes(RandomConfiguration& made) {
    const bool can = made.options.search != PairSearch::all_pairs && made.model.truncation != Truncation::tail &&
                     made.model.images == ImageRule::all;
    if (!chance(can ? 0.4 : 0.02)) return;
    for (bool& periodic : made.configuration.box.periodic) periodic = chance(0.5);
  }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  std::size_t below(std::size_t n) { return std::min(n - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(n)))); }
  bool chance(double p) { return between(0.0, 1.0) < p; }

  PairModel model(double unit) {
    PairModel model;
    model.name = "random";
    model.form = &pair_forms()[below(pair_forms().size())];
    const std::size_t count = 1 + below(5);
    for (std::size_t s = 0; s < count; ++s)
      model.species.push_back({std::string(1, static_cast<char>('A' + s)), 1.0, 1.0 / static_cast<double>(count)});
    model.epsilon.assign(count * count, 0.0);
    model.sigma.assign(count * count, 1.0);
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a; b < count; ++b) {
        model.epsilon[model.pair(a, b)] = model.epsilon[model.pair(b, a)] = chance(0.1) ? 0.0 : between(0.3, 2.0);
        if (!model.form->has_diameters) model.sigma[model.pair(a, b)] = model.sigma[model.pair(b, a)] = unit * between(0.8, 1.0);
      }
    for (const FormNumber& number : model.form->numbers)
      model.form_numbers.push_back(number.preset.value_or(1.7) / (number.per_length ? unit : 1.0));
    model.cutoff = std::isfinite(model.form->range) ? model.form->range : between(1.1, 3.0);
    constexpr Truncation truncations[] = {Truncation::shifted, Truncation::plain, Truncation::tail, Truncation::shifted_force,
                                          Truncation::smooth};
    model.truncation = truncations[below(5)];
    if (model.form->has_diameters) model.truncation = chance(0.5) ? Truncation::shifted : Truncation::plain;
    model.images = chance(0.3) ? ImageRule::minimum : ImageRule::all;
    return model;
  }

  // From half a cutoff to 10^6, up to 1:100.
  Box box(double cutoff, double unit) {
    const double base = chance(0.4) ? cutoff * between(0.5, 3.0) : unit * std::pow(10.0, between(0.3, 6.0));
    if (chance(0.4)) return {{base, base, base}};
    Box box;
    for (double& edge : box.length) edge = base * std::pow(10.0, between(0.0, 2.0));
    box.length[below(3)] = base;
    return box;
  }

  // A coordinate near a centre of a cluster, or anywhere; on a face at times, and boxes away.
  double coordinate(double centre, double spread, double edge) {
    double x = centre + between(-spread, spread);
    if (chance(0.02)) x = 0.0;
    if (chance(0.02)) x = edge;
    if (chance(0.02)) x = std::nextafter(edge, 0.0);
    if (chance(0.05)) x += edge * (static_cast<double>(below(9)) - 4.0);
    return x;
  }

  Configuration configuration(const PairModel& model, double unit) {
    Configuration c;
    c.box = box(model.cutoff * unit, unit);
    const std::size_t wanted = chance(0.3) ? 200 + below(60) : 1 + below(60);
    const std::size_t clusters = 1 + below(4);
    std::vector<Point> centres(clusters);
    for (Point& centre : centres)
      for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = c.box.length[axis] * between(0.0, 1.0);
    const double spread = unit * std::cbrt(static_cast<double>(wanted)) * between(0.5, 1.5);
    const bool clustered = chance(0.7);
    for (std::size_t attempt = 0; attempt < 20 * wanted && c.size() < wanted; ++attempt) {
      const Point& centre = centres[below(clusters)];
      Point at{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = coordinate(centre[axis], clustered ? std::min(spread, 0.5 * c.box.length[axis]) : c.box.length[axis],
                              c.box.length[axis]);
      if (!has_room(c, at, 0.7 * unit)) continue;
      c.positions.insert(c.positions.end(), at.begin(), at.end());
      c.species.push_back(static_cast<int>(below(model.species.size())));
      if (model.form->has_diameters) c.diameters.push_back(unit * between(0.8, 1.3));
    }
    return c;
  }

  static bool has_room(const Configuration& c, const Point& at, double least) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Point d = c.box.nearest_image(difference(c.position(i), at));
      if (dot(d, d) < least * least) return false;
    }
    return true;
  }

  std::mt19937_64 generator_;
};

}  // namespace lanescape::testing
