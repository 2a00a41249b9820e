#include "path/shortening/hard_nodes.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/float_environment.hpp"
#include "core/slot_point.hpp"

namespace lanescape {
namespace {

// Of gaps, relative to the unit of length. Overlaps below 1e-9 along segments count as none.
constexpr double margin = 2e-11, tolerance = 1e-11;
constexpr double contact_gap = 5e-7;   // of pairs that touch: half of what the certificate takes for a contact
constexpr double loose_gap = 2e-4;     // of pairs that touch while planes are those of nodes
constexpr double independence = 1e-9;  // added to the products of unit normals, which may depend on each other

// Of a pair, an image, and the segment before (0) or behind (1) the node.
std::uint64_t key(const Approach& pair, std::uint64_t side) {
  std::uint64_t result = static_cast<std::uint64_t>(pair.first) << 22 | static_cast<std::uint64_t>(pair.second);
  for (const std::int32_t image : pair.image) result = result << 6 | static_cast<std::uint64_t>(image & 63);
  return result << 1 | side;
}

Point scaled(double factor, const Point& x) { return {factor * x[0], factor * x[1], factor * x[2]}; }

}  // namespace

// The planes at a node that act, as unit normals in kinematic coordinates.
struct HardNodes::Face {
  struct Row {
    std::size_t i, j;
    Point at_i, at_j;
  };
  std::vector<Row> rows;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> products;
};

HardNodes::Block::Block(const HardSpherePath& path, const AlignedArray& inverse_masses, double unit)
    : spheres(path.box, path.layout, path.radii, kernel_table(path.isa)),
      gaps(spheres),
      projection(inverse_masses, {.margin = margin * unit, .tolerance = tolerance * unit}) {}

HardNodes::HardNodes(const HardSpherePath& path, std::size_t nodes, const Options& options)
    : box_(path.box),
      metric_(path.metric),
      options_(options),
      algebra_(kernel_table(path.isa)),
      blocks_(nodes, options.threads),
      scale_(path.layout.dimension(), 1.0),
      contact_(contact_gap * 2.0 * *std::min_element(path.radii.begin(), path.radii.end())),
      corridors_(nodes),
      faces_(nodes) {
  metric_.to_positions(scale_);
  const AlignedArray inverse_masses = metric_.inverse_masses(path.layout);
  for (std::size_t block = 0; block < NodeBlocks::count; ++block)
    scratch_.push_back(std::make_unique<Block>(path, inverse_masses, options.unit));
}

std::uint64_t HardNodes::evaluations() const {
  std::uint64_t sum = 0;
  for (const auto& block : scratch_) sum += block->evaluations;
  return sum;
}

AlignedArray HardNodes::positions(const AlignedArray& q) const {
  AlignedArray result = q;
  metric_.to_positions(result);
  return result;
}

// An end of the path stays where it is. Where the plane of an overlap cuts it off, the plane turns until the end lies on it.
void HardNodes::turn_to_end(std::vector<Approach>& approaches, const AlignedArray& end, const Block& block) const {
  const AlignedArray& radii = block.spheres.radii();
  for (Approach& pair : approaches) {
    const double contact = radii[static_cast<std::size_t>(pair.first)] + radii[static_cast<std::size_t>(pair.second)];
    const Point d = separation_at(end, pair, box_);
    const double nearest = std::sqrt(dot(pair.separation, pair.separation)), r = std::sqrt(dot(d, d));
    if (!(nearest > 0.0) || dot(d, pair.separation) >= contact * nearest) continue;
    const Point e = scaled(1.0 / r, d), n = scaled(1.0 / nearest, pair.separation);
    Point f = difference(n, scaled(dot(n, e), e));
    const double f_length = std::sqrt(dot(f, f)), cosine = std::min(1.0, contact / r);
    if (!(f_length > 1e-12)) continue;
    f = scaled(std::sqrt(1.0 - cosine * cosine) / f_length, f);
    for (std::size_t axis = 0; axis < 3; ++axis) pair.separation[axis] = cosine * e[axis] + f[axis];
  }
}

void HardNodes::add_planes(Corridor& corridor, const std::vector<Approach>& approaches, const AlignedArray& at, const Block& block,
                           std::uint64_t side) const {
  const AlignedArray& radii = block.spheres.radii();
  for (const Approach& pair : approaches) {
    const double length = std::sqrt(dot(pair.separation, pair.separation));
    const Point normal = length > 0.0 ? scaled(1.0 / length, pair.separation) : Point{1.0, 0.0, 0.0};
    const double contact = radii[static_cast<std::size_t>(pair.first)] + radii[static_cast<std::size_t>(pair.second)];
    const double gap = dot(normal, separation_at(at, pair, box_)) - contact;
    if (gap >= options_.reach || pair.first == pair.second) continue;
    corridor.planes.push_back({pair.first, pair.second, gap, normal});
    corridor.keys.push_back(key(pair, side));
  }
}

// Tangent planes at the node itself. A pair may come nearer by the smaller of its gaps on both segments.
void HardNodes::add_node_planes(Corridor& corridor, const std::vector<Approach>& before, const std::vector<Approach>& behind,
                                const AlignedArray& at) const {
  std::vector<std::pair<std::uint64_t, const Approach*>> sorted;
  for (const auto* list : {&before, &behind})
    for (const Approach& pair : *list)
      if (pair.first != pair.second) sorted.emplace_back(key(pair, 0), &pair);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first < b.first : a.second->gap < b.second->gap; });
  constexpr double far = std::numeric_limits<double>::infinity();
  for (const auto& [number, pair] : sorted) {
    const bool is_before = pair >= before.data() && pair < before.data() + before.size();
    if (!corridor.keys.empty() && corridor.keys.back() == number) {
      (is_before ? corridor.both.back().first : corridor.both.back().second) = pair->gap;
      continue;
    }
    corridor.both.emplace_back(is_before ? pair->gap : far, is_before ? far : pair->gap);
    const Point d = separation_at(at, *pair, box_);
    corridor.planes.push_back({pair->first, pair->second, pair->gap, scaled(1.0 / std::sqrt(dot(d, d)), d)});
    corridor.keys.push_back(number);
  }
}

