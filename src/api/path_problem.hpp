#pragma once

#include <lanescape/path.hpp>
#include <lanescape/potential.hpp>

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <string_view>
#include <thread>

#include "api/host_landscape.hpp"
#include "core/run_monitor.hpp"
#include "run/path_search.hpp"

namespace lanescape {

// Particles of a model without positions. Throws Error(bad_input) for none, unknown species, and diameters that are not as many as
// the model needs.
Configuration particles_of(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                           std::span<const double> diameters);
// Them at a host's positions. Throws Error(bad_input) where these are not 3N finite numbers.
Configuration placed(const Configuration& particles, std::span<const double> positions);

// The particles of a host's landscape, of which only the masses are known.
class HostParticles {
 public:
  // Throws what MassMixture does, and Error(bad_input) for no particles.
  HostParticles(Landscape& landscape, std::span<const double> masses);

  Configuration particles() const { return {{}, masses_.species, {}}; }
  const Mixture& mixture() const { return masses_.mixture; }
  const ParticleLayout& layout() const { return layout_; }
  // Must not outlive this object.
  SoftLandscapeMaker maker(Isa isa) const {
    return [this, isa]() -> std::unique_ptr<SoftLandscape> { return std::make_unique<HostLandscape>(*landscape_, layout_, isa); };
  }

 private:
  Landscape* landscape_;
  MassMixture masses_;
  ParticleLayout layout_;
};

// The search for a path that a host asks for, checked.
class PathProblem {
 public:
  // Both throw Error(bad_input) as find_path() says.
  PathProblem(const Model& model, std::span<const int> species, const std::array<double, 3>& box, std::span<const double> start,
              std::span<const double> finish, const PathSettings& settings, std::span<const double> diameters);
  PathProblem(Landscape& landscape, std::span<const double> start, std::span<const double> finish, const PathSettings& settings,
              std::span<const double> masses);
  PathProblem(const PathProblem&) = delete;
  PathProblem& operator=(const PathProblem&) = delete;

  const AnyModel& model() const { return model_; }
  const PathRunOptions& options() const { return options_; }
  // Must not outlive this object.
  SearchSetup setup() const;

 private:
  std::unique_ptr<const HostParticles> host_;  // of a landscape
  AnyModel model_;
  PathRunOptions options_;
  Isa isa_;
  SoftLandscapeMaker landscape_;  // of a host
  ConfigurationPair pair_;
  PreparedPair prepared_;
};

// The potential behind a landscape if paths on it are those of its model, which go without a host's arrays; else nullptr.
const Potential* model_potential(const Landscape& landscape, std::span<const double> masses);
// With the potential's threads, precision and instruction set.
PathSettings with_options_of(const Potential& potential, PathSettings settings);

// What long work tells a host, whose function is called from the thread that made this. An exception of the function passes
// through there, and ends the work of all threads.
class ProgressMonitor : public RunMonitor {
 public:
  explicit ProgressMonitor(const Progress& progress) : progress_(&progress) {}
  void progress(std::string_view stage, double done, double total) override;
  bool stop_requested() const override { return stop_; }

 protected:
  // What the host is told.
  virtual double told(std::string_view, double done, double) const { return done; }

 private:
  const Progress* progress_;
  std::thread::id thread_ = std::this_thread::get_id();
  std::atomic<bool> stop_ = false;
};

// Does work until it is finished or the monitor asks to stop: true if it was interrupted.
bool run_for_host(ResumableWork& work, RunMonitor& monitor);

}  // namespace lanescape
