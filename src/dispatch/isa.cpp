#include "dispatch/isa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "core/error.hpp"

// LANESCAPE_HAS_<ISA> is defined by the build for every kernel object library that is linked in.
namespace lanescape {
namespace kernels {
#ifdef LANESCAPE_HAS_GENERIC
namespace generic {
extern const KernelTable table;
}
#endif
#ifdef LANESCAPE_HAS_SSE2
namespace sse2 {
extern const KernelTable table;
}
#endif
#ifdef LANESCAPE_HAS_AVX2
namespace avx2 {
extern const KernelTable table;
}
#endif
#ifdef LANESCAPE_HAS_AVX512
namespace avx512 {
extern const KernelTable table;
}
#endif
}  // namespace kernels

namespace {

struct Implementation {
  Isa isa;
  const kernels::KernelTable* table;
  bool supported;
};

// The compiler's own CPU detection also asks whether the operating system saves the wide registers.
const std::vector<Implementation>& implementations() {
  static const std::vector<Implementation> all = {
#ifdef LANESCAPE_HAS_GENERIC
      {Isa::generic, &kernels::generic::table, true},
#endif
#ifdef LANESCAPE_HAS_SSE2
      {Isa::sse2, &kernels::sse2::table, true},
#endif
#ifdef LANESCAPE_HAS_AVX2
      {Isa::avx2, &kernels::avx2::table, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")},
#endif
#ifdef LANESCAPE_HAS_AVX512
      {Isa::avx512, &kernels::avx512::table,
       __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("fma")},
#endif
  };
  return all;
}

std::string names_of(const std::vector<Isa>& isas) {
  std::string names;
  for (const Isa isa : isas) names += fmt::format("{}{}", names.empty() ? "" : ", ", to_string(isa));
  return names;
}

}  // namespace

const char* to_string(Isa isa) {
  switch (isa) {
    case Isa::generic:
      return "generic";
    case Isa::sse2:
      return "sse2";
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
  }
  return "";
}

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
  for (const auto& implementation : implementations())
    if (implementation.supported) isas.push_back(implementation.isa);
  return isas;
}

std::optional<Isa> forced_isa(std::string_view request) {
  std::string wanted(request);
  std::string where = "--isa";
  if (wanted.empty() || wanted == "auto") {
    const char* from_environment = std::getenv("LANESCAPE_ISA");
    wanted = from_environment != nullptr ? from_environment : "";
    where = "LANESCAPE_ISA";
  }
  if (wanted.empty() || wanted == "auto") return std::nullopt;
  const std::vector<Isa> isas = available_isas();
  for (const Isa isa : {Isa::generic, Isa::sse2, Isa::avx2, Isa::avx512})
    if (wanted == to_string(isa)) {
      if (std::find(isas.begin(), isas.end(), isa) != isas.end()) return isa;
      throw_bad_input(fmt::format("{}: instruction set {} is not available here, available are {}", where, wanted, names_of(isas)));
    }
  throw_bad_input(fmt::format("{}: unknown instruction set '{}': available are auto, {}", where, wanted, names_of(isas)));
}

Isa choose_isa(std::string_view request) { return forced_isa(request).value_or(available_isas().back()); }

const kernels::KernelTable& kernel_table(Isa isa) {
  for (const auto& implementation : implementations())
    if (implementation.isa == isa && implementation.supported) return *implementation.table;
  throw_bad_input(fmt::format("instruction set {} is not available here", to_string(isa)));
}

}  // namespace lanescape
