#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <lanescape/path.hpp>

#include <optional>
#include <string>

#include "arguments.hpp"
#include "module.hpp"
#include "python_landscape.hpp"

namespace lanescape::python {
namespace {

Array frames_of(const Path& path) {
  std::vector<double> numbers;
  for (const auto& frame : path.frames) numbers.insert(numbers.end(), frame.begin(), frame.end());
  const std::size_t frames = path.frames.size();
  return new_array(std::span<const double>(numbers), {frames, frames == 0 ? 0 : numbers.size() / frames / 3, 3});
}

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
  members["frames"] = frames_of(path);
  return new_result<PathObject>(members);
}

PathSettings settings_of(const nb::dict& given) {
  PathSettings settings;
  const auto take = [&](const char* name, auto& member) {
    if (given.contains(name) && !nb::try_cast(nb::object(given[name]), member))
      throw nb::type_error((std::string("find_path: ") + name + " cannot be " + text(nb::repr(nb::object(given[name])))).c_str());
  };
  take("method", settings.method);
  take("adaptive", settings.adaptive);
  take("step", settings.step);
  take("avoidance_step", settings.avoidance_step);
  take("fictitious", settings.fictitious);
  take("landscape_energy", settings.landscape_energy);
  take("reverse", settings.reverse);
  take("max_steps", settings.max_steps);
  take("patience", settings.patience);
  take("frames", settings.frames);
  take("threads", settings.threads);
  threads_of(settings.threads);
  take("precision", settings.precision);
  take("instruction_set", settings.instruction_set);
  settings.progress = progress_of(given.contains("progress") ? nb::object(given["progress"]) : nb::none());
  return settings;
}

PathObject on_model(const Model& model, ArrayLike start, ArrayLike finish, ArrayLike species, ArrayLike box, ArrayLike diameters,
                    const nb::dict& options) {
  const Numbers from = Numbers::vectors(start, "start"), to = Numbers::vectors(finish, "finish");
  const std::vector<int> indices = species_of(model, species, from.rows());
  const Numbers sizes = Numbers::list(diameters, "diameters");
  const auto edges = box_of(box);
  const PathSettings settings = settings_of(options);
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
  const PathSettings settings = settings_of(options);
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
