#include "interaction/pair/pair_search.hpp"

#include <fmt/format.h>

#include "core/coordinate_checks.hpp"
#include "core/enum_words.hpp"
#include "core/error.hpp"
#include "interaction/pair/pair_parameters.hpp"

namespace lanescape {

namespace {

constexpr EnumWord<Precision> precisions[] = {{Precision::double_precision, "double"}, {Precision::mixed, "mixed"}};

}  // namespace

const char* to_string(Precision precision) { return word_of(precisions, precision); }
Precision parse_precision(std::string_view word) { return parse_word(precisions, "precision", word); }

bool fits_list(const PairModel& model, const Box& box, double skin, double scale) {
  if (model.images == ImageRule::all) return true;
  const double cutoff = scale * model.largest_cutoff();
  return 2.0 * (cutoff + skin) <= box.shortest();
}

namespace {

void check_list(const PairModel& model, const Box& box, double scale, Precision precision, double skin) {
  if (fits_list(model, box, skin, scale)) return;
  throw_bad_input(
      fmt::format("the minimum-image rule has no neighbour list{} in a box of shortest edge {}: at least twice the "
                  "cutoff and the skin is needed",
                  precision == Precision::mixed ? ", which mixed precision needs,"
                  : box.has_open_axis()         ? ", which open axes need,"
                                                : "",
                  box.shortest()));
}

}  // namespace

void check_precision(const PairModel& model, const Box& box, Precision precision, double skin) {
  if (precision != Precision::mixed) return;
  check_list(model, box, 1.0, precision, skin);
  check_single_precision(model);
}

bool takes_list(const PairModel& model, const Box& box, double scale, std::size_t particles, const PairSearchOptions& options) {
  if (options.precision == Precision::mixed && options.search == PairSearch::all_pairs)
    throw_bad_input("mixed precision needs a neighbour list: over all pairs there is double precision only");
  if (options.precision != Precision::mixed && options.search == PairSearch::clusters)
    throw_bad_input("clusters of particles need mixed precision");
  if (options.search == PairSearch::all_pairs) check_periodic(box, "sums over all pairs");
  switch (options.search) {
    case PairSearch::all_pairs:
      return false;
    case PairSearch::list:
      check_list(model, box, scale, options.precision, options.skin);
      return true;
    case PairSearch::clusters:
    case PairSearch::automatic:
      break;
  }
  if (options.precision == Precision::mixed || box.has_open_axis()) {
    check_list(model, box, scale, options.precision, options.skin);
    return true;
  }
  return particles >= list_crossover && fits_list(model, box, options.skin, scale);
}

}  // namespace lanescape
