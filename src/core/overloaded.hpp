#pragma once

namespace lanescape {

// One function object of several lambdas, for std::visit: an alternative that none of them takes does not compile. Name every
// alternative; a generic lambda would take those that are added later.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

}  // namespace lanescape