std::vector<HardNodes::Acting> HardNodes::acting_planes(const Corridor& corridor) {
  std::vector<Acting> acting;
  for (std::size_t c = 0; c < corridor.keys.size(); ++c)
    if (corridor.multipliers[c] > 0.0) acting.emplace_back(corridor.keys[c], corridor.multipliers[c]);
  std::sort(acting.begin(), acting.end());
  return acting;
}

void HardNodes::keep_multipliers(Corridor& corridor, const std::vector<Acting>& acting) {
  corridor.multipliers.assign(corridor.planes.size(), 0.0);
  for (std::size_t c = 0; c < corridor.planes.size(); ++c) {
    const auto found = std::lower_bound(acting.begin(), acting.end(), Acting(corridor.keys[c], 0.0));
    if (found != acting.end() && found->first == corridor.keys[c]) corridor.multipliers[c] = found->second;
  }
}

void HardNodes::follow_block(const Polyline& nodes, Block& block, std::size_t begin, std::size_t end) {
  block.from = positions(nodes[begin - 1]);
  block.to = positions(nodes[begin]);
  block.before = block.gaps.below(block.from, block.to, options_.reach);
  if (begin == 1) turn_to_end(block.before, block.from, block);
  for (std::size_t k = begin; k < end; ++k) {
    block.from.swap(block.to);
    block.to = positions(nodes[k + 1]);
    std::vector<Approach> behind = block.gaps.below(block.from, block.to, options_.reach);
    if (k + 2 == nodes.size()) turn_to_end(behind, block.to, block);
    ++block.evaluations;
    Corridor& corridor = corridors_[k];
    const std::vector<Acting> acting = acting_planes(corridor);
    corridor = {};
    if (mode_ == Planes::of_segments) {
      add_planes(corridor, block.before, block.from, block, 0);
      add_planes(corridor, behind, block.from, block, 1);
    } else {
      add_node_planes(corridor, block.before, behind, block.from);
    }
    keep_multipliers(corridor, acting);
    block.before.swap(behind);
  }
}

