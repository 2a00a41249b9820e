#pragma once

#include <string_view>

#include "configuration/pair_model.hpp"
#include "core/box.hpp"

namespace lanescape {

// How pairs are found: over all of them, over a neighbour list, or over clusters of particles, in mixed precision; or whichever is
// faster, by the number of particles. In a box with an open axis there are lists alone.
enum class PairSearch { automatic, all_pairs, list, clusters };

// Of the arithmetic of pairs. Mixed: single precision, over a list, with sums in double and the error that
// src/interaction/README.md states. What double_precision means is the rest of the library.
enum class Precision { double_precision, mixed };
const char* to_string(Precision precision);        // "double" or "mixed"
Precision parse_precision(std::string_view word);  // throws Error(bad_input)

// Whether the image rule allows a list: `minimum` only where the nearest image of a pair cannot change while the list lasts.
bool fits_list(const PairModel& model, const Box& box, double skin, double scale = 1.0);

// Throws Error(bad_input) where mixed precision would need a list that the image rule does not allow.
void check_precision(const PairModel& model, const Box& box, Precision precision, double skin);

// From so many particles on a list is faster (docs/PERFORMANCE.md).
inline constexpr std::size_t list_crossover = 200;
// Of a list: larger ones hold more pairs that are out of range, smaller ones are made anew more often [sigma].
inline constexpr double default_skin = 0.3;
// Along a path, whose particles hardly move from one step to the next: rare renewal is worth less than a short list.
inline constexpr double path_skin = 0.15;

struct PairSearchOptions {
  PairSearch search = PairSearch::automatic;
  int threads = 1;  // that share the rows of a list; no effect on any result
  double skin = default_skin;
  Precision precision = Precision::double_precision;  // mixed takes a list at any size
};

// Whether an interaction of so many particles takes a list. Throws Error(bad_input) where a list is asked for, or needed for mixed
// precision or an open axis, that the minimum-image rule or PairSearch::all_pairs does not allow, and where clusters are asked for
// in double precision.
bool takes_list(const PairModel& model, const Box& box, double scale, std::size_t particles, const PairSearchOptions& options);

}  // namespace lanescape
