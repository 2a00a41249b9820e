#include "run/run_loop.hpp"

#include <fmt/format.h>

#include <system_error>

#include "core/float_environment.hpp"
#include "io/hdf5_archive.hpp"
#include "io/whole_file.hpp"

namespace lanescape {
namespace {

// Where the state before the newest one is kept.
std::filesystem::path state_before(std::filesystem::path path) { return path += ".previous"; }

// Whether there is a state to resume from. Where the newest one is missing or not whole, the one before takes its place if it is
// whole.
bool has_state(const std::filesystem::path& path, RunMonitor& monitor) {
  const std::filesystem::path before = state_before(path);
  const auto fault = fault_of_file(path);
  std::error_code failed;
  if (fault && !fault_of_file(before)) {
    std::filesystem::rename(before, path, failed);
    if (!failed) monitor.notice(fmt::format("{}: {}; the state saved before it is used", path.string(), *fault));
  }
  return std::filesystem::exists(path);
}

}  // namespace

bool run_to_end(ResumableWork& work, const std::string& file, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  const FloatEnvironment environment;
  const std::filesystem::path path = checkpoint.folder / file;
  const auto exchange = [&](Archive& archive) {
    work.exchange(archive);
    work.clock_.exchange(archive);
  };
  // A kill leaves the old file or the new one, never half of either.
  const auto save = [&] {
    if (!checkpoint.enabled() || !work.saveable()) return;
    Hdf5Writer archive(path);
    exchange(archive);
    archive.commit(state_before(path));
  };
  if (checkpoint.enabled() && checkpoint.resume && has_state(path, monitor)) {
    Hdf5Reader archive(path);
    exchange(archive);
  }
  if (work.finished()) return false;
  work.clock_.start();
  for (;;) {
    work.advance(monitor);
    work.clock_.lap();
    const bool finished = work.finished(), interrupted = !finished && monitor.stop_requested();
    if (finished || interrupted || work.save_due()) save();
    if (finished || interrupted) return interrupted;
  }
}

}  // namespace lanescape
