// Neighbour lists of event-driven dynamics.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dynamics/event_driven.hpp"

namespace lanescape {
namespace {

// Intended mean length of a list: nearly every list then fits into two vectors of eight.
constexpr double wanted_neighbours = 13.0;
// Relative growth of the diameters that the lists allow for before they are rebuilt.
constexpr double growth_per_resync = 0.01;

}  // namespace

// Without a branch, which would often be predicted wrongly.
inline bool EventDriven::Encounters::possible(const Shell& shell, const Shell& other) const {
  const auto squared = [&](std::size_t axis) {
    const double d = std::fabs(other.centre[axis] - shell.centre[axis]), nearest = std::min(d, std::fabs(d - box.length[axis]));
    return nearest * nearest;
  };
  const double reach = (shell.radius + other.radius) * swollen + shells;
  return squared(0) + squared(1) + squared(2) < reach * reach;
}

// Chooses the shell for lists of the intended length, within the limit of the nearest-image rule: two particles in contact, each up
// to a shell radius from its reference, must have references within half the box edge.
void EventDriven::choose_shell() {
  horizon_ = growth_ > 0.0 ? growth_per_resync / growth_ : never;
  const double swollen = growth_ > 0.0 ? 1.0 + growth_per_resync : 1.0;
  double mean_radius = 0.0;
  for (const std::uint32_t i : slot_of_) mean_radius += spheres_[i].radius / static_cast<double>(size());
  const double per_neighbour = box_.volume() / static_cast<double>(size());
  const double reach = std::cbrt(wanted_neighbours * per_neighbour * 3.0 / (4.0 * std::numbers::pi));
  const double largest = 2.0 * largest_radius_ * swollen;
  const double allowed = 0.25 * (0.5 * box_.shortest() - largest);
  shell_ = std::min(allowed, std::max(0.05 * largest, 0.5 * (reach - 2.0 * mean_radius * swollen)));
  if (const double edge = largest + 2.0 * shell_; edge != shortest_cell_) {
    grid_ = CellGrid(box_, edge, size());
    shortest_cell_ = edge;
  }
}

EventDriven::ShellsByCell EventDriven::shells_by_cell() const {
  ShellsByCell shells;
  shells.all.reserve(size());
  shells.first.reserve(grid_.cells() + 1);
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    shells.first.push_back(shells.all.size());
    grid_.for_each_in(cell, [&](std::int32_t j) { shells.all.push_back({shell_of_[static_cast<std::size_t>(j)], j}); });
  }
  shells.first.push_back(shells.all.size());
  return shells;
}

// Gives the same lists as find_neighbours(), in another order: looks at each pair once.
void EventDriven::make_lists() {
  grid_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    renew_shell(i);
    grid_.insert(static_cast<std::int32_t>(i), shell_of_[i].centre);
  }
  lists_.assign(size() * list_capacity_, 0);
  list_sizes_.assign(size(), 0);
  const auto [all, first] = shells_by_cell();
  const Encounters encounters = this->encounters();
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    if (first[cell] == first[cell + 1]) continue;
    const CellGrid::NearCells near = grid_.cells_near(cell);
    for (std::size_t self = first[cell]; self < first[cell + 1]; ++self) {
      std::size_t count = 0;
      const auto find = [&, &others = all](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          found_[count] = others[k].particle;
          count += encounters.possible(others[self].shell, others[k].shell);
        }
      };
      find(self + 1, first[cell + 1]);
      for (const std::uint32_t other : near.all())
        if (other > cell) find(first[other], first[other + 1]);
      for (std::size_t k = 0; k < count; ++k) {
        append(static_cast<std::size_t>(all[self].particle), found_[k]);
        append(static_cast<std::size_t>(found_[k]), all[self].particle);
      }
    }
  }
}

// Puts into found_ each particle that can touch particle i before either leaves its shell. Returns their number.
std::size_t EventDriven::find_neighbours(std::size_t i) {
  const Encounters encounters = this->encounters();
  const Shell own = shell_of_[i];
  std::int32_t* const found = found_.data();
  std::size_t count = 0;
  grid_.for_each_near(own.centre, [&](std::int32_t candidate) {
    const auto j = static_cast<std::size_t>(candidate);
    found[count] = candidate;
    count += static_cast<std::size_t>(encounters.possible(own, shell_of_[j]) & (i != j));
  });
  return count;
}

void EventDriven::grow_lists() {
  const std::size_t capacity = list_capacity_ + 16;
  AlignedVector<std::int32_t> lists(size() * capacity, 0);
  for (std::size_t i = 0; i < size(); ++i) std::copy_n(list(i), list_sizes_[i], lists.data() + i * capacity);
  lists_.swap(lists);
  list_capacity_ = capacity;
}

void EventDriven::append(std::size_t i, std::int32_t neighbour) {
  if (static_cast<std::size_t>(list_sizes_[i]) == list_capacity_) grow_lists();
  list(i)[list_sizes_[i]++] = neighbour;
}

void EventDriven::remove(std::size_t i, std::int32_t neighbour) {
  std::int32_t* const begin = list(i);
  std::int32_t* const last = begin + --list_sizes_[i];
  *std::find(begin, last, neighbour) = *last;
}

// After particle i has left its shell: rebuilds its list around its position and updates the lists of its neighbours.
void EventDriven::rebuild_list(std::size_t i) {
  bring_to_now(i);
  wrap(i);
  renew_shell(i);
  const auto self = static_cast<std::int32_t>(i);
  grid_.move(self, shell_of_[i].centre);
  for (std::int32_t k = 0; k < list_sizes_[i]; ++k) remove(static_cast<std::size_t>(list(i)[k]), self);
  list_sizes_[i] = 0;
  const std::size_t count = find_neighbours(i);
  for (std::size_t k = 0; k < count; ++k) {
    append(i, found_[k]);
    append(static_cast<std::size_t>(found_[k]), self);
  }
}

}  // namespace lanescape
