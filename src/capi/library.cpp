#include <string>
#include <vector>

#include <lanescape/lanescape.hpp>

#include "capi/barrier.hpp"

using namespace lanescape;

namespace {

// A word of a list that is made once, for each type of List, and never destroyed: callers may ask at any time.
template <class List>
const char* word_of(const List& list, std::size_t index) noexcept {
  const char* word = nullptr;
  capi::guarded([&] {
    static const auto* const words = new std::vector<std::string>(list());
    if (index < words->size()) word = (*words)[index].c_str();
  });
  return word;
}

}  // namespace

const char* lanescape_version(void) { return version(); }

const char* lanescape_instruction_set(size_t index) {
  return word_of([] { return instruction_sets(); }, index);
}

const char* lanescape_model_name(size_t index) {
  return word_of([] { return model_names(); }, index);
}

const char* lanescape_pair_potential(size_t index) {
  return word_of([] { return pair_potentials(); }, index);
}

const char* lanescape_shorten_method(size_t index) {
  return word_of([] { return shorten_method_names(); }, index);
}
