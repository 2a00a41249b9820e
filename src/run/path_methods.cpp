// The table of path methods: a new stepper is one function and one line here.

#include <fmt/format.h>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "landscape/hard_sphere_landscape.hpp"
#include "run/path_search.hpp"
#include "stepper/adaptive_contour.hpp"
#include "stepper/avoidance.hpp"
#include "stepper/away.hpp"
#include "stepper/contour.hpp"
#include "stepper/escape.hpp"
#include "stepper/slide.hpp"

namespace lanescape {
namespace {

std::unique_ptr<HardSphereLandscape> hard_landscape(const SearchSetup& setup) {
  return std::make_unique<HardSphereLandscape>(setup.pair.start.box, setup.prepared.layout, setup.pair.start.radii, setup.isa);
}

std::unique_ptr<PathSearch> begin_contour(const SearchSetup& setup) {
  auto landscape = path_landscape(setup);
  ContourStepper::Options options{.direct_step = setup.options.step_length(setup.model)};
  options.correction *= length_unit(setup.model);
  options.max_corrections = setup.options.max_trials.value_or(options.max_corrections);
  ContourStepper stepper(*landscape, setup.prepared.landscape_energy, options);
  return begin_search(setup, std::move(landscape), std::move(stepper));
}

std::unique_ptr<PathSearch> begin_adaptive_contour(const SearchSetup& setup) {
  auto landscape = path_landscape(setup);
  AdaptiveContourStepper stepper(*landscape, setup.prepared.landscape_energy, {.unit = length_unit(setup.model)});
  return begin_search(setup, std::move(landscape), std::move(stepper));
}

std::unique_ptr<PathSearch> begin_escape(const SearchSetup& setup) {
  auto landscape = path_landscape(setup);
  EscapeStepper::Options options{.direct_step = setup.options.step_length(setup.model)};
  options.tolerance = setup.options.escape_tolerance.value_or(options.tolerance);
  options.max_iterations = setup.options.max_trials.value_or(options.max_iterations);
  EscapeStepper stepper(*landscape, setup.prepared.landscape_energy, options);
  return begin_search(setup, std::move(landscape), std::move(stepper));
}

std::unique_ptr<PathSearch> begin_avoidance(const SearchSetup& setup) {
  auto landscape = hard_landscape(setup);
  AvoidanceStepper::Options options{.direct_step = setup.options.step_length(setup.model),
                                    .avoidance_step = setup.options.avoidance_step_length(setup.model),
                                    .potential = setup.options.fictitious};
  options.max_trials = setup.options.max_trials.value_or(options.max_trials);
  AvoidanceStepper stepper(*landscape, options);
  return begin_search(setup, std::move(landscape), std::move(stepper));
}

std::unique_ptr<PathSearch> begin_slide(const SearchSetup& setup) {
  const double unit = length_unit(setup.model);
  const SlideStepper::Options options{.largest_move = SlideStepper::Options{}.largest_move * unit, .unit = unit};
  auto landscape =
      std::make_unique<ContactLandscape>(setup.pair.start.box, setup.prepared.layout, setup.pair.start.radii, setup.prepared.metric,
                                         setup.isa, SlideStepper::reach(options), SlideStepper::skin(options));
  SlideStepper stepper(*landscape, options);
  return begin_search(setup, std::move(landscape), std::move(stepper));
}

std::unique_ptr<PathSearch> begin_away(const SearchSetup& setup) {
  auto landscape = hard_landscape(setup);
  AwayStepper::Options options;
  options.max_moves = setup.options.max_trials.value_or(options.max_moves);
  options.max_depth = setup.options.max_depth.value_or(options.max_depth);
  AwayStepper stepper(setup.pair.start.box, setup.prepared.layout, setup.pair.start.radii, *landscape, setup.goal(), options);
  return begin_search(setup, std::move(landscape), std::move(stepper));
}

// Avoidance makes long detours of short steps: it needs the most patience.
constexpr PathMethod methods[] = {{"contour", false, 1e-3, 1, begin_contour, begin_adaptive_contour},
                                  {"escape", false, 1e-3, 1, begin_escape, nullptr},
                                  {"avoidance", true, 1e-2, 1000, begin_avoidance, begin_slide},
                                  {"away", true, {}, 10, begin_away, nullptr}};

template <class Wanted>
std::string words_of(Wanted wanted, std::string_view separator) {
  std::string words;
  for (const PathMethod& method : methods)
    if (wanted(method)) words += fmt::format("{}{}", words.empty() ? "" : separator, method.word);
  return words;
}

}  // namespace

std::span<const PathMethod> path_methods() { return methods; }

const PathMethod& default_path_method(bool is_hard) {
  for (const PathMethod& method : methods)
    if (method.is_hard == is_hard) return method;
  throw Error(ErrorCode::internal, "a family of models has no path method");
}

const PathMethod& path_method(std::string_view word) {
  for (const PathMethod& method : methods)
    if (word == method.word) return method;
  throw_bad_input(fmt::format("unknown method '{}': allowed are {} (soft particles), {} (hard spheres)", word,
                              path_method_words(false), path_method_words(true)));
}

std::string path_method_words(bool is_hard, std::string_view separator) {
  return words_of([&](const PathMethod& method) { return method.is_hard == is_hard; }, separator);
}

std::string adaptive_method_words() {
  return words_of([](const PathMethod& method) { return method.begin_adaptive != nullptr; }, ", ");
}

void check_adaptive(const PathMethod& method) {
  if (method.begin_adaptive == nullptr)
    throw_bad_input(
        fmt::format("method {} has no adaptive steps: methods that have them are {}", method.word, adaptive_method_words()));
}

void check_method(const PathMethod& method, const AnyModel& model) {
  if (method.is_hard == is_hard(model)) return;
  throw_bad_input(fmt::format("method {} is not for model {}: {} are for soft particles, {} for hard spheres", method.word,
                              mixture_of(model).name, path_method_words(false, " and "), path_method_words(true, " and ")));
}

}  // namespace lanescape
