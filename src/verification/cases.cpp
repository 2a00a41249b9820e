#include "verification/cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/box.hpp"
#include "core/error.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

using Point = std::array<double, 3>;

constexpr std::uint64_t seed = 1;

Box cube(double length) { return {{length, length, length}}; }

// Points in units of the box: `cells` unit cells per axis, each with `basis`.
std::vector<Point> lattice(const std::array<int, 3>& cells, const std::vector<Point>& basis) {
  std::vector<Point> sites;
  for (int x = 0; x < cells[0]; ++x)
    for (int y = 0; y < cells[1]; ++y)
      for (int z = 0; z < cells[2]; ++z)
        for (const Point& b : basis) sites.push_back({(x + b[0]) / cells[0], (y + b[1]) / cells[1], (z + b[2]) / cells[2]});
  return sites;
}

// The smallest cubic lattice (simple, body-centred or face-centred) with at least n sites, cut to n sites.
std::vector<Point> densest_lattice(std::size_t n) {
  const std::vector<std::vector<Point>> bases = {
      {{0.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}}, {{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}}};
  std::vector<Point> best;
  for (const auto& basis : bases) {
    int cells = 1;
    while (basis.size() * static_cast<std::size_t>(cells * cells * cells) < n) ++cells;
    const auto sites = lattice({cells, cells, cells}, basis);
    if (best.empty() || sites.size() < best.size()) best = sites;
  }
  best.resize(n);
  return best;
}

// Turns sites in box units into positions displaced by up to 0.05 per axis, so that no separation is special. Every third particle
// is moved by up to four boxes per periodic axis, as happens to particles in a long run; along an open axis sites near a face may
// come to lie outside. Every fifth particle is of the last species.
Configuration rattled(const std::vector<Point>& sites, const Box& box, std::size_t species_count) {
  const CounterRandom jitter(seed, RandomStream::displacements), boxes(seed, RandomStream::sites);
  Configuration configuration{box, {}, {}};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto particle = static_cast<std::uint32_t>(i);
    configuration.species.push_back(i % 5 == 4 ? static_cast<int>(species_count) - 1 : 0);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const double shift =
          i % 3 == 2 && box.periodic[axis] ? static_cast<double>(boxes.below(9, sites.size(), particle, axis)) - 4.0 : 0.0;
      const double displacement = 0.1 * (jitter.uniform(sites.size(), particle, axis) - 0.5);
      configuration.positions.push_back((sites[i][axis] + shift) * box.length[axis] + displacement);
    }
  }
  return configuration;
}

// A simple lattice that fills a box of any shape, sites at least 0.93 apart.
Configuration filled(const Box& box, std::size_t species_count) {
  std::array<int, 3> cells;
  for (std::size_t axis = 0; axis < 3; ++axis) cells[axis] = std::max(1, static_cast<int>(box.length[axis] / 0.93));
  return rattled(lattice(cells, {{0.0, 0.0, 0.0}}), box, species_count);
}

Configuration pair_at(const Point& first, const Point& separation, const Box& box) {
  Configuration pair{box, {0, 0}, {first[0], first[1], first[2]}};
  for (std::size_t axis = 0; axis < 3; ++axis) pair.positions.push_back(first[axis] + separation[axis]);
  return pair;
}

// A unit vector times r with no zero component and no two equal components.
Point along_diagonal(double r) { return {r * 2.0 / 7.0, r * 3.0 / 7.0, r * 6.0 / 7.0}; }

// Three species of unequal sizes.
PairModel ternary() {
  PairModel model;
  model.name = "ternary";
  model.species = {{"Ar", 1.0, 0.5}, {"Kr", 2.0, 0.3}, {"Xe", 3.0, 0.2}};
  model.epsilon = {1.0, 1.2, 0.9, 1.2, 1.5, 0.7, 0.9, 0.7, 0.5};
  model.sigma = {1.0, 0.9, 0.85, 0.9, 0.8, 0.75, 0.85, 0.75, 0.7};
  return model;
}

