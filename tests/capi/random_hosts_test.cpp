// Random systems as hosts see them: through the C++ facade and the C interface, by the text of a model file, they have the bits of
// the library's own classes and, for pair potentials and hard spheres, the reference's numbers; or all refuse them
// (support/random_run.hpp: how many).
#include <lanescape/lanescape.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "c_hosts.hpp"
#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/state/state_mixture.hpp"
#include "io/model_file.hpp"
#include "pair_comparison.hpp"
#include "random_run.hpp"
#include "random_spheres.hpp"
#include "random_state_mixtures.hpp"
#include "reference/hard_sphere.hpp"

namespace lanescape {
namespace {

using testing::HostAnswer;
using testing::Outcome;
using testing::SphereAnswer;

// What `make` gives, or the answer of what refuses it.
template <class Answer>
Answer unless_refused(const std::function<Answer()>& make) {
  try {
    return make();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
    return {};
  }
}

// Forces as hosts get them, and no -0.
std::vector<double> forces_of(const ParticleLayout& layout, const AlignedArray& gradient) {
  std::vector<double> forces = layout.to_user(gradient);
  for (double& x : forces) x = 0.0 - x;
  return forces;
}

std::array<double, 6> stress_of(const std::array<double, 6>& tensor, const Box& box) {
  std::array<double, 6> stress{};
  for (std::size_t k = 0; k < 6; ++k) stress[k] = 0.0 - tensor[k] / box.volume();
  return stress;
}

// The library's own classes, in the order of calls of an evaluation of all outputs.
HostAnswer directly(const testing::RandomConfiguration& made, Isa isa) {
  made.model.check();
  const Configuration& c = made.configuration;
  const ParticleLayout layout = ParticleLayout::in_users_order(c, made.model.species.size());
  PairInteraction interaction(made.model, c.box, layout, kernel_table(isa), made.options);
  const AlignedArray positions = layout.to_slots(c.positions);
  AlignedArray gradient(layout.dimension()), energies(layout.slots());
  HostAnswer answer{false};
  interaction.energies(positions, energies);
  for (std::size_t i = 0; i < c.size(); ++i) answer.energies.push_back(energies[layout.slot_of(i)]);
  auto sums = interaction.energy_and_stress(positions, gradient);
  answer.stress = stress_of(sums.virial_tensor, c.box);
  if (made.options.precision == Precision::mixed) sums = interaction.energy_and_gradient(positions, gradient);
  answer.energy = sums.energy;
  answer.virial = sums.virial;
  answer.forces = forces_of(layout, gradient);
  return answer;
}

HostAnswer directly(const testing::RandomStateMixture& made, Isa isa) {
  made.model.check();
  const Configuration& c = made.configuration;
  check_cutoff(made.model, c.box);
  const ParticleLayout layout(c.species, made.model.species.size());
  StateMixture sites(made.model, c.box, layout, kernel_table(isa), {});
  const AlignedArray positions = layout.to_slots(c.positions);
  AlignedArray gradient(layout.dimension()), energies(layout.slots());
  HostAnswer answer{false};
  sites.energies(positions, energies);
  for (std::size_t i = 0; i < c.size(); ++i) answer.energies.push_back(energies[layout.slot_of(i)]);
  const auto sums = sites.energy_and_stress(positions, gradient);
  answer.energy = sums.energy;
  answer.virial = sums.virial;
  answer.stress = stress_of(sums.virial_tensor, c.box);
  answer.forces = forces_of(layout, gradient);
  return answer;
}

HostAnswer evaluate_all(auto& potential, const Configuration& c) {
  HostAnswer answer{false};
  answer.forces.resize(3 * c.size());
  answer.energies.resize(c.size());
  const Evaluation found = potential.evaluate(
      c.positions, {.forces = Vectors<double>::interleaved(answer.forces), .energies = answer.energies, .stress = true});
  answer.energy = found.energy;
  answer.virial = found.virial;
  answer.stress = found.stress;
  return answer;
}

HostAnswer through_cpp(const std::string& toml, const Configuration& c, const char* precision, const char* isa) {
  const Model model = Model::from_toml(toml);
  if (model.has_states()) {
    StateSystem::Options options;
    options.instruction_set = isa;
    StateSystem sites(model, c.species, c.box.length, options);
    return evaluate_all(sites, c);
  }
  Potential potential(model, c.species, c.box.length, {.precision = precision, .instruction_set = isa, .diameters = c.diameters});
  return evaluate_all(potential, c);
}

// The text of a model; what cannot be written is refused by hosts too.
std::string text_of(const AnyModel& model) {
  std::ostringstream out;
  write_model_file(out, model);
  return out.str();
}

// Compares the hosts with each other; what is wrong, or an empty text.
template <class Made>
std::string differing(const Made& made, const char* precision, Isa isa, const HostAnswer& expected) {
  std::string toml, fault;
  try {
    toml = text_of(made.model);
  } catch (const Error& error) {
    return expected.refused ? "" : fmt::format("the model cannot be written: {}", error.what());
  }
  const HostAnswer cpp =
      unless_refused<HostAnswer>([&] { return through_cpp(toml, made.configuration, precision, to_string(isa)); });
  const HostAnswer c = testing::soft_through_c(toml, made.configuration, precision, to_string(isa), fault);
  if (!fault.empty()) return "C: " + fault;
  if (cpp.refused != expected.refused) return cpp.refused ? "C++ refuses it" : "C++ does not refuse it";
  if (c.refused != expected.refused) return c.refused ? "C refuses it" : "C does not refuse it";
  if (!(cpp == expected)) return fmt::format("C++ has other numbers: energy {} instead of {}", cpp.energy, expected.energy);
  return c == cpp ? "" : fmt::format("C has other numbers: energy {} instead of {}", c.energy, cpp.energy);
}

// What of the answer is not the reference's, or an empty text.
std::string deviating(const testing::RandomConfiguration& made, const HostAnswer& answer, const reference::Evaluation& expected,
                      testing::Comparable what) {
  testing::PairNumbersFound found{answer.energy, answer.virial, answer.forces, {}};
  for (double& x : found.gradient) x = -x;
  for (const double stress : answer.stress) found.virial_tensor.push_back(-stress * made.configuration.box.volume());
  const auto worst = testing::deviations(found, expected), allowed = testing::tolerances(made);
  return testing::within(worst, allowed, what) ? "" : testing::describe(worst, allowed);
}

TEST(RandomHosts, HaveTheNumbersOfPairPotentials) {
  testing::RandomRun(3.0).for_each("configurations for hosts", [](std::uint64_t number, auto add) {
    const testing::RandomConfiguration made = testing::RandomConfigurations(number).make_for_hosts();
    const testing::DecidedByRounding rounding(made);
    const testing::Comparable what = rounding.comparable(made.model);
    const reference::Evaluation expected = testing::expected_of(made, rounding);
    for (const Isa isa : available_isas()) {
      const HostAnswer answer = unless_refused<HostAnswer>([&] { return directly(made, isa); });
      std::string wrong = differing(made, to_string(made.options.precision), isa, answer);
      if (wrong.empty() && !answer.refused && what != testing::Comparable::nothing) wrong = deviating(made, answer, expected, what);
      if (!wrong.empty())
        ADD_FAILURE() << fmt::format("configuration {} on {}: {}: {}", number, to_string(isa), testing::describe(made), wrong);
      add(!wrong.empty()                     ? Outcome::wrong
          : answer.refused                   ? Outcome::refused
          : what != testing::Comparable::all ? Outcome::undecided
                                             : Outcome::right);
    }
  });
}

TEST(RandomHosts, HaveTheNumbersOfSitesInStates) {
  testing::RandomRun(1.0).for_each("systems of sites in states for hosts", [](std::uint64_t number, auto add) {
    const testing::RandomStateMixture made = testing::RandomStateMixtures(number).make();
    for (const Isa isa : available_isas()) {
      const HostAnswer answer = unless_refused<HostAnswer>([&] { return directly(made, isa); });
      const std::string wrong = differing(made, "double", isa, answer);
      if (!wrong.empty()) ADD_FAILURE() << fmt::format("sites {} on {}: {}", number, to_string(isa), wrong);
      add(!wrong.empty() ? Outcome::wrong : answer.refused ? Outcome::refused : Outcome::right);
    }
  });
}

SphereAnswer spheres_of_reference(const testing::RandomSpheres& made) {
  if (!made.box_holds_spheres) return {};
  const Configuration& c = made.configuration;
  SphereAnswer answer{false};
  for (const auto& overlap : reference::overlaps(c.positions, c.radii, c.box.length)) {
    answer.pairs.emplace_back(overlap.i, overlap.j);
    answer.gaps.push_back(overlap.gap);
  }
  answer.any = !answer.pairs.empty();
  answer.smallest_gap = reference::smallest_gap(c.positions, c.radii, c.box.length);
  return answer;
}

SphereAnswer spheres_through_cpp(const Configuration& c, const char* isa) {
  HardSpheres::Options options;
  options.instruction_set = isa;
  HardSpheres spheres(c.radii, c.box.length, options);
  SphereAnswer answer{false, spheres.any_overlap(c.positions), spheres.smallest_gap(c.positions)};
  for (const Overlap& overlap : spheres.overlaps(c.positions)) {
    answer.pairs.emplace_back(overlap.first, overlap.second);
    answer.gaps.push_back(overlap.gap);
  }
  return answer;
}

TEST(RandomHosts, HaveTheOverlapsOfHardSpheres) {
  testing::RandomRun(1.0).for_each("systems of hard spheres for hosts", [](std::uint64_t number, auto add) {
    const testing::RandomSpheres made = testing::RandomSphereSystems(number).make(3.0);
    const SphereAnswer expected = spheres_of_reference(made);
    for (const Isa isa : available_isas()) {
      std::string fault;
      const SphereAnswer cpp =
          unless_refused<SphereAnswer>([&] { return spheres_through_cpp(made.configuration, to_string(isa)); });
      const SphereAnswer c = testing::spheres_through_c(made.configuration, to_string(isa), fault);
      const bool right = cpp == expected && c == expected && fault.empty();
      EXPECT_TRUE(right) << fmt::format("spheres {} on {}: {} overlaps by C++, {} by C, {} expected, {}", number, to_string(isa),
                                        cpp.pairs.size(), c.pairs.size(), expected.pairs.size(), fault);
      add(!right ? Outcome::wrong : expected.refused ? Outcome::refused : Outcome::right);
    }
  });
}

}  // namespace
}  // namespace lanescape
