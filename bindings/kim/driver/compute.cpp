#include <exception>
#include <memory>

#include "KIM_ModelHeaders.hpp"
#include "driver.hpp"

namespace lanescape_kim {
namespace {

namespace names = KIM::COMPUTE_ARGUMENT_NAME;

// The simulator's array, null where it has none.
template <class Number>
Number* array(const KIM::ModelComputeArguments& arguments, const KIM::ComputeArgumentName& name) {
  Number* numbers = nullptr;
  arguments.GetArgumentPointer(name, &numbers);
  return numbers;
}

Particles particles_of(const KIM::ModelComputeArguments& arguments) {
  const int* count = array<const int>(arguments, names::numberOfParticles);
  const auto n = static_cast<std::size_t>(count == nullptr ? 0 : *count);
  return {{array<const int>(arguments, names::particleSpeciesCodes), n},
          {array<const int>(arguments, names::particleContributing), n},
          array<const double>(arguments, names::coordinates)};
}

}  // namespace

int create_arguments(const KIM::ModelCompute* model, KIM::ModelComputeArgumentsCreate* arguments) {
  PairDriver* driver = nullptr;
  model->GetModelBufferPointer(reinterpret_cast<void**>(&driver));
  for (const auto& name : {names::partialEnergy, names::partialForces, names::partialParticleEnergy, names::partialVirial})
    if (arguments->SetArgumentSupportStatus(name, KIM::SUPPORT_STATUS::optional) != 0) return 1;
  try {
    arguments->SetModelBufferPointer(new SimulatedParticles(driver->model, driver->units));
  } catch (const std::exception& error) {
    arguments->LogEntry(KIM::LOG_VERBOSITY::error, std::string("lanescape: ") + error.what(), __LINE__, __FILE__);
    return 1;
  }
  return 0;
}

int compute(const KIM::ModelCompute*, const KIM::ModelComputeArguments* arguments) {
  SimulatedParticles* listed = nullptr;
  arguments->GetModelBufferPointer(reinterpret_cast<void**>(&listed));
  try {
    listed->evaluate(particles_of(*arguments),
                     {array<double>(*arguments, names::partialEnergy), array<double>(*arguments, names::partialForces),
                      array<double>(*arguments, names::partialParticleEnergy), array<double>(*arguments, names::partialVirial)});
  } catch (const std::exception& error) {
    arguments->LogEntry(KIM::LOG_VERBOSITY::error, std::string("lanescape: ") + error.what(), __LINE__, __FILE__);
    return 1;
  }
  return 0;
}

int destroy_arguments(const KIM::ModelCompute*, KIM::ModelComputeArgumentsDestroy* arguments) {
  SimulatedParticles* listed = nullptr;
  arguments->GetModelBufferPointer(reinterpret_cast<void**>(&listed));
  delete listed;
  return 0;
}

}  // namespace lanescape_kim
