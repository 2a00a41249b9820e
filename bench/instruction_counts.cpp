// The program whose instructions tools/check_instructions.py counts: ROUNDS evaluations of one hot operation on a fixed
// configuration. It prints and verifies nothing. The simplest instruction set generates the configurations, so all instruction sets
// work on the same numbers.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/event_driven.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/probe_field.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "interaction/state/state_mixture.hpp"
#include "io/extended_xyz.hpp"
#include "landscape/hard_sphere_landscape.hpp"
#include "landscape/pair_landscape.hpp"
#include "neighbour/neighbour_list.hpp"
#include "neighbour/pair_finder.hpp"
#include "path/finder.hpp"
#include "path/shortening/block_tridiagonal.hpp"
#include "stepper/avoidance.hpp"
#include "stepper/contour.hpp"

namespace lanescape::bench {
namespace {

// Prevents the compiler from removing results that nothing reads.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

// Both ends of a Kob-Andersen path, N = 108, T = 1, and what is needed to evaluate them.
struct SoftLiquid {
  PairModel model = kob_andersen();
  std::vector<Frame> frames = read_frames(LANESCAPE_BENCH_DATA_DIR "/ka108-T1-pair.extxyz", model);
  const Configuration& start = frames.front().configuration;
  ParticleLayout layout{start.species, model.species.size()};
  AlignedArray positions = layout.to_slots(start.positions), goal = layout.to_slots(frames.back().configuration.positions);
  AlignedArray out = AlignedArray(layout.dimension(), 0.0);

  PairInteraction nearest_images(Isa isa) {
    model.images = ImageRule::minimum;
    return PairInteraction(model, start.box, layout, kernel_table(isa));
  }
};

// Binary hard spheres, N = 108, packing fraction 0.49: a lattice after 20 collisions per particle, and after 20 more.
struct HardLiquid {
  Configuration start = hard_sphere_start(hard_sphere_binary(), 108, 0.49, Arrangement::random, 1);
  EventDriven dynamics{start, std::vector<double>(start.size(), 1.0), kernel_table(available_isas().front())};
  ParticleLayout layout{start.species, 2};
  AlignedArray positions, goal;

  HardLiquid() {
    dynamics.draw_velocities(1);
    positions = after_collisions();
    start.positions = layout.to_user(positions);
    goal = after_collisions();
  }

 private:
  AlignedArray after_collisions() {
    for (int k = 0; k < 1080; ++k) dynamics.collide();
    std::vector<double> between_events;
    dynamics.positions(0.5 * (dynamics.time() + dynamics.next_event_time()), between_events);
    return layout.to_slots(between_events);
  }
};

// Accepted steps of a path, from its start.
template <class Stepper>
void walk(const VectorAlgebra& algebra, Stepper stepper, const AlignedArray& start, const AlignedArray& goal, std::size_t particles,
          std::uint64_t steps) {
  PathFinder<Stepper> finder(algebra, std::move(stepper), start, goal, particles, {});
  finder.advance(steps);
  keep(finder.position());
}

void lj_energy(Isa isa, std::uint64_t rounds) {
  SoftLiquid liquid;
  PairInteraction interaction = liquid.nearest_images(isa);
  for (; rounds > 0; --rounds) keep(interaction.energy(liquid.positions));
}

void lj_gradient(Isa isa, std::uint64_t rounds) {
  SoftLiquid liquid;
  PairInteraction interaction = liquid.nearest_images(isa);
  for (; rounds > 0; --rounds) keep(interaction.energy_and_gradient(liquid.positions, liquid.out));
}

void lj_stress(Isa isa, std::uint64_t rounds) {
  SoftLiquid liquid;
  PairInteraction interaction = liquid.nearest_images(isa);
  for (; rounds > 0; --rounds) keep(interaction.energy_and_stress(liquid.positions, liquid.out));
}

// A list for Kob-Andersen's mixture, N = 500, on a rattled lattice: as large as is practical under valgrind, and large enough for
// rows like those of a large system.
struct ListLiquid {
  PairModel model = kob_andersen();
  Configuration start = fcc_start(model, 500, 1.2, 1);
  ParticleLayout layout{start.species, model.species.size()};
  AlignedArray positions, moved, out = AlignedArray(layout.dimension(), 0.0);

