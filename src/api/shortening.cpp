#include <lanescape/shortening.hpp>

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "api/access.hpp"
#include "api/path_problem.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "run/given_path.hpp"
#include "run/path_nodes.hpp"
#include "run/shorten_starts.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

using Frames = std::vector<std::vector<double>>;

ShortenOptions shorten_options(const ShortenSettings& settings, const PathProblem& problem) {
  ShortenOptions options;
  if (!settings.method.empty()) options.method = &shorten_method(settings.method);
  options.search = problem.options();
  options.starts = settings.starts;
  options.seed = settings.seed;
  if (options.search.reverse) throw_bad_input("a path to shorten is not searched from both ends: without reverse only");
  options.check(problem.model());
  return options;
}

std::vector<Configuration> placed_frames(const Configuration& particles, const Frames& frames) {
  std::vector<Configuration> path;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    try {
      path.push_back(placed(particles, frames[k]));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("path, frame {}: {}", k + 1, error.what()));
    }
  }
  return path;
}

// A run tells how many iterations or trials were made, and a search which part of the path is found.
class ShorteningMonitor final : public ProgressMonitor {
 public:
  using ProgressMonitor::ProgressMonitor;

 private:
  double told(std::string_view, double done, double total) const override { return total > 0.0 ? 0.0 : done; }
};

ShortPath short_path_of(ShortenResult found, double distance) {
  ShortPath path;
  path.outcome = to_string(found.outcome);
  path.reason = std::move(found.reason);
  path.length_before = found.length_before;
  path.distance = distance;
  path.start_lengths = std::move(found.start_lengths);
  PathResult& shortest = found.shortest.path;
  path.length = shortest.length;
  path.ratio_squared = shortest.ratio_squared();
  path.landscape_energy = shortest.landscape_energy;
  path.largest_violation = shortest.largest_violation;
  path.evaluations = shortest.evaluations;
  if (found.shortest.check) {
    path.kuhn_tucker_residual = found.shortest.check->kuhn_tucker_residual;
    path.multipliers = std::move(found.shortest.check->multipliers);
  }
  for (Configuration& frame : shortest.frames) path.frames.push_back(std::move(frame.positions));
  return path;
}

ShortPath shorten_for_host(const PathProblem& problem, const ShortenSettings& settings, const Frames& frames) {
  const auto began = std::chrono::steady_clock::now();
  const FloatEnvironment environment;
  const ShortenOptions options = shorten_options(settings, problem);
  SearchSetup search = problem.setup();
  search.threads = options.threads_of_one_start();
  std::vector<Configuration> nodes = placed_frames(search.pair.start, frames);
  if (!nodes.empty()) nodes = fit_path(std::move(nodes), search, "path");
  ShorteningMonitor monitor(settings.search.progress);
  const auto loop = [](ResumableWork& work, const std::string&, RunMonitor& reported) { return run_for_host(work, reported); };
  ShortPath path = short_path_of(shorten_between(search, nodes, options, loop, monitor), search.prepared.distance);
  path.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return path;
}

PathCertificate certificate_of(CheckedPath found) {
  PathCertificate certificate;
  certificate.length = found.check.length;
  certificate.distance = found.distance;
  certificate.ratio_squared = found.ratio_squared();
  certificate.landscape_energy = found.landscape_energy;
  certificate.largest_violation = found.check.largest_violation;
  certificate.kuhn_tucker_residual = found.check.kuhn_tucker_residual;
  certificate.multipliers = std::move(found.check.multipliers);
  certificate.excess = std::move(found.check.excess);
  certificate.segment_violation = std::move(found.check.segment_violation);
  return certificate;
}

void check_settings(const CheckSettings& settings, std::size_t frames) {
  checked_threads(settings.threads);
  if (settings.landscape_energy && !std::isfinite(*settings.landscape_energy))
    throw_bad_input(fmt::format("landscape energy {} is not allowed: it must be finite", *settings.landscape_energy));
  if (frames < 3) throw_bad_input(fmt::format("a path of {} frames is not allowed: at least 3 are needed", frames));
}

}  // namespace

std::vector<std::string> shorten_method_names() {
  std::vector<std::string> words;
  for (const ShortenMethod& method : shorten_methods()) words.emplace_back(method.word);
  return words;
}

ShortPath shorten_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                       std::span<const double> start, std::span<const double> finish, const ShortenSettings& settings,
                       std::span<const double> diameters, const Frames& frames) {
  return shorten_for_host(PathProblem(model, species, box, start, finish, settings.search, diameters), settings, frames);
}

ShortPath shorten_path(Landscape& landscape, std::span<const double> start, std::span<const double> finish,
                       const ShortenSettings& settings, std::span<const double> masses, const Frames& frames) {
  const Potential* potential = model_potential(landscape, masses);
  if (potential == nullptr)
    return shorten_for_host(PathProblem(landscape, start, finish, settings.search, masses), settings, frames);
  ShortenSettings own = settings;
  own.search = with_options_of(*potential, settings.search);
  return shorten_path(potential->model(), potential->species(), potential->box(), start, finish, own,
                      potential->options().diameters, frames);
}

PathCertificate check_path(const Model& model, std::span<const int> species, const std::array<double, 3>& box, const Frames& frames,
                           const CheckSettings& settings, std::span<const double> diameters) {
  const Configuration particles = particles_of(model, species, box, diameters);
  check_settings(settings, frames.size());
  const std::vector<Configuration> path = placed_frames(particles, frames);
  return certificate_of(check_path(detail::Access::of(model), path, settings.landscape_energy, choose_isa(settings.instruction_set),
                                   {.threads = settings.threads}));
}

PathCertificate check_path(Landscape& landscape, const Frames& frames, const CheckSettings& settings,
                           std::span<const double> masses) {
  if (const Potential* potential = model_potential(landscape, masses))
    return check_path(potential->model(), potential->species(), potential->box(), frames,
                      {settings.landscape_energy, potential->options().threads, potential->options().instruction_set},
                      potential->options().diameters);
  const HostParticles host(landscape, masses);
  check_settings(settings, frames.size());
  const PathNodes nodes = path_nodes(host.mixture(), host.layout(), placed_frames(host.particles(), frames));
  const Isa isa = choose_isa(settings.instruction_set);
  return certificate_of(check_path_on(host.maker(isa), nodes, settings.landscape_energy, isa));
}

LANESCAPE_ABI_END
}  // namespace lanescape