PairModel with(PairModel model, ImageRule images, Truncation truncation) {
  model.images = images;
  model.truncation = truncation;
  return model;
}

PairModel with_cutoff(PairModel model, double cutoff) {
  model.cutoff = cutoff;
  return model;
}

const std::array<ImageRule, 2> image_rules = {ImageRule::all, ImageRule::minimum};
const std::array<Truncation, 3> truncations = {Truncation::shifted, Truncation::plain, Truncation::tail};

// Numbers of particles that leave every kind of remainder in vectors of 2, 4 and 8 lanes and in tiles of 4 rows. At density 1.2
// they also cover the three image searches.
void add_sizes(std::vector<PairCase>& cases) {
  for (const auto& model : {lennard_jones(), kob_andersen()})
    for (const std::size_t n : {0U, 1U, 2U, 3U, 7U, 8U, 9U, 31U, 107U, 108U, 256U, 257U}) {
      const Box box = cube(std::cbrt(static_cast<double>(std::max<std::size_t>(n, 1)) / 1.2));
      const Configuration configuration = rattled(densest_lattice(n), box, model.species.size());
      for (const ImageRule images : image_rules)
        for (const Truncation truncation : truncations)
          cases.push_back({fmt::format("{} N={} {} {}", model.name, n, to_string(images), to_string(truncation)),
                           with(model, images, truncation), configuration});
    }
}

// Non-cubic boxes, one for each image search at the cutoff 2.5; and boxes much smaller than the cutoff.
void add_boxes(std::vector<PairCase>& cases) {
  const std::vector<std::pair<const char*, Box>> boxes = {{"orthorhombic nearest", {{6.0, 5.5, 7.2}}},
                                                          {"orthorhombic two nearest", {{4.0, 4.4, 5.2}}},
                                                          {"orthorhombic lattice", {{2.2, 3.1, 4.7}}},
                                                          {"slab", {{6.5, 5.7, 1.1}}},
                                                          {"needle", {{1.2, 1.3, 9.0}}}};
  for (const auto& [name, box] : boxes)
    for (const auto& model : {lennard_jones(), kob_andersen()})
      for (const ImageRule images : image_rules)
        for (const Truncation truncation : {Truncation::shifted, Truncation::tail})
          cases.push_back({fmt::format("{} {} {} {}", name, model.name, to_string(images), to_string(truncation)),
                           with(model, images, truncation), filled(box, model.species.size())});
  for (const std::size_t n : {1U, 2U, 5U}) {
    const Box box = cube(std::cbrt(static_cast<double>(n) / 1.2));
    cases.push_back(
        {fmt::format("tiny box N={} cutoff 4", n), with_cutoff(kob_andersen(), 4.0), rattled(densest_lattice(n), box, 2)});
  }
}

// A pair on either side of the cutoff. The potential is cut without a shift, so a wrong decision is visible. There is one case per
// code path of a kernel: the nearest image, the second nearest and the lattice, in a cube and in another box.
void add_cutoff_edges(std::vector<PairCase>& cases) {
  struct Edge {
    const char* name;
    Box box;
    bool next_image;  // the image at the cutoff is the one across the x face
  };
  for (const Edge& edge : {Edge{"nearest, cube", cube(9.0), false}, Edge{"nearest", {{9.0, 8.0, 7.5}}, false},
                           Edge{"two nearest, cube", cube(4.0), true}, Edge{"two nearest", {{4.0, 4.4, 5.2}}, true},
                           Edge{"lattice", {{2.2, 3.1, 4.7}}, true}})
    for (const double side : {-1.0, 1.0}) {
      const double r = 2.5 * (1.0 + side * 1e-12);
      const Point across = {edge.box.length[0] - std::sqrt(r * r - 0.9 * 0.9 - 0.7 * 0.7), 0.9, 0.7};
      const Point separation = edge.next_image ? across : along_diagonal(r);
      cases.push_back({fmt::format("pair {} the cutoff ({})", side < 0.0 ? "inside" : "outside", edge.name),
                       with(lennard_jones(), ImageRule::all, Truncation::plain), pair_at({0.1, 0.2, 0.3}, separation, edge.box)});
    }
}

