#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lanescape/error.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// One species of a model.
struct ModelSpecies {
  std::string name;       // chemical symbol, as files have it: without blanks
  double mass = 1.0;      // [m]
  double fraction = 1.0;  // of the particles, where the library makes a start
};

// A mixture with a pair potential of one form. Matrices are S x S, row-major and symmetric, for S species.
struct PairParameters {
  std::string form = "lennard-jones";  // a word of pair_potentials()
  std::vector<ModelSpecies> species{};
  std::vector<double> epsilon{};            // energy of each pair of species
  std::vector<double> sigma{};              // length of each pair of species
  std::map<std::string, double> numbers{};  // what the form has beside these, by the keys of docs/FORMATS.md
  double cutoff = 2.5;                      // in units of sigma_ab; forms of a fixed range have their own
  std::string truncation = "shifted";       // plain, tail, shifted-force, smooth
  std::string images = "all";               // minimum: the nearest image of a pair only
  std::string name = "mixture";
};

// Additive hard spheres.
struct HardSphereParameters {
  std::vector<ModelSpecies> species{};
  std::vector<double> diameters{};  // of each species
  std::string name = "hard-spheres";
};

// Changes of a named model; what is empty or 0 stays.
struct ModelChanges {
  double cutoff = 0.0;  // in units of sigma_ab
  std::string truncation{}, images{};
};

namespace detail {
struct ModelData;
struct Access;
}  // namespace detail

// What particles are and how they interact. A value that does not change; copies share it, also between threads.
// All functions that make one throw Error(bad_input) with one line saying what is wrong and what is allowed.
class LANESCAPE_API Model {
 public:
  Model(const Model&) = default;  // a move copies: no model is ever empty
  Model& operator=(const Model&) = default;
  ~Model() = default;

  // A name of model_names(). Models by name are in reduced units: lengths in sigma, energies in epsilon.
  static Model named(std::string_view name, const ModelChanges& changes = {});
  static Model mixture(const PairParameters& parameters);
  static Model hard_spheres(const HardSphereParameters& parameters);
  // A model file (docs/FORMATS.md), or its text.
  static Model from_file(const std::string& path);
  static Model from_toml(std::string_view text);

  // The text from which from_toml() makes the same model, bit for bit.
  std::string to_toml() const;
  const std::string& name() const;
  std::vector<ModelSpecies> species() const;
  std::size_t species_count() const;
  // Index of a species by its name.
  int find_species(std::string_view name) const;
  bool is_hard() const;        // hard spheres: overlaps instead of energies
  bool has_states() const;     // sites in states: see StateSystem
  bool has_diameters() const;  // every particle has a diameter of its own
  // The distance beyond which no two particles interact; 0 for hard spheres.
  double largest_cutoff() const;
  // The library's unit of length for this model: a power of two near the largest diameter. Default steps are given in it.
  double length_unit() const;
  friend LANESCAPE_API bool operator==(const Model& a, const Model& b);

 private:
  friend struct detail::Access;
  explicit Model(std::shared_ptr<const detail::ModelData> data);
  std::shared_ptr<const detail::ModelData> data_;
};

// What Model::named() takes, and the words of pair potentials.
LANESCAPE_API std::vector<std::string> model_names();
LANESCAPE_API std::vector<std::string> pair_potentials();

LANESCAPE_ABI_END
}  // namespace lanescape
