#include "core/parallel.hpp"

#include <pthread.h>

#include <atomic>
#include <exception>

#include "core/float_environment.hpp"

namespace lanescape {
namespace {

// The threads of GNU's OpenMP end with fork(): a child of a process that has used them would wait for them for ever.
std::atomic<bool> threads_are_gone = false;

bool threads_are_left() {
  [[maybe_unused]] static const int watched = pthread_atfork(nullptr, nullptr, [] { threads_are_gone = true; });
  return !threads_are_gone;
}

}  // namespace

void run_on_threads(int parts, const std::function<void(int)>& body) {
  std::exception_ptr failure;  // of the first part that fails
  int failed = parts;
#pragma omp parallel for schedule(static, 1) num_threads(parts) if (threads_are_left())
  for (int part = 0; part < parts; ++part) {
    const FloatEnvironment environment;
    try {
      body(part);
    } catch (...) {
#pragma omp critical(lanescape_failure)
      if (part < failed) {
        failed = part;
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lanescape
