#include "verification/hard_sphere_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/padded.hpp"
#include "core/random.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "reference/hard_sphere.hpp"
#include "verification/check.hpp"

namespace lanescape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Pairs of particles in the user's order, sorted.
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

// The number of pairs that are in only one of the lists; duplicates count too.
double wrong_pairs(const Pairs& a, const Pairs& b) {
  Pairs different;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(different));
  return static_cast<double>(different.size());
}

// A case in the library's order.
struct Prepared {
  const Configuration& configuration;
  ParticleLayout layout;
  AlignedArray positions;
  std::vector<std::size_t> particle_of;  // of each slot

  explicit Prepared(const Configuration& c)
      : configuration(c),
        layout(c.species, c.size() == 0 ? 1 : 1 + static_cast<std::size_t>(*std::max_element(c.species.begin(), c.species.end()))),
        positions(layout.to_slots(c.positions)),
        particle_of(layout.slots(), c.size()) {
    for (std::size_t i = 0; i < c.size(); ++i) particle_of[layout.slot_of(i)] = i;
  }

  // Sorted pairs of particles; (N, N) for an invalid pair: out of order or with padding.
  template <class SlotPairs>
  Pairs to_particles(const SlotPairs& slots, std::size_t count) const {
    Pairs pairs;
    for (std::size_t k = 0; k < count; ++k) {
      const kernels::SpherePair pair = slots[k];
      const std::size_t n = configuration.size();
      if (!(0 <= pair.first && pair.first < pair.second && static_cast<std::size_t>(pair.second) < particle_of.size())) {
        pairs.emplace_back(n, n);
        continue;
      }
      const std::size_t i = particle_of[static_cast<std::size_t>(pair.first)],
                        j = particle_of[static_cast<std::size_t>(pair.second)];
      pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }
};

double largest_radius(const Configuration& configuration) {
  return configuration.radii.empty() ? 0.0 : *std::max_element(configuration.radii.begin(), configuration.radii.end());
}

// The reach beyond contact up to which only the nearest image matters.
double room(const Configuration& configuration) {
  return std::max(0.0, 0.5 * configuration.box.shortest() - 2.0 * largest_radius(configuration));
}

struct AllPairsChecks {
  Check any, within, truncated, gap;

  explicit AllPairsChecks(const kernels::KernelTable& table)
      : any(table, "sphere_any_overlap", tolerance::exact),
        within(table, "sphere_pairs_within", tolerance::exact),
        truncated(table, "sphere_pairs_within beyond the capacity", tolerance::exact),
        gap(table, "sphere_smallest_gap", tolerance::exact) {}

  void run(const std::string& name, const Prepared& prepared, const kernels::KernelTable& table) {
    const Configuration& c = prepared.configuration;
    HardSphereOverlap spheres(c.box, prepared.layout, c.radii, table);
    any.add(name, spheres.any_overlap(prepared.positions) != reference::any_overlap(c.positions, c.radii, c.box.length));
    gap.add(name,
            !same_bits(spheres.smallest_gap(prepared.positions), reference::smallest_gap(c.positions, c.radii, c.box.length)));
    for (const double reach : {0.0, 1e-9, 0.01, 0.3, 0.999 * room(c)}) {
      if (reach > room(c)) continue;
      const Pairs expected = reference::pairs_within(c.positions, c.radii, c.box.length, reach);
      const auto& found = spheres.pairs_within(prepared.positions, reach);
      within.add(fmt::format("{}, reach {:.3g}", name, reach), wrong_pairs(prepared.to_particles(found, found.size()), expected));
    }
    run_truncated(name, prepared, spheres);
  }

