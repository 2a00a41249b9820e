#include "path/shortening/curve_shortening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr std::size_t fewest_nodes = 9;
constexpr std::uint64_t most_tightenings = 30;

}  // namespace

CurveShortening::CurveShortening(const VectorAlgebra& algebra, std::unique_ptr<CurveRelaxation> relaxation,
                                 const CurveOptions& options)
    : algebra_(&algebra), relaxation_(std::move(relaxation)), options_(options) {}

void CurveShortening::begin(const Polyline& start) {
  check_polyline(*algebra_, start);
  const double length = polyline_length(*algebra_, start);
  std::size_t nodes = std::max(fewest_nodes, 1 + static_cast<std::size_t>(std::ceil(length / options_.coarse_spacing)));
  // Nodes far apart may lie deep in the forbidden region, from where no gradient leads back; those of the path itself do not.
  for (;; nodes = 2 * nodes - 1) {
    try {
      begin_level(resampled(*algebra_, start, std::min(nodes, options_.most_nodes)));
      return;
    } catch (const Error&) {
      if (nodes >= options_.most_nodes || nodes > 4 * start.size()) throw;
    }
  }
}

void CurveShortening::begin_level(Polyline nodes) {
  relaxation_->begin(std::move(nodes));
  ++levels_;
}

void CurveShortening::finish(std::string reason) {
  finished_ = 1;
  reason_ = std::move(reason);
}

void CurveShortening::advance() {
  if (finished()) return;
  ++iterations_;
  const Relaxation state = relaxation_->iterate();
  if (iterations_ >= options_.most_iterations)
    return finish(fmt::format("{} iterations were allowed: the residual is {:.3g}", options_.most_iterations, residual()));
  if (state != Relaxation::continues) end_level();
}

void CurveShortening::end_level() {
  const double now = length();
  if (tightenings_ == 0) {
    if (last_length_ > 0.0) length_change_ = std::abs(last_length_ / now - 1.0);
    last_length_ = now;
    const std::size_t finer = 2 * nodes().size() - 1;
    if (length_change_ > options_.length_tolerance && finer <= options_.most_nodes)
      return begin_level(resampled(*algebra_, nodes(), finer));
  }
  if (relaxation_->tighten()) {
    if (++tightenings_ < most_tightenings) return;
    return finish("the segments of the path do not settle within the allowed region");
  }
  finish(length_change_ <= options_.length_tolerance
             ? ""
             : fmt::format("{} nodes were allowed: the length changes by {:.3g} of it", options_.most_nodes, length_change_));
}

void CurveShortening::exchange(Archive& archive) {
  archive.field("finished", finished_);
  archive.field("levels", levels_);
  archive.field("iterations", iterations_);
  archive.field("tightenings", tightenings_);
  archive.field("last_length", last_length_);
  archive.field("length_change", length_change_);
  archive.field("reason", reason_);
  archive.enter("relaxation");
  relaxation_->exchange(archive);
  archive.leave();
}

}  // namespace lanescape
