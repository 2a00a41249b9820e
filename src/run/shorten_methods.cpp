// The table of shortening methods: a new one is one class and one line here.

#include <fmt/format.h>

#include "core/error.hpp"
#include "run/shorten_curve.hpp"
#include "run/shorten_method.hpp"
#include "run/shorten_montecarlo.hpp"

namespace lanescape {
namespace {

constexpr ShortenMethod shortening[] = {{"curve", "iterations", begin_curve_shortening},
                                        {"montecarlo", "trials", begin_montecarlo_shortening}};

}  // namespace

std::span<const ShortenMethod> shorten_methods() { return shortening; }

const ShortenMethod& default_shorten_method() { return shortening[0]; }

const ShortenMethod& shorten_method(std::string_view word) {
  for (const ShortenMethod& method : shortening)
    if (word == method.word) return method;
  throw_bad_input(fmt::format("unknown method '{}': allowed: {}", word, shorten_method_words()));
}

std::string shorten_method_words() {
  std::string words;
  for (const ShortenMethod& method : shortening) words += fmt::format("{}{}", words.empty() ? "" : ", ", method.word);
  return words;
}

}  // namespace lanescape
