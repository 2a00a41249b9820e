#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lanescape/landscape.hpp>
#include <lanescape/model.hpp>
#include <lanescape/owned.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// N vectors in a host's memory: x of particle i is x[i * stride], and so on. Interleaved arrays have stride 3, separate ones 1.
template <class Number>
struct Vectors {
  Number *x = nullptr, *y = nullptr, *z = nullptr;
  std::size_t count = 0;
  std::ptrdiff_t stride = 3;

  // These throw Error(bad_input) for a length that is not 3N, and for arrays of different lengths.
  static Vectors interleaved(std::span<Number> xyz) {
    if (xyz.size() % 3 != 0)
      throw Error(ErrorCode::bad_input,
                  "an array of " + std::to_string(xyz.size()) + " numbers holds no vectors: 3 for each are needed");
    return {xyz.data(), xyz.data() + 1, xyz.data() + 2, xyz.size() / 3, 3};
  }
  static Vectors separate(std::span<Number> x, std::span<Number> y, std::span<Number> z) {
    if (x.size() != y.size() || x.size() != z.size())
      throw Error(ErrorCode::bad_input, "arrays of x, y and z have " + std::to_string(x.size()) + ", " + std::to_string(y.size()) +
                                            " and " + std::to_string(z.size()) + " entries: as many of each are needed");
    return {x.data(), y.data(), z.data(), x.size(), 1};
  }
};

// What an evaluation writes besides the energy. What is left empty is not computed.
struct Outputs {
  Vectors<double> forces{};      // -dV/dr, N
  std::span<double> energies{};  // of each particle, N: half of each of its pairs, so that they add up to the energy
  bool stress = false;           // costs more than forces alone
};

struct Evaluation {
  double energy = 0.0;
  double virial = 0.0;  // sum over pairs of r.f; with forces or stress
  // xx yy zz yz xz xy, minus sum r_a f_b over the volume: the pressure is minus a third of the trace.
  std::array<double, 6> stress{};
};

// The potential energy of a soft model in a periodic orthorhombic box, evaluated by the vector kernels. Not thread-safe: one
// object per thread. It keeps its memory: after the first call of a kind no call allocates, except where a neighbour list
// grows or the order below changes.
//
// From some thousand particles on it keeps an order of its own, that of the particles in space, and follows them when they diffuse
// away. This order and the neighbour list follow from all positions before: the last bits of results do too.
//
// Results do not depend on the caller's floating-point environment: rounding mode, traps and flushing to zero are set aside during
// a call. Two particles at one place give an energy and forces that are not finite.
class LANESCAPE_API Potential final : public Landscape {
 public:
  struct Options {
    int threads = 1;                       // that share an evaluation; no effect on any result
    std::string precision = "double";      // or "mixed": pairs in single precision, relative errors near 1e-6
    std::string instruction_set = "auto";  // or a name of instruction_sets()
    std::vector<double> diameters{};       // of each particle, for models that have them
  };

  // `species[i]` is an index into model.species(); `box` holds edge lengths. Throws Error(bad_input) with one line saying what is
  // wrong and what is allowed.
  Potential(Model model, std::span<const int> species, const std::array<double, 3>& box);
  Potential(Model model, std::span<const int> species, const std::array<double, 3>& box, Options options);
  ~Potential() override;
  Potential(const Potential&);  // an object of its own, with a neighbour list of its own
  Potential& operator=(const Potential&);
  Potential(Potential&&) noexcept;
  Potential& operator=(Potential&&) noexcept;

  std::size_t particles() const override;
  const Model& model() const;
  const std::vector<int>& species() const;
  const Options& options() const;
  const std::array<double, 3>& box() const;
  // Changes the box for the calls that follow, at a fraction of the cost of a new object; positions are the caller's to scale. Over
  // a neighbour list, which outlasts small changes, results agree with those of a new object to rounding.
  void set_box(const std::array<double, 3>& box);
  // Pairs of particles that do not interact, such as bonded ones, in place of those before. Only the nearest image of a pair is
  // left out. Over all pairs (small systems with images = minimum) they are subtracted: 1e-14 of their own energy stays.
  void set_exclusions(std::span<const std::array<std::size_t, 2>> pairs);
  bool has_exclusions() const;

  // Positions x0 y0 z0 x1 ..., 3N of them, wrapped or not. Throws Error(bad_input) if the length is not 3N or a coordinate is not
  // finite.
  double energy(std::span<const double> positions) override;
  double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) override;
  double energy_and_forces(std::span<const double> positions, std::span<double> forces, double* virial = nullptr);
  Evaluation evaluate(std::span<const double> positions, const Outputs& outputs);
  Evaluation evaluate(const Vectors<const double>& positions, const Outputs& outputs);

 private:
  friend struct detail::Access;
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

// Moves of one particle at a time, for Monte Carlo: what a move changes costs the particle's neighbours, whatever N. Double
// precision. Not thread-safe.
class LANESCAPE_API ParticleMoves {
 public:
  struct Options {
    std::string instruction_set = "auto";  // or a name of instruction_sets()
    std::vector<double> diameters{};       // of each particle, for models that have them
  };

  // The model has a pair potential; positions 3N, wrapped or not.
  ParticleMoves(const Model& model, std::span<const int> species, std::span<const double> positions,
                const std::array<double, 3>& box);
  ParticleMoves(const Model& model, std::span<const int> species, std::span<const double> positions,
                const std::array<double, 3>& box, const Options& options);
  ~ParticleMoves();
  ParticleMoves(ParticleMoves&&) noexcept;
  ParticleMoves& operator=(ParticleMoves&&) noexcept;

  // By how much the energy rises if particle `particle`, from 0, goes there while all others stand still.
  double energy_change(std::size_t particle, const std::array<double, 3>& to);
  // Makes the last move that was asked for; the next one starts from there.
  void accept();
  // 3N, with the moves that were made.
  std::span<const double> positions() const;

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
