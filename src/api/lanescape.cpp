#include <lanescape/lanescape.hpp>

#include "dispatch/isa.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

const char* version() noexcept { return LANESCAPE_VERSION; }

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Isa isa : available_isas()) names.emplace_back(to_string(isa));
  return names;
}

LANESCAPE_ABI_END
}  // namespace lanescape
