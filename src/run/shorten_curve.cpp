#include "run/shorten_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "path/path_check.hpp"
#include "path/shortening/curve_shortening.hpp"
#include "path/shortening/hard_curve.hpp"
#include "path/shortening/soft_curve.hpp"
#include "run/neighbour_configuration.hpp"
#include "run/path_nodes.hpp"
#include "run/path_pieces.hpp"

namespace lanescape {
namespace {

// A path with a larger residual is not called stationary.
constexpr double largest_residual = 1e-2;
// Spacing of nodes at first, for 108 particles of unit diameter: normals of the boundary turn over lengths that grow with sqrt(N).
// Hard spheres bend only where they touch.
constexpr double coarse_spacing = 0.5, hard_coarse_spacing = 4.0, spacing_particles = 108.0;
constexpr std::uint64_t iterations_per_checkpoint = 25;

// An iteration on hard spheres takes a time ~ N^3: paths of many are refined less.
double hard_length_tolerance(double particles) { return std::clamp(4e-7 * particles * particles, 3e-6, 5e-3); }

class CurveShorteningWork final : public ShortenWork {
 public:
  explicit CurveShorteningWork(const ShortenSetup& setup)
      : setup_(setup.search),
        random_(setup.seed, RandomStream::shortening),
        start_(setup.start),
        algebra_(kernel_table(setup_.isa)),
        initial_(&setup.initial) {
    if (start_ == 1)
      first_path_ = std::make_unique<PathPieces>(
          setup_, std::vector<PathPieces::Piece>{{setup_.pair.finish.positions, setup_.pair.start.positions, true}},
          recorded_configurations);
  }

  bool finished() const override { return !failure_.empty() || (curve_ && curve_->finished()); }
  double length() const override { return curve_ && failure_.empty() ? curve_->length() : initial_->length; }
  bool succeeded() const override { return failure_.empty() && curve_ && curve_->finished() && curve_->reason().empty(); }
  bool save_due() const override {
    return curve_ ? curve_->iterations() % iterations_per_checkpoint == 0 : !first_path_ || first_path_->save_due();
  }

  void advance(RunMonitor& monitor) override {
    try {
      advance_stage(monitor);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::goal_not_reached) throw;
      failure_ = error.what();
    }
    monitor.progress("iterations", curve_ ? static_cast<double>(curve_->iterations()) : 0.0, 0.0);
  }

  void exchange(Archive& archive) override {
    std::uint64_t stage = curve_ ? 2 : first_path_ ? 1 : 0;
    archive.field("stage", stage);
    archive.field("failure", failure_);
    if (!failure_.empty()) return;
    archive.field("neighbour", neighbour_);
    if (archive.reading()) resume_at(stage);
    if (stage == 1) first_path_->exchange(archive);
    if (stage == 2) curve_->exchange(archive);
  }

  ShortenedPath result() override {
    if (!curve_ || !failure_.empty()) return unchanged();
    ShortenedPath shortened{
        measured_path(), certificate(), {}, CurveReport{curve_->length_change(), curve_->levels(), curve_->iterations()}};
    shortened.path.largest_violation = shortened.check->largest_violation;
    judge(shortened.path, shortened.check->kuhn_tucker_residual);
    return shortened;
  }

 private:
  void advance_stage(const RunMonitor& monitor) {
    if (curve_)
      curve_->advance();
    else if (first_path_)
      advance_first_path();
    else if (start_ == 0)
      begin_curve(*initial_);
    else
      begin_through_neighbour(monitor);
  }

  void begin_through_neighbour(const RunMonitor& monitor) {
    const auto inner = static_cast<std::uint32_t>(initial_->frames.size() - 2);
    if (inner == 0) return begin_curve(*initial_);
    const std::uint32_t picked = 1 + random_.below(inner, 0, start_, 0);
    std::optional<std::vector<double>> point =
        neighbour_configuration(setup_, initial_->frames[picked].positions, random_, 0, start_, monitor);
    if (!point) return;
    if (point->empty()) return begin_curve(*initial_);
    neighbour_ = std::move(*point);
    first_path_ = paths_through(setup_, neighbour_, recorded_configurations);
  }

  void advance_first_path() {
    SilentMonitor nobody;  // its progress is none of the whole
    first_path_->advance(nobody);
    if (!first_path_->finished()) return;
    begin_curve(first_path_->joined().outcome == Outcome::reached ? first_path_->joined() : *initial_);
    first_path_.reset();
  }

