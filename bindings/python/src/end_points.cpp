#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <lanescape/dynamics.hpp>

#include <string>

#include "arguments.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

StartObject start(const Model& model, std::size_t particles, double density, std::uint64_t seed) {
  Start made;
  {
    const nb::gil_scoped_release others_may_run;
    made = make_start(model, particles, density, seed);
  }
  const std::vector<std::int64_t> species(made.species.begin(), made.species.end());
  nb::dict members;
  members["species"] = new_list(species);
  members["positions"] = new_vectors(made.positions);
  members["box"] = new_list(made.box);
  members["diameters"] = new_list_or_none(made.diameters);
  return new_result<StartObject>(members);
}

nb::typed<nb::list, EndPointsObject> end_points(const Model& model, nb::handle start, double temperature, double distance,
                                                std::size_t pairs, bool quick, std::uint64_t equilibration, std::uint64_t between,
                                                std::uint64_t seed, int threads, const std::string& precision,
                                                const std::string& instruction_set, nb::object progress) {
  const Numbers positions = Numbers::vectors(start.attr("positions"), "positions of the start");
  const Start begin{species_of(model, start.attr("species"), positions.rows()), positions.copy(), box_of(start.attr("box")),
                    Numbers::list(start.attr("diameters"), "diameters of the start").copy()};
  const EndPointSettings settings{
      temperature,          distance, pairs, quick, equilibration, between, seed, threads_of(threads), precision, instruction_set,
      progress_of(progress)};
  std::vector<EndPoints> made;
  {
    const nb::gil_scoped_release others_may_run;
    made = make_end_points(model, begin, settings);
  }
  nb::typed<nb::list, EndPointsObject> results;
  for (const EndPoints& pair : made) {
    nb::dict members;
    members["start"] = new_vectors(pair.start);
    members["finish"] = new_vectors(pair.finish);
    members["distance"] = pair.distance;
    members["steps"] = pair.steps;
    members["time"] = pair.time;
    results.append(new_result<EndPointsObject>(members));
  }
  return results;
}

}  // namespace

void bind_end_points(nb::module_& module) {
  using namespace nb::literals;
  module.def(
      "make_start", &start, "model"_a, "particles"_a, "density"_a, "seed"_a = 1,
      "A Start: a lattice at a number density, species at random in the model's proportions. For hard spheres a packing fraction\n"
      "takes the place of the density.\n\nRaises InputError.");
  module.def(
      "make_end_points", &end_points, "model"_a, "start"_a, nb::kw_only(), "temperature"_a = 1.0, "distance"_a = 0.0, "pairs"_a = 1,
      "quick"_a = false, "equilibration"_a = 0, "between"_a = 0, "seed"_a = 1, "threads"_a = 1, "precision"_a = "double",
      "instruction_set"_a = "auto", "progress"_a = nb::none(),
      "A list of EndPoints: two configurations of one trajectory each. Melts, cools, checks the temperature, settles and follows "
      "the\n"
      "trajectory over a distance in 3N space (0: 108 at N = 108, else 10 sqrt(N), in the model's unit of length); hard spheres:\n"
      "equilibrates and follows. start: a Start. equilibration: steps of each stage, or collisions; between: from one pair to the\n"
      "next; 0 stands for the library's own, `quick` for shorter ones. progress: called now and then with the part done; False "
      "ends\n"
      "the work.\n\nRaises InputError, RunError if the temperature does not hold or the distance is not reached, and "
      "InterruptedRunError\n"
      "if `progress` ended the work.");
}

}  // namespace lanescape::python