void add_pairs(std::vector<PairCase>& cases) {
  for (const auto& [shape, box] : {std::pair{"cube", cube(9.0)}, std::pair{"box", Box{{9.0, 8.0, 7.5}}}}) {
    cases.push_back({fmt::format("touching pair ({})", shape), lennard_jones(), pair_at({1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, box)});
    cases.push_back(
        {fmt::format("pair near contact ({})", shape), lennard_jones(), pair_at({1.0, 2.0, 3.0}, along_diagonal(0.8), box)});
    cases.push_back({fmt::format("pair across a corner ({})", shape), lennard_jones(),
                     pair_at({0.05, 0.1, 0.2}, {box.length[0] - 0.5, box.length[1] - 0.6, box.length[2] - 0.7}, box)});
    cases.push_back({fmt::format("pair six boxes apart ({})", shape), lennard_jones(),
                     pair_at({0.05, 0.1, 0.2}, {6.0 * box.length[0] + 0.5, 0.6 - 6.0 * box.length[1], 0.7}, box)});
    cases.push_back(
        {fmt::format("pair out of range ({})", shape), lennard_jones(), pair_at({1.0, 2.0, 3.0}, along_diagonal(3.0), box)});
  }
}

// Three species, one of them without particles: at the beginning, in the middle or at the end of the blocks.
void add_empty_species(std::vector<PairCase>& cases) {
  for (int empty = 0; empty < 3; ++empty)
    for (const double length : {2.3, 3.2, 4.6}) {
      Configuration configuration = filled(cube(length), 1);
      const int many = (empty + 1) % 3, few = (empty + 2) % 3;
      for (std::size_t i = 0; i < configuration.size(); ++i) configuration.species[i] = i % 4 == 1 ? few : many;
      cases.push_back({fmt::format("ternary without species {}, box {}", empty, length),
                       with(ternary(), ImageRule::all, length < 3.0 ? Truncation::tail : Truncation::shifted), configuration});
    }
}

// Two species of a form with these parameters.
PairModel two_species(const PairForm& form, const std::vector<double>& numbers) {
  PairModel model = kob_andersen();
  model.name = form.word;
  model.form = &form;
  model.form_numbers = numbers;
  if (std::isfinite(form.range)) model.cutoff = form.range;
  if (form.has_diameters) {
    model.epsilon = {1.0, 1.0, 1.0, 1.0};
    model.sigma = {1.0, 1.0, 1.0, 1.0};
  }
  return model;
}

// Parameters of a form: its presets, and others.
std::vector<std::vector<double>> numbers_of(const PairForm& form) {
  std::vector<std::vector<double>> all(2);
  for (const FormNumber& number : form.numbers) {
    all[0].push_back(number.preset.value_or(1.5));
    all[1].push_back(number.even ? 2.0 * std::round(0.6 * number.preset.value_or(10.0)) : 2.0 * number.preset.value_or(2.0));
  }
  if (form.numbers.empty()) all.pop_back();
  return all;
}

bool allows(const PairModel& model) {
  try {
    model.check();
    return true;
  } catch (const Error&) {
    return false;
  }
}

void give_diameters(Configuration& configuration) {
  const CounterRandom random(seed, RandomStream::velocities);
  for (std::uint32_t i = 0; i < configuration.size(); ++i)
    configuration.diameters.push_back(0.8 + 0.4 * random.uniform(configuration.size(), i));
}

}  // namespace

std::vector<PairCase> pair_cases() {
  std::vector<PairCase> cases;
  add_sizes(cases);
  add_boxes(cases);
  add_cutoff_edges(cases);
  add_pairs(cases);
  add_empty_species(cases);
  return cases;
}

