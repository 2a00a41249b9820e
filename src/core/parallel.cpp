#include "core/parallel.hpp"

#include <algorithm>

namespace lanescape {

void run_on_threads(int threads, std::size_t blocks, const std::function<void(std::size_t)>& body, Taking taking) {
  if (!ThreadTeam::is_alone()) {
    const int members = static_cast<int>(std::min(static_cast<std::size_t>(threads), blocks));
    return ThreadTeam::of_this_thread(members).for_each(members, blocks, body, taking);
  }
  for (std::size_t block = 0; block < blocks; ++block) body(block);
}

}  // namespace lanescape
