#pragma once

#include <lanescape/engine.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "configuration/model.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "landscape/soft_landscape.hpp"
#include "run/configuration_pair.hpp"

namespace lanescape::program {

// Another program's energies as a landscape: a module and what it has opened.
class Engine {
 public:
  // `word`: NAME:INPUT. Throws Error(bad_input) where there is no such module, and where the module cannot use the input. Null
  // where this process has served another one.
  static std::unique_ptr<Engine> open(const std::string& word);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const char* units() const { return engine_.units; }
  // Throws Error(bad_input) unless the engine has the particles, species, masses and box of this pair.
  void check(const ConfigurationPair& pair, const AnyModel& model, const std::string& where) const;
  // Positions and gradient in the user's order. Throws Error(internal) where the engine fails.
  double evaluate(std::span<const double> positions, std::span<double> gradient);
  std::vector<double> state() const;
  void restore(std::span<const double> state);

 private:
  explicit Engine(std::string word) : word_(std::move(word)) {}
  [[noreturn]] void fail() const;

  std::string word_;
  lanescape_engine engine_{};
};

// V(R) by an engine, which must outlive this object; one such object at a time.
class EngineLandscape final : public SoftLandscape {
 public:
  EngineLandscape(Engine& engine, const ParticleLayout& layout, Isa isa);

  std::size_t dimension() const override { return layout_.dimension(); }
  std::size_t particles() const override { return layout_.size(); }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& position) override;
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override;
  bool has_history() const override { return true; }
  void pass_over(const AlignedArray& position) override { energy(position); }
  void exchange(Archive& archive) override;

 private:
  Engine* engine_;
  ParticleLayout layout_;
  VectorAlgebra algebra_;
  std::vector<double> positions_, gradient_;  // in the user's order
};

}  // namespace lanescape::program
