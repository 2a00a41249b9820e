#pragma once

#include "configuration/pair_model.hpp"
#include "core/box.hpp"
#include "views/pair.hpp"

namespace lanescape {

// Which image search a cutoff needs in a periodic box (src/interaction/README.md, "Small boxes"); lengths in the same unit.
kernels::ImageSearch image_search(const Box& box, double cutoff, ImageRule rule);

// Shifts by more than this many boxes bring no image of a nearest separation (|d| <= L/2) within the cutoff.
double image_shells(double length, double cutoff);
// Largest number of periodic images per direction that the rule `all` takes part in.
inline constexpr int max_image_shells = 8;
// Throws what check_edges() throws, and Error(bad_input) where a cutoff reaches over more images than that.
void check_reach(const Box& box, double cutoff);
// Throws what check_edges() throws, and Error(bad_input) where some pair's cutoff reaches further than that, and for a long-range
// correction, which is that of a fluid without end, in a box with an open axis. `scale`: by which particles' diameters lengthen
// cutoffs.
void check_cutoff(const PairModel& model, const Box& box, double scale = 1.0);

}  // namespace lanescape