void HardNodes::follow(const Polyline& nodes) {
  blocks_.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    const FloatEnvironment environment;
    follow_block(nodes, *scratch_[block], begin, end);
  });
  if (mode_ == Planes::of_nodes_evenly) blocks_.for_each_node([&](std::size_t k) { share_gaps(k); });
}

bool HardNodes::acts(std::size_t k, std::uint64_t number) const {
  const Corridor& corridor = corridors_[k];
  const auto found = std::lower_bound(corridor.keys.begin(), corridor.keys.end(), number);
  return found != corridor.keys.end() && *found == number &&
         corridor.multipliers[static_cast<std::size_t>(found - corridor.keys.begin())] > 0.0;
}

void HardNodes::share_gaps(std::size_t k) {
  Corridor& corridor = corridors_[k];
  for (std::size_t c = 0; c < corridor.planes.size(); ++c) {
    if (!(corridor.multipliers[c] > 0.0)) continue;
    const bool from = acts(k - 1, corridor.keys[c]), on = acts(k + 1, corridor.keys[c]);
    const auto [before, behind] = corridor.both[c];
    if (from && on && std::max(before, behind) < options_.reach) corridor.planes[c].gap = 0.5 * (before + behind);
  }
}

bool HardNodes::restore(Polyline& nodes) {
  const Planes mode = mode_;
  mode_ = Planes::of_segments;
  follow(nodes);
  mode_ = mode;
  std::atomic<bool> all = true;
  blocks_.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    Block& scratch = *scratch_[block];
    for (std::size_t k = begin; k < end; ++k) {
      scratch.field.assign(nodes[k].size(), 0.0);
      Corridor& corridor = corridors_[k];
      std::fill(corridor.multipliers.begin(), corridor.multipliers.end(), 0.0);
      if (!scratch.projection.project(corridor.planes, scratch.field, corridor.multipliers) || most_share(scratch.field) < 1.0) {
        all = false;
        continue;
      }
      metric_.to_kinematic(scratch.field);
      algebra_.axpy(nodes[k], nodes[k], 1.0, scratch.field);
      std::fill(corridor.multipliers.begin(), corridor.multipliers.end(), 0.0);
    }
  });
  return all;
}

double HardNodes::most_share(const AlignedArray& displacement) const {
  double squared = 0.0;
  for (std::size_t i = 0; i < displacement.size() / 3; ++i)
    squared = std::max(squared, dot(slot_point(displacement, i), slot_point(displacement, i)));
  const double most = 0.5 * options_.reach;
  return squared > most * most ? most / std::sqrt(squared) : 1.0;
}

bool HardNodes::project(std::size_t k, std::size_t block, AlignedArray& displacement) {
  metric_.to_positions(displacement);
  Corridor& corridor = corridors_[k];
  if (!scratch_[block]->projection.project(corridor.planes, displacement, corridor.multipliers)) {
    std::fill(displacement.begin(), displacement.end(), 0.0);
    std::fill(corridor.multipliers.begin(), corridor.multipliers.end(), 0.0);
    return false;
  }
  const double share = most_share(displacement);
  if (share < 1.0)
    for (double& x : displacement) x *= share;
  metric_.to_kinematic(displacement);
  return true;
}

void HardNodes::remove_support(std::size_t k, std::size_t block, AlignedArray& field) {
  Block& scratch = *scratch_[block];
  const Corridor& corridor = corridors_[k];
  const double largest = mode_ == Planes::of_segments ? contact_ : contact_ * (loose_gap / contact_gap);
  scratch.touching.clear();
  scratch.multipliers.clear();
  for (std::size_t c = 0; c < corridor.planes.size(); ++c)
    if (corridor.planes[c].gap < largest) {
      scratch.touching.push_back(corridor.planes[c]);
      scratch.touching.back().gap = 0.0;
      scratch.multipliers.push_back(corridor.multipliers[c]);
    }
  metric_.to_positions(field);
  scratch.projection.project(scratch.touching, field, scratch.multipliers);
  metric_.to_kinematic(field);
}

