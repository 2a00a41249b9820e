#include <CLI/CLI.hpp>

#include "program.hpp"

namespace lanescape::program {

std::vector<Subcommand> add_subcommands(CLI::App& app) {
  app.require_subcommand(1);
  return {add_info(app),    add_energy(app),    add_overlap(app), add_endpoints(app), add_path(app),
          add_shorten(app), add_diffusion(app), add_insert(app),  add_flow(app),      add_slab(app),
          add_analyze(app), add_verify(app),    add_cases(app),   add_check(app)};
}

}  // namespace lanescape::program