  ListLiquid() {
    const CounterRandom random(1, RandomStream::displacements);
    for (std::uint32_t k = 0; k < start.positions.size(); ++k) start.positions[k] += 0.2 * (random.uniform(0, k / 3, k % 3) - 0.5);
    positions = layout.to_slots(start.positions);
    for (double& x : start.positions) x += default_skin;
    moved = layout.to_slots(start.positions);
  }
  PairInteraction interaction(Isa isa, Precision precision = Precision::double_precision) const {
    return PairInteraction(model, start.box, layout, kernel_table(isa), {.search = PairSearch::list, .precision = precision});
  }
};

void lj_list_energy(Isa isa, std::uint64_t rounds) {
  const ListLiquid liquid;
  PairInteraction interaction = liquid.interaction(isa);
  for (; rounds > 0; --rounds) keep(interaction.energy(liquid.positions));
}

void lj_list_force(Isa isa, std::uint64_t rounds) {
  ListLiquid liquid;
  PairInteraction interaction = liquid.interaction(isa);
  for (; rounds > 0; --rounds) interaction.gradient(liquid.positions, liquid.out);
}

void lj_list_gradient(Isa isa, std::uint64_t rounds) {
  ListLiquid liquid;
  PairInteraction interaction = liquid.interaction(isa);
  for (; rounds > 0; --rounds) keep(interaction.energy_and_gradient(liquid.positions, liquid.out));
}

void lj_list_stress(Isa isa, std::uint64_t rounds) {
  ListLiquid liquid;
  PairInteraction interaction = liquid.interaction(isa);
  for (; rounds > 0; --rounds) keep(interaction.energy_and_stress(liquid.positions, liquid.out));
}

void lj_list_energy_mixed(Isa isa, std::uint64_t rounds) {
  const ListLiquid liquid;
  PairInteraction interaction = liquid.interaction(isa, Precision::mixed);
  for (; rounds > 0; --rounds) keep(interaction.energy(liquid.positions));
}

void lj_list_gradient_mixed(Isa isa, std::uint64_t rounds) {
  ListLiquid liquid;
  PairInteraction interaction = liquid.interaction(isa, Precision::mixed);
  for (; rounds > 0; --rounds) keep(interaction.energy_and_gradient(liquid.positions, liquid.out));
}

// Three passes over the same lattice: two states, with Lennard-Jones or with tables.
void state_gradient(Isa isa, std::uint64_t rounds, bool tables) {
  ListLiquid liquid;
  StateMixtureModel model = liquid_vapour();
  if (tables)
    for (auto& potential : model.potentials)
      potential = StateMixtureModel::Table{0.7, 2.5, {6.0, 1.0, -0.6, -0.8, -0.5, -0.3, -0.2, -0.1, -0.05, 0.0}};
  const ParticleLayout layout(std::vector<int>(liquid.start.size(), 0), 1);
  const AlignedArray positions = layout.to_slots(liquid.start.positions);
  AlignedArray gradient(layout.dimension());
  StateMixture interaction(model, liquid.start.box, layout, kernel_table(isa), {});
  for (; rounds > 0; --rounds) keep(interaction.energy_and_gradient(positions, gradient));
}

void state_lj_gradient(Isa isa, std::uint64_t rounds) { state_gradient(isa, rounds, false); }
void state_table_gradient(Isa isa, std::uint64_t rounds) { state_gradient(isa, rounds, true); }

// Rebuilds the list: particles move forth and back.
void neighbour_list(Isa isa, std::uint64_t rounds) {
  const ListLiquid liquid;
  NeighbourList list(liquid.start.box, liquid.layout, {2.5, 2.0, 2.0, 2.2}, default_skin, kernel_table(isa), 1);
  for (; rounds > 0; --rounds) list.update(rounds % 2 == 0 ? liquid.positions : liquid.moved);
}

// Sorted pairs for a host, in memory that is kept.
void neighbour_pairs(Isa isa, std::uint64_t rounds) {
  const ListLiquid liquid;
  PairFinder finder({.cutoffs = {2.5}}, kernel_table(isa));
  for (; rounds > 0; --rounds) {
    finder.set_particles(liquid.start.positions, liquid.start.box.length, {});
    keep(finder.pairs().count);
  }
}

// All images within the cutoff.
void contour_step(Isa isa, std::uint64_t rounds) {
  SoftLiquid liquid;
  PairLandscape landscape(liquid.model, liquid.start.box, liquid.layout, isa);
  const double landscape_energy = std::max(landscape.energy(liquid.positions), landscape.energy(liquid.goal));
  walk(landscape.algebra(), ContourStepper(landscape, landscape_energy, {}), liquid.positions, liquid.goal, liquid.start.size(),
       rounds);
}

void sphere_any_overlap(Isa isa, std::uint64_t rounds) {
  HardLiquid liquid;
  HardSphereOverlap spheres(liquid.start.box, liquid.layout, liquid.start.radii, kernel_table(isa));
  for (; rounds > 0; --rounds) keep(spheres.any_overlap(liquid.positions));
}

// The cost of building a list.
void sphere_pairs_within(Isa isa, std::uint64_t rounds) {
  HardLiquid liquid;
  HardSphereOverlap spheres(liquid.start.box, liquid.layout, liquid.start.radii, kernel_table(isa));
  for (; rounds > 0; --rounds) keep(spheres.pairs_within(liquid.positions, HardSphereLandscape::default_skin));
}

void sphere_list_any_overlap(Isa isa, std::uint64_t rounds) {
  HardLiquid liquid;
  HardSphereLandscape landscape(liquid.start.box, liquid.layout, liquid.start.radii, isa);
  for (; rounds > 0; --rounds) keep(landscape.allowed(liquid.positions));
}

// Spheres one per cent too large, so that some overlap, and the forces between them.
void sphere_list_contacts(Isa isa, std::uint64_t rounds) {
  HardLiquid liquid;
  for (double& radius : liquid.start.radii) radius *= 1.01;
  HardSphereLandscape landscape(liquid.start.box, liquid.layout, liquid.start.radii, isa);
  AlignedArray force(liquid.layout.dimension(), 0.0);
  for (; rounds > 0; --rounds) {
    keep(landscape.find_contacts(liquid.positions));
    landscape.add_contact_forces(kernels::ContactPotential::harmonic, force);
    keep(force);
  }
}

void avoidance_step(Isa isa, std::uint64_t rounds) {
  HardLiquid liquid;
  HardSphereLandscape landscape(liquid.start.box, liquid.layout, liquid.start.radii, isa);
  walk(landscape.algebra(), AvoidanceStepper(landscape, {}), liquid.positions, liquid.goal, liquid.start.size(), rounds);
}

// The first collision of each sphere of the liquid with the spheres whose gap is less than 0.6.
void sphere_first_collision(Isa isa, std::uint64_t rounds) {
  const HardLiquid liquid;
  const std::vector<double> velocities = liquid.dynamics.velocities();
  const std::size_t particles = liquid.start.size();
  std::vector<kernels::FlyingSphere, AlignedAllocator<kernels::FlyingSphere>> spheres;
  std::vector<std::vector<std::int32_t>> neighbours(particles);
  std::vector<std::size_t> counts(particles, 0);
  for (std::size_t i = 0; i < particles; ++i) {
    const double *x = &liquid.start.positions[3 * i], *v = &velocities[3 * i];
    spheres.push_back({x[0], x[1], x[2], v[0], v[1], v[2], 0.0, liquid.start.radii[i]});
    for (std::size_t j = 0; j < particles; ++j)
      if (j != i && sphere_gap(liquid.start, i, j) < 0.6) neighbours[i].push_back(static_cast<std::int32_t>(j));
    counts[i] = neighbours[i].size();
    neighbours[i].resize(counts[i] + kernels::slot_padding, 0);
  }
  const auto& box = liquid.start.box.length;
  const kernels::KernelTable& table = kernel_table(isa);
  for (; rounds > 0; --rounds)
    for (std::size_t i = 0; i < particles; ++i)
      keep(table.sphere_first_collision({spheres.data(), neighbours[i].data(), counts[i], i, 0.0, 0.0, {box[0], box[1], box[2]}}));
}

void collision(Isa isa, std::uint64_t rounds) {
  const HardLiquid liquid;
  EventDriven dynamics(liquid.start, std::vector<double>(liquid.start.size(), 1.0), kernel_table(isa));
  dynamics.draw_velocities(2);
  for (; rounds > 0; --rounds) dynamics.collide();
  keep(dynamics.time());
}

void dot(Isa isa, std::uint64_t rounds) {
  const SoftLiquid liquid;
  const VectorAlgebra algebra(kernel_table(isa));
  for (; rounds > 0; --rounds) keep(algebra.dot(liquid.positions, liquid.goal));
}

void axpy(Isa isa, std::uint64_t rounds) {
  SoftLiquid liquid;
  const VectorAlgebra algebra(kernel_table(isa));
  for (; rounds > 0; --rounds) {
    algebra.axpy(liquid.out, liquid.positions, 0.5, liquid.goal);
    keep(liquid.out);
  }
}

void displacement_moments(Isa isa, std::uint64_t rounds) {
  const SoftLiquid liquid;
  const VectorAlgebra algebra(kernel_table(isa));
  for (; rounds > 0; --rounds) keep(algebra.displacement_moments(liquid.positions, liquid.goal));
}

// Three blocks of 42 with a large diagonal.
class Blocks {
 public:
  explicit Blocks(Isa isa) : matrix_(kernel_table(isa), 3, 42, 1) {}
  BlockTridiagonal& matrix() { return matrix_; }
  bool factor() {
    return matrix_.factor({[&](std::size_t block) {
                             for (std::size_t i = 0; i < matrix_.dimension(); ++i) matrix_.add(block, i, i, 4.0);
                           },
                           [](std::size_t, BlockTridiagonal::Coupling& coupling) { coupling.unit = -1.0; }});
  }

