#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <lanescape/owned.hpp>
#include <lanescape/potential.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// All pairs of sites within reach, once from each end: separation = r_first - r_second (an image of it).
struct SitePairs {
  std::span<const std::int64_t> first, second;
  std::span<const std::array<double, 3>> separation;
};

// One number per site on which the site's state depends, such as a local density: a host's own.
class LANESCAPE_API SiteOrderParameter {
 public:
  virtual ~SiteOrderParameter() = default;
  // The distance within which it looks at pairs of these species, at most 8.5 of the box's shortest edge.
  virtual double reach(int first_species, int second_species) const = 0;
  // Overwrites `values`, one per site.
  virtual void evaluate(const SitePairs& pairs, std::span<const int> species, std::span<double> values) = 0;
  // Adds sum_k multipliers[k] d value[k]/dr_i to the gradient of each site, 3N, and returns in `virial` what that adds to
  // sum r_a f_b, xx yy zz yz xz xy.
  virtual void add_gradient(const SitePairs& pairs, std::span<const int> species, std::span<const double> multipliers,
                            std::span<double> gradient, std::array<double, 6>& virial) = 0;
};

// One state of one site: its probability, the slope with respect to the order parameter, and the logarithm.
struct SiteProbability {
  double p = 0.0, slope = 0.0, logarithm = 0.0;
};

// The probabilities of a site's states as functions of its order parameter; they add up to one.
class LANESCAPE_API SiteResponse {
 public:
  virtual ~SiteResponse() = default;
  virtual std::size_t states() const = 0;
  virtual void evaluate(int species, double value, std::span<SiteProbability> states) const = 0;
};

// Sites whose states follow their surroundings (ultra-coarse-graining): U(p(R), R). Energies, forces and stress, and the states of
// the last evaluation. Not thread-safe.
class LANESCAPE_API StateSystem final : public Landscape {
 public:
  struct Options {
    int threads = 1;
    std::string instruction_set = "auto";  // or a name of instruction_sets()
    // In place of the model's: both or none, on one thread.
    std::shared_ptr<SiteOrderParameter> order_parameter{};
    std::shared_ptr<SiteResponse> response{};
  };

  // The model has states: Model::has_states().
  StateSystem(Model model, std::span<const int> species, const std::array<double, 3>& box);
  StateSystem(Model model, std::span<const int> species, const std::array<double, 3>& box, const Options& options);
  ~StateSystem() override;
  StateSystem(StateSystem&&) noexcept;
  StateSystem& operator=(StateSystem&&) noexcept;

  std::size_t particles() const override;
  // As Potential::set_box().
  void set_box(const std::array<double, 3>& box);
  double energy(std::span<const double> positions) override;
  double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) override;
  // Outputs::energies: the one-body terms of each site and half of each of its pairs at the present probabilities.
  Evaluation evaluate(std::span<const double> positions, const Outputs& outputs);
  Evaluation evaluate(const Vectors<const double>& positions, const Outputs& outputs);

  // Of the last evaluation: order parameters, N, and probabilities, N x states().
  std::size_t states() const;
  std::vector<double> order_parameters() const;
  std::vector<double> probabilities() const;

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
