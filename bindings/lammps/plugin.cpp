#include <cstdio>
#include <cstdlib>

#include "error.h"
#include "lammps.h"
#include "pair_lanescape.hpp"

// What LAMMPS's command "plugin load FILE" calls, and the record that it hands to LAMMPS: its C interface, which no header is
// installed for.
namespace {

struct PluginRecord {
  const char *version, *style, *name, *info, *author;
  void* (*create)(void*);
  void* handle;
};

void* create_pair(void* lammps) { return new LAMMPS_NS::PairLanescape(static_cast<LAMMPS_NS::LAMMPS*>(lammps)); }

}  // namespace

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void* lammps, void* handle, void* register_plugin) {
  const auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps);
  // Classes of another version have other layouts.
  if (lmp->num_ver != LANESCAPE_LAMMPS_VERSION) {
    lmp->error->all(FLERR, "the lanescape plugin was built for LAMMPS " + std::to_string(LANESCAPE_LAMMPS_VERSION) + ", this is " +
                               std::to_string(lmp->num_ver) + ": build it with the headers of this one");
    return;
  }
  PluginRecord record{lmp->version, "pair", "lanescape", "pair potentials of lanescape", "the Lanescape developers",
                      create_pair,  handle};
  reinterpret_cast<void (*)(PluginRecord*, void*)>(register_plugin)(&record, lammps);
}
