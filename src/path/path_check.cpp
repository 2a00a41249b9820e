#include "path/path_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "core/parallel.hpp"
#include "path/bend.hpp"
#include "path/segment_energies.hpp"

namespace lanescape {
namespace {

// The certificate of a soft path, in parts that may run on threads.
class SoftCheck {
 public:
  SoftCheck(double landscape_energy, const Polyline& nodes, const PathCheckOptions& options)
      : landscape_energy_(landscape_energy), nodes_(&nodes), options_(&options), norms_(nodes.size()) {
    check_.excess.resize(nodes.size());
    check_.multipliers.assign(nodes.size(), 0.0);
    check_.segment_violation.resize(nodes.size() - 1);
  }

  // Of segments [begin, end): V on them and at the nodes they start from, and after the last one at the end of the path.
  void add_energies(SoftLandscape& landscape, std::size_t begin, std::size_t end) {
    SegmentEnergies segment(landscape, options_->samples);
    double v = landscape.energy((*nodes_)[begin]);
    for (std::size_t k = begin; k < end; ++k) {
      check_.excess[k] = v - landscape_energy_;
      const double next = landscape.energy((*nodes_)[k + 1]);
      const double largest = segment.largest((*nodes_)[k], v, (*nodes_)[k + 1], next);
      if (!std::isfinite(largest))
        throw_bad_input(fmt::format("the energy between nodes {} and {} of the path is not finite: particles meet", k, k + 1));
      check_.segment_violation[k] = largest - landscape_energy_;
      v = next;
    }
    if (end + 1 == nodes_->size()) check_.excess[end] = v - landscape_energy_;
  }

  // Of the inner nodes among [begin, end), once all energies are known.
  void add_bends(SoftLandscape& landscape, std::size_t begin, std::size_t end) {
    const VectorAlgebra& algebra = landscape.algebra();
    Bend bend(algebra, *nodes_);
    AlignedArray gradient(nodes_->front().size(), 0.0), rest = gradient;
    for (std::size_t k = std::max<std::size_t>(begin, 1); k < std::min(end, nodes_->size() - 1); ++k) {
      const AlignedArray& tau = bend.at(k);
      const double size = algebra.norm(tau);
      double unexplained = size;
      if (std::max(check_.segment_violation[k - 1], check_.segment_violation[k]) > -options_->boundary_tolerance) {
        landscape.gradient((*nodes_)[k], gradient);
        const double slope = algebra.norm(gradient);
        const double lambda = slope > 0.0 ? std::max(0.0, algebra.dot(tau, gradient) / slope) : 0.0;
        if (lambda > 0.0) {
          algebra.axpy(rest, tau, -lambda / slope, gradient);
          unexplained = algebra.norm(rest);
        }
        check_.multipliers[k] = lambda;
      }
      norms_.set(k, size, unexplained, bend.floor());
    }
  }

  PathCheck result(const VectorAlgebra& algebra) {
    check_.length = polyline_length(algebra, *nodes_);
    // Each segment has its ends.
    const auto& violations = check_.segment_violation;
    check_.largest_violation = std::max(0.0, *std::max_element(violations.begin(), violations.end()));
    check_.kuhn_tucker_residual = norms_.residual();
    return std::move(check_);
  }

 private:
  double landscape_energy_;
  const Polyline* nodes_;
  const PathCheckOptions* options_;
  PathCheck check_;
  BendNorms norms_;
};

// V has bits that depend on where its lists were built: each block of segments starts from a new landscape, so that the
// threads do not matter.
constexpr std::size_t block_segments = 64;

}  // namespace

void PathCheckOptions::check() const {
  check_positive("boundary_tolerance", boundary_tolerance);
  check_positive("contact_tolerance", contact_tolerance);
  if (samples < 2 || samples > 1'000'000)
    throw_bad_input(fmt::format("samples {} is not allowed: 2 to 1000000 per segment", samples));
  checked_threads(threads);
}

PathCheck check_path(SoftLandscape& landscape, double landscape_energy, const Polyline& nodes, const PathCheckOptions& options) {
  const FloatEnvironment environment;
  options.check();
  check_polyline(landscape.algebra(), nodes, 3);
  SoftCheck check(landscape_energy, nodes, options);
  check.add_energies(landscape, 0, nodes.size() - 1);
  check.add_bends(landscape, 0, nodes.size());
  return check.result(landscape.algebra());
}

PathCheck check_path(const SoftLandscapeMaker& make_landscape, double landscape_energy, const Polyline& nodes,
                     const PathCheckOptions& options) {
  const FloatEnvironment environment;
  options.check();
  const std::unique_ptr<SoftLandscape> first = make_landscape();
  check_polyline(first->algebra(), nodes, 3);
  SoftCheck check(landscape_energy, nodes, options);
  const std::size_t segments = nodes.size() - 1, blocks = (segments + block_segments - 1) / block_segments;
  const auto in_blocks = [&](auto&& work) {
    for_each_block(options.threads, blocks, [&](std::size_t b) {
      work(*make_landscape(), b * block_segments, std::min(segments, (b + 1) * block_segments));
    });
  };
  in_blocks([&](SoftLandscape& landscape, std::size_t begin, std::size_t end) { check.add_energies(landscape, begin, end); });
  in_blocks([&](SoftLandscape& landscape, std::size_t begin, std::size_t end) { check.add_bends(landscape, begin, end); });
  return check.result(first->algebra());
}

}  // namespace lanescape
