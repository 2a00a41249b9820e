#include "run/shorten_montecarlo.hpp"

#include <algorithm>
#include <utility>

#include "core/random.hpp"
#include "run/neighbour_configuration.hpp"
#include "run/path_pieces.hpp"

namespace lanescape {
namespace {

// As in the source.
constexpr std::uint64_t allowed_failures = 5;

class MonteCarloShortening final : public ShortenWork {
 public:
  explicit MonteCarloShortening(const ShortenSetup& setup)
      : setup_(setup.search),
        random_(setup.seed, RandomStream::shortening),
        start_(setup.start),
        algebra_(kernel_table(setup_.isa)),
        path_(setup.initial) {
    record();
  }

  bool finished() const override { return failures_ >= allowed_failures; }
  double length() const override { return path_.length; }
  bool succeeded() const override { return finished(); }
  bool save_due() const override { return !trial_ || trial_->save_due(); }
  ShortenedPath result() override { return {path_, std::nullopt, trials_, std::nullopt}; }

  void advance(RunMonitor& monitor) override {
    if (!trial_) {
      begin_trial(monitor);
    } else {
      SilentMonitor nobody;  // the progress of one trial is none of the whole
      trial_->advance(nobody);
      if (trial_->finished()) end_trial();
    }
    monitor.progress("trials", static_cast<double>(trials_.size()), 0.0);
  }

  void exchange(Archive& archive) override {
    archive.field("failures", failures_);
    exchange_trials(archive);
    archive.enter("path");
    exchange_joined(archive, path_, setup_.pair);
    archive.leave();
    archive.field("displaced", displaced_);
    archive.field("distance_left", distance_left_);
    if (archive.reading()) {
      add_heterogeneity(path_, setup_.prepared.layout.blocks().size());
      trial_ = displaced_.empty() ? nullptr : paths_from_displaced();
    }
    if (!trial_) return;
    archive.enter("trial");
    trial_->exchange(archive);
    archive.leave();
  }

 private:
  // Of the frames of `path_`, keeps those equally spaced in the distance to the end, and the ends.
  void record() {
    PathRecorder recorder(recorded_configurations, setup_.prepared.distance);
    std::vector<Configuration> kept = {path_.frames.front()};
    for (std::size_t k = 1; k + 1 < path_.frames.size(); ++k) {
      const AlignedArray q = kinematic_coordinates(setup_, path_.frames[k].positions);
      const std::size_t before = recorder.frames().size();
      recorder.keep_frame(q, algebra_.distance(q, setup_.prepared.goal));
      if (recorder.frames().size() > before) kept.push_back(std::move(path_.frames[k]));
    }
    kept.push_back(path_.frames.back());
    path_.frames = std::move(kept);
  }

  void begin_trial(const RunMonitor& monitor) {
    const auto inner = static_cast<std::uint32_t>(path_.frames.size() - 2);
    if (inner == 0) return fail({});
    const std::uint32_t picked = 1 + random_.below(inner, trials_.size(), start_, 0);
    const std::vector<double>& positions = path_.frames[picked].positions;
    std::optional<std::vector<double>> displaced =
        neighbour_configuration(setup_, positions, random_, trials_.size(), start_, monitor);
    if (!displaced) return;
    distance_left_ = algebra_.distance(kinematic_coordinates(setup_, positions), setup_.prepared.goal);
    displaced_ = std::move(*displaced);
    if (displaced_.empty()) return fail({});
    trial_ = paths_from_displaced();
  }

  std::unique_ptr<PathPieces> paths_from_displaced() const {
    return paths_through(setup_, displaced_, 2 * recorded_configurations);
  }

  void end_trial() {
    PathResult found = trial_->joined();
    trial_.reset();
    displaced_.clear();
    if (found.outcome != Outcome::reached) return fail({});
    if (!(found.length < path_.length)) return fail(found.length);
    trials_.push_back({distance_left_, found.length, true});
    failures_ = 0;
    path_ = std::move(found);
    record();
  }

  void fail(std::optional<double> length) {
    trials_.push_back({distance_left_, length, false});
    ++failures_;
  }

  void exchange_trials(Archive& archive) {
    std::vector<double> distances, lengths;
    std::vector<std::uint64_t> kinds;  // 0 no path, 1 a longer one, 2 a shorter one
    for (const ShortenTrial& trial : trials_) {
      distances.push_back(trial.distance_left);
      lengths.push_back(trial.length.value_or(0.0));
      kinds.push_back(trial.accepted ? 2 : trial.length ? 1 : 0);
    }
    archive.field("trial_distances", distances);
    archive.field("trial_lengths", lengths);
    archive.field("trial_kinds", kinds);
    if (!archive.reading()) return;
    trials_.clear();
    for (std::size_t k = 0; k < kinds.size(); ++k)
      trials_.push_back({distances[k], kinds[k] > 0 ? std::optional(lengths[k]) : std::nullopt, kinds[k] == 2});
  }

  SearchSetup setup_;
  CounterRandom random_;
  std::uint32_t start_;
  VectorAlgebra algebra_;
  PathResult path_;  // the shortest by now
  std::uint64_t failures_ = 0;
  std::vector<ShortenTrial> trials_;
  // The trial under way.
  double distance_left_ = 0.0;
  std::vector<double> displaced_;
  std::unique_ptr<PathPieces> trial_;
};

}  // namespace

std::unique_ptr<ShortenWork> begin_montecarlo_shortening(const ShortenSetup& setup) {
  return std::make_unique<MonteCarloShortening>(setup);
}

}  // namespace lanescape