void HardNodes::prepare_faces() {
  blocks_.for_each_node([&](std::size_t k) {
    faces_[k] = std::make_shared<Face>();
    Face& face = *faces_[k];
    const Corridor& corridor = corridors_[k];
    for (std::size_t c = 0; c < corridor.planes.size(); ++c) {
      if (!(corridor.multipliers[c] > 0.0)) continue;
      const PairGap& pair = corridor.planes[c];
      const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
      const double size = std::sqrt(scale_[i] * scale_[i] + scale_[j] * scale_[j]);
      face.rows.push_back({i, j, scaled(-scale_[i] / size, pair.normal), scaled(scale_[j] / size, pair.normal)});
    }
    const std::size_t n = face.rows.size();
    if (n == 0) return;
    std::vector<std::vector<std::size_t>> at(scale_.size() / 3);
    for (std::size_t c = 0; c < n; ++c)
      for (const std::size_t s : {face.rows[c].i, face.rows[c].j}) at[s].push_back(c);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t s = 0; s < at.size(); ++s)
      for (const std::size_t a : at[s])
        for (const std::size_t b : at[s]) {
          const Point& x = face.rows[a].i == s ? face.rows[a].at_i : face.rows[a].at_j;
          const Point& y = face.rows[b].i == s ? face.rows[b].at_i : face.rows[b].at_j;
          entries.emplace_back(static_cast<int>(a), static_cast<int>(b), dot(x, y) + (a == b ? 0.5 * independence : 0.0));
        }
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::SparseMatrix<double> products(size, size);
    products.setFromTriplets(entries.begin(), entries.end());
    face.products.compute(products);
  });
}

void HardNodes::keep_to_face(std::size_t k, AlignedArray& field) const {
  const Face& face = *faces_[k];
  if (face.rows.empty()) return;
  const std::size_t slots = field.size() / 3;
  Eigen::VectorXd parts(static_cast<Eigen::Index>(face.rows.size()));
  for (std::size_t c = 0; c < face.rows.size(); ++c)
    parts[static_cast<Eigen::Index>(c)] =
        dot(face.rows[c].at_i, slot_point(field, face.rows[c].i)) + dot(face.rows[c].at_j, slot_point(field, face.rows[c].j));
  const Eigen::VectorXd weights = face.products.solve(parts);
  for (std::size_t c = 0; c < face.rows.size(); ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double w = weights[static_cast<Eigen::Index>(c)];
      field[axis * slots + face.rows[c].i] -= w * face.rows[c].at_i[axis];
      field[axis * slots + face.rows[c].j] -= w * face.rows[c].at_j[axis];
    }
}

void HardNodes::exchange(Archive& archive) {
  exchange_enum(archive, "planes", mode_);
  std::uint64_t done = evaluations();
  archive.field("evaluations", done);
  if (archive.reading()) scratch_.front()->evaluations = done;
  std::vector<std::vector<Acting>> acting(corridors_.size());
  if (!archive.reading())
    for (std::size_t k = 0; k < corridors_.size(); ++k) acting[k] = acting_planes(corridors_[k]);
  std::vector<std::uint64_t> counts;
  for (const std::vector<Acting>& planes : acting) counts.push_back(planes.size());
  archive.field("acting_counts", counts);
  const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  std::vector<std::uint64_t> keys(total, 0);
  std::vector<double> multipliers(total, 0.0);
  std::size_t next = 0;
  for (const std::vector<Acting>& planes : acting)
    for (const auto& [number, multiplier] : planes) {
      keys[next] = number;
      multipliers[next++] = multiplier;
    }
  archive.field("acting_planes", keys);
  archive.field("acting_multipliers", multipliers);
  if (!archive.reading()) return;
  auto key = keys.begin();
  auto multiplier = multipliers.begin();
  for (std::size_t k = 0; k < corridors_.size(); ++k) {
    const auto count = static_cast<std::ptrdiff_t>(counts[k]);
    corridors_[k].keys.assign(key, key + count);
    corridors_[k].multipliers.assign(multiplier, multiplier + count);
    key += count;
    multiplier += count;
  }
}

}  // namespace lanescape