 private:
  BlockTridiagonal matrix_;
};

void block_factor(Isa isa, std::uint64_t rounds) {
  Blocks blocks(isa);
  for (; rounds > 0; --rounds) keep(blocks.factor());
}

void block_solve(Isa isa, std::uint64_t rounds) {
  Blocks blocks(isa);
  blocks.factor();
  std::vector<AlignedArray> x(blocks.matrix().blocks(), AlignedArray(blocks.matrix().dimension(), 1.0));
  for (; rounds > 0; --rounds) blocks.matrix().solve(x);
  keep(x);
}

// Random positions in the same liquid.
std::vector<double> random_places(const Box& box, std::uint64_t count) {
  const CounterRandom random(1, RandomStream::sites);
  std::vector<double> places;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto fraction = random.uniform_point(k, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) places.push_back(fraction[axis] * box.length[axis]);
  }
  return places;
}

void lj_probe(Isa isa, std::uint64_t rounds) {
  const SoftLiquid liquid;
  const ProbeField field(liquid.model, liquid.start, 0, kernel_table(isa));
  const std::vector<double> places = random_places(liquid.start.box, rounds);
  for (std::size_t k = 0; k < places.size(); k += 3) keep(field.sample({places[k], places[k + 1], places[k + 2]}));
}

void lj_probe_first_clear(Isa isa, std::uint64_t rounds) {
  const SoftLiquid liquid;
  const ProbeField field(liquid.model, liquid.start, 0, kernel_table(isa));
  const std::vector<double> places = random_places(liquid.start.box, rounds), clearances = field.clearances(60.0);
  for (std::size_t k = 0; k < rounds; ++k) k += field.first_clear(clearances, std::span(places).subspan(3 * k));
}

struct Case {
  std::string_view name;
  void (*run)(Isa isa, std::uint64_t rounds);
  // The counts are averaged over this number of rounds: about 10^5 to 10^6 instructions, so that the few hundred instructions by
  // which program starts differ are negligible.
  std::uint64_t rounds;
};

constexpr Case cases[] = {
    {"lj_energy", lj_energy, 5},
    {"lj_gradient", lj_gradient, 5},
    {"lj_stress", lj_stress, 5},
    {"lj_list_energy", lj_list_energy, 4},
    {"lj_list_force", lj_list_force, 4},
    {"lj_list_gradient", lj_list_gradient, 4},
    {"lj_list_stress", lj_list_stress, 4},
    {"lj_list_energy_mixed", lj_list_energy_mixed, 4},
    {"lj_list_gradient_mixed", lj_list_gradient_mixed, 4},
    {"state_lj_gradient", state_lj_gradient, 2},
    {"state_table_gradient", state_table_gradient, 2},
    {"neighbour_list", neighbour_list, 4},
    {"neighbour_pairs", neighbour_pairs, 2},
    {"lj_probe", lj_probe, 400},
    {"lj_probe_first_clear", lj_probe_first_clear, 4000},
    {"contour_step", contour_step, 40},
    {"sphere_any_overlap", sphere_any_overlap, 20},
    {"sphere_pairs_within", sphere_pairs_within, 20},
    {"sphere_list_any_overlap", sphere_list_any_overlap, 200},
    {"sphere_list_contacts", sphere_list_contacts, 200},
    {"avoidance_step", avoidance_step, 200},
    {"sphere_first_collision", sphere_first_collision, 5},
    {"collision", collision, 500},
    {"dot", dot, 500},
    {"axpy", axpy, 500},
    {"displacement_moments", displacement_moments, 500},
    {"block_factor", block_factor, 4},
    {"block_solve", block_solve, 20},
};

constexpr int skipped = 77;  // the instruction set is not available

int run(std::string_view name, std::string_view isa_name, std::string_view rounds_word) {
  std::uint64_t rounds = 0;
  const auto [end, error] = std::from_chars(rounds_word.data(), rounds_word.data() + rounds_word.size(), rounds);
  if (error != std::errc{} || end != rounds_word.data() + rounds_word.size())
    throw_bad_input(fmt::format("rounds '{}': a whole number is needed", rounds_word));
  for (const Case& one : cases)
    if (one.name == name) {
      for (const Isa isa : available_isas())
        if (isa_name == to_string(isa)) {
          one.run(isa, rounds);
          return 0;
        }
      fmt::print(stderr, "instruction_counts: instruction set {} is not available here\n", isa_name);
      return skipped;
    }
  throw_bad_input(fmt::format("unknown case '{}': --list names those there are", name));
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  using namespace lanescape;
  try {
    const std::vector<std::string_view> words(argv + 1, argv + argc);
    if (words.size() == 1 && words[0] == "--list") {
      for (const bench::Case& one : bench::cases) fmt::print("{} {}\n", one.name, one.rounds);
      return 0;
    }
    if (words.size() == 1 && words[0] == "--compiler") {
      fmt::print("{}\n", LANESCAPE_BENCH_COMPILER);
      return 0;
    }
    if (words.size() == 3) return bench::run(words[0], words[1], words[2]);
    throw_bad_input("usage: instruction_counts --list | --compiler | CASE ISA ROUNDS");
  } catch (const std::exception& error) {
    fmt::print(stderr, "instruction_counts: {}\n", error.what());
    return 2;
  }
}