 private:
  // If there is room for half of the pairs only, all pairs are counted, the written half is right, and nothing is written beyond
  // it.
  void run_truncated(const std::string& name, const Prepared& prepared, HardSphereOverlap& spheres) {
    const Configuration& c = prepared.configuration;
    const std::size_t slots = prepared.layout.slots(), float_slots = (slots + 15) / 16 * 16;
    std::vector<std::int32_t, AlignedAllocator<std::int32_t>> fractions(3 * float_slots);
    std::vector<float, AlignedAllocator<float>> reaches(float_slots);
    const kernels::SphereInput input{
        prepared.positions.data(), spheres.radii().data(), slots,      {c.box.length[0], c.box.length[1], c.box.length[2]},
        fractions.data(),          reaches.data(),         float_slots};
    const Pairs expected = reference::pairs_within(c.positions, c.radii, c.box.length, 0.5 * room(c));
    const std::size_t capacity = expected.size() / 2;
    std::vector<kernels::SpherePair> out(capacity + 1, {-7, -7});
    const std::size_t count = spheres.table().sphere_pairs_within(input, 0.5 * room(c), out.data(), capacity);
    const Pairs written = prepared.to_particles(out, capacity);
    Pairs unknown;
    std::set_difference(written.begin(), written.end(), expected.begin(), expected.end(), std::back_inserter(unknown));
    truncated.add(name, static_cast<double>(unknown.size()) + (count != expected.size()) + (out[capacity].first != -7));
  }
};

// The largest force of one contact in the reference: its rounding scales with it.
double force_scale(kernels::ContactPotential potential, double s) {
  return potential == kernels::ContactPotential::cubic ? s * s : s;
}

// The reference's formula on the reference's overlaps. If r/s rounds to 1, the pair still overlaps by r^2 < s^2 and is treated as
// just inside contact, where the linear force does not vanish.
std::vector<double> expected_forces(const std::vector<reference::Overlap>& overlaps, const Configuration& configuration,
                                    reference::FictitiousPotential potential) {
  std::vector<double> forces(3 * configuration.size(), 0.0);
  for (const auto& pair : overlaps) {
    const auto& d = pair.separation;
    const double s = configuration.radii[pair.i] + configuration.radii[pair.j],
                 r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (r == 0.0) continue;
    const double force_over_r = reference::fictitious_force(potential, std::min(r, std::nextafter(s, 0.0)), s) / r;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      forces[3 * pair.i + axis] -= force_over_r * d[axis];
      forces[3 * pair.j + axis] += force_over_r * d[axis];
    }
  }
  return forces;
}

struct ListChecks {
  static constexpr std::array<std::pair<kernels::ContactPotential, reference::FictitiousPotential>, 3> potentials = {
      {{kernels::ContactPotential::harmonic, reference::FictitiousPotential::harmonic},
       {kernels::ContactPotential::linear, reference::FictitiousPotential::linear},
       {kernels::ContactPotential::cubic, reference::FictitiousPotential::cubic}}};
  Check any, contacts;
  std::array<Check, 3> forces;

  explicit ListChecks(const kernels::KernelTable& table)
      : any(table, "sphere_list_any_overlap", tolerance::exact),
        contacts(table, "sphere_list_contacts", tolerance::exact),
        forces{Check(table, "sphere_contact_forces harmonic", tolerance::contact_force),
               Check(table, "sphere_contact_forces linear", tolerance::contact_force),
               Check(table, "sphere_contact_forces cubic", tolerance::contact_force)} {}

  // A list is built once and used while the particles move further and further: by thousandths of the skin, by less than half of
  // it, by half of it and, in the end, anywhere. No overlap may be missed.
  void run(const std::string& name, const Prepared& prepared, const kernels::KernelTable& table) {
    const Configuration& c = prepared.configuration;
    const CounterRandom random(3, RandomStream::displacements);
    HardSphereOverlap spheres(c.box, prepared.layout, c.radii, table);
    for (const double skin : {0.0, 0.01, 0.4}) {
      HardSphereList list(spheres, skin);
      std::vector<double> positions = c.positions;
      std::uint64_t move = 0;
      for (const double step : {0.0, 1e-3, 0.1, 0.29, 0.29, 0.5, 3.0}) {
        const double length = step * (skin > 0.0 ? skin : 0.05);
        for (std::size_t k = 0; k < positions.size(); ++k)
          positions[k] += length * (2.0 * random.uniform(move, static_cast<std::uint32_t>(k)) - 1.0);
        ++move;
        follow(fmt::format("{}, skin {}, step {}", name, skin, move), prepared, positions, list);
      }
    }
  }

 private:
  void follow(const std::string& name, const Prepared& prepared, const std::vector<double>& positions, HardSphereList& list) {
    const Configuration& c = prepared.configuration;
    const AlignedArray in_slots = prepared.layout.to_slots(positions);
    const auto overlaps = reference::overlaps(positions, c.radii, c.box.length);
    Pairs expected;
    for (const auto& overlap : overlaps) expected.emplace_back(overlap.i, overlap.j);
    any.add(name, list.any_overlap(in_slots) != !expected.empty());
    const ContactPairs found = list.find_contacts(in_slots);
    contacts.add(name, wrong_pairs(prepared.to_particles(found, found.count), expected));

    for (std::size_t p = 0; p < potentials.size(); ++p) {
      const auto [kernel_potential, reference_potential] = potentials[p];
      std::vector<double> scale(c.size(), 0.0);
      for (const auto& [i, j] : expected)
        for (const std::size_t k : {i, j}) scale[k] += force_scale(kernel_potential, c.radii[i] + c.radii[j]);
      // Forces are added to the previous values.
      AlignedArray force(prepared.layout.dimension(), 0.0);
      list.add_contact_forces(kernel_potential, force);
      const std::vector<double> in_users_order = prepared.layout.to_user(force);
      const auto wanted = expected_forces(overlaps, c, reference_potential);
      double worst = 0.0;
      for (std::size_t k = 0; k < wanted.size(); ++k) worst = std::max(worst, relative(in_users_order[k], wanted[k], scale[k / 3]));
      const AlignedArray once = force;
      list.add_contact_forces(kernel_potential, force);
      for (std::size_t k = 0; k < force.size(); ++k)
        if (relative(force[k], 2.0 * once[k], 1.0) > 1e-13) worst = infinity;
      for (std::size_t slot = 0; slot < prepared.particle_of.size(); ++slot)
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (prepared.particle_of[slot] == c.size() && force[axis * prepared.particle_of.size() + slot] != 0.0) worst = infinity;
      forces[p].add(name, worst);
    }
  }
};

