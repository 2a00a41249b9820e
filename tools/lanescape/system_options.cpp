#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/available_threads.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "interaction/sphere/rounding_overlaps.hpp"
#include "interaction/state/state_mixture.hpp"
#include "io/extended_xyz.hpp"
#include "io/model_file.hpp"
#include "program.hpp"
#include "resume_or_start.hpp"

namespace lanescape::program {

void CommonOptions::add_to(Options& options) {
  threads = default_threads();
  options.add("--seed", seed, "seed of all random numbers");
  options.add("--threads", threads, "threads; default OMP_NUM_THREADS, else the processors that this process may use");
  options.add("--isa", isa, "instruction set: auto, sse2, avx2, avx512; wins over LANESCAPE_ISA");
  options.add_unsaved("--quiet", quiet, "no progress bar, no messages");
  options.add_unsaved("--config", config, "run file (TOML) with any of these options; flags win");
  options.add_unsaved("--out", out, "folder for all files; without it none is written");
  options.add_unsaved("--resume", resume, "folder of an interrupted run (exit status 4) to continue");
  options.add_unsaved("--resume-or-start", resume_or_start,
                      "the same, or where it holds no run yet the folder to start one in; does nothing to a finished one");
  for (const char* other : {"--out", "--resume"}) options.exclude("--resume-or-start", other);
}

Isa CommonOptions::resolve_isa() {
  try {
    const Isa chosen = choose_isa(isa);
    isa = to_string(chosen);
    return chosen;
  } catch (const Error& error) {
    if (resume.empty()) throw;
    // With another one the results would have other bits.
    throw_bad_input(fmt::format("{}/run.toml: {}: a run goes on only with the one it began with", resume, error.what()));
  }
}

void CommonOptions::check() const {
  if (threads < 1 || threads > 4096) throw_bad_input(fmt::format("--threads: {} is not allowed: from 1 to 4096", threads));
}

RunKind CommonOptions::folder_kind() const {
  return kind_if(!out.empty() || !resume.empty(), runs_with_a_folder, "with --out", "without --out");
}

namespace {

constexpr Scope generated_starts{"particles", "runs that generate their particles, without a file of them"};
constexpr Scope named_models{"model", "runs without a model file, or with one of kind ucg"};

}  // namespace

void SystemOptions::add_to(Options& options) {
  options.add("--model", model, fmt::format("{}", fmt::join(known_models(), ", "))).only_for({named_models});
  options.add("--model-file", model_file, "model file (TOML) instead of --model; of kind ucg with --model ucg");
  options.begin_group({soft_models});
  options.add("--cutoff", cutoff, "cutoff of a soft model in units of sigma_ab; of ucg in sigma [2.5]");
  options.add("--images", images, "periodic images of a soft model: all within the cutoff, or the minimum image only [all]");
  options.add("--truncation", truncation, "of a soft model: shifted, plain, tail, shifted-force or smooth [shifted]");
  options.add("--composition", composition, "of a soft model's generated starts: fractions of the species, 0.65,0.35")
      .only_for({generated_starts});
  options.add("--precision", precision, "of a soft model's pairs: double, or mixed: single with sums in double [double]");
  options.end_group();
}

RunKinds SystemOptions::kinds(const AnyModel& resolved, bool generates_start) const {
  const std::string with = fmt::format("with model {}", mixture_of(resolved).name);
  return {{is_hard(resolved) ? hard_spheres : soft_models, with},
          kind_if(generates_start, generated_starts, "without a file of particles", "with a file of particles"),
          kind_if(model_file.empty() || model == "ucg", named_models, "with --model", "with --model-file")};
}

namespace {

// Refuses a model file of another kind than the name given with it.
AnyModel read_named(const std::string& file, const std::string& name) {
  AnyModel model = read_model_file(file);
  if (name == "ucg" && !traits_of(model).has_states)
    throw_bad_input(fmt::format("--model ucg: {} is of another kind: a model file of kind ucg is needed", file));
  return model;
}

// Refuses the options that were given, which this model does not have.
void refuse_options(std::initializer_list<std::pair<const char*, bool>> given, const Mixture& model, const char* why) {
  for (const auto& [option, is_given] : given)
    if (is_given) throw_bad_input(fmt::format("{} is not allowed with model {}: {}", option, model.name, why));
}

std::vector<Species> with_fractions(std::vector<Species> species, const std::string& list) {
  std::vector<double> fractions;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');)
    fractions.push_back(number_in(word).value_or(std::numeric_limits<double>::quiet_NaN()));
  const double sum = std::accumulate(fractions.begin(), fractions.end(), 0.0);
  const bool in_range = std::all_of(fractions.begin(), fractions.end(), [](double f) { return f >= 0.0 && f <= 1.0; });
  if (fractions.size() != species.size() || !in_range || std::abs(sum - 1.0) > 1e-9)
    throw_bad_input(
        fmt::format("--composition: {} is not allowed: {} numbers from 0 to 1 with the sum 1 are needed, separated by commas", list,
                    species.size()));
  for (std::size_t s = 0; s < species.size(); ++s) species[s].fraction = fractions[s];
  return species;
}

}  // namespace

AnyModel SystemOptions::resolve() const {
  AnyModel resolved = model_file.empty() ? named_model(model) : read_named(model_file, model);
  std::visit(
      Overloaded{
          [&](PairModel& soft) {
            if (cutoff) soft.cutoff = *cutoff;
            if (images) soft.images = parse_image_rule(*images);
            if (truncation) soft.truncation = parse_truncation(*truncation);
            if (composition) soft.species = with_fractions(std::move(soft.species), *composition);
            soft.check();
            resolve_precision();
          },
          [&](StateMixtureModel& states) {
            refuse_options({{"--images", images && parse_image_rule(*images) != ImageRule::all}}, states, "all images count");
            refuse_options({{"--truncation", truncation && parse_truncation(*truncation) != Truncation::shifted}}, states,
                           "its potentials are shifted");
            refuse_options({{"--composition", composition.has_value()}}, states, "a model file gives the fractions of its species");
            refuse_options({{"--precision", resolve_precision() != Precision::double_precision}}, states, "double precision only");
            if (cutoff) states.cutoff = *cutoff;
            states.check();
          },
          [](HardSphereModel&) {}},
      resolved);
  return resolved;
}

Precision SystemOptions::resolve_precision() const { return parse_precision(precision.value_or("double")); }

void SystemOptions::check_precision_in(const AnyModel& model, const Box& box, double skin) const {
  std::visit(Overloaded{[&](const PairModel& soft) { check_precision(soft, box, resolve_precision(), skin); },
                        [](const HardSphereModel&) {}, [](const StateMixtureModel&) {}},
             model);
}

namespace {

// The model if it is of the kind wanted; refuses every other kind.
template <class Wanted>
Wanted only(const AnyModel& resolved, const char* subcommand, const char* allowed) {
  return std::visit(Overloaded{[](const Wanted& model) { return model; },
                               [&](const Mixture& other) -> Wanted {
                                 throw_bad_input(fmt::format("{}: model {} is made of {}: {}", subcommand, other.name,
                                                             traits_of(resolved).particles, allowed));
                               }},
                    resolved);
}

}  // namespace

PairModel SystemOptions::resolve_pair_model(const char* subcommand) const {
  return only<PairModel>(resolve(), subcommand, "allowed are models of pair potentials, kob-andersen, lennard-jones and others");
}

StateMixtureModel SystemOptions::resolve_state_mixture(const char* subcommand) const {
  return only<StateMixtureModel>(resolve(), subcommand, "a model of kind ucg is needed");
}

void check_separations_in(const std::string& file, const Configuration& configuration, const AnyModel& model) {
  try {
    check_soft_separations(configuration, model);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", file, error.what()));
  }
}

namespace {

// Frames that follow are not read, but a wrong particle count shows in the line after the first.
Configuration first_of(ExtendedXyzReader& reader) {
  Configuration first = reader.next()->configuration;
  reader.another_begins();
  return first;
}

}  // namespace

Configuration read_first_frame(const std::string& file, const AnyModel& model, OpenAxes open_axes) {
  ExtendedXyzReader reader(file, mixture_of(model), traits_of(model).sizes, open_axes);
  Configuration first = first_of(reader);
  check_separations_in(file, first, model);
  return first;
}

Configuration read_hard_frame(const std::string& file) {
  ExtendedXyzReader reader(file, SizeColumn::radius);
  return first_of(reader);
}

Configuration read_hard_frame(const std::string& file, const HardSphereModel& model) {
  ExtendedXyzReader reader(file, model, SizeColumn::radius);
  return first_of(reader);
}

double remove_rounding_overlaps_in(const std::string& file, Configuration& configuration, double tolerance) {
  try {
    return remove_rounding_overlaps(configuration, tolerance);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", file, error.what()));
  }
}

OutputFolder open_folder(const CommonOptions& common) {
  if (!common.resume.empty()) return OutputFolder(common.resume, true);
  return common.out.empty() ? OutputFolder() : OutputFolder(common.out, false);
}

void write_result(OutputFolder& folder, const std::string& subcommand, const toml::table& resolved, const Json& result) {
  const std::string text = text_of_result(result);
  folder.write_run_file(subcommand, resolved);
  folder.write("result.json", [&](std::ostream& out) { out << text << '\n'; });
  folder.keep();
}

void write_result(OutputFolder& folder, const std::string& subcommand, const toml::table& resolved, Json& result, int status) {
  result[exit_status_key] = status;
  write_result(folder, subcommand, resolved, std::as_const(result));
}

void say(const CommonOptions& common, const std::string& line) {
  if (!common.quiet) std::cerr << line << '\n';
}

}  // namespace lanescape::program
