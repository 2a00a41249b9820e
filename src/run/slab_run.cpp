#include "run/slab_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dynamics/langevin.hpp"
#include "landscape/state_mixture_landscape.hpp"

namespace lanescape {
namespace {

// The number of cells that keeps the nearest neighbours as far apart as possible: a squeezed lattice flies apart.
std::size_t cells_across(const SlabOptions& options) {
  const auto nearest = [&](double cells) {
    const double step = options.width / cells;
    return std::min(step, 1.0 / (options.start_density * step * step));
  };
  const double few = std::max(1.0, std::floor(options.width * std::cbrt(options.start_density)));
  return static_cast<std::size_t>(nearest(few) < nearest(few + 1.0) ? few + 1.0 : few);
}

// A simple cubic lattice in the middle of the box, as long as needed; species alternate.
Configuration lattice_slab(const SlabOptions& options, std::size_t species) {
  Configuration slab{{{options.width, options.width, options.length}}, {}, {}};
  const std::size_t across = cells_across(options);
  const double step = options.width / static_cast<double>(across), rise = 1.0 / (options.start_density * step * step);
  const std::size_t layers = (options.particles + across * across - 1) / (across * across);
  if (static_cast<double>(layers) * rise > options.length)
    throw_bad_input(fmt::format("{} particles at density {} do not fit into a box of {} x {} x {}", options.particles,
                                options.start_density, options.width, options.width, options.length));
  const double bottom = 0.5 * (options.length - static_cast<double>(layers) * rise);
  for (std::size_t i = 0; i < options.particles; ++i) {
    const std::size_t layer = i / (across * across), in_layer = i % (across * across);
    slab.species.push_back(static_cast<int>(i % species));
    slab.positions.push_back((static_cast<double>(in_layer % across) + 0.5) * step);
    slab.positions.push_back((static_cast<double>(in_layer / across) + 0.5) * step);
    slab.positions.push_back(bottom + (static_cast<double>(layer) + 0.5) * rise);
  }
  return slab;
}

// Langevin dynamics of a slab, with samples taken after its equilibration.
class SlabWork final : public ResumableWork {
 public:
  SlabWork(const StateMixtureModel& model, const Configuration& start, const SlabOptions& options, Isa isa)
      : start_(start),
        options_(options),
        layout_(ParticleLayout::in_space_order(start, model.species.size())),
        landscape_(model, start.box, layout_, isa, with_threads(options.threads)),
        dynamics_(landscape_, model, layout_, layout_.to_slots(start.positions),
                  {options.temperature, options.friction, options.time_step, options.seed}),
        sampler_(start.box, options.bins, model.most_states()) {}

  bool finished() const override { return dynamics_.steps() == total(); }
  void advance(RunMonitor& monitor) override {
    do step();
    while (!finished() && dynamics_.steps() % steps_per_chunk != 0);
    monitor.progress("slab", static_cast<double>(dynamics_.steps()), static_cast<double>(total()));
  }
  bool save_due() const override { return dynamics_.steps() % (steps_per_chunk * chunks_per_checkpoint) == 0; }
  void exchange(Archive& archive) override {
    dynamics_.exchange(archive);
    sampler_.exchange(archive);
    archive.field("temperature_sum", temperature_);
  }

  SlabRunResult result(bool interrupted) const {
    SlabRunResult result{.profiles = sampler_.profiles(), .interrupted = interrupted, .seconds = clock().seconds()};
    if (sampler_.samples() > 0) result.temperature = temperature_ / static_cast<double>(sampler_.samples());
    result.last = {start_.box, start_.species, layout_.to_user(dynamics_.position())};
    result.last.wrap();
    return result;
  }

 private:
  static constexpr std::uint64_t steps_per_chunk = 100, chunks_per_checkpoint = 20;

  static StateMixture::Options with_threads(int threads) {
    StateMixture::Options options;
    options.threads = threads;
    return options;
  }
  std::uint64_t total() const { return options_.equilibration_steps + options_.sampling_steps; }
  void step() {
    dynamics_.step();
    if (dynamics_.steps() <= options_.equilibration_steps || dynamics_.steps() % options_.interval != 0) return;
    sampler_.add(layout_.to_user(dynamics_.position()), layout_, landscape_.interaction());
    temperature_ += dynamics_.temperature();
  }

  const Configuration& start_;
  const SlabOptions& options_;
  ParticleLayout layout_;
  StateMixtureLandscape landscape_;
  Langevin dynamics_;
  SlabSampler sampler_;
  double temperature_ = 0.0;  // sum over samples
};

}  // namespace

void SlabOptions::check() const {
  check_positive("width", width, 1e4);
  check_positive("length", length, 1e5);
  check_positive("start density", start_density, 1.5);
  if (particles == 0 || particles > 4'000'000)
    throw_bad_input(fmt::format("{} particles are not allowed: from 1 to 4000000", particles));
  if (interval == 0) throw_bad_input("interval 0 is not allowed: at least one step between samples");
  if (bins == 0 || bins > 100'000) throw_bad_input(fmt::format("{} bins are not allowed: from 1 to 100000", bins));
  LangevinOptions{temperature, friction, time_step, seed}.check();
}

void SlabOptions::check_against(const StateMixtureModel& model) const {
  check();
  const Configuration start = lattice_slab(*this, model.species.size());
  check_cutoff(model, start.box);
  check_separations(start, model);
}

SlabRunResult run_slab(const StateMixtureModel& model, const SlabOptions& options, Isa isa, const CheckpointOptions& checkpoint,
                       RunMonitor& monitor) {
  options.check_against(model);
  const Configuration start = lattice_slab(options, model.species.size());
  SlabWork work(model, start, options, isa);
  return work.result(run_to_end(work, "slab.h5", checkpoint, monitor));
}

}  // namespace lanescape