AlignedArray random_array(std::size_t length, std::uint64_t which, double extent) {
  const CounterRandom random(4, RandomStream::displacements);
  AlignedArray values(length);
  for (std::size_t i = 0; i < length; ++i) values[i] = extent * (2.0 * random.uniform(which, static_cast<std::uint32_t>(i)) - 1.0);
  return values;
}

struct AvoidanceChecks {
  Check moved, sum, trial;

  explicit AvoidanceChecks(const kernels::KernelTable& table)
      : moved(table, "sphere_avoidance_trial moved", tolerance::exact),
        sum(table, "sphere_avoidance_trial sum", tolerance::avoidance),
        trial(table, "sphere_avoidance_trial trial", tolerance::avoidance) {}

  // `still`: every still-th slot has no force and no sum yet.
  void run(std::size_t slots, std::size_t still, bool forces, const kernels::KernelTable& table) {
    AlignedArray position = random_array(3 * slots, 1, 10.0), sums = random_array(3 * slots, 2, 0.2),
                 force = random_array(3 * slots, 3, forces ? 0.7 : 0.0);
    for (std::size_t k = 0; k < 3 * slots; ++k)
      if (k % slots % still == 0) sums[k] = force[k] = 0.0;
    const AlignedArray sums_before = sums, force_before = force;
    AlignedArray found(3 * slots, std::numeric_limits<double>::quiet_NaN());
    const double step = 1e-2;
    const std::size_t count = table.sphere_avoidance_trial(found.data(), position.data(), sums.data(), force.data(), step, slots);

    long double squared = 0.0L;
    for (const double f : force_before) squared += static_cast<long double>(f) * f;
    const long double weight = squared > 0.0L ? 1.0L / std::sqrt(squared) : 0.0L;
    std::size_t moving = 0;
    double worst_sum = 0.0, worst_trial = 0.0;
    for (std::size_t i = 0; i < slots; ++i) {
      std::array<long double, 3> s{};
      long double norm = 0.0L;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = axis * slots + i;
        s[axis] = sums_before[at] + weight * force_before[at];
        norm += s[axis] * s[axis];
        worst_sum =
            std::max(worst_sum, relative(sums[at], s[axis], std::abs(sums_before[at]) + std::abs(weight * force_before[at])));
        if (force[at] != 0.0) worst_sum = infinity;
      }
      norm = std::sqrt(norm);
      moving += norm > 1e-12L;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = axis * slots + i;
        const long double wanted = position[at] + (norm > 1e-12L ? step * s[axis] / norm : 0.0L);
        worst_trial = std::max(worst_trial, relative(found[at], wanted, std::abs(position[at]) + step));
      }
    }
    const std::string name = fmt::format("{} slots, one of {} at rest, {}", slots, still, forces ? "forces" : "no forces");
    moved.add(name, count != moving);
    sum.add(name, worst_sum);
    trial.add(name, worst_trial);
  }
};

}  // namespace

std::vector<Deviation> verify_hard_spheres(const kernels::KernelTable& table, const std::vector<HardSphereCase>& cases) {
  AllPairsChecks all(table);
  ListChecks list(table);
  for (const auto& [name, configuration] : cases) {
    const Prepared prepared(configuration);
    all.run(name, prepared, table);
    list.run(name, prepared, table);
  }
  AvoidanceChecks avoidance(table);
  for (const std::size_t slots : {8U, 16U, 24U, 112U, 264U})
    for (const std::size_t still : {1U, 2U, 5U, 1000U})
      for (const bool forces : {true, false}) avoidance.run(slots, still, forces, table);
  return {all.any.deviation,        all.within.deviation,      all.truncated.deviation,  all.gap.deviation,
          list.any.deviation,       list.contacts.deviation,   list.forces[0].deviation, list.forces[1].deviation,
          list.forces[2].deviation, avoidance.moved.deviation, avoidance.sum.deviation,  avoidance.trial.deviation};
}

}  // namespace lanescape
