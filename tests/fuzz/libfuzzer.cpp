#include <cstdint>

#include "targets.hpp"

// The entry of libFuzzer, once for each target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lanescape::fuzz::Target& target = lanescape::fuzz::find_target(LANESCAPE_FUZZ_TARGET);
  target.feed({reinterpret_cast<const char*>(data), size});
  return 0;
}
