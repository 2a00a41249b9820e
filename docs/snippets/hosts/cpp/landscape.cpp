// A path on a landscape of the host's own: around a hill, from one side to the other.

#include <cmath>
#include <cstdio>
#include <lanescape/lanescape.hpp>

struct Hill final : lanescape::Landscape {
  std::size_t particles() const override { return 1; }
  double energy(std::span<const double> r) override { return 5.0 * std::exp(-(r[0] * r[0] + r[1] * r[1])); }
  double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
    const double v = energy(r);
    for (std::size_t k = 0; k < 3; ++k) gradient[k] = k < 2 ? -2.0 * r[k] * v : 0.0;
    return v;
  }
};

int main() {
  Hill hill;
  const std::vector<double> start = {-2.0, 0.1, 0.0}, finish = {2.0, 0.1, 0.0};
  const lanescape::Path path = lanescape::find_path(hill, start, finish, {.landscape_energy = 1.0});
  std::printf("%s, length %.3f\n", path.outcome.c_str(), path.length);

  const lanescape::ShortPath shortest = lanescape::shorten_path(hill, start, finish, {.search = {.landscape_energy = 1.0}});
  const lanescape::PathCertificate found = lanescape::check_path(hill, shortest.frames, {.landscape_energy = 1.0});
  std::printf("shortened to %.3f, Kuhn-Tucker residual %.1e, V - E_L at most %.1e\n", found.length, found.kuhn_tucker_residual,
              found.largest_violation);
  return path.reached() && shortest.reached() ? 0 : 1;
}
