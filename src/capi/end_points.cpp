#include <lanescape/dynamics.hpp>

#include "capi/arguments.hpp"
#include "capi/callbacks.hpp"
#include "capi/model.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_end_points : Handle<std::vector<EndPoints>> {};

namespace {

EndPointSettings settings_of(const lanescape_end_point_settings* given) {
  EndPointSettings settings;
  if (given == nullptr) return settings;
  const auto& s = sized(given, "settings", "lanescape_end_point_settings");
  settings.temperature = s.temperature;
  settings.distance = s.distance;
  settings.pairs = s.pairs;
  settings.quick = s.quick != 0;
  settings.equilibration = s.equilibration;
  settings.between = s.between;
  settings.seed = s.seed;
  settings.threads = s.threads;
  settings.precision = word(s.precision, settings.precision.c_str());
  settings.instruction_set = word(s.instruction_set, settings.instruction_set.c_str());
  settings.progress = progress_of(s.progress, s.progress_user);
  return settings;
}

template <class Number>
std::vector<std::remove_const_t<Number>> copied(std::span<Number> numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace

lanescape_status lanescape_make_start(const lanescape_model* model, size_t particles, double density, uint64_t seed, int* species,
                                      double* positions, double box[3], double* diameters) {
  return guarded([&] {
    array(species, particles, "species");
    array(positions, times(3, particles), "positions");
    given(box, "box");
    const Start start = make_start(object_of(model, "model").model, particles, density, seed);
    copy_out(start.species, species);
    copy_out(start.positions, positions);
    copy_out(start.box, box);
    copy_out(start.diameters, diameters);
  });
}

lanescape_status lanescape_end_point_settings_init(lanescape_end_point_settings* settings, size_t size) {
  return guarded([&] {
    const EndPointSettings own;
    lanescape_end_point_settings presets{};
    presets.temperature = own.temperature;
    presets.distance = own.distance;
    presets.pairs = own.pairs;
    presets.equilibration = own.equilibration;
    presets.between = own.between;
    presets.seed = own.seed;
    presets.threads = own.threads;
    initialise(settings, size, "settings", "lanescape_end_point_settings", presets);
  });
}

lanescape_status lanescape_make_end_points(const lanescape_model* model, size_t particles, const int* species,
                                           const double* positions, const double box[3], const double* diameters,
                                           const lanescape_end_point_settings* settings, lanescape_end_points** ends) {
  return guarded([&] {
    create(ends, "ends", [&] {
      const Start start{copied(array(species, particles, "species")), copied(vectors(positions, particles, "positions")),
                        three(box, "box"), copied(optional_array(diameters, particles, "diameters"))};
      return make_end_points(object_of(model, "model").model, start, settings_of(settings));
    });
  });
}

lanescape_status lanescape_end_points_count(const lanescape_end_points* ends, size_t* pairs) {
  return guarded([&] { given(pairs, "pairs") = object_of(ends, "ends").size(); });
}

lanescape_status lanescape_end_points_get(const lanescape_end_points* ends, size_t pair, double* start, double* finish,
                                          double* distance, uint64_t* steps, double* time) {
  return guarded([&] {
    const auto& pairs = object_of(ends, "ends");
    if (pair >= pairs.size())
      refuse("pair " + std::to_string(pair) + " is not allowed: there are " + std::to_string(pairs.size()) + ", numbered from 0");
    const EndPoints& one = pairs[pair];
    copy_out(one.start, start);
    copy_out(one.finish, finish);
    if (distance != nullptr) *distance = one.distance;
    if (steps != nullptr) *steps = one.steps;
    if (time != nullptr) *time = one.time;
  });
}

lanescape_status lanescape_end_points_destroy(lanescape_end_points* ends) { return destroy(ends, "ends"); }
