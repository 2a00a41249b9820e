#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "configuration/mixture.hpp"
#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "io/model_file.hpp"
#include "targets.hpp"

// Readers of text. What they accept must come back when it is written and read again.
namespace lanescape::fuzz {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

std::string text_of(const std::vector<Frame>& frames, const Mixture& mixture) {
  std::ostringstream out;
  for (const Frame& frame : frames) write_frame(out, frame.configuration, mixture, {});
  return out.str();
}

std::vector<Frame> frames_of(const std::string& path, SizeColumn size, OpenAxes open_axes, Mixture& mixture) {
  ExtendedXyzReader reader =
      mixture.species.empty() ? ExtendedXyzReader(path, size) : ExtendedXyzReader(path, mixture, size, open_axes);
  std::vector<Frame> frames;
  while (auto frame = reader.next()) frames.push_back(std::move(*frame));
  mixture = reader.mixture();
  return frames;
}

template <SizeColumn size, OpenAxes open_axes>
void round_trip(std::string_view bytes) {
  Mixture mixture;  // without species a reader accepts any
  if (open_axes == OpenAxes::allowed) mixture.species = {{"Ar"}, {"Ni"}, {"P"}, {"Xe"}};
  const std::string first = text_of(frames_of(MemoryFile(bytes).path(), size, open_axes, mixture), mixture);
  Mixture again = mixture;
  require(text_of(frames_of(MemoryFile(first).path(), size, open_axes, again), again) == first,
          "frames change when written and read");
}

void read_and_write_model(std::string_view bytes) {
  const auto text_of_model = [](const AnyModel& model) {
    std::ostringstream out;
    write_model_file(out, model);
    return out.str();
  };
  const std::string first = text_of_model(read_model_text(std::string(bytes)));
  require(text_of_model(read_model_text(first)) == first, "a model changes when written and read");
}

}  // namespace

void read_extended_xyz(std::string_view bytes) {
  refusing(round_trip<SizeColumn::ignored, OpenAxes::refused>, bytes);
  refusing(round_trip<SizeColumn::ignored, OpenAxes::allowed>, bytes);
  refusing(round_trip<SizeColumn::radius, OpenAxes::refused>, bytes);
  refusing(round_trip<SizeColumn::diameter, OpenAxes::refused>, bytes);
}

void read_model(std::string_view bytes) { refusing(read_and_write_model, bytes); }

std::vector<std::string> extended_xyz_seeds() {
  std::vector<std::string> seeds = {
      "2\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=species:S:1:pos:R:3:radius:R:1 pbc=\"T T T\"\nXe 0.1 0.2 0.3 0.7\nAr 2.5 2.5 "
      "2.5 0.5\n",
      "1\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=species:S:1:pos:R:3:diameter:R:1\nAr 1 2 3 1.1\n",
      "1\nLattice=[[5, 0, 0], [0, 5, 0], [0, 0, 5]] Properties=id:I:1:species:S:1:pos:R:3 pbc=[F, T, T] config_type= key='a b'\n1 "
      "Ar 1D0 2 3\n"};
  for (const char* folder : {"tests/data", "tests/data/foreign"})
    for (std::string& text : files_in(folder, "xyz", 10'000)) seeds.push_back(std::move(text));
  return seeds;
}

std::vector<std::string> model_seeds() {
  std::vector<std::string> seeds = files_in("docs/examples", ".toml", 20'000);
  const std::string species = "[[species]]\nname = \"Ar\"\nmass = 2.0\nfraction = 1.0\n";
  const std::string pair = "[[pair]]\nspecies = [\"Ar\", \"Ar\"]\nepsilon = 1.0\nsigma = 1.0\n";
  for (const std::string kind :
       {"lennard-jones\"\ncutoff = 2.5\ntruncation = \"smooth\"\nimages = \"minimum",
        "mie\"\nrepulsive_exponent = 14\nattractive_exponent = 8", "inverse-power\"\nexponent = 10", "yukawa\"\nkappa = 2.5",
        "harmonic", "hertzian", "lennard-jones-12-6-4\"\nc4 = 0.5", "polydisperse\"\nnon_additivity = 0.3"}) {
    const bool number_ends = kind.back() >= '0' && kind.back() <= '9';
    seeds.push_back("kind = \"" + kind + (number_ends ? "\n" : "\"\n") + species + pair);
  }
  seeds.push_back("kind = \"hard-sphere\"\nname = \"my-spheres\"\n" + species + "diameter = 1.4\n");
  // Two on which toml++ 3.3 goes wrong (io/toml.hpp).
  seeds.push_back("kind = \"mie\"\n[[{pecies]]\nname = \"Ar\"\n");
  seeds.push_back("kind = \"mie\"\nn \xcd\x96me = \"Ar\"\n");
  return seeds;
}

}  // namespace lanescape::fuzz
