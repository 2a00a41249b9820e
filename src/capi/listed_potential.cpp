#include <lanescape/listed_potential.hpp>

#include <limits>
#include <utility>

#include "capi/arguments.hpp"
#include "capi/handles.hpp"
#include "capi/model.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_listed_potential : Handle<ListedPotential> {};

namespace {

ListedPotential::Lists lists_of(const char* given) {
  constexpr std::pair<const char*, ListedPotential::Lists> words[] = {{"rows", ListedPotential::Lists::rows},
                                                                      {"gradient", ListedPotential::Lists::gradient},
                                                                      {"half", ListedPotential::Lists::half}};
  const std::string asked = word(given, words[0].first);
  for (const auto& [known, lists] : words)
    if (asked == known) return lists;
  refuse("argument options->lists has word " + asked + ": rows, gradient or half is allowed");
}

ListedPotential::Options options_of(const lanescape_listed_options* given) {
  ListedPotential::Options options;
  if (given == nullptr) return options;
  const auto& o = sized(given, "options", "lanescape_listed_options");
  options.lists = lists_of(o.lists);
  const auto species = optional_array(o.species_of, o.species, "options->species_of");
  options.species_of.assign(species.begin(), species.end());
  options.threads = o.threads;
  options.instruction_set = word(o.instruction_set, options.instruction_set.c_str());
  return options;
}

ListedOutputs wanted(const lanescape_listed_outputs& out, std::size_t points) {
  ListedOutputs wanted;
  wanted.energy = out.energy != nullptr || out.virial != nullptr;
  if (out.forces != nullptr) wanted.forces = Vectors<double>::interleaved({out.forces, 3 * points});
  wanted.add_to_forces = out.add_to_forces != 0;
  if (out.energies != nullptr) wanted.energies = {out.energies, points};
  wanted.stress = out.virial_tensor != nullptr || (out.virial != nullptr && out.forces == nullptr);
  return wanted;
}

}  // namespace

lanescape_status lanescape_listed_options_init(lanescape_listed_options* options, size_t size) {
  return guarded([&] {
    lanescape_listed_options presets{};
    presets.threads = ListedPotential::Options{}.threads;
    initialise(options, size, "options", "lanescape_listed_options", presets);
  });
}

lanescape_status lanescape_listed_potential_create(const lanescape_model* model, const lanescape_listed_options* options,
                                                   lanescape_listed_potential** potential) {
  return guarded([&] {
    create(potential, "potential", [&] { return ListedPotential(object_of(model, "model").model, options_of(options)); });
  });
}

lanescape_status lanescape_listed_potential_cutoff(const lanescape_listed_potential* potential, size_t a, size_t b,
                                                   double* cutoff) {
  return alone(potential, "potential", [&](const ListedPotential& p) { given(cutoff, "cutoff") = p.cutoff(a, b); });
}

lanescape_status lanescape_listed_potential_set_lists(lanescape_listed_potential* potential, const lanescape_lists* lists) {
  return alone(potential, "potential", [&](ListedPotential& p) {
    const auto& l = sized(lists, "lists", "lanescape_lists");
    p.set_lists({array(l.species, l.points, "lists->species"), array(l.row_points, l.rows, "lists->row_points"),
                 array(l.neighbours, l.points, "lists->neighbours").data(), array(l.lengths, l.points, "lists->lengths").data(),
                 l.mask == 0 ? std::numeric_limits<unsigned>::max() : l.mask});
  });
}

lanescape_status lanescape_listed_potential_evaluate(lanescape_listed_potential* potential, const double* positions,
                                                     const lanescape_listed_outputs* outputs) {
  return alone(potential, "potential", [&](ListedPotential& p) {
    const auto& out = sized(outputs, "outputs", "lanescape_listed_outputs");
    const ListedEvaluation e =
        p.evaluate(Vectors<const double>::interleaved(vectors(positions, p.points(), "positions")), wanted(out, p.points()));
    if (out.energy != nullptr) *out.energy = e.energy;
    if (out.virial != nullptr) *out.virial = e.virial;
    copy_out(e.virial_tensor, out.virial_tensor);
  });
}

lanescape_status lanescape_listed_potential_destroy(lanescape_listed_potential* potential) {
  return destroy(potential, "potential");
}
