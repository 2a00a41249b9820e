#pragma once

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "pair_systems.hpp"

/// Configurations and results of other codes in tests/data.
namespace lanescape::reference {

inline std::string data_file(const std::string& name) { return std::string(LANESCAPE_TEST_DATA_DIR) + "/" + name; }

/// Reads files of tools/make_configurations.py; no other variety of extended XYZ.
inline System read_configuration(const std::string& name) {
  std::ifstream file(data_file(name));
  std::size_t count = 0;
  std::string comment;
  file >> count;
  std::getline(file, comment);
  std::getline(file, comment);
  System result;
  if (!file || std::sscanf(comment.c_str(), "Lattice=\"%lf 0.0 0.0 0.0 %lf 0.0 0.0 0.0 %lf\"", &result.box[0], &result.box[1],
                           &result.box[2]) != 3)
    throw std::runtime_error(data_file(name) + ": not as expected");
  std::string symbol;
  for (double x, y, z; file >> symbol >> x >> y >> z;) {
    result.positions.insert(result.positions.end(), {x, y, z});
    result.species.push_back(symbol == "P" ? 1 : 0);
  }
  if (result.species.size() != count) throw std::runtime_error(data_file(name) + ": wrong number of particles");
  return result;
}

inline nlohmann::json read_json(const std::string& name) {
  nlohmann::json result;
  std::ifstream(data_file(name)) >> result;
  return result;
}

}  // namespace lanescape::reference
