#include "flow/continuum_outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "flow/lennard_jones_fluid.hpp"
#include "flow/simple_wave.hpp"

namespace lanescape {
namespace {

Conserved passed_flux(const FaceReport& passed, double area_time) {
  return {passed.particles / area_time, passed.momentum[0] / area_time, passed.momentum[1] / area_time,
          passed.momentum[2] / area_time, passed.energy / area_time};
}

CompressibleSolver region(const ContinuumOptions& options, const std::shared_ptr<const EquationOfState>& equation,
                          const SolverGrid& grid) {
  return {equation, grid, options.transport, [&options](double x) { return options.initial(x); }};
}

SolverGrid left_region(const ContinuumOptions& options) {
  options.check();
  return {options.planes[0] - static_cast<double>(options.cells) * options.cell_width, options.cell_width, options.cells};
}

void check_pulse(const ContinuumOptions& options) {
  const Pulse& pulse = *options.pulse;
  check_positive("width of the pulse", pulse.width, 1e9);
  if (!(std::abs(pulse.centre) <= 1e9)) throw_bad_input(fmt::format("centre {} of the pulse is not allowed: finite", pulse.centre));
  if (!(pulse.amplitude > -1.0 && pulse.amplitude <= 10.0))
    throw_bad_input(fmt::format("amplitude {} of the pulse is not allowed: above -1 and at most 10", pulse.amplitude));
  options.initial(pulse.centre);
}

}  // namespace

void ContinuumOptions::check() const {
  check_positive("area", area, 1e18);
  SolverGrid{0.0, cell_width, cells}.check();
  transport.check();
  check_positive("distance of the slice", slice_distance, 1e9);
  if (!(planes[0] < planes[1] && std::abs(planes[0]) <= 1e9 && std::abs(planes[1]) <= 1e9))
    throw_bad_input(
        fmt::format("planes at x = {} and {} are not allowed: the first must be left of the second", planes[0], planes[1]));
  if (!(memory >= 1.0 && memory <= 1e6)) throw_bad_input(fmt::format("memory {} is not allowed: from 1 to 1e6 intervals", memory));
  const ThermodynamicState fluid = reservoir().fluid;
  if (!fluid.stable())
    throw_bad_input(fmt::format("density {} at temperature {} is not allowed: this is inside the spinodal", density, temperature));
  if (!(std::abs(velocity) < fluid.sound_velocity()))
    throw_bad_input(fmt::format("velocity {} is not allowed: below that of sound, {}", velocity, fluid.sound_velocity()));
  if (pulse) check_pulse(*this);
}

std::shared_ptr<const EquationOfState> ContinuumOptions::equation() const {
  return cutoff ? std::make_shared<const LennardJonesFluid>(*cutoff) : std::make_shared<const LennardJonesFluid>();
}

FlowState ContinuumOptions::reservoir() const { return {equation()->at_temperature(density, temperature), {velocity, 0.0, 0.0}}; }

FlowState ContinuumOptions::initial(double x) const {
  if (!pulse) return reservoir();
  const double from_centre = (x - pulse->centre) / pulse->width;
  return simple_wave(*equation(), reservoir(), density * (1.0 + pulse->amplitude * std::exp(-0.5 * from_centre * from_centre)));
}

// The limit of Euler's method for the last cell: sound crosses it once, and so does what diffuses to the slice.
double ContinuumOptions::longest_interval() const {
  const ThermodynamicState fluid = reservoir().fluid;
  const double diffusion = 2.0 * transport.largest_diffusivity(fluid) / (0.5 * cell_width + slice_distance);
  return cell_width / (std::abs(velocity) + fluid.sound_velocity() + diffusion);
}

CompressibleSolver solver_alone(const ContinuumOptions& options) {
  SolverGrid grid = left_region(options);
  const double length = 2.0 * (options.planes[0] - grid.left) + options.planes[1] - options.planes[0];
  grid.cells = static_cast<std::size_t>(std::max(1.0, std::round(length / options.cell_width)));
  grid.cell_width = length / static_cast<double>(grid.cells);
  return region(options, options.equation(), grid);
}

ContinuumOutside::ContinuumOutside(const ContinuumOptions& options)
    : options_(options),
      equation_(options.equation()),
      reservoir_(options.reservoir()),
      left_(region(options, equation_, left_region(options))),
      right_(region(options, equation_, {options.planes[1], options.cell_width, options.cells})) {}

Outside::Demands ContinuumOutside::begin(const Reports& initial) {
  faces_ = {};
  return demands(initial);
}

Outside::Demands ContinuumOutside::advance(const Reports& passed, double time) {
  check_positive("coupling interval", time, options_.longest_interval());
  const double area_time = options_.area * time;
  for (std::size_t face = 0; face < 2; ++face) learn(faces_[face], passed[face], area_time);
  left_.advance(time, {reservoir_, passed_flux(passed[0], area_time)});
  right_.advance(time, {passed_flux(passed[1], area_time), reservoir_});
  return demands(passed);
}

Outside::Demands ContinuumOutside::demands(const Reports& reports) { return {demand(0, reports[0]), demand(1, reports[1])}; }

void ContinuumOutside::learn(Face& face, const FaceReport& passed, double area_time) const {
  for (std::size_t k = 0; k < 4; ++k) {
    const double carried = k < 3 ? passed.momentum[k] - passed.impulse[k] : passed.energy - passed.heat;
    face.excess[k] += (carried / area_time - face.expected[k] - face.excess[k]) / options_.memory;
  }
}

// The fluid of the slab, by its density and energy: these have a smaller noise than its temperature.
FlowState ContinuumOutside::beside(std::size_t face, const FaceReport& report) const {
  const double energy = report.energy_per_particle - 0.5 * dot(report.velocity, report.velocity);
  const std::optional<ThermodynamicState> fluid = equation_->at_energy(report.density, energy, report.temperature);
  if (!fluid || !fluid->stable())
    throw Error(
        ErrorCode::goal_not_reached,
        fmt::format("the slab beside x = {} has density {} and internal energy {} per particle, which is no stable state of the "
                    "continuum's equation of state: take larger slices, longer intervals or another initial state",
                    options_.planes[face], report.density, energy));
  return {*fluid, report.velocity};
}

FaceDemand ContinuumOutside::demand(std::size_t face, const FaceReport& report) {
  using Side = CompressibleSolver::Side;
  const FlowState slab = beside(face, report), &cell = face == 0 ? left_.flow().back() : right_.flow().front();
  const Conserved flux = face == 0 ? left_.flux_between(Side::right, slab, options_.slice_distance)
                                   : right_.flux_between(Side::left, slab, options_.slice_distance);
  const bool enters = (flux[0] >= 0.0) == (face == 0);
  const FlowState& upwind = enters ? cell : slab;
  const Point& v = upwind.velocity;
  auto& [expected, excess] = faces_[face];
  Point force{};  // per area, as a flux along +x
  for (std::size_t axis = 0; axis < 3; ++axis) {
    expected[axis] = flux[0] * v[axis];
    force[axis] = flux[1 + axis] - expected[axis] - excess[axis];
  }
  const double work = force[0] * flux[0] / upwind.fluid.density + force[1] * v[1] + force[2] * v[2];
  expected[3] = flux[0] * (upwind.fluid.energy + 0.5 * dot(v, v)) + work;
  // On the slab the left face acts with this force, and the right one with its opposite.
  const double sign = face == 0 ? 1.0 : -1.0;
  FaceDemand wanted;
  wanted.pressure = force[0];
  wanted.shear = {sign * force[1], sign * force[2]};
  wanted.mass_flux = flux[0];
  wanted.velocity = v;
  wanted.temperature = upwind.fluid.temperature;
  wanted.energy = upwind.fluid.excess_energy();
  wanted.heat_flux = flux[4] - expected[3] - excess[3];
  return wanted;
}

std::vector<OutsideCell> cells_of(const CompressibleSolver& solver) {
  std::vector<OutsideCell> cells;
  for (std::size_t k = 0; k < solver.flow().size(); ++k) {
    const FlowState& state = solver.flow()[k];
    cells.push_back({solver.grid().centre(k), state.fluid.density, state.velocity[0], state.fluid.temperature});
  }
  return cells;
}

std::vector<OutsideCell> ContinuumOutside::cells() const {
  std::vector<OutsideCell> cells = cells_of(left_);
  const std::vector<OutsideCell> right = cells_of(right_);
  cells.insert(cells.end(), right.begin(), right.end());
  return cells;
}

void ContinuumOutside::exchange(Archive& archive) {
  archive.enter("left");
  left_.exchange(archive);
  archive.leave();
  archive.enter("right");
  right_.exchange(archive);
  archive.leave();
  std::vector<double> carried;
  for (const auto& [expected, excess] : faces_)
    for (const Carried* values : {&expected, &excess}) carried.insert(carried.end(), values->begin(), values->end());
  archive.field("carried", carried);
  if (!archive.reading()) return;
  if (carried.size() != 16) throw_bad_input(fmt::format("the archived faces have {} numbers: 16 are wanted", carried.size()));
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t face = 0; face < 2; ++face) {
      faces_[face].expected[k] = carried[8 * face + k];
      faces_[face].excess[k] = carried[8 * face + 4 + k];
    }
}

}  // namespace lanescape
