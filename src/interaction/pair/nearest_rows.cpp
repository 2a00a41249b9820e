#include "interaction/pair/nearest_rows.hpp"

#include "core/padded.hpp"
#include "interaction/pair/pair_parameters.hpp"

namespace lanescape {
namespace {

constexpr std::uint32_t row_offset = 0;

}  // namespace

NearestRows::NearestRows(const PairModel& model, const ParticleLayout& layout) : layout_(layout), pairs_(pair_parameters(model)) {}

std::size_t NearestRows::species_of(std::size_t slot) const {
  std::size_t species = layout_.blocks().size() - 1;
  while (layout_.blocks()[species].begin > slot) --species;
  return species;
}

void NearestRows::put(const AlignedArray& diameters, std::size_t slot, const Point& place) {
  points_.insert(points_.end(), place.begin(), place.end());
  points_.push_back(diameters.empty() ? 0.0 : diameters[slot]);
}

kernels::PairListInput NearestRows::row(const AlignedArray& positions, const Box& box, std::size_t slot,
                                        std::span<const std::uint32_t> partners) {
  const std::size_t slots = layout_.slots(), species = layout_.blocks().size();
  points_.clear();
  offsets_.clear();
  lengths_.assign(species, 0);
  put(layout_.diameters(), slot, {});
  std::size_t next = 0;
  for (std::size_t s = 0; s < species; ++s) {
    const std::size_t end = layout_.blocks()[s].begin + layout_.blocks()[s].count;
    for (; next < partners.size() && partners[next] < end; ++next, ++lengths_[s]) {
      const std::size_t other = partners[next];
      offsets_.push_back(static_cast<std::uint32_t>(points_.size()));
      put(layout_.diameters(), other,
          box.nearest_image({positions[other] - positions[slot], positions[slots + other] - positions[slots + slot],
                             positions[2 * slots + other] - positions[2 * slots + slot]}));
    }
    offsets_.resize(padded(offsets_.size()), row_offset);
  }
  offsets_.resize(offsets_.size() + kernels::slot_padding, row_offset);
  return {.list = {.points = points_.data(),
                   .rows = &row_offset,
                   .row_count = 1,
                   .neighbours = offsets_.data(),
                   .lengths = lengths_.data(),
                   .species_count = species,
                   .fixed_points = nullptr,
                   .fixed_unit = 0.0},
          .pairs = pairs_.data() + species_of(slot) * species,
          .single_pairs = nullptr};
}

}  // namespace lanescape
