#include "configuration/model_traits.hpp"
#include "end_point_options.hpp"

namespace lanescape::program {
namespace {

struct EndPointsState {
  CommonOptions common;
  SystemOptions system;
  EndPointSetup setup;
};

Json run_endpoints(EndPointsState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const AnyModel model = state.system.resolve();
  options.settle(joined({state.system.kinds(model, state.setup.generates_start()), state.setup.kinds(false)}));
  state.setup.settle(model);
  const Configuration start = state.setup.start(model, state.common, isa);
  state.system.check_precision_in(model, start.box);
  const EndPointProtocol protocol = state.setup.resolve(model, start.size(), state.common.seed);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("endpoints", options.resolved());
  EndPoints ends = make_end_points(model, start, protocol, isa, folder, state.common, state.system.resolve_precision());
  if (traits_of(model).has_precision) ends.json["precision"] = to_string(state.system.resolve_precision());
  if (state.setup.radius_factor()) ends.json["radius_factor"] = *state.setup.radius_factor();
  status = status_of_run(ends.reached, ends.run.interrupted);
  write_result(folder, "endpoints", options.resolved(), ends.json, status);
  return ends.json;
}

}  // namespace

Subcommand add_endpoints(CLI::App& app) {
  const auto options = std::make_shared<Options>(app, "endpoints", "Equilibrate a liquid and collect pairs of end points");
  const auto state = std::make_shared<EndPointsState>();
  state->setup.add_to(*options);
  state->setup.add_tolerance_to(*options);
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_endpoints(*state, *options, status); }};
}

}  // namespace lanescape::program
