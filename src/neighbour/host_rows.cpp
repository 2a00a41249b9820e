#include "neighbour/host_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/padded.hpp"
#include "core/parallel.hpp"
#include "views/pair.hpp"

namespace lanescape {
namespace {

std::span<const int> list_of(const HostLists& lists, int point) {
  const auto i = static_cast<std::size_t>(point);
  return {lists.neighbours[i], static_cast<std::size_t>(lists.lengths[i])};
}

std::uint32_t offset_of(std::uint32_t point) { return point * static_cast<std::uint32_t>(kernels::point_width); }

void check_row(const HostLists& lists, int point) {
  const std::size_t points = lists.species.size();
  if (point < 0 || static_cast<std::size_t>(point) >= points)
    throw_bad_input(fmt::format("a list of point {} is not allowed: there are {} points, numbered from 0", point, points));
  const int length = lists.lengths[point];
  if (length < 0 || (length > 0 && lists.neighbours[point] == nullptr))
    throw_bad_input(fmt::format("the list of point {} has length {}{}", point, length, length < 0 ? "" : " but no array"));
  std::uint32_t largest = 0;
  for (const int j : list_of(lists, point)) largest = std::max(largest, static_cast<std::uint32_t>(j) & lists.mask);
  if (length > 0 && largest >= points)
    throw_bad_input(
        fmt::format("neighbour {} of point {} is not allowed: there are {} points, numbered from 0", largest, point, points));
}

}  // namespace

void check_lists(const HostLists& lists, int threads) {
  constexpr std::size_t part = 256, most_points = std::size_t{1} << 30;  // whose offsets fit 32 bits
  if (lists.species.size() > most_points)
    throw_bad_input(fmt::format("{} points are not allowed: at most {} are", lists.species.size(), most_points));
  if (!lists.rows.empty() && (lists.lengths == nullptr || lists.neighbours == nullptr))
    throw_bad_input("lists without lengths or without neighbours are not allowed");
  for_each_block(threads, (lists.rows.size() + part - 1) / part, [&](std::size_t k) {
    for (const int point : lists.rows.subspan(k * part, std::min(part, lists.rows.size() - k * part))) check_row(lists, point);
  });
}

kernels::NeighbourRows HostRows::rows_of(std::size_t block, const double* points) const {
  const Block& b = blocks_[block];
  return {.points = points,
          .rows = rows_.data() + b.first_row,
          .row_count = b.row_count,
          .neighbours = neighbours_.data() + b.first_neighbour,
          .lengths = lengths_.data() + b.first_row * species_,
          .species_count = species_,
          .fixed_points = nullptr,
          .fixed_unit = 0.0};
}

void HostRows::assign(const HostLists& lists, int threads) {
  blocks_.clear();
  find_keys(lists);
  if (ends_ == Ends::both) return assign_both_ends(lists);
  cut_into_blocks(lists, lists.rows, [&](int point) {
    return padded(static_cast<std::size_t>(lists.lengths[point]) + species_ * (kernels::slot_padding - 1));
  });
  for_each_block(threads, blocks_.size(), [&](std::size_t b) { fill(lists, blocks_[b]); });
}

void HostRows::find_keys(const HostLists& lists) {
  const bool all = partners_ == Partners::all;
  keys_.assign(lists.species.size(), partners_ == Partners::with_list ? none : std::uint8_t{0});
  if (partners_ == Partners::with_list)
    for (const int point : lists.rows) keys_[static_cast<std::size_t>(point)] = 0;
  if (partners_ == Partners::ghosts)
    for (const int point : lists.rows) keys_[static_cast<std::size_t>(point)] = none;
  one_key_ = all && species_ == 1;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    const int s = lists.species[k];
    if (keys_[k] != none) keys_[k] = s < 0 ? none : static_cast<std::uint8_t>(s);
    one_key_ = one_key_ && keys_[k] == 0;
  }
}

template <class Needed>
void HostRows::cut_into_blocks(const HostLists& lists, std::span<const int> points, Needed needed) {
  rows_.clear();
  std::size_t end = 0;
  for (std::size_t s = 0; s < species_; ++s) {
    for (const int point : points) {
      if (lists.species[static_cast<std::size_t>(point)] != static_cast<int>(s)) continue;
      if (blocks_.empty() || blocks_.back().species != s || blocks_.back().row_count == block_rows)
        blocks_.push_back({s, rows_.size(), 0, end});
      rows_.push_back(offset_of(static_cast<std::uint32_t>(point)));
      ++blocks_.back().row_count;
      end += needed(point);
    }
  }
  neighbours_.room_for(end + kernels::slot_padding);
  lengths_.room_for(rows_.size() * species_);
}