  void begin_curve(const PathResult& path) {
    Polyline nodes;
    for (const Configuration& frame : path.frames) nodes.push_back(kinematic_coordinates(setup_, frame.positions));
    curve_ = make_curve();
    curve_->begin(nodes);
  }

  std::unique_ptr<CurveShortening> make_curve() const {
    const double unit = length_unit(setup_.model);
    const double particles = static_cast<double>(setup_.prepared.layout.size());
    const double scale = unit * std::sqrt(particles / spacing_particles);
    if (!is_hard())
      return std::make_unique<CurveShortening>(
          algebra_,
          std::make_unique<SoftCurve>(landscape_factory(), setup_.prepared.landscape_energy,
                                      SoftCurveOptions{.length_unit = unit, .threads = threads()}),
          CurveOptions{.coarse_spacing = coarse_spacing * scale});
    auto curve = std::make_unique<HardCurve>(hard_path(), HardCurveOptions{.length_unit = unit, .threads = threads()});
    const std::size_t most_nodes = curve->most_nodes();
    return std::make_unique<CurveShortening>(algebra_, std::move(curve),
                                             CurveOptions{.coarse_spacing = hard_coarse_spacing * scale,
                                                          .length_tolerance = hard_length_tolerance(particles),
                                                          .most_nodes = most_nodes});
  }

  bool is_hard() const { return setup_.options.method->is_hard; }
  HardSpherePath hard_path() const {
    return {setup_.pair.start.box, setup_.prepared.layout, setup_.pair.start.radii, setup_.prepared.metric, setup_.isa};
  }
  // A host's own landscape is one object: it is asked from one thread.
  int threads() const { return setup_.landscape ? 1 : setup_.threads; }
  SoftLandscapeMaker landscape_factory() const {
    return [setup = setup_]() mutable {
      setup.threads = 1;
      return path_landscape(setup);
    };
  }

  // The initial path, where none was made of it.
  ShortenedPath unchanged() const {
    ShortenedPath initial{*initial_, std::nullopt, {}, std::nullopt};
    initial.path.outcome = failure_.empty() ? Outcome::interrupted : Outcome::stalled;
    initial.path.reason = failure_;
    return initial;
  }

  PathCheck certificate() const {
    const PathCheckOptions options{.threads = threads()};
    if (is_hard()) return check_path(hard_path(), curve_->nodes(), options);
    return check_path(landscape_factory(), setup_.prepared.landscape_energy, curve_->nodes(), options);
  }

  // What a search measures of its path, from the nodes.
  PathResult measured_path() const {
    const ParticleLayout& layout = setup_.prepared.layout;
    const Polyline& nodes = curve_->nodes();
    PathStatistics statistics(layout.slots(), layout.size(), Stepping::adaptive);
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) statistics.add_step(algebra_, nodes[k], nodes[k + 1]);
    PathResult path;
    path.distance = setup_.prepared.distance;
    add_statistics(path, statistics, layout);
    path.evaluations = curve_->evaluations();
    path.landscape_energy = setup_.prepared.landscape_energy;
    path.frames = configurations_of(nodes, layout, setup_.prepared.metric, setup_.pair.start);
    path.frames.front() = setup_.pair.start;
    path.frames.back() = setup_.pair.finish;
    add_heterogeneity(path, layout.blocks().size());
    path.seconds = clock().seconds();
    return path;
  }

  void judge(PathResult& path, double residual) const {
    path.outcome = curve_->finished() ? Outcome::reached : Outcome::interrupted;
    if (!curve_->finished()) return;
    path.reason = curve_->reason();
    if (path.reason.empty() && residual > largest_residual)
      path.reason = fmt::format("no step makes it shorter, but its Kuhn-Tucker residual is {:.3g}", residual);
    if (!path.reason.empty()) path.outcome = Outcome::stalled;
  }

  void resume_at(std::uint64_t stage) {
    if (stage == 1 && !first_path_) first_path_ = paths_through(setup_, neighbour_, recorded_configurations);
    if (stage == 2) curve_ = make_curve();
    if (stage != 1) first_path_.reset();
  }

  SearchSetup setup_;
  CounterRandom random_;
  std::uint32_t start_;
  VectorAlgebra algebra_;
  const PathResult* initial_;
  std::vector<double> neighbour_;  // the point of paths_through(), or none
  std::unique_ptr<PathPieces> first_path_;
  std::unique_ptr<CurveShortening> curve_;
  std::string failure_;  // why there is no shortened path
};

}  // namespace

std::unique_ptr<ShortenWork> begin_curve_shortening(const ShortenSetup& setup) {
  return std::make_unique<CurveShorteningWork>(setup);
}

}  // namespace lanescape
