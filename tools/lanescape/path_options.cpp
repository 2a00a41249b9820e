#include "path_options.hpp"

#include <fmt/format.h>

#include <string_view>

#include "configuration/model_traits.hpp"

namespace lanescape::program {
namespace {

// Options that depend on the method.
constexpr Scope direct_steps_of_a_length{"direct steps",
                                         "faithful contour, escape and avoidance: other steps have no given length"};
constexpr Scope collision_avoidance{"method", "faithful method avoidance"};

}  // namespace

void PathOptions::add_to(Options& options, const std::string& method_option) {
  options.add(method_option, method_,
              fmt::format("{}; {} for hard spheres [{}, {}]", path_method_words(false, " or "), path_method_words(true, " or "),
                          default_path_method(false).word, default_path_method(true).word));
  options.add_synonym_of_default("--faithful", "steps exactly as published (the default)");
  options
      .add_flag("--adaptive", adaptive_,
                fmt::format("few long steps, as far as their error allows, of hard spheres along contacts: methods {}",
                            adaptive_method_words()))
      .excludes("--faithful");
  options.add("--step", step_, "length of a direct step in 3N space [sigma] [0.001; hard spheres 0.01; see FORMATS.md, Units]")
      .only_for({direct_steps_of_a_length});
  options.add("--avoidance-step", avoidance_step_, "of each particle that moves in a collision-avoidance step [sigma] [0.0001]")
      .only_for({collision_avoidance});
  options.add("--fictitious", fictitious_, "potential between overlapping spheres: harmonic, linear or cubic [harmonic]")
      .only_for({collision_avoidance});
  options.add("--landscape-energy", landscape_energy_, "E_L [the higher energy of the two end points]").only_for({soft_models});
  options.add("--max-steps", max_steps_, "steps of one path before giving up");
}

PathRunOptions PathOptions::run_options(const AnyModel& model, int threads, Precision precision) const {
  PathRunOptions options;
  options.method = method_ ? &path_method(*method_) : &default_path_method(is_hard(model));
  check_method(*options.method, model);
  options.stepping = adaptive_ ? Stepping::adaptive : Stepping::faithful;
  options.direct_step = step_;
  options.avoidance_step = avoidance_step_;
  if (fictitious_) options.fictitious = parse_contact_potential(*fictitious_);
  options.landscape_energy = landscape_energy_;
  options.finder.max_steps = max_steps_;
  options.finder.frames = frames;
  options.threads = threads;
  options.precision = precision;
  return options;
}

RunKinds PathOptions::kinds(const PathRunOptions& options) const {
  const std::string with = fmt::format("with method {}{}", options.method->word, adaptive_ ? " and --adaptive" : "");
  const bool avoids = options.stepping == Stepping::faithful && options.method->word == std::string_view("avoidance");
  return {kind_if(avoids, collision_avoidance, with, with),
          kind_if(options.has_step_length(), direct_steps_of_a_length, with, with)};
}

void PathOptions::settle(const PathRunOptions& options, const AnyModel& model) {
  options.check(model);
  method_ = options.method->word;
  if (options.has_step_length()) step_ = options.step_length(model);
}

}  // namespace lanescape::program
