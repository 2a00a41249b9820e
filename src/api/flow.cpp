#include <lanescape/flow.hpp>

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "api/host_arrays.hpp"
#include "api/pair_models.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "flow/open_slab.hpp"
#include "interaction/pair/images.hpp"
#include "interaction/pair/separations.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

FaceDemand demand_of(const FlowDemand& d) {
  return {d.pressure, d.shear, d.mass_flux, d.velocity, d.temperature, d.energy, d.heat_flux};
}

FlowReport report_of(const FaceReport& r) {
  return {r.particles,           r.momentum, r.impulse, r.energy, r.heat, r.density, r.temperature,
          r.energy_per_particle, r.velocity, r.filling};
}

FlowOutside::Reports reports_of(const Outside::Reports& reports) { return {report_of(reports[0]), report_of(reports[1])}; }

// A host's outside as the slab sees it. Its state stays with the host.
class HostOutside final : public Outside {
 public:
  explicit HostOutside(FlowOutside& host) : host_(&host) {}
  Demands begin(const Reports& initial) override { return checked(host_->begin(reports_of(initial))); }
  Demands advance(const Reports& passed, double time) override { return checked(host_->advance(reports_of(passed), time)); }
  void exchange(Archive&) override {}

 private:
  static Demands checked(const FlowOutside::Demands& demands) {
    for (const FlowDemand& demand : demands) {
      const std::array<double, 9> numbers = {demand.pressure,    demand.shear[0],    demand.shear[1],
                                             demand.mass_flux,   demand.velocity[0], demand.velocity[1],
                                             demand.velocity[2], demand.heat_flux,   demand.energy.value_or(0.0)};
      check_finite(numbers);
      check_positive("temperature of an outside", demand.temperature);
    }
    return {demand_of(demands[0]), demand_of(demands[1])};
  }

  FlowOutside* host_;
};

FluidState fluid_of(const PairModel& model, std::span<const double> positions, std::span<const double> velocities,
                    const std::array<double, 3>& box) {
  check_positions(positions.size(), positions.size() / 3);
  check_positions(velocities.size(), positions.size() / 3);
  check_finite(velocities);
  FluidState fluid{{Box{box, {false, true, true}}, std::vector<int>(positions.size() / 3, 0), {positions.begin(), positions.end()}},
                   {velocities.begin(), velocities.end()}};
  check_cutoff(model, fluid.configuration.box);
  check_separations(fluid.configuration, model);
  return fluid;
}

OpenSlabOptions options_of(const OpenFlow::Options& from) {
  OpenSlabOptions options;
  options.buffer = from.buffer;
  options.slice = from.slice;
  options.time_step = from.time_step;
  options.steps_per_exchange = from.steps_per_exchange;
  options.exchanges_per_coupling = from.exchanges_per_coupling;
  options.faces.nearest = from.nearest;
  options.faces.farthest = from.farthest;
  options.faces.thermostat_rate = from.thermostat_rate;
  options.faces.insertion.tolerance = from.tolerance;
  options.faces.insertion.seed = from.seed;
  options.threads = checked_threads(from.threads);
  options.isa = choose_isa(from.instruction_set);
  return options;
}

}  // namespace

// The slab refers to the model and the outside.
struct OpenFlow::Implementation {
  PairModel model;
  HostOutside outside;
  OpenSlab slab;

  Implementation(const PairModel& of, std::span<const double> positions, std::span<const double> velocities,
                 const std::array<double, 3>& box, FlowOutside& host, const Options& options)
      : model(of), outside(host), slab(model, fluid_of(model, positions, velocities, box), options_of(options), outside) {}
};

OpenFlow::OpenFlow(const Model& model, std::span<const double> positions, std::span<const double> velocities,
                   const std::array<double, 3>& box, FlowOutside& outside)
    : OpenFlow(model, positions, velocities, box, outside, Options()) {}
OpenFlow::OpenFlow(const Model& model, std::span<const double> positions, std::span<const double> velocities,
                   const std::array<double, 3>& box, FlowOutside& outside, const Options& options)
    : implementation_(
          std::make_unique<Implementation>(pair_model(model, "OpenFlow"), positions, velocities, box, outside, options)) {}
OpenFlow::~OpenFlow() = default;
OpenFlow::OpenFlow(OpenFlow&&) noexcept = default;
OpenFlow& OpenFlow::operator=(OpenFlow&&) noexcept = default;

void OpenFlow::advance() {
  const FlowOutcome outcome = implementation_->slab.advance();
  if (outcome != FlowOutcome::followed)
    throw Error(ErrorCode::goal_not_reached,
                fmt::format("the slab cannot follow its outside after {} steps: {}", steps(), to_string(outcome)));
}

std::uint64_t OpenFlow::steps() const { return implementation_->slab.steps(); }
double OpenFlow::time() const { return implementation_->slab.time(); }
std::size_t OpenFlow::particles() const { return implementation_->slab.fluid().configuration.size(); }
std::vector<double> OpenFlow::positions() const { return implementation_->slab.fluid().configuration.positions; }
std::vector<double> OpenFlow::velocities() const { return implementation_->slab.fluid().velocities; }
double OpenFlow::energy_error() const { return implementation_->slab.balance().energy_error(); }

FlowProfiles OpenFlow::profiles() {
  FlowSampler& sampler = implementation_->slab.sampler();
  if (sampler.empty()) throw_bad_input("profiles without a step since the last ones are not allowed: advance() first");
  FlowProfile means = sampler.profile();
  sampler.clear();
  FlowProfiles profiles{std::move(means.x),           std::move(means.density), {},
                        std::move(means.temperature), std::move(means.energy),  std::move(means.mass_flux),
                        std::move(means.pressure)};
  for (const Point& velocity : means.velocity) profiles.velocity.insert(profiles.velocity.end(), velocity.begin(), velocity.end());
  return profiles;
}

LANESCAPE_ABI_END
}  // namespace lanescape
