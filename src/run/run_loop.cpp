#include "run/run_loop.hpp"

#include "core/float_environment.hpp"
#include "io/hdf5_archive.hpp"

namespace lanescape {

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
    archive.commit();
  };
  if (checkpoint.enabled() && checkpoint.resume && std::filesystem::exists(path)) {
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
