#pragma once

#include <vector>

#include <lanescape/model.hpp>

#include "capi/handles.hpp"

namespace lanescape::capi {

struct NamedModel {
  Model model;
  std::vector<ModelSpecies> species;  // whose names callers hold
};

}  // namespace lanescape::capi

struct lanescape_model : lanescape::capi::Handle<lanescape::capi::NamedModel> {};
