#pragma once

#include <lanescape/model.hpp>

#include <memory>
#include <utility>

#include "configuration/model.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace detail {

struct ModelData {
  AnyModel model;
};

// What the public classes hide from hosts and show to each other.
struct Access {
  static const AnyModel& of(const Model& model) { return model.data_->model; }
  static Model make(AnyModel model) { return Model(std::make_shared<const ModelData>(ModelData{std::move(model)})); }
};

}  // namespace detail
LANESCAPE_ABI_END
}  // namespace lanescape
