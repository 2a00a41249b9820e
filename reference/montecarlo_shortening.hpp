#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "reference/geodesic.hpp"
#include "reference/hard_geodesic.hpp"
#include "reference/path_sum.hpp"

/// The source's optimisation of a path by random displacements ([G] 3.1.2.4, PHYSICS 4), to check the method in src.
namespace lanescape::reference {

struct SteppedPath {
  bool reached = false;
  double length = 0.0;       // [sigma]
  std::vector<Point> steps;  // all configurations, both ends included
};

using FindPath = std::function<SteppedPath(const Point& from, const Point& to)>;
using Allowed = std::function<bool(const Point& position)>;
using Uniform = std::function<double()>;  // the next random number in [0, 1)

/// The finders of this folder. `options` for soft paths name the landscape energy, which is that of the pair for every piece.
FindPath soft_paths(const Energy& energy, const Gradient& gradient, Method method, const GeodesicOptions& options);
FindPath hard_paths(std::span<const double> radii, const Vector& box, const AvoidanceOptions& options = {});

struct TrialOptions {
  long configurations = 1000;  // equally spaced in |R_f - R|, from which one is picked
  double move = 0.10;          // [sigma], the largest displacement of a particle per axis
  double displacement = 0.10;  // [sigma], moves go on until |R - R'| exceeds it
  long failures = 5;           // in a row that end the search
  long max_moves = 1'000'000;  // of one trial, allowed or not
};

struct OptimisedPath {
  SteppedPath path;
  long trials = 0;
  long accepted = 0;
};

/// Throws std::invalid_argument if no path is found between the ends.
OptimisedPath optimise_path(const Point& start, const Point& finish, const FindPath& find, const Allowed& allowed,
                            const Uniform& uniform, const TrialOptions& options = {});

}  // namespace lanescape::reference
