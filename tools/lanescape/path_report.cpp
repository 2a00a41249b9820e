#include "path_report.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <map>
#include <string>

#include "configuration/model_traits.hpp"
#include "io/extended_xyz.hpp"
#include "run/path_file.hpp"

namespace lanescape::program {
namespace {

void write_histograms(std::ostream& out, const PathResult& path) {
  out << "quantity,value,steps\n";
  for (const StepHistogram& h : path.histograms)
    for (std::size_t k = 0; k < h.counts.size(); ++k)
      if (h.counts[k] > 0.0)
        fmt::print(out, "{},{:.10g},{}\n", h.quantity, h.first + static_cast<double>(k) * h.width, h.counts[k]);
}

void write_particles(std::ostream& out, const PathResult& path, const Mixture& model) {
  out << "particle,species,path_length,displacement\n";
  for (std::size_t j = 0; j < path.particle_lengths.size(); ++j)
    fmt::print(out, "{},{},{},{}\n", j, model.species[static_cast<std::size_t>(path.frames.front().species[j])].name,
               path.particle_lengths[j], path.particle_displacements[j]);
}

}  // namespace

Json path_json(const PathResult& path, const PathMethod& method, const Mixture& mixture) {
  const auto particles = static_cast<double>(path.frames.front().size());
  const bool complete = path.outcome == Outcome::reached;
  Json json;
  json["outcome"] = to_string(path.outcome);
  if (!path.reason.empty()) json["reason"] = path.reason;
  json["length"] = path.length;
  json["distance"] = path.distance;
  json["ratio_squared"] = complete ? Json(path.ratio_squared()) : Json();
  json["participation_ratio"] = path.participation_number / particles;
  json["steps"] = {{"direct", path.direct_steps}, {method.word, path.detour_steps}};
  json["lengths"] = {{"direct", path.direct_length}, {method.word, path.detour_length}};
  json["corrections"] = path.corrections;
  json["evaluations"] = path.evaluations;
  json["seconds"] = path.seconds;
  json["landscape_energy"] = method.is_hard ? Json() : Json(path.landscape_energy);
  json["largest_violation"] = path.largest_violation;
  for (const StepHistogram& h : path.histograms) json["mean_over_steps"][h.quantity] = h.mean();
  for (std::size_t s = 0; complete && s < path.heterogeneity.size(); ++s)
    json["heterogeneity"][mixture.species[s].name] = path.heterogeneity[s];
  json["reversed"] = path.reversed;
  return json;
}

void add_system(Json& json, const SystemOptions& system, const AnyModel& model, std::optional<double> radius_factor, Isa isa) {
  json["model"] = mixture_of(model).name;
  if (!is_hard(model))
    json["images"] = to_string(traits_of(model).images);
  else if (radius_factor)
    json["radius_factor"] = *radius_factor;
  json["isa"] = to_string(isa);
  if (traits_of(model).has_precision) json["precision"] = to_string(system.resolve_precision());
}

void write_path_files(OutputFolder& folder, std::size_t number, const PathResult& path, const Mixture& mixture) {
  const std::string name = fmt::format("path-{:04}", number + 1);
  folder.write(name + ".extxyz", [&](std::ostream& out) {
    std::map<std::string, std::string> info;
    if (path.frames.front().radii.empty()) info[landscape_energy_key] = fmt::format("{}", path.landscape_energy);
    for (const Configuration& frame : path.frames) write_frame(out, frame, mixture, info);
  });
  folder.write(name + "-steps.csv", [&](std::ostream& out) { write_histograms(out, path); });
  folder.write(name + "-particles.csv", [&](std::ostream& out) { write_particles(out, path, mixture); });
}

}  // namespace lanescape::program
