#pragma once

#include <filesystem>
#include <string>

#include "io/hdf5_archive.hpp"

namespace lanescape {

// Where and how often a run keeps its state, and whether it starts from a state that is there.
struct CheckpointOptions {
  std::filesystem::path folder;  // empty: keep none
  bool resume = false;

  bool enabled() const { return !folder.empty(); }
};

// Writes a state in one atomic step: a kill leaves the old file or the new one, never half of either.
template <class State>
void save_checkpoint(const std::filesystem::path& file, State& state) {
  Hdf5Writer archive(file);
  state.exchange(archive);
  archive.commit();
}

// Reads a state if there is a file; whether there was.
template <class State>
bool load_checkpoint(const std::filesystem::path& file, State& state) {
  if (!std::filesystem::exists(file)) return false;
  Hdf5Reader archive(file);
  state.exchange(archive);
  return true;
}

}  // namespace lanescape
