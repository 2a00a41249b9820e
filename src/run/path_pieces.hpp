#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "run/path_search.hpp"

namespace lanescape {

// A path through given points, found piece by piece by the path method of `whole`. All pieces share its layout, metric, options and
// landscape energy. A piece that does not reach its goal ends the search.
class PathPieces final : public ResumableWork {
 public:
  struct Piece {
    std::vector<double> from, to;  // the user's order, unwrapped, 3N [sigma]
    bool backwards = false;        // is found from `from` to `to` and runs from `to` to `from` in the joined path
  };

  // Records about `frames` configurations of the joined path. What `whole` refers to must outlive this.
  PathPieces(const SearchSetup& whole, std::vector<Piece> pieces, std::size_t frames);

  bool finished() const override { return !active_; }
  void advance(RunMonitor& monitor) override;
  bool save_due() const override { return !active_ || active_->search->save_due(); }
  void exchange(Archive& archive) override;

  // The pieces joined: sums over all of them, without a trace. `running` before all are found.
  const PathResult& joined() const { return joined_; }

 private:
  struct Active {
    ConfigurationPair pair;
    PreparedPair prepared;
    std::unique_ptr<PathSearch> search;
  };

  void begin();
  void join(PathResult piece, bool backwards);

  SearchSetup whole_;
  PathRunOptions options_;
  std::vector<Piece> pieces_;
  std::uint64_t current_ = 0;
  std::unique_ptr<Active> active_;  // the piece being searched
  PathResult joined_;
};

// The paths from a point to both ends of the pair of `whole`, joined at it. The point is 3N numbers in the user's order.
std::unique_ptr<PathPieces> paths_through(const SearchSetup& whole, const std::vector<double>& point, std::size_t frames);

// The path search between other points: same layout, metric and landscape energy.
PreparedPair with_ends(const PreparedPair& prepared, const std::vector<double>& from, const std::vector<double>& to, Isa isa);

// What a joined path holds, but for what follows from `pair`: the composition of its frames, distance and landscape energy.
void exchange_joined(Archive& archive, PathResult& path, const ConfigurationPair& pair);

}  // namespace lanescape
