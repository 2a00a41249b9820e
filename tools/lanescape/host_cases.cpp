#include "host_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "json.hpp"
#include "lanescape/lanescape.hpp"

namespace lanescape::program {
namespace {

// S x S numbers, row by row, as a list of rows.
template <class Number>
Json matrix(std::size_t rows, const Number& number) {
  Json all = Json::array();
  for (std::size_t a = 0; a < rows; ++a) {
    Json row = Json::array();
    for (std::size_t b = 0; b < rows; ++b) row.push_back(number(a * rows + b));
    all.push_back(std::move(row));
  }
  return all;
}

Json to_json(const PairCase& one) {
  const PairModel& model = one.model;
  const std::size_t species = model.species.size();
  Json json = {{"name", one.name}, {"particles", one.configuration.size()}, {"box", one.configuration.box.length}};
  for (const Species& s : model.species) json["species"].push_back(s.name);
  json["form"] = model.form->word;
  json["numbers"] = Json::object();
  for (std::size_t k = 0; k < model.form_numbers.size(); ++k) json["numbers"][model.form->numbers[k].key] = model.form_numbers[k];
  json["epsilon"] = matrix(species, [&](std::size_t ab) { return model.epsilon[ab]; });
  json["sigma"] = matrix(species, [&](std::size_t ab) { return model.sigma[ab]; });
  json["cutoff"] = matrix(species, [&](std::size_t ab) { return model.cutoff_of(ab); });
  json["truncation"] = to_string(model.truncation);
  json["images"] = to_string(model.images);
  return json;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file)) throw_bad_input(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

void check_untouched(const std::filesystem::path& file, const std::string& expected) {
  if (content(file) != expected)
    throw_bad_input(
        fmt::format("{}: is not what this version of lanescape cases writes: write the cases again, and leave the file as it is",
                    file.string()));
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) { throw_bad_input(fmt::format("{}: {}", where, what)); }

double number_of(const Json& json, const std::string& where) {
  if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!json.is_number()) refuse(where, "a number is needed");
  return json.get<double>();
}

std::vector<double> forces_of(const Json& json, std::size_t particles, const std::string& where) {
  if (!json.is_array() || json.size() != particles)
    refuse(where, fmt::format("{} rows, one for each particle, are needed{}", particles,
                              json.is_array() ? fmt::format(", not {}", json.size()) : ""));
  std::vector<double> forces;
  for (std::size_t i = 0; i < particles; ++i) {
    if (!json[i].is_array() || json[i].size() != 3) refuse(fmt::format("{}[{}]", where, i), "three numbers are needed");
    for (const Json& component : json[i]) forces.push_back(number_of(component, fmt::format("{}[{}]", where, i)));
  }
  return forces;
}

HostResult result_of(const Json& json, std::size_t particles, const std::string& where) {
  if (json.is_null()) return {HostResult::Kind::declined};
  if (!json.is_object()) refuse(where, "an object with energy, forces and virial is needed, or null for a case that is declined");
  HostResult result{HostResult::Kind::given};
  for (const auto& [key, value] : json.items()) {
    const std::string here = fmt::format("{}: {}", where, key);
    if (key == "energy")
      result.energy = number_of(value, here);
    else if (key == "virial")
      result.virial = number_of(value, here);
    else if (key == "forces")
      result.forces = forces_of(value, particles, here);
    else
      refuse(here, "is unknown: allowed are energy, forces and virial");
  }
  return result;
}

Json parse(const std::filesystem::path& file) {
  const std::string text = content(file);
  try {
    return Json::parse(text);
  } catch (const Json::out_of_range& error) {
    refuse(file.string(), fmt::format("a number is out of range ({}): null is allowed for one that is not finite", error.what()));
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    refuse(file.string(),
           fmt::format("line {}, byte {}: no JSON (NaN and Infinity are none: null is allowed for such a number)", line, end));
  }
}

}  // namespace

std::string text_of_cases(const std::vector<PairCase>& cases) {
  Json json;
  json["version"] = version();
  std::size_t frames = 0;
  for (const PairCase& one : cases) {
    Json entry = to_json(one);
    entry["frame"] = one.configuration.size() == 0 ? Json() : Json(frames++);
    json["cases"].push_back(std::move(entry));
  }
  return json.dump(1) + "\n";
}

std::string text_of_positions(const std::vector<PairCase>& cases) {
  std::ostringstream out;
  for (const PairCase& one : cases)
    if (one.configuration.size() > 0) write_frame(out, one.configuration, one.model, {{"case", one.name}});
  return out.str();
}

std::vector<HostResult> read_host_results(const std::filesystem::path& folder, const std::vector<PairCase>& cases) {
  check_untouched(folder / cases_file, text_of_cases(cases));
  check_untouched(folder / positions_file, text_of_positions(cases));
  const std::filesystem::path file = folder / host_results_file;
  const Json json = parse(file);
  if (!json.is_object()) refuse(file.string(), "an object is needed, with the names of cases as keys");
  std::map<std::string, std::size_t> index;
  for (std::size_t k = 0; k < cases.size(); ++k) index[cases[k].name] = k;
  std::vector<HostResult> results(cases.size());
  for (const auto& [name, value] : json.items()) {
    const auto found = index.find(name);
    const std::string where = fmt::format("{}: case '{}'", file.string(), name);
    if (found == index.end()) refuse(where, fmt::format("is unknown: the names of {} are allowed", cases_file));
    results[found->second] = result_of(value, cases[found->second].configuration.size(), where);
  }
  return results;
}

}  // namespace lanescape::program
