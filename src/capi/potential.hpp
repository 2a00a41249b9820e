#pragma once

#include <memory>
#include <utility>
#include <variant>

#include <lanescape/potential.hpp>
#include <lanescape/states.hpp>

#include "capi/handles.hpp"

namespace lanescape::capi {

// Shared by the caller and the dynamics that run on it, one at a time.
struct SoftPotential {
  std::variant<Potential, StateSystem> potential;
  std::atomic<bool> busy{false};
};

template <class Work>
auto with(SoftPotential& soft, const Work& work) {
  const Occupied occupied(soft.busy, "potential");
  return std::visit(work, soft.potential);
}

class SharedLandscape final : public Landscape {
 public:
  explicit SharedLandscape(std::shared_ptr<SoftPotential> potential) : potential_(std::move(potential)) {}

  std::size_t particles() const override {
    return std::visit([](const auto& p) { return p.particles(); }, potential_->potential);
  }
  double energy(std::span<const double> positions) override {
    return with(*potential_, [&](auto& p) { return p.energy(positions); });
  }
  double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) override {
    return with(*potential_, [&](auto& p) { return p.energy_and_gradient(positions, gradient); });
  }

 private:
  std::shared_ptr<SoftPotential> potential_;
};

}  // namespace lanescape::capi

struct lanescape_potential : lanescape::capi::Handle<std::shared_ptr<lanescape::capi::SoftPotential>> {};

namespace lanescape::capi {

Potential::Options options_of(const lanescape_potential_options* given, std::size_t particles);
// Sites in states; the last two in place of the model's, or none.
std::shared_ptr<SoftPotential> make_states(const Model& model, std::span<const int> species, const std::array<double, 3>& box,
                                           const Potential::Options& options, std::shared_ptr<SiteOrderParameter> order_parameter,
                                           std::shared_ptr<SiteResponse> response);

// Stays valid if the handle is destroyed meanwhile.
inline std::shared_ptr<SoftPotential> shared_of(const lanescape_potential* potential) {
  const Occupied occupied(given(potential, "potential").busy, "potential");
  return object_of(potential, "potential");
}

}  // namespace lanescape::capi
