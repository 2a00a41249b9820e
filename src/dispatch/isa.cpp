#include "dispatch/isa.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "core/error.hpp"

namespace lanescape {
namespace kernels {
#define LANESCAPE_ENTRY(name, supported) \
  namespace name {                       \
  extern const KernelTable table;        \
  }
LANESCAPE_BUILT_INSTRUCTION_SETS(LANESCAPE_ENTRY)
#undef LANESCAPE_ENTRY
}  // namespace kernels

namespace {

struct Implementation {
  Isa isa;
  const kernels::KernelTable* table;
  bool supported;
};

// The processor's features are not known before the constructors of libgcc have run: a host's own early ones would see SSE2 only.
void detect_processor() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_cpu_init();
#endif
}

const std::vector<Implementation>& implementations() {
#define LANESCAPE_ENTRY(name, supported) {Isa::name, &kernels::name::table, supported},
  static const std::vector<Implementation> all = [] {
    detect_processor();
    return std::vector<Implementation>{LANESCAPE_BUILT_INSTRUCTION_SETS(LANESCAPE_ENTRY)};
  }();
#undef LANESCAPE_ENTRY
  return all;
}

std::string names_of(const std::vector<Isa>& isas) {
  std::string names;
  for (const Isa isa : isas) names += (names.empty() ? "" : ", ") + std::string(to_string(isa));
  return names;
}

}  // namespace

const char* to_string(Isa isa) {
#define LANESCAPE_ENTRY(name) #name,
  static constexpr const char* names[] = {LANESCAPE_INSTRUCTION_SETS(LANESCAPE_ENTRY)};
#undef LANESCAPE_ENTRY
  return names[static_cast<std::size_t>(isa)];
}

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
  for (const auto& implementation : implementations())
    if (implementation.supported) isas.push_back(implementation.isa);
  return isas;
}

const std::string& isa_of_environment() {
  static const std::string value = [] {
    const char* given = std::getenv("LANESCAPE_ISA");
    return std::string(given != nullptr ? given : "");
  }();
  return value;
}

std::optional<Isa> forced_isa(std::string_view request, const std::string& environment) {
  std::string wanted(request);
  std::string where;
  if (wanted.empty() || wanted == "auto") {
    wanted = environment;
    where = "LANESCAPE_ISA: ";
  }
  if (wanted.empty() || wanted == "auto") return std::nullopt;
  const std::vector<Isa> isas = available_isas();
  for (const Isa isa : every_isa)
    if (wanted == to_string(isa)) {
      if (std::find(isas.begin(), isas.end(), isa) != isas.end()) return isa;
      throw_bad_input(where + "instruction set " + wanted + " is not available here, available are " + names_of(isas));
    }
  throw_bad_input(where + "unknown instruction set '" + wanted + "': available are auto, " + names_of(isas));
}

Isa choose_isa(std::string_view request, const std::string& environment) {
  return forced_isa(request, environment).value_or(available_isas().back());
}

const kernels::KernelTable& kernel_table(Isa isa) {
  for (const auto& implementation : implementations())
    if (implementation.isa == isa && implementation.supported) return *implementation.table;
  throw_bad_input("instruction set " + std::string(to_string(isa)) + " is not available here");
}

}  // namespace lanescape
