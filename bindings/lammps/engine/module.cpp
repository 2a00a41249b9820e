#include <lanescape/engine.h>

#include <mpi.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "ranks.hpp"

namespace lanescape_lammps {
namespace {

struct Module {
  explicit Module(const char* input) : ranks(input), types(ranks.simulation().types()), masses(ranks.simulation().masses()) {}

  Ranks ranks;
  std::vector<int> types;
  std::vector<double> masses;
  std::string message;
};

// 0, or 1 with a message.
template <class Work>
int guarded(void* user, const Work& work) {
  auto& module = *static_cast<Module*>(user);
  try {
    work(module.ranks);
    return 0;
  } catch (const std::exception& error) {
    module.message = error.what();
  }
  return 1;
}

void finish_mpi() {
  int finished = 0;
  MPI_Finalized(&finished);
  if (finished == 0) MPI_Finalize();
}

void close(void* user) {
  guarded(user, [](Ranks& ranks) { ranks.close(); });
  delete static_cast<Module*>(user);
  finish_mpi();
}

void describe(Module& module, lanescape_engine& engine) {
  const Simulation& simulation = module.ranks.simulation();
  engine.user = &module;
  engine.particles = module.types.size();
  for (std::size_t axis = 0; axis < 3; ++axis) engine.box[axis] = simulation.box()[axis];
  engine.types = module.types.data();
  engine.masses = module.masses.empty() ? nullptr : module.masses.data();
  engine.units = simulation.units().c_str();
  engine.evaluate = [](void* user, const double* positions, double* energy, double* gradient) {
    return guarded(user, [&](Ranks& ranks) { *energy = ranks.evaluate(positions, gradient); });
  };
  engine.state_size = [](void* user) { return static_cast<Module*>(user)->ranks.state().size(); };
  engine.save = [](void* user, double* state) {
    for (const double x : static_cast<Module*>(user)->ranks.state()) *state++ = x;
  };
  engine.restore = [](void* user, const double* state, std::size_t count) {
    return guarded(user, [&](Ranks& ranks) { ranks.restore(state, count); });
  };
  engine.message = [](void* user) { return static_cast<Module*>(user)->message.c_str(); };
  engine.close = close;
}

}  // namespace
}  // namespace lanescape_lammps

extern "C" __attribute__((visibility("default"))) int lanescape_engine_open(const char* input, lanescape_engine* engine,
                                                                            char* message, size_t capacity) {
  using namespace lanescape_lammps;
  int ready = 0;
  MPI_Initialized(&ready);
  if (ready == 0) MPI_Init(nullptr, nullptr);
  try {
    if (engine->size != sizeof *engine) throw Failure("the module was built for another version of the program");
    auto module = std::make_unique<Module>(input);
    if (!module->ranks.is_root()) {
      module->ranks.serve();
      module.reset();
      finish_mpi();
      return LANESCAPE_ENGINE_SERVED;
    }
    describe(*module.release(), *engine);
    return LANESCAPE_ENGINE_OPEN;
  } catch (const std::exception& error) {
    std::snprintf(message, capacity, "%s", error.what());
  }
  finish_mpi();
  return LANESCAPE_ENGINE_FAILED;
}
