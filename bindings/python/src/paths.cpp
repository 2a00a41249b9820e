#include <lanescape/path.hpp>

#include "module.hpp"
#include "options.hpp"
#include "python_landscape.hpp"

namespace lanescape::python {

PathSettings path_settings_of(const Options& options, const char* method) {
  PathSettings settings;
  options.take(method, settings.method);
  options.take("adaptive", settings.adaptive);
  options.take("step", settings.step);
  options.take("avoidance_step", settings.avoidance_step);
  options.take("fictitious", settings.fictitious);
  options.take("landscape_energy", settings.landscape_energy);
  options.take("reverse", settings.reverse);
  options.take("max_steps", settings.max_steps);
  options.take("patience", settings.patience);
  options.take("frames", settings.frames);
  options.take("threads", settings.threads);
  threads_of(settings.threads);
  options.take("precision", settings.precision);
  options.take("instruction_set", settings.instruction_set);
  settings.progress = progress_of(options.at("progress"));
  return settings;
}

Array frames_of(const std::vector<std::vector<double>>& frames) {
  std::vector<double> numbers;
  for (const auto& frame : frames) numbers.insert(numbers.end(), frame.begin(), frame.end());
  const std::size_t count = frames.size();
  return new_array(std::span<const double>(numbers), {count, count == 0 ? 0 : numbers.size() / count / 3, 3});
}

namespace {

PathObject to_python(const Path& path) {
  nb::dict members;
  members["outcome"] = path.outcome;
  members["reason"] = path.reason;
  members["length"] = path.length;
  members["distance"] = path.distance;
  members["ratio_squared"] = path.ratio_squared;
  members["participation_ratio"] = path.participation_ratio;
  members["direct_steps"] = path.direct_steps;
  members["detour_steps"] = path.detour_steps;
  members["evaluations"] = path.evaluations;
  members["landscape_energy"] = path.landscape_energy;
  members["largest_violation"] = path.largest_violation;
  members["reversed"] = path.reversed;
  members["seconds"] = path.seconds;
  members["frames"] = frames_of(path.frames);
  return new_result<PathObject>(members);
}

PathObject on_model(const Model& model, ArrayLike start, ArrayLike finish, ArrayLike species, ArrayLike box, ArrayLike diameters,
                    const nb::dict& options) {
  const Numbers from = Numbers::vectors(start, "start"), to = Numbers::vectors(finish, "finish");
  const std::vector<int> indices = species_of(model, species, from.rows());
  const Numbers sizes = Numbers::list(diameters, "diameters");
  const auto edges = box_of(box);
  const PathSettings settings = path_settings_of({options, "find_path"}, "method");
  Path path;
  {
    const nb::gil_scoped_release others_may_run;
    path = find_path(model, indices, edges, from.values(), to.values(), settings, sizes.values());
  }
  return to_python(path);
}

PathObject on_landscape(nb::handle landscape, ArrayLike start, ArrayLike finish, ArrayLike masses, const nb::dict& options) {
  const Numbers from = Numbers::vectors(start, "start"), to = Numbers::vectors(finish, "finish");
  const Numbers weights = Numbers::list(masses, "masses");
  const HeldLandscape held(landscape, from.rows());
  const PathSettings settings = path_settings_of({options, "find_path"}, "method");
  Lock search;
  return to_python(
      unlocked(search, held, [&] { return find_path(*held.landscape, from.values(), to.values(), settings, weights.values()); }));
}

}  // namespace

void bind_paths(nb::module_& module) {
  using namespace nb::literals;
  module.def("path_of_model", &on_model, "model"_a, "start"_a, "finish"_a, "species"_a.none(), "box"_a, "diameters"_a.none(),
             "options"_a);
  module.def("path_on_landscape", &on_landscape, "landscape"_a, "start"_a, "finish"_a, "masses"_a.none(), "options"_a);
}

}  // namespace lanescape::python