std::string name_in_results(const PairForm& form) {
  std::string name = form.word;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<PairCase> form_cases(const PairForm& form) {
  std::vector<PairCase> cases;
  for (const auto& numbers : numbers_of(form))
    for (const std::size_t n : {1U, 2U, 9U, 31U, 65U, 108U}) {
      PairModel model = two_species(form, numbers);
      Configuration configuration =
          rattled(densest_lattice(n), cube(std::cbrt(static_cast<double>(n) / 1.2)), model.species.size());
      if (form.has_diameters) give_diameters(configuration);
      for (const ImageRule images : image_rules)
        for (const Truncation truncation :
             {Truncation::shifted, Truncation::plain, Truncation::tail, Truncation::shifted_force, Truncation::smooth}) {
          const PairModel truncated = with(model, images, truncation);
          if (allows(truncated))
            cases.push_back(
                {fmt::format("{} {} N={} {} {}", form.word, fmt::join(numbers, ","), n, to_string(images), to_string(truncation)),
                 truncated, configuration});
        }
    }
  return cases;
}

std::vector<PairCase> cluster_cases(const PairForm& form) {
  std::vector<PairCase> cases;
  if (form.has_diameters) return cases;
  for (const auto& numbers : numbers_of(form))
    for (const auto& [n, box] : {std::pair<std::size_t, Box>{1, cube(7.5)},
                                 {9, cube(7.5)},
                                 {60, {{7.1, 9.3, 8.0}}},
                                 {351, cube(7.3)},
                                 {500, {{7.0, 7.2, 11.0}}}}) {
      const PairModel model = two_species(form, numbers);
      const Configuration configuration = rattled(densest_lattice(n), box, model.species.size());
      for (const Truncation truncation : {Truncation::shifted, Truncation::tail, Truncation::shifted_force, Truncation::smooth}) {
        const PairModel truncated = with(model, ImageRule::all, truncation);
        if (allows(truncated))
          cases.push_back(
              {fmt::format("{} {} N={} box {} {}", form.word, fmt::join(numbers, ","), n, box.length[0], to_string(truncation)),
               truncated, configuration});
      }
    }
  return cases;
}

std::vector<PairCase> open_cases(const PairForm& form) {
  constexpr std::array<bool, 3> axes[] = {{false, true, true},  {true, false, true},  {true, true, false},
                                          {false, false, true}, {true, false, false}, {false, false, false}};
  constexpr Truncation truncations_here[] = {Truncation::shifted, Truncation::plain, Truncation::shifted_force, Truncation::smooth};
  std::vector<PairModel> models{two_species(form, numbers_of(form).front())};
  if (&form == &lennard_jones_form()) models.insert(models.end(), {lennard_jones(), ternary()});
  std::vector<PairCase> cases;
  for (const PairModel& model : models)
    for (const auto& periodic : axes)
      for (const Point& edges : {Point{6.0, 6.7, 7.2}, Point{2.2, 3.1, 4.7}, Point{1.2, 4.8, 1.3}}) {
        Configuration configuration = filled({edges, periodic}, model.species.size());
        if (form.has_diameters) give_diameters(configuration);
        PairModel truncated = with(model, ImageRule::all, truncations_here[cases.size() % 4]);
        if (!allows(truncated)) truncated.truncation = Truncation::shifted;
        cases.push_back(
            {fmt::format("{} open along {}{}{}, box {} {} {}, {}", cases.size(), periodic[0] ? "" : "x", periodic[1] ? "" : "y",
                         periodic[2] ? "" : "z", edges[0], edges[1], edges[2], to_string(truncated.truncation)),
             truncated, configuration});
      }
  return cases;
}

std::vector<PairCase> with_open_cases(const std::vector<PairCase>& cases) {
  if (cases.empty()) return {};
  std::vector<PairCase> all = open_cases(*cases.front().model.form);
  all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

std::vector<PairCase> all_pair_cases() {
  std::vector<PairCase> cases = pair_cases();
  for (const PairForm& form : pair_forms().subspan(1))
    for (PairCase& one : form_cases(form)) cases.push_back(std::move(one));
  return cases;
}

}  // namespace lanescape
