#include "python_states.hpp"

#include <nanobind/ndarray.h>

#include <array>
#include <initializer_list>
#include <string>

#include "arguments.hpp"

namespace lanescape::python {
namespace {

// Of memory of the library's. Of const numbers it is read-only.
template <class Number>
nb::object view(Number* numbers, std::initializer_list<std::size_t> shape) {
  return nb::cast(nb::ndarray<nb::numpy, Number>(numbers, shape.size(), shape.begin(), nb::handle()), nb::rv_policy::reference);
}

nb::object pairs_view(const SitePairs& pairs) {
  const std::size_t count = pairs.first.size();
  nb::dict members;
  members["first"] = view(pairs.first.data(), {count});
  members["second"] = view(pairs.second.data(), {count});
  members["separation"] = view(reinterpret_cast<const double*>(pairs.separation.data()), {count, 3});
  return new_result("SitePairs", members);
}

void check_method(nb::handle given, const char* what, const char* name) {
  if (nb::hasattr(given, name) && PyCallable_Check(nb::object(given.attr(name)).ptr()) != 0) return;
  throw nb::type_error((std::string(what) + ": " + text(nb::type_name(given.type())) + " has no method " + name).c_str());
}

class PythonOrderParameter final : public SiteOrderParameter {
 public:
  explicit PythonOrderParameter(nb::handle given) : given_(given) {
    for (const char* name : {"reach", "evaluate", "add_gradient"}) check_method(given, "order_parameter", name);
  }

  double reach(int first_species, int second_species) const override {
    const nb::gil_scoped_acquire interpreter;
    return nb::cast<double>(nb::float_(given_.attr("reach")(first_species, second_species)));
  }

  void evaluate(const SitePairs& pairs, std::span<const int> species, std::span<double> values) override {
    const nb::gil_scoped_acquire interpreter;
    given_.attr("evaluate")(pairs_view(pairs), view(species.data(), {species.size()}), view(values.data(), {values.size()}));
  }

  void add_gradient(const SitePairs& pairs, std::span<const int> species, std::span<const double> multipliers,
                    std::span<double> gradient, std::array<double, 6>& virial) override {
    const nb::gil_scoped_acquire interpreter;
    given_.attr("add_gradient")(pairs_view(pairs), view(species.data(), {species.size()}),
                                view(multipliers.data(), {multipliers.size()}), view(gradient.data(), {gradient.size() / 3, 3}),
                                view(virial.data(), {6}));
  }

 private:
  nb::handle given_;
};

class PythonResponse final : public SiteResponse {
 public:
  explicit PythonResponse(nb::handle given) : given_(given) {
    for (const char* name : {"states", "evaluate"}) check_method(given, "response", name);
    states_ = nb::cast<std::size_t>(given.attr("states")());
  }

  std::size_t states() const override { return states_; }

  void evaluate(int species, double value, std::span<SiteProbability> states) const override {
    static_assert(sizeof(SiteProbability) == 3 * sizeof(double));
    const nb::gil_scoped_acquire interpreter;
    given_.attr("evaluate")(species, value, view(&states.data()->p, {states.size(), 3}));
  }

 private:
  nb::handle given_;
  std::size_t states_ = 0;
};

}  // namespace

std::shared_ptr<SiteOrderParameter> order_parameter_of(nb::handle given) {
  return given.is_none() ? nullptr : std::make_shared<PythonOrderParameter>(given);
}

std::shared_ptr<SiteResponse> response_of(nb::handle given) {
  return given.is_none() ? nullptr : std::make_shared<PythonResponse>(given);
}

}  // namespace lanescape::python
