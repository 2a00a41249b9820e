#include "capi/callbacks.hpp"

namespace lanescape::capi {

double CallbackLandscape::evaluate(const double* positions, double* gradient) const {
  double energy = std::numeric_limits<double>::quiet_NaN();
  const int code =
      call_back("evaluate of the landscape", [&] { return landscape_.evaluate(landscape_.user, positions, gradient, &energy); });
  if (code != 0) throw CallbackFailure(code, "evaluate of the landscape returned error code " + std::to_string(code));
  return energy;
}

Progress progress_of(lanescape_progress progress, void* user) {
  if (progress == nullptr) return {};
  return [progress, user](double done) { return call_back("progress", [&] { return progress(user, done) == 0; }); };
}

}  // namespace lanescape::capi
