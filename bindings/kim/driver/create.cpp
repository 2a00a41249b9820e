#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "KIM_ModelDriverHeaders.hpp"
#include "driver.hpp"

extern "C" {
int lanescape_kim_create(KIM::ModelDriverCreate* driver, KIM::LengthUnit length, KIM::EnergyUnit energy, KIM::ChargeUnit charge,
                         KIM::TemperatureUnit temperature, KIM::TimeUnit time);
}

namespace lanescape_kim {
namespace {

// So many of the simulator's units are one of the model file's.
double factor(const KIM::LengthUnit& length, const KIM::EnergyUnit& energy, double length_exponent, double energy_exponent) {
  double factor = 0.0;
  if (KIM::ModelDriverCreate::ConvertUnit(KIM::LENGTH_UNIT::A, KIM::ENERGY_UNIT::eV, KIM::CHARGE_UNIT::e, KIM::TEMPERATURE_UNIT::K,
                                          KIM::TIME_UNIT::ps, length, energy, KIM::CHARGE_UNIT::e, KIM::TEMPERATURE_UNIT::K,
                                          KIM::TIME_UNIT::ps, length_exponent, energy_exponent, 0.0, 0.0, 0.0, &factor) != 0)
    throw lanescape::Error(lanescape::ErrorCode::bad_input, "lengths in " + length.ToString() + " and energies in " +
                                                                energy.ToString() + " cannot be converted from Angstrom and eV");
  return factor;
}

lanescape::Model read_model(const KIM::ModelDriverCreate& driver) {
  int files = 0;
  driver.GetNumberOfParameterFiles(&files);
  const std::string *folder = nullptr, *name = nullptr;
  driver.GetParameterFileDirectoryName(&folder);
  if (files != 1 || driver.GetParameterFileBasename(0, &name) != 0)
    throw lanescape::Error(lanescape::ErrorCode::bad_input,
                           "a model has one parameter file, a model file: " + std::to_string(files) + " are given");
  return lanescape::Model::from_file(*folder + "/" + *name);
}

std::unique_ptr<PairDriver> make(const KIM::ModelDriverCreate& create, const KIM::LengthUnit& length,
                                 const KIM::EnergyUnit& energy) {
  const lanescape::Model model = read_model(create);
  const Units units{factor(length, energy, 1.0, 0.0), factor(length, energy, 0.0, 1.0)};
  const double reach = model.largest_cutoff() * units.length;
  const SimulatedParticles checked(model, units);  // throws for what such a potential cannot be
  return std::make_unique<PairDriver>(PairDriver{model, units, reach, 0.25 * reach});
}

template <class Routine>
bool set_routine(KIM::ModelDriverCreate& create, const KIM::ModelRoutineName& name, Routine* routine) {
  return create.SetRoutinePointer(name, KIM::LANGUAGE_NAME::cpp, 1, reinterpret_cast<KIM::Function*>(routine)) == 0;
}

int destroy(KIM::ModelDestroy* model) {
  PairDriver* driver = nullptr;
  model->GetModelBufferPointer(reinterpret_cast<void**>(&driver));
  delete driver;
  return 0;
}

bool set_routines(KIM::ModelDriverCreate& create) {
  namespace names = KIM::MODEL_ROUTINE_NAME;
  return set_routine(create, names::ComputeArgumentsCreate, &create_arguments) && set_routine(create, names::Compute, &compute) &&
         set_routine(create, names::ComputeArgumentsDestroy, &destroy_arguments) && set_routine(create, names::Destroy, &destroy);
}

void set_species(KIM::ModelDriverCreate& create, const lanescape::Model& model) {
  const std::vector<lanescape::ModelSpecies> species = model.species();
  for (std::size_t s = 0; s < species.size(); ++s)
    if (create.SetSpeciesCode(KIM::SpeciesName(species[s].name), static_cast<int>(s)) != 0)
      throw lanescape::Error(
          lanescape::ErrorCode::bad_input,
          "species " + species[s].name + " is none of the KIM API's: chemical symbols are allowed, and user01 to user20");
}

}  // namespace
}  // namespace lanescape_kim

int lanescape_kim_create(KIM::ModelDriverCreate* create, KIM::LengthUnit length, KIM::EnergyUnit energy, KIM::ChargeUnit,
                         KIM::TemperatureUnit, KIM::TimeUnit) {
  using namespace lanescape_kim;
  try {
    std::unique_ptr<PairDriver> driver = make(*create, length, energy);
    set_species(*create, driver->model);
    if (create->SetUnits(length, energy, KIM::CHARGE_UNIT::unused, KIM::TEMPERATURE_UNIT::unused, KIM::TIME_UNIT::unused) != 0 ||
        create->SetModelNumbering(KIM::NUMBERING::zeroBased) != 0 || !set_routines(*create))
      throw lanescape::Error(lanescape::ErrorCode::internal, "the KIM API refuses the driver's routines");
    create->SetInfluenceDistancePointer(&driver->influence_distance);
    create->SetNeighborListPointers(1, &driver->list_cutoff, &driver->contributing_only);
    create->SetModelBufferPointer(driver.release());
  } catch (const std::exception& error) {
    create->LogEntry(KIM::LOG_VERBOSITY::error, std::string("lanescape: ") + error.what(), __LINE__, __FILE__);
    return 1;
  }
  return 0;
}
