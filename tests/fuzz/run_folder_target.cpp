#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "analysis_run.hpp"
#include "targets.hpp"

// The folder of a finished run, as `analyze` reads it. A line "@@ NAME" begins the file of that name.
namespace lanescape::fuzz {
namespace {

constexpr std::array<std::string_view, 5> names = {"result.json", "run.toml", "pair-0001.extxyz", "path-0001-steps.csv",
                                                   "path-0001-particles.csv"};

// One folder for the whole process.
class RunFolder {
 public:
  RunFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lanescape-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      std::perror("fuzz: no folder");
      std::abort();
    }
    path_ = name;
  }
  ~RunFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

  void fill(std::string_view bytes) const {
    for (const std::string_view name : names) {
      const std::string mark = "@@ " + std::string(name) + "\n";
      const std::size_t at = bytes.find(mark);
      if (at == std::string_view::npos) {
        std::filesystem::remove(path_ / name);
        continue;
      }
      const std::string_view rest = bytes.substr(at + mark.size());
      std::ofstream(path_ / name, std::ios::binary) << rest.substr(0, rest.find("@@ "));
    }
  }

 private:
  std::filesystem::path path_;
};

void read(std::string_view bytes) {
  static const RunFolder folder;
  folder.fill(bytes);
  program::read_analysed_run(folder.path());
}

constexpr const char* pair_file =
    "@@ pair-0001.extxyz\n1\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=species:S:1:pos:R:3 pbc=\"T T T\" distance=9.0 "
    "asked_distance=9 end=first temperature=1\nAr 1 2 3\n1\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=species:S:1:pos:R:3 "
    "pbc=\"T T T\" end=second\nAr 4 5 6\n";
constexpr const char* tables =
    "@@ path-0001-steps.csv\nquantity,value,steps\nparticipation_ratio,0.5,439\nalpha_2,0.2,3\nmoved_particles,2,17\n"
    "group_size_few_groups,3,5\n@@ path-0001-particles.csv\nparticle,species,path_length,displacement\n0,Ar,21.5,18.4\n";
constexpr const char* path_numbers =
    "\"outcome\": \"reached\", \"length\": 12.5, \"distance\": 9.0, \"ratio_squared\": 0.5184, \"participation_ratio\": 0.4, "
    "\"steps\": "
    "{\"direct\": 7, \"contour\": 90}, \"lengths\": {\"direct\": 0.7, \"contour\": 9.0}, \"corrections\": [80, 10, 0], "
    "\"evaluations\": 200, \"seconds\": 1.5, \"heterogeneity\": {\"Ar\": 0.1}";

}  // namespace

void read_run_folder(std::string_view bytes) { refusing(read, bytes); }

std::vector<std::string> run_folder_seeds() {
  const std::string with_tables = std::string(pair_file) + tables, numbers = path_numbers;
  return {
      "@@ run.toml\nsubcommand = 'path'\nmethod = 'contour'\nmodel = 'lennard-jones'\nadaptive = false\nstep = 0.001\npair = "
      "['a.extxyz']\nimages = 'minimum'\n@@ result.json\n{\"paths\": [{" +
          numbers + "}], \"exit_status\": 0}\n" + with_tables,
      "@@ run.toml\nsubcommand = 'shorten'\nmethod = 'curve'\npath-method = 'contour'\nadaptive = true\nstarts = 2\npair = "
      "'a.extxyz'\n@@ result.json\n{" +
          numbers +
          ", \"length_before\": 14.0, \"kuhn_tucker_residual\": 1e-3, \"model\": \"lennard-jones\", \"exit_status\": 0}\n" +
          with_tables,
      "@@ run.toml\nsubcommand = 'endpoints'\nmodel = 'lennard-jones'\ndensity = 0.8\ntemperature = 1\ndistance = 9\n@@ "
      "result.json\n{\"pairs\": [{\"distance\": 9.0, \"steps\": 12, \"time\": 0.012, \"seconds\": 1}], \"temperature\": 1.02, "
      "\"exit_status\": 0}\n" +
          std::string(pair_file),
      "@@ run.toml\nsubcommand = 'diffusion'\ninterval = 0.01\nlags = 5\ndensity = 0.8\ntemperature = 1\nwave-number = '7.25'\n@@ "
      "result.json\n{\"species\": {\"Ar\": {\"diffusion_vacf\": 0.1, \"diffusion_vacf_error\": 0.01, \"diffusion_msd\": 0.1, "
      "\"tau_alpha\": null}}, \"pressure\": 4.0, \"temperature\": 1.0, \"trajectories\": 3, \"longest_time\": 0.05, \"model\": "
      "\"lennard-jones\", \"particles\": 108, \"exit_status\": 0}\n"};
}

}  // namespace lanescape::fuzz
