#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>

#include "program.hpp"
#include "run_file.hpp"
#include "targets.hpp"

// The command line with its run file, up to where a subcommand would start to work. The bytes are arguments, one in a line; what
// follows an empty line is the run file, which arguments call RUN.
namespace lanescape::fuzz {
namespace {

void parse(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find("\n\n"), bytes.size());
  const MemoryFile run_file(bytes.substr(std::min(end + 2, bytes.size())));
  std::vector<std::string> arguments;
  for (std::size_t at = 0; at < end;) {
    const std::size_t next = std::min(bytes.find('\n', at), end);
    const std::string argument(bytes.substr(at, next - at));
    arguments.push_back(argument == "RUN" ? run_file.path() : argument);
    at = next + 1;
  }
  CLI::App app("", "lanescape");
  const std::vector<program::Subcommand> subcommands = program::add_subcommands(app);
  try {
    program::CommandLine line = program::with_run_file(arguments, app);
    std::reverse(line.arguments.begin(), line.arguments.end());
    app.parse(line.arguments);
  } catch (const CLI::ParseError&) {
    // Refused, or --help.
  }
}

}  // namespace

void read_command_line(std::string_view bytes) { refusing(parse, bytes); }

std::vector<std::string> command_line_seeds() {
  return {"energy\n--model\nlennard-jones\n--cutoff\n2.5\n--images\nminimum\nfile.extxyz",
          "endpoints\n--pairs\n3\n--particles\n108\n--temperature=0.5\n--distance\n4\n--seed\n18446744073709551615\n--out\nDIR",
          "path\n--pair\na.extxyz\nb.extxyz\n--method\ncontour\n--step\n1e-3\n--adaptive\n--threads\n2\n--quiet",
          "shorten\n--check\npath.h5\n--starts\n4",
          "diffusion\n--config\nRUN\n\nmodel = \"kob-andersen\"\nparticles = 256\ntemperature = 1.0\nthreads = 2\nquiet = true\n",
          "insert\n--scan\n--states\n0.4:2.5,0.8:2\n--methods\nusher,descent\n--config=RUN\n\nsubcommand = \"insert\"\ntolerances "
          "= \"0.2,0.1\"\n"
          "traverse-step = 1.5\nconfigurations = 2\n",
          "path\n--config\nRUN\n--max-steps\n50\n\npair = [\"a.extxyz\", \"b.extxyz\"]\nstep = 0.001\nframes = 0\n",
          "flow\n--length\n30\n--outside\ncontinuum\n--resume-or-start\nnowhere",
          "verify\n--library\nlib.so\n--symbol\nf",
          "slab\n--resume\nnowhere\n--threads\n3"};
}

}  // namespace lanescape::fuzz
