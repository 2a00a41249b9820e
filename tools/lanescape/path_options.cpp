#include "path_options.hpp"

#include <fmt/format.h>

#include <string_view>

#include "configuration/model_traits.hpp"

namespace lanescape::program {
namespace {

// Options that depend on the method.
constexpr Scope direct_steps_of_a_length{"direct steps",
                                         "faithful contour, escape and avoidance: other steps have no given length"};
constexpr Scope collision_avoidance{"method", "faithful method avoidance"}, escape_steps{"method", "method escape"},
    away_steps{"method", "method away"};
constexpr Scope faithful_steps{"stepping", "faithful steps"};

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
  options.add("--patience", patience_, "steps without progress until a path is stalled, times 1000 for avoidance, 10 for away");
  options
      .add("--max-trials", max_trials_,
           "of one detour until a path is stalled: corrections of contour [100000], iterations of escape [10000], trials of "
           "avoidance "
           "[10000], moves of single spheres of away [100000]")
      .only_for({faithful_steps});
  options.add("--escape-tolerance", escape_tolerance_, "dV: escape steps end where V <= E_L + dV [epsilon] [0.0001]")
      .only_for({escape_steps});
  options.add("--max-depth", max_depth_, "spheres that push one another in an away step until the path is stalled [2000]")
      .only_for({away_steps});
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
  options.escape_tolerance = escape_tolerance_;
  options.max_trials = max_trials_;
  options.max_depth = max_depth_;
  options.finder.max_steps = max_steps_;
  options.finder.patience = patience_;
  options.finder.frames = frames;
  options.threads = threads;
  options.precision = precision;
  return options;
}

RunKinds PathOptions::kinds(const PathRunOptions& options) const {
  const std::string with = fmt::format("with method {}{}", options.method->word, adaptive_ ? " and --adaptive" : "");
  const std::string_view word = options.method->word;
  const bool faithful = options.stepping == Stepping::faithful;
  const Scope method = faithful && word == "avoidance" ? collision_avoidance
                       : word == "escape"              ? escape_steps
                       : word == "away"                ? away_steps
                                                       : Scope{"method", ""};
  return {RunKind{method, with}, kind_if(faithful, faithful_steps, with, with),
          kind_if(options.has_step_length(), direct_steps_of_a_length, with, with)};
}

void PathOptions::settle(const PathRunOptions& options, const AnyModel& model) {
  options.check(model);
  method_ = options.method->word;
  if (options.has_step_length()) step_ = options.step_length(model);
}

}  // namespace lanescape::program
