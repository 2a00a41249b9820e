#include "flow/compressible_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/option_checks.hpp"

namespace lanescape {
namespace {

constexpr double courant_number = 0.4;  // of the fastest signal, sound or diffusion, in a step

void check_not_negative(const char* option, double value) {
  if (!(value >= 0.0) || !std::isfinite(value))
    throw_bad_input(fmt::format("{} {} is not allowed: it must be finite and at least 0", option, value));
}

// The smallest of twice either difference and their mean, or 0 at an extremum.
double limited_difference(double before, double after) {
  if (before * after <= 0.0) return 0.0;
  const double size = std::min({2.0 * std::abs(before), 2.0 * std::abs(after), 0.5 * std::abs(before + after)});
  return std::copysign(size, before);
}

std::array<double, 6> flow_change(const std::array<double, 6>& from, const std::array<double, 6>& to) {
  std::array<double, 6> difference{};
  for (std::size_t k = 0; k < to.size(); ++k) difference[k] = to[k] - from[k];
  return difference;
}

}  // namespace

void TransportCoefficients::check() const {
  check_not_negative("shear viscosity", shear_viscosity);
  check_not_negative("bulk viscosity", bulk_viscosity);
  check_not_negative("heat conductivity", heat_conductivity);
}

double TransportCoefficients::largest_diffusivity(const ThermodynamicState& fluid) const {
  return std::max(4.0 / 3.0 * shear_viscosity + bulk_viscosity, heat_conductivity / fluid.heat_capacity) / fluid.density;
}

void SolverGrid::check() const {
  check_positive("cell width", cell_width, 1e9);
  if (cells < 1 || cells > 10'000'000) throw_bad_input(fmt::format("{} cells are not allowed: from 1 to 10000000", cells));
  if (!(std::abs(left) <= 1e9)) throw_bad_input(fmt::format("the grid's left end {} is not allowed: from -1e9 to 1e9", left));
}

CompressibleSolver::CompressibleSolver(std::shared_ptr<const EquationOfState> equation, const SolverGrid& grid,
                                       const TransportCoefficients& transport, const std::function<FlowState(double)>& initial)
    : equation_(std::move(equation)), grid_(grid), transport_(transport) {
  grid.check();
  transport.check();
  flow_.resize(grid.cells);
  slope_.resize(grid.cells);
  flux_.resize(grid.cells + 1);
  for (std::size_t i = 0; i < grid.cells; ++i) {
    const FlowState state = initial(grid.centre(i));
    if (!state.fluid.stable())
      throw_bad_input(
          fmt::format("the fluid of density {} and temperature {} at x = {} is unstable: give a state outside the spinodal",
                      state.fluid.density, state.fluid.temperature, grid.centre(i)));
    const Conserved amounts = densities(state);
    densities_.insert(densities_.end(), amounts.begin(), amounts.end());
    start_.push_back(state.fluid.temperature);
  }
  look();
}

// The states of all cells from what they hold.
void CompressibleSolver::look() {
  for (std::size_t i = 0; i < grid_.cells; ++i) {
    const double* amounts = densities_.data() + 5 * i;
    FlowState& cell = flow_[i];
    for (std::size_t axis = 0; axis < 3; ++axis) cell.velocity[axis] = amounts[1 + axis] / amounts[0];
    const double energy = amounts[4] / amounts[0] - 0.5 * dot(cell.velocity, cell.velocity);
    const std::optional<ThermodynamicState> found = equation_->at_energy(amounts[0], energy, start_[i]);
    if (!found || !found->stable())
      throw Error(
          ErrorCode::goal_not_reached,
          fmt::format("the continuum at x = {} has density {} and internal energy {} per particle, which is no stable state of "
                      "its equation of state: take a smaller disturbance or other densities and temperatures",
                      grid_.centre(i), amounts[0], energy));
    cell.fluid = *found;
  }
}

void CompressibleSolver::look_from_here() {
  for (std::size_t i = 0; i < grid_.cells; ++i) start_[i] = flow_[i].fluid.temperature;
  look();
}

CompressibleSolver::Primitive CompressibleSolver::primitive(const FlowState& state) {
  const ThermodynamicState& fluid = state.fluid;
  return {fluid.density, state.velocity[0], state.velocity[1], state.velocity[2], fluid.pressure, fluid.density * fluid.energy};
}

CompressibleSolver::Primitive CompressibleSolver::limited_slope(const Primitive& before, const Primitive& after) {
  Primitive found{};
  for (std::size_t k = 0; k < found.size(); ++k) found[k] = limited_difference(before[k], after[k]);
  return found;
}

// Per cell width. Beside a given flux the difference to the only neighbour counts.
CompressibleSolver::Primitive CompressibleSolver::slope(std::size_t cell, const Ends& ends) const {
  const auto* left = cell > 0 ? &flow_[cell - 1] : std::get_if<FlowState>(&ends[0]);
  const auto* right = cell + 1 < grid_.cells ? &flow_[cell + 1] : std::get_if<FlowState>(&ends[1]);
  const Primitive here = primitive(flow_[cell]);
  const Primitive before = left ? flow_change(primitive(*left), here) : Primitive{};
  const Primitive after = right ? flow_change(here, primitive(*right)) : Primitive{};
  if (left && right) return limited_slope(before, after);
  return left ? before : after;
}

// At a face: towards = -1/2 on the left of the cell, 1/2 on its right.
FaceSide CompressibleSolver::side_of_cell(const FlowState& cell, const Primitive& slope, double towards) {
  FaceSide side = face_side(cell);
  side.density += towards * slope[0];
  for (std::size_t axis = 0; axis < 3; ++axis) side.velocity[axis] += towards * slope[1 + axis];
  side.pressure += towards * slope[4];
  side.energy_density += towards * slope[5];
  return side;
}

Conserved CompressibleSolver::viscous_flux(const FlowState& left, const FlowState& right, double distance) const {
  Conserved flux{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double viscosity =
        axis == 0 ? 4.0 / 3.0 * transport_.shear_viscosity + transport_.bulk_viscosity : transport_.shear_viscosity;
    flux[1 + axis] = -viscosity * (right.velocity[axis] - left.velocity[axis]) / distance;
    flux[4] += 0.5 * (left.velocity[axis] + right.velocity[axis]) * flux[1 + axis];
  }
  flux[4] -= transport_.heat_conductivity * (right.fluid.temperature - left.fluid.temperature) / distance;
  return flux;
}

Conserved CompressibleSolver::end_flux(Side side, const FlowState& beyond, double distance, const Primitive& slope) const {
  const bool at_left = side == Side::left;
  const FlowState& cell = at_left ? flow_.front() : flow_.back();
  const FaceSide inner = side_of_cell(cell, slope, at_left ? -0.5 : 0.5), outer = face_side(beyond);
  const double apart = distance + 0.5 * grid_.cell_width;
  Conserved flux = at_left ? riemann_flux(outer, inner) : riemann_flux(inner, outer);
  const Conserved viscous = at_left ? viscous_flux(beyond, cell, apart) : viscous_flux(cell, beyond, apart);
  for (std::size_t k = 0; k < flux.size(); ++k) flux[k] += viscous[k];
  return flux;
}

Conserved CompressibleSolver::flux_between(Side side, const FlowState& beyond, double distance) const {
  const bool at_left = side == Side::left;
  const std::size_t last = grid_.cells - 1, cell = at_left ? 0 : last,
                    next = at_left ? std::min(last, cell + 1) : last - (last > 0);
  const Primitive here = primitive(flow_[cell]), inner = flow_change(here, primitive(flow_[next]));
  Primitive outer = flow_change(primitive(beyond), here);
  for (double& component : outer) component *= grid_.cell_width / (distance + 0.5 * grid_.cell_width);
  Primitive slope = limited_slope(outer, inner);
  if (!at_left)
    for (double& component : slope) component = -component;
  return end_flux(side, beyond, distance, slope);
}

void CompressibleSolver::find_fluxes(const Ends& ends) {
  for (std::size_t i = 0; i < grid_.cells; ++i) slope_[i] = slope(i, ends);
  for (std::size_t i = 0; i + 1 < grid_.cells; ++i) {
    flux_[i + 1] = riemann_flux(side_of_cell(flow_[i], slope_[i], 0.5), side_of_cell(flow_[i + 1], slope_[i + 1], -0.5));
    const Conserved viscous = viscous_flux(flow_[i], flow_[i + 1], grid_.cell_width);
    for (std::size_t k = 0; k < viscous.size(); ++k) flux_[i + 1][k] += viscous[k];
  }
  const auto at_end = [&](Side side, const End& end, const Primitive& slope) {
    const auto* given = std::get_if<Conserved>(&end);
    return given ? *given : end_flux(side, std::get<FlowState>(end), 0.5 * grid_.cell_width, slope);
  };
  flux_.front() = at_end(Side::left, ends[0], slope_.front());
  flux_.back() = at_end(Side::right, ends[1], slope_.back());
}

double CompressibleSolver::stable_step() const {
  double rate = 0.0;
  for (const FlowState& cell : flow_)
    rate = std::max(rate, (std::abs(cell.velocity[0]) + cell.fluid.sound_velocity() +
                           2.0 * transport_.largest_diffusivity(cell.fluid) / grid_.cell_width) /
                              grid_.cell_width);
  return courant_number / rate;
}

// Half of the old densities and half of two steps of Euler's method.
void CompressibleSolver::step(double time, const Ends& ends) {
  before_ = densities_;
  for (int stage = 0; stage < 2; ++stage) {
    if (stage == 1) look_from_here();
    find_fluxes(ends);
    for (std::size_t i = 0; i < grid_.cells; ++i)
      for (std::size_t k = 0; k < 5; ++k) densities_[5 * i + k] += time / grid_.cell_width * (flux_[i][k] - flux_[i + 1][k]);
    for (std::size_t k = 0; k < 5; ++k) {
      passed_[0][k] += 0.5 * time * flux_.front()[k];
      passed_[1][k] += 0.5 * time * flux_.back()[k];
    }
  }
  for (std::size_t j = 0; j < densities_.size(); ++j) densities_[j] = 0.5 * (before_[j] + densities_[j]);
  look_from_here();
}

void CompressibleSolver::advance(double time, const Ends& ends) {
  check_positive("time to advance by", time);
  passed_ = {};
  for (double left = time; left > 0.0;) {
    const double steps = std::ceil(left / stable_step());
    if (!(steps <= 1e7))
      throw Error(ErrorCode::goal_not_reached,
                  fmt::format("a time of {} takes {} steps of the continuum: at most 1e7, take wider cells", time, steps));
    step(left / steps, ends);
    left = steps > 1.0 ? left - left / steps : 0.0;
  }
}

Conserved CompressibleSolver::total() const {
  Conserved sum{};
  for (std::size_t i = 0; i < grid_.cells; ++i)
    for (std::size_t k = 0; k < 5; ++k) sum[k] += densities_[5 * i + k] * grid_.cell_width;
  return sum;
}

void CompressibleSolver::exchange(Archive& archive) {
  archive.field("densities", densities_);
  archive.field("start", start_);
  std::vector<double> passed(passed_[0].begin(), passed_[0].end());
  passed.insert(passed.end(), passed_[1].begin(), passed_[1].end());
  archive.field("passed", passed);
  if (!archive.reading()) return;
  if (densities_.size() != 5 * grid_.cells || start_.size() != grid_.cells || passed.size() != 10)
    throw_bad_input(fmt::format("the archived continuum has {} cells: {} are wanted", start_.size(), grid_.cells));
  for (std::size_t k = 0; k < 10; ++k) passed_[k / 5][k % 5] = passed[k];
  look();
}

}  // namespace lanescape
