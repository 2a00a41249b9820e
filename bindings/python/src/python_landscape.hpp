#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <memory>
#include <span>

#include <lanescape/landscape.hpp>

#include "guarded.hpp"

namespace lanescape::python {

// A landscape written in Python: an object with energy(R) and energy_and_gradient(R), or a function of R that returns both.
class PythonLandscape final : public Landscape {
 public:
  PythonLandscape(nb::handle given, std::size_t particles);

  std::size_t particles() const override { return particles_; }
  double energy(std::span<const double> positions) override;
  double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) override;
  // Python's objects that this one holds; null where there is none.
  std::array<PyObject*, 2> references() const { return {energy_.ptr(), both_.ptr()}; }

 private:
  std::size_t particles_;
  nb::object energy_, both_;  // energy_ is null where only both are there
};

// A landscape that Python gives, as the library takes it.
struct HeldLandscape {
  // Potential and StateSystem are used as they are, without the interpreter.
  HeldLandscape(nb::handle given, std::size_t particles);

  nb::object given;
  std::unique_ptr<PythonLandscape> in_python;
  Landscape* landscape = nullptr;
  Lock* lock = nullptr;  // of a landscape of the library's
};

// Like the other of its name, with the landscape's lock too.
template <class Work>
auto unlocked(Lock& lock, const HeldLandscape& held, Work&& work) {
  return unlocked(lock, [&] {
    if (held.lock == nullptr) return work();
    const std::lock_guard also(*held.lock);
    return work();
  });
}

}  // namespace lanescape::python
