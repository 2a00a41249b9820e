#include "run/path_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace lanescape {
namespace {

// The progress of one piece as a part of the whole.
class PieceMonitor final : public RunMonitor {
 public:
  PieceMonitor(RunMonitor& monitor, std::size_t piece, std::size_t pieces) : monitor_(&monitor), piece_(piece), pieces_(pieces) {}
  void progress(std::string_view stage, double done, double) override {
    monitor_->progress(stage, (static_cast<double>(piece_) + done) / static_cast<double>(pieces_), 1.0);
  }
  void notice(std::string_view line) override { monitor_->notice(line); }
  bool stop_requested() const override { return monitor_->stop_requested(); }

 private:
  RunMonitor* monitor_;
  std::size_t piece_, pieces_;
};

Configuration at(const Configuration& like, std::vector<double> positions) {
  return {like.box, like.species, std::move(positions), like.radii, like.diameters};
}

template <class T>
void add_up(std::vector<T>& sum, const std::vector<T>& more) {
  if (sum.size() < more.size()) sum.resize(more.size(), T{});
  std::transform(more.begin(), more.end(), sum.begin(), sum.begin(), std::plus<T>());
}

// Each method has the same histograms in every path.
void add_up(std::vector<StepHistogram>& sum, const std::vector<StepHistogram>& more) {
  if (sum.empty())
    sum = more;
  else
    for (std::size_t k = 0; k < sum.size(); ++k) add_up(sum[k].counts, more[k].counts);
}

void exchange_histograms(Archive& archive, std::vector<StepHistogram>& histograms) {
  std::uint64_t count = histograms.size();
  archive.field("histograms", count);
  histograms.resize(count);
  for (std::size_t k = 0; k < histograms.size(); ++k) {
    archive.enter(fmt::format("histogram{}", k));
    archive.field("quantity", histograms[k].quantity);
    archive.field("first", histograms[k].first);
    archive.field("width", histograms[k].width);
    archive.field("counts", histograms[k].counts);
    archive.leave();
  }
}

void exchange_frames(Archive& archive, std::vector<Configuration>& frames, const Configuration& like) {
  std::vector<double> positions;
  for (const Configuration& frame : frames) positions.insert(positions.end(), frame.positions.begin(), frame.positions.end());
  archive.field("frames", positions);
  if (!archive.reading()) return;
  frames.clear();
  const auto length = static_cast<std::ptrdiff_t>(like.positions.size());
  for (auto begin = positions.begin(); begin != positions.end(); begin += length)
    frames.push_back(at(like, {begin, begin + length}));
}

}  // namespace

std::unique_ptr<PathPieces> paths_through(const SearchSetup& whole, const std::vector<double>& point, std::size_t frames) {
  return std::make_unique<PathPieces>(
      whole, std::vector<PathPieces::Piece>{{point, whole.pair.start.positions, true}, {point, whole.pair.finish.positions, false}},
      frames);
}

PreparedPair with_ends(const PreparedPair& prepared, const std::vector<double>& from, const std::vector<double>& to, Isa isa) {
  PreparedPair other = prepared;
  other.start = prepared.metric.coordinates(prepared.layout, from);
  other.goal = prepared.metric.coordinates(prepared.layout, to);
  other.distance = VectorAlgebra(kernel_table(isa)).distance(other.start, other.goal);
  return other;
}

void exchange_joined(Archive& archive, PathResult& path, const ConfigurationPair& pair) {
  exchange_enum(archive, "outcome", path.outcome);
  archive.field("reason", path.reason);
  archive.field("length", path.length);
  archive.field("participation_number", path.participation_number);
  archive.field("direct_steps", path.direct_steps);
  archive.field("detour_steps", path.detour_steps);
  archive.field("direct_length", path.direct_length);
  archive.field("detour_length", path.detour_length);
  archive.field("evaluations", path.evaluations);
  archive.field("corrections", path.corrections);
  archive.field("largest_violation", path.largest_violation);
  archive.field("particle_lengths", path.particle_lengths);
  exchange_histograms(archive, path.histograms);
  exchange_frames(archive, path.frames, pair.start);
}

PathPieces::PathPieces(const SearchSetup& whole, std::vector<Piece> pieces, std::size_t frames)
    : whole_(whole), options_(whole.options), pieces_(std::move(pieces)) {
  options_.finder.frames = (frames + pieces_.size() - 1) / pieces_.size();
  joined_.distance = whole.prepared.distance;
  joined_.landscape_energy = whole.prepared.landscape_energy;
  begin();
}

void PathPieces::begin() {
  const Piece& piece = pieces_[current_];
  const Configuration& like = whole_.pair.start;
  active_ = std::make_unique<Active>(
      Active{{at(like, piece.from), at(like, piece.to)}, with_ends(whole_.prepared, piece.from, piece.to, whole_.isa), nullptr});
  active_->search =
      begin_path({whole_.model, active_->pair, active_->prepared, options_, whole_.isa, whole_.threads, false, whole_.landscape});
}

void PathPieces::advance(RunMonitor& monitor) {
  PieceMonitor part(monitor, current_, pieces_.size());
  active_->search->advance(part);
  if (!active_->search->finished()) return;
  join(active_->search->result(), pieces_[current_].backwards);
  active_.reset();
  if (joined_.outcome != Outcome::running) return;
  ++current_;
  if (current_ < pieces_.size()) return begin();
  joined_.outcome = Outcome::reached;
  add_heterogeneity(joined_, whole_.prepared.layout.blocks().size());
}

void PathPieces::join(PathResult piece, bool backwards) {
  if (piece.outcome != Outcome::reached) {
    joined_.outcome = piece.outcome;
    joined_.reason = std::move(piece.reason);
  }
  const double length = joined_.length + piece.length;
  if (length > 0.0)
    joined_.participation_number =
        (joined_.length * joined_.participation_number + piece.length * piece.participation_number) / length;
  joined_.length = length;
  joined_.direct_steps += piece.direct_steps;
  joined_.detour_steps += piece.detour_steps;
  joined_.direct_length += piece.direct_length;
  joined_.detour_length += piece.detour_length;
  joined_.evaluations += piece.evaluations;
  joined_.largest_violation = std::max(joined_.largest_violation, piece.largest_violation);
  add_up(joined_.corrections, piece.corrections);
  add_up(joined_.particle_lengths, piece.particle_lengths);
  add_up(joined_.histograms, piece.histograms);
  if (backwards) std::reverse(piece.frames.begin(), piece.frames.end());
  if (!joined_.frames.empty()) joined_.frames.pop_back();  // two pieces share the point between them
  std::move(piece.frames.begin(), piece.frames.end(), std::back_inserter(joined_.frames));
}

void PathPieces::exchange(Archive& archive) {
  archive.field("piece", current_);
  exchange_joined(archive, joined_, whole_.pair);
  std::uint64_t searching = active_ ? 1 : 0;
  archive.field("searching", searching);
  if (archive.reading()) {
    active_.reset();
    if (searching != 0) begin();
  }
  if (!active_) {
    if (archive.reading() && joined_.outcome == Outcome::reached)
      add_heterogeneity(joined_, whole_.prepared.layout.blocks().size());
    return;
  }
  archive.enter("search");
  active_->search->exchange(archive);
  archive.leave();
}

}  // namespace lanescape
