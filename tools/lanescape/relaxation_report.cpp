#include "relaxation_report.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>

namespace lanescape::program {
namespace {

using Relaxation = RelaxationAccumulator;
using Curve = Estimate (Relaxation::*)(std::size_t, std::size_t) const;

// The value of a curve at its peak, with its error and time, or nulls.
void add_peak(Json& species, const std::string& name, const Relaxation& relaxation, Curve curve, std::size_t index,
              const std::optional<std::size_t>& peak) {
  const Estimate at_peak = peak ? (relaxation.*curve)(index, *peak) : Estimate();
  species[name] = peak ? Json(at_peak.value) : Json();
  species[name + "_error"] = error_of(at_peak);
  species[name + "_time"] = peak ? Json(relaxation.time(*peak)) : Json();
}

}  // namespace

void RelaxationSetup::add_to(Options& options) {
  options.add(
      "--wave-number", wave_number,
      "k of the self intermediate scattering function [1/sigma]: one, or one for each species, between commas [7.25 over the "
      "largest sigma]");
  options.add("--overlap-length", overlap_length,
              "chi_4 counts particles that moved less than this [sigma] [0.3 of the largest sigma]");
  options.add("--relaxation-records", records,
              "records of a trajectory for relaxation, whose longest lag is half of them [those of --records]");
}

RelaxationOptions RelaxationSetup::resolve() const {
  RelaxationOptions options;
  options.overlap_length = overlap_length;
  options.records = records;
  if (!wave_number.empty())
    for (const std::string& k : list_of(wave_number, "--wave-number"))
      options.wave_numbers.push_back(number_of(k, "--wave-number"));
  return options;
}

Json error_of(const Estimate& estimate) { return estimate.error ? Json(*estimate.error) : Json(); }

void add_relaxation(Json& species, const Relaxation& relaxation, std::size_t index) {
  species["wave_number"] = relaxation.window().wave_numbers[index];
  const std::optional<Estimate> time = relaxation.relaxation_time(index);
  species["tau_alpha"] = time ? Json(time->value) : Json();
  species["tau_alpha_error"] = error_of(time.value_or(Estimate()));
  add_peak(species, "alpha_2_peak", relaxation, &Relaxation::non_gaussian, index, relaxation.non_gaussian_peak(index));
  add_peak(species, "chi_4_peak", relaxation, &Relaxation::susceptibility, index, relaxation.susceptibility_peak(index));
}

void write_relaxation(OutputFolder& folder, const Relaxation& relaxation, const Mixture& mixture) {
  struct Column {
    const char* name;
    Curve curve;
  };
  static constexpr Column columns[] = {{"squared_displacement", &Relaxation::squared_displacement},
                                       {"intermediate_scattering", &Relaxation::intermediate_scattering},
                                       {"alpha_2", &Relaxation::non_gaussian},
                                       {"chi_4", &Relaxation::susceptibility}};
  if (relaxation.trajectories() == 0) return;
  folder.write("relaxation.csv", [&](std::ostream& out) {
    out << "time";
    for (std::size_t s = 0; s < relaxation.species(); ++s)
      for (const Column& column : columns) fmt::print(out, ",{0}_{1},{0}_error_{1}", column.name, mixture.species[s].name);
    out << '\n';
    for (std::size_t p = 0; p < relaxation.points(); ++p) {
      fmt::print(out, "{}", relaxation.time(p));
      for (std::size_t s = 0; s < relaxation.species(); ++s)
        for (const Column& column : columns) {
          const Estimate at = (relaxation.*column.curve)(s, p);
          fmt::print(out, ",{},{}", at.value, at.error.value_or(std::nan("")));
        }
      out << '\n';
    }
  });
}

}  // namespace lanescape::program
