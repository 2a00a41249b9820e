// Runs one kernel of every instruction set that this processor supports.

#include <cstdio>

#include "dispatch/isa.hpp"
#include "kernel_table.hpp"

int main() {
  if (lanescape::available_isas().empty()) return 1;
  alignas(64) const double a[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const lanescape::Isa isa : lanescape::available_isas()) {
    if (lanescape::kernel_table(isa).dot(a, a, 8) != 204.0) {
      std::printf("%s: a wrong dot product\n", lanescape::to_string(isa));
      return 1;
    }
  }
  std::puts("kernels");
}
