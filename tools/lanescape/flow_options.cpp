#include "flow_options.hpp"

#include <fmt/format.h>

#include "configuration/lattice.hpp"
#include "core/error.hpp"

namespace lanescape::program {
namespace {

constexpr Scope made_slabs{"fluid", "slabs that are made, without FILE"}, constant_outsides{"outside", "--outside constant"},
    continua{"outside", "--outside continuum"}, descents{"descent", "method descent"},
    screened_starts{"screened", "method screened"};

void add_slab_options(FlowSetup& setup, Options& options) {
  OpenSlabOptions& slab = setup.flow.slab;
  options.add("--density", setup.density, "of the slab").only_for({made_slabs});
  options.add("--length", setup.length, "of the slab along x, between its open faces [sigma]").only_for({made_slabs});
  options.add("--width", setup.width, "of the slab along y and z, which are periodic [sigma]").only_for({made_slabs});
  options.add("--temperature", setup.flow.temperature,
              "of the start, and of particles that are put in by a constant outside [epsilon]");
  options.add("--buffer", slab.buffer, "width of the layers at the faces that bear the outside's pressure [sigma]");
  options.add("--nearest", slab.faces.nearest, "distance from a face from which on particles are put in [sigma]");
  options.add("--farthest", slab.faces.farthest, "distance up to which they are, and within which they are taken out [sigma]");
  options.add("--slice", slab.slice, "about, the thickness of the slices of profiles [sigma]");
  options.add("--thermostat-rate", slab.faces.thermostat_rate,
              "at which particles in the buffers get new thermal velocities; 0: no thermostat");
  options.add("--removal", setup.removal, "of particles that must go and have not left: random or least-disturbance");
  options.add("--time-step", slab.time_step, "of the dynamics");
  options.add("--steps-per-exchange", slab.steps_per_exchange, "between exchanges of particles at the faces");
  options.add("--exchanges-per-coupling", slab.exchanges_per_coupling, "between questions to the outside");
}

void add_step_options(FlowOptions& flow, Options& options) {
  options.add("--equilibration-steps", flow.equilibration_steps, "in a periodic box, with a thermostat");
  options.add("--resting-steps", flow.resting_steps, "between the open faces, before the flow");
  options.add("--flow-steps", flow.flow_steps, "of the flow");
  options.add("--sampling-steps", flow.sampling_steps, "the last of these, over which means are taken");
  options.add("--row-steps", flow.row_steps, "for each row of the profiles");
}

void add_outside_options(FlowSetup& setup, Options& options) {
  FlowOptions& flow = setup.flow;
  options.add("--outside", setup.outside, "constant, or continuum: a compressible fluid on both sides");
  options.add("--pressure", flow.pressure,
              "of the outside; of the rest before a flow with a continuum [that of the equilibrated fluid]");
  options.begin_group({constant_outsides});
  options.add("--velocity", flow.velocity, "of the flow");
  options.add("--mass-flux", flow.mass_flux, "particles per area and time [density times velocity]");
  options.add("--shear", flow.shear, "momentum along y that passes both faces per area and time");
  options.add("--enthalpy", setup.enthalpy,
              "energy that each particle brings, as heat where it and the force on the buffers do not carry it: fluid: that of the "
              "equilibrated fluid, a number, or free: no heat passes");
  options.add_flag(
      "--constant-force", flow.constant_force,
      "the force on the buffers is pressure times area whatever momentum leaving particles carry; else both together are");
  options.end_group();
  options.add(
      "--impedance", flow.impedance,
      "density times sound velocity: the constant outside answers waves with its pressure, which then leave the slab; 0: they "
      "are reflected");
  options.begin_group({continua});
  ContinuumOptions& continuum = setup.continuum;
  options.add("--cells", continuum.cells, "of the continuum on each side");
  options.add("--cell-width", continuum.cell_width, "[sigma]");
  options.add("--shear-viscosity", continuum.transport.shear_viscosity, "[sqrt(m epsilon)/sigma^2]");
  options.add("--bulk-viscosity", continuum.transport.bulk_viscosity, "[sqrt(m epsilon)/sigma^2]");
  options.add("--heat-conductivity", continuum.transport.heat_conductivity, "[k_B sqrt(epsilon/m)/sigma^2]");
  options.add("--far-velocity", continuum.velocity, "of the fluid far away, and of all of the continuum at the start");
  options.add("--pulse-amplitude", setup.pulse.amplitude, "relative, of a wave of density that goes to the right; 0: none");
  options.add("--pulse-centre", setup.pulse.centre, "x at the start, below 0 [sigma]");
  options.add("--pulse-width", setup.pulse.width, "standard deviation [sigma]");
  options.end_group();
}

}  // namespace

void FlowSetup::add_to(Options& options) {
  continuum.cells = 60;
  continuum.cell_width = 2.0;
  flow.slab.faces.insertion.tolerance = insertion.tolerance = 0.1;
  options.add_positional("FILE", file, "start: particles in a box with pbc \"T T T\", or \"F T T\": then it is not equilibrated");
  add_slab_options(*this, options);
  add_step_options(flow, options);
  add_outside_options(*this, options);
  insertion.add_to(options);
  options.at("--energy").described("of a place for a particle: a number, or mean: the slab's mean excess energy per particle");
  options.at("--region").refused("--nearest and --farthest say where particles are put in");
  options.at("--species").refused("a flow has one species");
  options.at("--traverse-step").only_for({descents});
  options.at("--clear-energy").only_for({screened_starts});
  options.at("--energy").only_for({constant_outsides});
  options.add_flag("--plot", plot, "draw the flow, the balance and the cost of insertions (needs --out)")
      .only_for({runs_with_a_folder});
  system.add_to(options);
  common.add_to(options);
}

RunKinds FlowSetup::kinds(const PairModel& model) const {
  if (outside != "constant" && outside != "continuum")
    throw_bad_input(fmt::format("--outside: '{}' is not allowed: constant or continuum", outside));
  const RunKind face =
      outside == "constant" ? RunKind{constant_outsides, "with --outside constant"} : RunKind{continua, "with --outside continuum"};
  return joined({system.kinds(model, file.empty()),
                 {common.folder_kind(), kind_if(file.empty(), made_slabs, "without FILE", "with FILE"), face,
                  kind_if(insertion.method == "descent", descents, "with method descent", "without method descent"),
                  kind_if(insertion.method == "screened", screened_starts, "with method screened", "without method screened")}});
}

Configuration FlowSetup::start(const PairModel& model) const {
  if (!file.empty()) return read_first_frame(file, model, OpenAxes::allowed);
  for (const auto& [name, value] : {std::pair("--length", length), {"--width", width}})
    if (!(value > 0.0 && value <= 1e6)) throw_bad_input(fmt::format("{}: {} is not allowed: above 0 and at most 1e6", name, value));
  return fcc_in_box(model, Box{{length, width, width}}, density, common.seed);
}

FlowOptions FlowSetup::resolve_flow(const PairModel& model, const Configuration& start, Isa isa) const {
  FlowOptions with = flow;
  with.seed = common.seed;
  with.energy = insertion.number({"mean"});
  using Enthalpy = FlowOptions::Enthalpy;
  with.enthalpy_kind = enthalpy == "fluid" ? Enthalpy::of_fluid : enthalpy == "free" ? Enthalpy::free : Enthalpy::number;
  if (with.enthalpy_kind == Enthalpy::number) with.enthalpy = number_of(enthalpy, "--enthalpy");
  with.slab.isa = isa;
  with.slab.threads = common.threads;
  with.slab.faces.insertion = insertion.resolve(common.seed);
  with.slab.faces.removal = parse_removal_rule(removal);
  check_cutoff(model, start.box);
  with.check(model, start);
  return with;
}

std::optional<ContinuumOptions> FlowSetup::resolve_continuum(const PairModel& model, const FlowOptions& with,
                                                             const Configuration& start) const {
  if (outside != "continuum") return std::nullopt;
  if (model.form != &lennard_jones_form() || model.epsilon[0] != 1.0 || model.sigma[0] != 1.0 || model.species[0].mass != 1.0 ||
      model.truncation != Truncation::shifted)
    throw_bad_input(fmt::format(
        "--outside continuum is not allowed with model {}: its equation of state is that of Lennard-Jones particles of mass "
        "1 with epsilon = sigma = 1, truncated and shifted",
        model.name));
  const SlabGeometry geometry(start.box, with.slab.buffer, with.slab.slice);
  ContinuumOptions outer = continuum;
  outer.density = static_cast<double>(start.size()) / start.box.volume();
  outer.temperature = with.temperature;
  outer.cutoff = model.cutoff;
  outer.planes = {geometry.buffer, geometry.length - geometry.buffer};
  outer.area = geometry.area;
  outer.slice_distance = 0.5 * geometry.slice_width();
  if (pulse.amplitude != 0.0) outer.pulse = pulse;
  outer.check();
  const double interval =
      static_cast<double>(with.slab.steps_per_exchange * with.slab.exchanges_per_coupling) * with.slab.time_step;
  if (interval > outer.longest_interval())
    throw_bad_input(
        fmt::format("coupling every {} is not allowed: at most {} for these cells: take fewer steps per exchange or "
                    "exchanges per coupling, or wider cells",
                    interval, outer.longest_interval()));
  return outer;
}

}  // namespace lanescape::program
