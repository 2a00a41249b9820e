#include "core/available_threads.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <string_view>
#include <thread>

#ifdef __linux__
#include <sched.h>
#endif

namespace lanescape {
namespace {

constexpr int most_threads = 4096;
constexpr double no_limit = std::numeric_limits<double>::infinity();

int processors_of_mask() {
#ifdef __linux__
  // A machine may have more processors than a mask of the usual size: the call then fails.
  for (int processors = CPU_SETSIZE; processors <= 1 << 20; processors *= 2) {
    const auto free_mask = [](cpu_set_t* mask) { CPU_FREE(mask); };
    const std::unique_ptr<cpu_set_t, decltype(free_mask)> mask(CPU_ALLOC(static_cast<std::size_t>(processors)), free_mask);
    const std::size_t bytes = CPU_ALLOC_SIZE(static_cast<std::size_t>(processors));
    if (mask && sched_getaffinity(0, bytes, mask.get()) == 0) return CPU_COUNT_S(bytes, mask.get());
  }
#endif
  return static_cast<int>(std::thread::hardware_concurrency());
}

double ratio(long long quota, long long period) {
  return quota > 0 && period > 0 ? static_cast<double>(quota) / static_cast<double>(period) : no_limit;
}

// cpu.max: "max 100000" or quota and period.
double limit_in_version_2(const std::string& folder) {
  std::ifstream file(folder + "/cpu.max");
  long long quota = 0, period = 0;
  return file >> quota >> period ? ratio(quota, period) : no_limit;
}

double limit_in_version_1(const std::string& folder) {
  std::ifstream quota_file(folder + "/cpu.cfs_quota_us"), period_file(folder + "/cpu.cfs_period_us");
  long long quota = 0, period = 0;
  return quota_file >> quota && period_file >> period ? ratio(quota, period) : no_limit;
}

// The least limit of a group and those above it. In a container the path may be one of the host, of which only the end is mounted:
// files that are not there limit nothing.
template <class Limit>
double least_limit(const std::string& mount, std::string group, Limit limit) {
  double least = limit(mount);
  while (group.size() > 1) {
    least = std::min(least, limit(mount + group));
    group.resize(group.rfind('/'));
  }
  return least;
}

bool names_cpu(std::string_view controllers) {
  for (std::string_view rest = controllers; !rest.empty();) {
    const std::string_view name = rest.substr(0, rest.find(','));
    if (name == "cpu") return true;
    rest.remove_prefix(std::min(name.size() + 1, rest.size()));
  }
  return false;
}

// Lines "0::/group" of version 2, "4:cpu,cpuacct:/group" of version 1.
double limit_of_groups(const std::string& root) {
  double least = no_limit;
  std::ifstream file(root + "/proc/self/cgroup");
  const std::string mounts = root + "/sys/fs/cgroup";
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos || line.compare(second + 1, 1, "/") != 0) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    if (controllers.empty())
      for (const char* mount : {"", "/unified"}) least = std::min(least, least_limit(mounts + mount, group, limit_in_version_2));
    else if (names_cpu(controllers))
      for (const std::string& mount : {controllers, std::string("cpu")})
        least = std::min(least, least_limit(mounts + "/" + mount, group, limit_in_version_1));
  }
  return least;
}

}  // namespace

int available_threads(const std::string& root) {
  const double allowed = std::ceil(std::min<double>(limit_of_groups(root), processors_of_mask()));
  return static_cast<int>(std::clamp<double>(allowed, 1.0, most_threads));
}

int default_threads() {
  const char* wanted = std::getenv("OMP_NUM_THREADS");
  const long threads = wanted == nullptr ? 0 : std::strtol(wanted, nullptr, 10);
  return threads > 0 ? static_cast<int>(std::min<long>(threads, most_threads)) : available_threads();
}

}  // namespace lanescape
