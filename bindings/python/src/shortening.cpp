#include <lanescape/shortening.hpp>

#include "module.hpp"
#include "options.hpp"
#include "python_landscape.hpp"

namespace lanescape::python {
namespace {

ShortPathObject to_python(const ShortPath& path) {
  nb::dict members;
  members["outcome"] = path.outcome;
  members["reason"] = path.reason;
  members["length_before"] = path.length_before;
  members["length"] = path.length;
  members["distance"] = path.distance;
  members["ratio_squared"] = path.ratio_squared;
  members["landscape_energy"] = path.landscape_energy;
  members["largest_violation"] = path.largest_violation;
  members["kuhn_tucker_residual"] = path.kuhn_tucker_residual;
  members["multipliers"] = path.kuhn_tucker_residual ? nb::object(new_list(path.multipliers)) : nb::object(nb::none());
  members["start_lengths"] = new_list(path.start_lengths);
  members["evaluations"] = path.evaluations;
  members["seconds"] = path.seconds;
  members["frames"] = frames_of(path.frames);
  return new_result<ShortPathObject>(members);
}

PathCertificateObject to_python(const PathCertificate& certificate) {
  nb::dict members;
  members["length"] = certificate.length;
  members["distance"] = certificate.distance;
  members["ratio_squared"] = certificate.ratio_squared;
  members["landscape_energy"] = certificate.landscape_energy;
  members["largest_violation"] = certificate.largest_violation;
  members["kuhn_tucker_residual"] = certificate.kuhn_tucker_residual;
  members["multipliers"] = new_list(certificate.multipliers);
  members["excess"] = new_list(certificate.excess);
  members["segment_violation"] = new_list(certificate.segment_violation);
  return new_result<PathCertificateObject>(members);
}

ShortenSettings shorten_settings_of(const nb::dict& given) {
  const Options options(given, "shorten_path");
  ShortenSettings settings;
  options.take("method", settings.method);
  options.take("starts", settings.starts);
  options.take("seed", settings.seed);
  settings.search = path_settings_of(options, "path_method");
  return settings;
}

CheckSettings check_settings_of(const nb::dict& given) {
  const Options options(given, "check_path");
  CheckSettings settings;
  options.take("landscape_energy", settings.landscape_energy);
  options.take("threads", settings.threads);
  threads_of(settings.threads);
  options.take("instruction_set", settings.instruction_set);
  return settings;
}

// None: no frames.
std::vector<std::vector<double>> path_to_shorten(ArrayLike given) {
  std::vector<std::vector<double>> path = Numbers::frames(given, "path").parts();
  if (path.empty() && !given.is_none())
    throw Error(ErrorCode::bad_input, "path: no frames were given: at least 3 are needed, or None");
  return path;
}

ShortPathObject shortened_of_model(const Model& model, ArrayLike start, ArrayLike finish, ArrayLike frames, ArrayLike species,
                                   ArrayLike box, ArrayLike diameters, const nb::dict& options) {
  const Numbers from = Numbers::vectors(start, "start"), to = Numbers::vectors(finish, "finish");
  const std::vector<std::vector<double>> path = path_to_shorten(frames);
  const std::vector<int> indices = species_of(model, species, from.rows());
  const Numbers sizes = Numbers::list(diameters, "diameters");
  const auto edges = box_of(box);
  const ShortenSettings settings = shorten_settings_of(options);
  ShortPath shortened;
  {
    const nb::gil_scoped_release others_may_run;
    shortened = shorten_path(model, indices, edges, from.values(), to.values(), settings, sizes.values(), path);
  }
  return to_python(shortened);
}

ShortPathObject shortened_on_landscape(nb::handle landscape, ArrayLike start, ArrayLike finish, ArrayLike frames, ArrayLike masses,
                                       const nb::dict& options) {
  const Numbers from = Numbers::vectors(start, "start"), to = Numbers::vectors(finish, "finish");
  const std::vector<std::vector<double>> path = path_to_shorten(frames);
  const Numbers weights = Numbers::list(masses, "masses");
  const HeldLandscape held(landscape, from.rows());
  const ShortenSettings settings = shorten_settings_of(options);
  Lock search;
  return to_python(unlocked(
      search, held, [&] { return shorten_path(*held.landscape, from.values(), to.values(), settings, weights.values(), path); }));
}

// Of the particles of each frame.
std::size_t particles_in(const std::vector<std::vector<double>>& path) { return path.empty() ? 0 : path.front().size() / 3; }

PathCertificateObject checked_of_model(const Model& model, ArrayLike frames, ArrayLike species, ArrayLike box, ArrayLike diameters,
                                       const nb::dict& options) {
  const std::vector<std::vector<double>> path = Numbers::frames(frames, "path").parts();
  const std::vector<int> indices = species_of(model, species, particles_in(path));
  const Numbers sizes = Numbers::list(diameters, "diameters");
  const auto edges = box_of(box);
  const CheckSettings settings = check_settings_of(options);
  PathCertificate certificate;
  {
    const nb::gil_scoped_release others_may_run;
    certificate = check_path(model, indices, edges, path, settings, sizes.values());
  }
  return to_python(certificate);
}

PathCertificateObject checked_on_landscape(nb::handle landscape, ArrayLike frames, ArrayLike masses, const nb::dict& options) {
  const std::vector<std::vector<double>> path = Numbers::frames(frames, "path").parts();
  const Numbers weights = Numbers::list(masses, "masses");
  const HeldLandscape held(landscape, particles_in(path));
  const CheckSettings settings = check_settings_of(options);
  Lock check;
  return to_python(unlocked(check, held, [&] { return check_path(*held.landscape, path, settings, weights.values()); }));
}

}  // namespace

void bind_shortening(nb::module_& module) {
  using namespace nb::literals;
  module.def("short_path_of_model", &shortened_of_model, "model"_a, "start"_a, "finish"_a, "path"_a.none(), "species"_a.none(),
             "box"_a, "diameters"_a.none(), "options"_a);
  module.def("short_path_on_landscape", &shortened_on_landscape, "landscape"_a, "start"_a, "finish"_a, "path"_a.none(),
             "masses"_a.none(), "options"_a);
  module.def("certificate_of_model", &checked_of_model, "model"_a, "path"_a, "species"_a.none(), "box"_a, "diameters"_a.none(),
             "options"_a);
  module.def("certificate_on_landscape", &checked_on_landscape, "landscape"_a, "path"_a, "masses"_a.none(), "options"_a);
}

}  // namespace lanescape::python
