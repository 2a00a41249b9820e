#include <lanescape/states.hpp>

#include "capi/arguments.hpp"
#include "capi/model.hpp"
#include "capi/potential.hpp"

using namespace lanescape;
using namespace lanescape::capi;

namespace {

const lanescape_state_functions& checked(const lanescape_state_functions* given) {
  const auto& functions = sized(given, "functions", "lanescape_state_functions");
  if (functions.reach == nullptr) refuse_null("functions->reach");
  if (functions.evaluate == nullptr) refuse_null("functions->evaluate");
  if (functions.add_gradient == nullptr) refuse_null("functions->add_gradient");
  if (functions.respond == nullptr) refuse_null("functions->respond");
  return functions;
}

template <class Call>
void call(const char* name, const Call& function) {
  const std::string what = std::string(name) + " of the states";
  const int code = call_back(what.c_str(), function);
  if (code != 0) throw CallbackFailure(code, what + " returned error code " + std::to_string(code));
}

lanescape_site_pairs given_to_caller(const SitePairs& pairs) {
  return {sizeof(lanescape_site_pairs), pairs.first.size(), pairs.first.data(), pairs.second.data(),
          pairs.separation.empty() ? nullptr : pairs.separation.data()->data()};
}

class CallbackOrderParameter final : public SiteOrderParameter {
 public:
  explicit CallbackOrderParameter(const lanescape_state_functions& functions) : functions_(functions) {}

  double reach(int first_species, int second_species) const override {
    double reach = std::numeric_limits<double>::quiet_NaN();
    call("reach", [&] { return functions_.reach(functions_.user, first_species, second_species, &reach); });
    return reach;
  }

  void evaluate(const SitePairs& pairs, std::span<const int> species, std::span<double> values) override {
    const lanescape_site_pairs seen = given_to_caller(pairs);
    call("evaluate", [&] { return functions_.evaluate(functions_.user, &seen, species.size(), species.data(), values.data()); });
  }

  void add_gradient(const SitePairs& pairs, std::span<const int> species, std::span<const double> multipliers,
                    std::span<double> gradient, std::array<double, 6>& virial) override {
    const lanescape_site_pairs seen = given_to_caller(pairs);
    call("add_gradient", [&] {
      return functions_.add_gradient(functions_.user, &seen, species.size(), species.data(), multipliers.data(), gradient.data(),
                                     virial.data());
    });
  }

 private:
  lanescape_state_functions functions_;
};

class CallbackResponse final : public SiteResponse {
 public:
  explicit CallbackResponse(const lanescape_state_functions& functions) : functions_(functions) {}

  std::size_t states() const override { return functions_.states; }
  void evaluate(int species, double value, std::span<SiteProbability> states) const override {
    static_assert(sizeof(SiteProbability) == 3 * sizeof(double));
    call("respond", [&] { return functions_.respond(functions_.user, species, value, &states.data()->p); });
  }

 private:
  lanescape_state_functions functions_;
};

}  // namespace

lanescape_status lanescape_potential_create_with_states(const lanescape_model* model, size_t particles, const int* species,
                                                        const double box[3], const lanescape_potential_options* options,
                                                        const lanescape_state_functions* functions,
                                                        lanescape_potential** potential) {
  return guarded([&] {
    create(potential, "potential", [&] {
      const lanescape_state_functions& own = checked(functions);
      return make_states(object_of(model, "model").model, array(species, particles, "species"), three(box, "box"),
                         options_of(options, particles), std::make_shared<CallbackOrderParameter>(own),
                         std::make_shared<CallbackResponse>(own));
    });
  });
}
