#include "resume_or_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/error.hpp"
#include "options.hpp"
#include "program.hpp"
#include "run_file.hpp"

namespace lanescape::program {
namespace {

bool same(const std::string& one, const std::string& other) {
  const std::optional<double> a = number_in(one), b = number_in(other);
  return a && b ? *a == *b : one == other;
}

// Options that change no result, or that say only where the run is and what it is made of.
bool is_compared(const CLI::Option& option) {
  static constexpr std::array others = {"--threads", "--quiet", "--config", "--out", "--resume", "--resume-or-start", "--help"};
  return std::find(others.begin(), others.end(), name_of(option)) == others.end();
}

void refuse_other(const CLI::Option& option, const std::vector<std::string>& given, const toml::table& stored,
                  const std::string& stored_file) {
  const std::string name = name_of(option);
  const toml::node* node = stored.get(key_of(option));
  // Flags without an effect are refused later, and those that name a default where it does not hold.
  if (node == nullptr && option.get_items_expected_max() == 0) return;
  const std::vector<std::string> own = node == nullptr ? std::vector<std::string>{} : values_of(*node, stored_file);
  if (std::equal(given.begin(), given.end(), own.begin(), own.end(), same) || (name == "--isa" && given.front() == "auto")) return;
  throw_bad_input(fmt::format("{} {} contradicts {}, where the run has {}: leave it out, or name another folder", name,
                              fmt::join(given, " "), stored_file, own.empty() ? "none" : fmt::format("{}", fmt::join(own, " "))));
}

}  // namespace

void refuse_contradictions(const CLI::App& subcommand, const toml::table& stored, const std::string& stored_file) {
  for (const CLI::Option* option : subcommand.get_options())
    if (option->count() > 0 && is_compared(*option)) refuse_other(*option, option->results(), stored, stored_file);
}

void refuse_contradictions(const CLI::App& subcommand, const toml::table& given, const toml::table& stored,
                           const std::string& stored_file) {
  for (const CLI::Option* option : subcommand.get_options())
    if (const toml::node* node = given.get(key_of(*option)); node != nullptr && option->count() == 0 && is_compared(*option))
      refuse_other(*option, values_of(*node, stored_file), stored, stored_file);
}

std::optional<FinishedRun> finished_run(const std::filesystem::path& folder) {
  std::ifstream file(folder / "result.json", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Json result = Json::parse(text, nullptr, false);
  if (!result.is_object() || !result.contains(exit_status_key) || !result[exit_status_key].is_number_integer()) return std::nullopt;
  const int status = result[exit_status_key].get<int>();
  if (status == interrupted_status) return std::nullopt;
  return FinishedRun{text, status};
}

}  // namespace lanescape::program
