#include <lanescape/path.hpp>

#include <chrono>
#include <utility>

#include "api/path_problem.hpp"
#include "core/float_environment.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

// The progress of one of several searches as a part of the whole.
class SearchMonitor final : public ProgressMonitor {
 public:
  SearchMonitor(const Progress& progress, double offset, double share)
      : ProgressMonitor(progress), offset_(offset), share_(share) {}

 private:
  double told(std::string_view, double done, double) const override { return offset_ + share_ * done; }

  double offset_, share_;
};

PathResult one_way(const SearchSetup& setup, const Progress& progress) {
  const FloatEnvironment environment;
  const double share = setup.options.reverse ? 0.5 : 1.0;
  SearchMonitor monitor(progress, setup.reversed ? share : 0.0, share);
  const auto search = begin_path(setup);
  run_for_host(*search, monitor);
  return search->result();
}

Path to_public(PathResult found, double seconds) {
  Path path;
  path.outcome = to_string(found.outcome);
  path.reason = std::move(found.reason);
  path.length = found.length;
  path.distance = found.distance;
  path.ratio_squared = found.ratio_squared();
  path.participation_ratio = found.participation_number / static_cast<double>(found.particle_lengths.size());
  path.direct_steps = found.direct_steps;
  path.detour_steps = found.detour_steps;
  path.evaluations = found.evaluations;
  path.landscape_energy = found.landscape_energy;
  path.largest_violation = found.largest_violation;
  path.reversed = found.reversed;
  path.seconds = seconds;
  for (Configuration& frame : found.frames) path.frames.push_back(std::move(frame.positions));
  return path;
}

Path search(const SearchSetup& setup, const Progress& progress) {
  const auto began = std::chrono::steady_clock::now();
  PathResult found = one_way(setup, progress);
  if (setup.options.reverse && found.outcome != Outcome::interrupted) {
    SearchSetup backwards = setup;
    backwards.reversed = true;
    found = shorter_way(std::move(found), one_way(backwards, progress));
  }
  return to_public(std::move(found), std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
}

}  // namespace

Path find_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box, std::span<const double> start,
               std::span<const double> finish, const PathSettings& settings, std::span<const double> diameters) {
  return search(PathProblem(model, species, box, start, finish, settings, diameters).setup(), settings.progress);
}

Path find_path(Landscape& landscape, std::span<const double> start, std::span<const double> finish, const PathSettings& settings,
               std::span<const double> masses) {
  if (const Potential* potential = model_potential(landscape, masses))
    return find_path(potential->model(), potential->species(), potential->box(), start, finish,
                     with_options_of(*potential, settings), potential->options().diameters);
  return search(PathProblem(landscape, start, finish, settings, masses).setup(), settings.progress);
}

LANESCAPE_ABI_END
}  // namespace lanescape
