#include "engine.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"

namespace lanescape::program {
namespace {

constexpr const char* folders_variable = "LANESCAPE_ENGINES";
using OpenFunction = decltype(&lanescape_engine_open);

// The file of a module: NAME itself, or lanescape-NAME.so in one of the folders.
std::filesystem::path module_file(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const char* folders = std::getenv(folders_variable);
  std::istringstream list(folders == nullptr ? "" : folders);
  const std::string file = "lanescape-" + name + ".so";
  for (std::string folder; std::getline(list, folder, ':');)
    if (std::filesystem::exists(std::filesystem::path(folder) / file)) return std::filesystem::path(folder) / file;
  throw_bad_input(fmt::format("--landscape {}: there is no {} in the folders of {}{}", name, file, folders_variable,
                              folders == nullptr ? ", which is not set" : ""));
}

// Modules stay loaded: their libraries do not expect to be unloaded.
OpenFunction load(const std::string& name) {
  const std::filesystem::path file = module_file(name);
  // Global: MPI loads parts of itself that look for its names.
  void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (module == nullptr) throw_bad_input(fmt::format("--landscape {}: {}", name, ::dlerror()));
  const auto open = reinterpret_cast<OpenFunction>(::dlsym(module, "lanescape_engine_open"));
  if (open == nullptr) throw_bad_input(fmt::format("--landscape {}: {} has no lanescape_engine_open", name, file.string()));
  return open;
}

}  // namespace

std::unique_ptr<Engine> Engine::open(const std::string& word) {
  const std::size_t colon = word.find(':');
  if (colon == 0 || colon == std::string::npos || colon + 1 == word.size())
    throw_bad_input(fmt::format("--landscape {} is not allowed: an engine and its input are, such as lammps:in.lmp", word));
  std::unique_ptr<Engine> engine(new Engine(word));
  engine->engine_.size = sizeof engine->engine_;
  std::array<char, 4096> message{};
  const int status = load(word.substr(0, colon))(word.c_str() + colon + 1, &engine->engine_, message.data(), message.size());
  if (status == LANESCAPE_ENGINE_OPEN) return engine;
  engine->engine_.close = nullptr;
  if (status == LANESCAPE_ENGINE_SERVED) return nullptr;
  throw_bad_input(fmt::format("--landscape {}: {}", word, message.data()));
}

Engine::~Engine() {
  if (engine_.close != nullptr) engine_.close(engine_.user);
}

void Engine::fail() const {
  throw Error(ErrorCode::internal, fmt::format("--landscape {}: {}", word_, engine_.message(engine_.user)));
}

void Engine::check(const ConfigurationPair& pair, const AnyModel& model, const std::string& where) const {
  const Configuration& start = pair.start;
  if (start.size() != engine_.particles)
    throw_bad_input(fmt::format("{}: {} particles, {} has {}", where, start.size(), word_, engine_.particles));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(std::abs(start.box.length[axis] - engine_.box[axis]) <= 1e-9 * engine_.box[axis]))
      throw_bad_input(fmt::format("{}: box {} {} {}, {} has {} {} {}", where, start.box.length[0], start.box.length[1],
                                  start.box.length[2], word_, engine_.box[0], engine_.box[1], engine_.box[2]));
  const auto& species = mixture_of(model).species;
  std::map<int, int> type_of;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const int type = type_of.try_emplace(start.species[i], engine_.types[i]).first->second;
    const auto mass = [&](std::size_t j) { return species[static_cast<std::size_t>(start.species[j])].mass; };
    if (type != engine_.types[i])
      throw_bad_input(fmt::format("{}: particle {} (from 0) has type {} in {}, others of its species have {}", where, i,
                                  engine_.types[i], word_, type));
    if (engine_.masses != nullptr && !(std::abs(engine_.masses[i] * mass(0) / (engine_.masses[0] * mass(i)) - 1.0) <= 1e-6))
      throw_bad_input(fmt::format("{}: particle {} (from 0) is {} times as heavy as the first one in {}, {} times in the model",
                                  where, i, engine_.masses[i] / engine_.masses[0], word_, mass(i) / mass(0)));
  }
}

double Engine::evaluate(std::span<const double> positions, std::span<double> gradient) {
  double energy = 0.0;
  if (engine_.evaluate(engine_.user, positions.data(), &energy, gradient.data()) != 0) fail();
  return energy;
}

std::vector<double> Engine::state() const {
  std::vector<double> state(engine_.state_size(engine_.user));
  engine_.save(engine_.user, state.data());
  return state;
}

void Engine::restore(std::span<const double> state) {
  if (engine_.restore(engine_.user, state.data(), state.size()) != 0) fail();
}

EngineLandscape::EngineLandscape(Engine& engine, const ParticleLayout& layout, Isa isa)
    : engine_(&engine), layout_(layout), algebra_(kernel_table(isa)), positions_(3 * layout.size()), gradient_(3 * layout.size()) {
  engine.restore({});
}

double EngineLandscape::energy(const AlignedArray& position) {
  layout_.put_user(position, positions_);
  return engine_->evaluate(positions_, gradient_);
}

double EngineLandscape::energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) {
  const double value = energy(position);
  layout_.put_slots(gradient_, gradient);
  return value;
}

void EngineLandscape::exchange(Archive& archive) {
  std::vector<double> state = archive.reading() ? std::vector<double>{} : engine_->state();
  archive.field("engine", state);
  if (archive.reading()) engine_->restore(state);
}

}  // namespace lanescape::program
