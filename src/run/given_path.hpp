#pragma once

#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "dispatch/isa.hpp"
#include "run/path_run.hpp"
#include "run/path_search.hpp"

namespace lanescape {

// Turns a path that runs from the last end of the pair to its first round. Throws Error(bad_input), with messages that start with
// `where`, for fewer than three nodes, nodes of another system and other ends. Ends may differ from those of the pair, and radii
// from its radii, as much as rounding in a file makes them differ.
void match_ends(std::vector<Configuration>& nodes, const AnyModel& model, const ConfigurationPair& pair, const std::string& where);

// The nodes of a path that somebody else found, fit for the pair: from its first end to its last, with its own ends and
// radii. Throws what match_ends() throws, and Error(bad_input) for nodes that are not allowed: a soft one may exceed the landscape
// energy by the escape method's tolerance, a hard one has no overlap.
std::vector<Configuration> fit_path(std::vector<Configuration> nodes, const AnyModel& model, const ConfigurationPair& pair,
                                    const std::string& where, const PathRunOptions& options, Isa isa);
// The same on the landscape of a search, whose pair it is.
std::vector<Configuration> fit_path(std::vector<Configuration> nodes, const SearchSetup& search, const std::string& where);

}  // namespace lanescape