// Each species is looked for in the whole list, without branches.
void HostRows::fill(const HostLists& lists, const Block& block) {
  std::uint32_t* out = neighbours_.data() + block.first_neighbour;
  std::uint32_t* length = lengths_.data() + block.first_row * species_;
  for (std::size_t row = block.first_row; row < block.first_row + block.row_count; ++row) {
    const auto list = list_of(lists, static_cast<int>(rows_[row] / kernels::point_width));
    for (std::size_t s = 0; s < species_; ++s, ++length) {
      std::size_t count = 0;
      if (one_key_) {
        for (const int j : list) out[count++] = offset_of(static_cast<std::uint32_t>(j) & lists.mask);
      } else {
        for (const int j : list) {
          const std::uint32_t point = static_cast<std::uint32_t>(j) & lists.mask;
          out[count] = offset_of(point);
          count += keys_[point] == s ? 1 : 0;
        }
      }
      *length = static_cast<std::uint32_t>(count);
      std::fill_n(out + count, padded(count) - count, rows_[row]);
      out += padded(count);
    }
  }
}

void HostRows::find_pairs(const HostLists& lists) {
  pairs_.clear();
  for (const int i : lists.rows) {
    if (lists.species[static_cast<std::size_t>(i)] < 0) continue;
    for (const int j : list_of(lists, i)) {
      const std::uint32_t point = static_cast<std::uint32_t>(j) & lists.mask;
      if (keys_[point] != none) pairs_.push_back({static_cast<std::uint32_t>(i), point});
    }
  }
}

// The arrays of rows for the counts, and where the first neighbour of each goes.
void HostRows::make_rows_of_both_ends(const HostLists& lists) {
  const auto room = [&](int point) {
    std::size_t room = 0;
    for (std::size_t s = 0; s < species_; ++s) room += padded(counts_[static_cast<std::size_t>(point) * species_ + s]);
    return room;
  };
  points_.clear();
  for (int point = 0; point < static_cast<int>(lists.species.size()); ++point)
    if (room(point) > 0) points_.push_back(point);
  cut_into_blocks(lists, points_, room);
  next_.resize(counts_.size());
  std::uint32_t *out = neighbours_.data(), *length = lengths_.data();
  for (const std::uint32_t row : rows_)
    for (std::size_t s = 0; s < species_; ++s) {
      const std::size_t k = row / kernels::point_width * species_ + s, count = counts_[k];
      next_[k] = out;
      *length++ = counts_[k];
      std::fill_n(out + count, padded(count) - count, row);
      out += padded(count);
    }
}

void HostRows::assign_both_ends(const HostLists& lists) {
  counts_.assign(lists.species.size() * species_, 0);
  if (one_key_) return assign_both_ends_of_one_species(lists);
  const auto segment = [&](std::size_t of, std::size_t with) {
    return of * species_ + static_cast<std::size_t>(lists.species[with]);
  };
  find_pairs(lists);
  for (const auto& [i, j] : pairs_) {
    ++counts_[segment(i, j)];
    ++counts_[segment(j, i)];
  }
  make_rows_of_both_ends(lists);
  for (const auto& [i, j] : pairs_) {
    *next_[segment(i, j)]++ = offset_of(j);
    *next_[segment(j, i)]++ = offset_of(i);
  }
}

// Lists are copied as they are; only the other ends of their pairs are scattered.
void HostRows::assign_both_ends_of_one_species(const HostLists& lists) {
  for (const int i : lists.rows) {
    const auto list = list_of(lists, i);
    counts_[static_cast<std::size_t>(i)] += static_cast<std::uint32_t>(list.size());
    for (const int j : list) ++counts_[static_cast<std::uint32_t>(j) & lists.mask];
  }
  make_rows_of_both_ends(lists);
  for (const int i : lists.rows) {
    const auto list = list_of(lists, i);
    std::uint32_t*& next = next_[static_cast<std::size_t>(i)];
    next = std::transform(list.begin(), list.end(), next,
                          [&](int j) { return offset_of(static_cast<std::uint32_t>(j) & lists.mask); });
    const std::uint32_t own = offset_of(static_cast<std::uint32_t>(i));
    for (const int j : list) *next_[static_cast<std::uint32_t>(j) & lists.mask]++ = own;
  }
}

}  // namespace lanescape
