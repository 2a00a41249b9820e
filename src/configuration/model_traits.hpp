#pragma once

#include "configuration/model.hpp"

namespace lanescape {

enum class Family { soft, hard };

// What the rest of the library asks about a model without knowing its kind. A kind of model that lacks an answer does not compile.
struct ModelTraits {
  Family family;
  const char* particles;  // in messages: "model X is made of ..."
  ImageRule images;       // of soft models
  SizeColumn sizes;       // what files must hold of each particle
  bool has_precision;     // single precision is possible (Precision::mixed)
  bool has_states;        // each site has state probabilities
};

ModelTraits traits_of(const AnyModel& model);

inline bool is_hard(const AnyModel& model) { return traits_of(model).family == Family::hard; }

}  // namespace lanescape
