#include "core/parallel.hpp"

#include <exception>
#include <vector>

#include "core/float_environment.hpp"

namespace lanescape {

void run_on_threads(int parts, const std::function<void(int)>& body) {
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(parts));
#pragma omp parallel for schedule(static, 1) num_threads(parts)
  for (int part = 0; part < parts; ++part) {
    const FloatEnvironment environment;
    try {
      body(part);
    } catch (...) {
      failures[static_cast<std::size_t>(part)] = std::current_exception();
    }
  }
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace lanescape
