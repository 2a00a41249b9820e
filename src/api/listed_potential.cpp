#include <lanescape/listed_potential.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "api/host_arrays.hpp"
#include "api/pair_models.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/host_list_sums.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

namespace {

HostListSums::Lists kind_of(ListedPotential::Lists lists) {
  using enum ListedPotential::Lists;
  switch (lists) {
    case rows:
      return HostListSums::Lists::rows;
    case gradient:
      return HostListSums::Lists::gradient;
    case half:
      return HostListSums::Lists::half;
  }
  throw_bad_input("lists of another kind than rows, gradient and half are not allowed");
}

}  // namespace

struct ListedPotential::Implementation {
  Implementation(const Model& given, Options with)
      : model(pair_model(given, "a ListedPotential")),
        options(std::move(with)),
        unit(model.length_unit()),
        sums(model.in_unit(unit), kernel_table(choose_isa(options.instruction_set)), kind_of(options.lists),
             checked_threads(options.threads)) {
    for (const int species_of_model : options.species_of)
      if (species_of_model >= species_count())
        throw_bad_input(fmt::format("species_of names species {}: model {} has {}, numbered from 0", species_of_model, model.name,
                                    model.species.size()));
  }

  int species_count() const { return static_cast<int>(model.species.size()); }

  // The model's species of each point.
  std::span<const int> map(std::span<const int> species) {
    const int last = options.species_of.empty() ? species_count() : static_cast<int>(options.species_of.size());
    const int first = options.species_of.empty() ? -1 : 0;
    const auto unknown = std::find_if(species.begin(), species.end(), [&](int s) { return s < first || s >= last; });
    if (unknown != species.end())
      throw_bad_input(fmt::format("species {} of point {} is not allowed: from {} to {}", *unknown, unknown - species.begin(),
                                  first, last - 1));
    if (options.species_of.empty()) return species;
    mapped.clear();
    std::transform(species.begin(), species.end(), std::back_inserter(mapped),
                   [&](int s) { return options.species_of[static_cast<std::size_t>(s)]; });
    return mapped;
  }

  void read(const Vectors<const double>& host) {
    check_positions(host, sums.size());
    double* point = sums.points().data();
    double nothing = 0.0;  // x - x is 0, or not a number
    for (std::size_t i = 0; i < host.count; ++i, point += kernels::point_width) {
      const auto k = static_cast<std::ptrdiff_t>(i) * host.stride;
      const double x = host.x[k] / unit, y = host.y[k] / unit, z = host.z[k] / unit;
      nothing += (x - x) + (y - y) + (z - z);
      point[0] = x;
      point[1] = y;
      point[2] = z;
    }
    if (nothing != 0.0) name_what_is_not_finite(host);
  }

  void write(const Vectors<double>& host, bool add) const {
    const double* record = gradient.data();
    for (std::size_t i = 0; i < host.count; ++i, record += kernels::point_width) {
      const auto k = static_cast<std::ptrdiff_t>(i) * host.stride;
      // Of no force this makes 0, not -0.
      host.x[k] = (add ? host.x[k] : 0.0) - record[0] / unit;
      host.y[k] = (add ? host.y[k] : 0.0) - record[1] / unit;
      host.z[k] = (add ? host.z[k] : 0.0) - record[2] / unit;
    }
  }

  ListedEvaluation sum(const ListedOutputs& outputs) {
    if (outputs.stress) return with(sums.energy_and_stress(gradient));
    if (outputs.forces.x == nullptr) return {.energy = outputs.energy ? sums.energy() : 0.0};
    if (outputs.energy) return with(sums.energy_and_gradient(gradient));
    sums.gradient(gradient);
    return {};
  }

  static ListedEvaluation with(const kernels::PairOutput& out) {
    ListedEvaluation e{out.energy, out.virial, {}};
    std::copy(std::begin(out.virial_tensor), std::end(out.virial_tensor), e.virial_tensor.begin());
    return e;
  }

  PairModel model;
  Options options;
  double unit;  // of length inside
  HostListSums sums;
  std::vector<int> mapped{};
  AlignedArray gradient{}, energies{};
};

ListedPotential::ListedPotential(const Model& model) : ListedPotential(model, Options{}) {}
ListedPotential::ListedPotential(const Model& model, const Options& options)
    : implementation_(std::make_unique<Implementation>(model, options)) {}
ListedPotential::~ListedPotential() = default;
ListedPotential::ListedPotential(ListedPotential&&) noexcept = default;
ListedPotential& ListedPotential::operator=(ListedPotential&&) noexcept = default;

double ListedPotential::cutoff(std::size_t a, std::size_t b) const {
  const PairModel& model = implementation_->model;
  if (std::max(a, b) >= model.species.size())
    throw_bad_input(fmt::format("species {} is not allowed: model {} has {}, numbered from 0", std::max(a, b), model.name,
                                model.species.size()));
  return model.cutoff_of(model.pair(a, b));
}

void ListedPotential::set_lists(const ListsOfHost& lists) {
  Implementation& of = *implementation_;
  of.sums.set_lists({of.map(lists.species), lists.rows, lists.neighbours, lists.lengths, lists.mask});
}

std::size_t ListedPotential::points() const { return implementation_->sums.size(); }

ListedEvaluation ListedPotential::evaluate(const Vectors<const double>& positions, const ListedOutputs& outputs) {
  Implementation& of = *implementation_;
  if (outputs.forces.x != nullptr) check_forces(outputs.forces, points());
  if (!outputs.energies.empty()) check_room("energies", outputs.energies.size(), points());
  of.read(positions);
  if (!outputs.energies.empty()) {
    of.sums.energies(of.energies);
    std::copy(of.energies.begin(), of.energies.end(), outputs.energies.begin());
  }
  const ListedEvaluation result = of.sum(outputs);
  if (outputs.forces.x != nullptr) of.write(outputs.forces, outputs.add_to_forces);
  return result;
}

LANESCAPE_ABI_END
}  // namespace lanescape
