// A simulator of the KIM API with a cluster in vacuum: energies of particles add up, forces are slopes of the energy, and the
// virial is the sum of -r_a f_b. Particles that do not contribute lie around it.
//
// Usage: kim_simulator MODEL SPECIES
#include <KIM_SimulatorHeaders.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

int failures = 0;

void check(bool holds, const char* what) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "kim_simulator: false: %s\n", what);
}

void must(int status, const char* what) {
  if (status == 0) return;
  std::fprintf(stderr, "kim_simulator: %s failed\n", what);
  std::exit(1);
}

// The driver has lists of its own.
int no_neighbours(void*, int, const double*, int, int, int* count, const int** list) {
  *count = 0;
  *list = nullptr;
  return 0;
}

struct Cluster {
  std::vector<int> species, contributing;
  std::vector<double> positions;
  int count() const { return static_cast<int>(species.size()); }
};

// 5 x 5 x 5 particles, of which the inner 27 contribute, off their places by some tenths.
Cluster make_cluster(int species, double spacing) {
  Cluster cluster;
  unsigned state = 1;
  for (int k = 0; k < 125; ++k) {
    const int at[3] = {k % 5, k / 5 % 5, k / 25};
    bool inner = true;
    for (const int x : at) {
      state = state * 1664525u + 1013904223u;
      cluster.positions.push_back(spacing * (x + 0.2 * (state / 4294967296.0 - 0.5)));
      inner = inner && x > 0 && x < 4;
    }
    cluster.species.push_back(species);
    cluster.contributing.push_back(inner);
  }
  return cluster;
}

struct Results {
  double energy;
  std::vector<double> forces, energies;
  double virial[6];
};

Results evaluate(KIM::Model& model, KIM::ComputeArguments& arguments, const Cluster& cluster) {
  namespace names = KIM::COMPUTE_ARGUMENT_NAME;
  const int count = cluster.count();
  Results r{0.0, std::vector<double>(cluster.positions.size()), std::vector<double>(cluster.species.size()), {}};
  must(arguments.SetArgumentPointer(names::numberOfParticles, &count), "numberOfParticles");
  must(arguments.SetArgumentPointer(names::particleSpeciesCodes, cluster.species.data()), "particleSpeciesCodes");
  must(arguments.SetArgumentPointer(names::particleContributing, cluster.contributing.data()), "particleContributing");
  must(arguments.SetArgumentPointer(names::coordinates, cluster.positions.data()), "coordinates");
  must(arguments.SetArgumentPointer(names::partialEnergy, &r.energy), "partialEnergy");
  must(arguments.SetArgumentPointer(names::partialForces, r.forces.data()), "partialForces");
  must(arguments.SetArgumentPointer(names::partialParticleEnergy, r.energies.data()), "partialParticleEnergy");
  must(arguments.SetArgumentPointer(names::partialVirial, r.virial), "partialVirial");
  must(model.Compute(&arguments), "Compute");
  return r;
}

void check_results(const Results& r, const Cluster& cluster) {
  double sum = 0.0, virial[6] = {};
  constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (std::size_t i = 0; i < r.energies.size(); ++i) {
    sum += r.energies[i];
    check(cluster.contributing[i] != 0 || r.energies[i] == 0.0, "others have no energy");
    for (int k = 0; k < 6; ++k) virial[k] -= cluster.positions[3 * i + voigt[k][0]] * r.forces[3 * i + voigt[k][1]];
  }
  check(std::fabs(sum - r.energy) < 1e-12 * std::fabs(r.energy), "energies of particles add up");
  for (int k = 0; k < 6; ++k) check(std::fabs(virial[k] - r.virial[k]) < 1e-10 * std::fabs(r.virial[0]), "virial is -sum r_a f_b");
}

void check_slopes(KIM::Model& model, KIM::ComputeArguments& arguments, Cluster cluster, const Results& r) {
  for (std::size_t k = 0; k < cluster.positions.size(); k += 37) {
    const double x = cluster.positions[k], h = 1e-4;
    cluster.positions[k] = x + h;
    const double above = evaluate(model, arguments, cluster).energy;
    cluster.positions[k] = x - h;
    const double below = evaluate(model, arguments, cluster).energy;
    cluster.positions[k] = x;
    check(std::fabs(r.forces[k] + (above - below) / (2.0 * h)) < 1e-6, "forces are slopes of the energy");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: kim_simulator MODEL SPECIES\n");
    return 2;
  }
  KIM::Model* model = nullptr;
  int accepted = 0;
  must(KIM::Model::Create(KIM::NUMBERING::zeroBased, KIM::LENGTH_UNIT::A, KIM::ENERGY_UNIT::eV, KIM::CHARGE_UNIT::e,
                          KIM::TEMPERATURE_UNIT::K, KIM::TIME_UNIT::ps, argv[1], &accepted, &model),
       "Create");
  check(accepted != 0, "units are accepted");
  int known = 0, species = -1;
  must(model->GetSpeciesSupportAndCode(KIM::SpeciesName(argv[2]), &known, &species), "GetSpeciesSupportAndCode");
  check(known != 0, "the species is known");
  KIM::ComputeArguments* arguments = nullptr;
  must(model->ComputeArgumentsCreate(&arguments), "ComputeArgumentsCreate");
  must(arguments->SetCallbackPointer(KIM::COMPUTE_CALLBACK_NAME::GetNeighborList, KIM::LANGUAGE_NAME::cpp,
                                     reinterpret_cast<KIM::Function*>(&no_neighbours), nullptr),
       "SetCallbackPointer");
  const Cluster cluster = make_cluster(species, 3.8);
  const Results r = evaluate(*model, *arguments, cluster);
  check(r.energy < 0.0, "the cluster is bound");
  check_results(r, cluster);
  check_slopes(*model, *arguments, cluster, r);
  Cluster broken = cluster;
  broken.positions[40] = NAN;
  int count = broken.count();
  must(arguments->SetArgumentPointer(KIM::COMPUTE_ARGUMENT_NAME::numberOfParticles, &count), "numberOfParticles");
  must(arguments->SetArgumentPointer(KIM::COMPUTE_ARGUMENT_NAME::coordinates, broken.positions.data()), "coordinates");
  check(model->Compute(arguments) != 0, "coordinates that are not finite are refused");
  must(model->ComputeArgumentsDestroy(&arguments), "ComputeArgumentsDestroy");
  KIM::Model::Destroy(&model);
  return failures != 0;
}
