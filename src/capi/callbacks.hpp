#pragma once

#include <lanescape/dynamics.hpp>
#include <lanescape/landscape.hpp>

#include "capi/barrier.hpp"

namespace lanescape::capi {

// The caller's landscape.
class CallbackLandscape final : public Landscape {
 public:
  explicit CallbackLandscape(const lanescape_landscape* landscape)
      : landscape_(sized(landscape, "landscape", "lanescape_landscape")) {
    if (landscape_.evaluate == nullptr) refuse_null("landscape->evaluate");
  }

  std::size_t particles() const override { return landscape_.particles; }
  double energy(std::span<const double> positions) override { return evaluate(positions.data(), nullptr); }
  double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) override {
    return evaluate(positions.data(), gradient.data());
  }

 private:
  double evaluate(const double* positions, double* gradient) const;

  lanescape_landscape landscape_;
};

// Nothing for NULL.
Progress progress_of(lanescape_progress progress, void* user);

}  // namespace lanescape::capi
