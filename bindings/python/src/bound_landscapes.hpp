#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <lanescape/potential.hpp>
#include <lanescape/states.hpp>

#include "guarded.hpp"
#include "python_states.hpp"

// The library's landscapes as Python holds them, with what their pickles need and the library's classes do not tell again.
namespace lanescape::python {

struct BoundPotential : Guarded<Potential> {
  using Guarded<Potential>::Guarded;
  std::vector<std::array<std::size_t, 2>> exclusions{};
};

struct StateParameters {
  Model model;
  std::vector<int> species;
  std::array<double, 3> box;
  int threads;
  std::string instruction_set;
  nb::object order_parameter, response;  // of the user's, or None
};

struct BoundStates : Guarded<StateSystem> {
  explicit BoundStates(StateParameters with)
      : Guarded<StateSystem>(with.model, with.species, with.box,
                             StateSystem::Options{with.threads, with.instruction_set, order_parameter_of(with.order_parameter),
                                                  response_of(with.response)}),
        parameters(std::move(with)) {}
  StateParameters parameters;
};

}  // namespace lanescape::python
