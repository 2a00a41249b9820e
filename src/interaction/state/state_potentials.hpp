#pragma once

// All potentials of sites in states.
#include "interaction/state/bonded_angles.hpp"
#include "interaction/state/lennard_jones_states.hpp"
#include "interaction/state/pair_function_states.hpp"
#include "interaction/state/tabulated_states.hpp"
