#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "configuration/model.hpp"

namespace lanescape {

// A mixture as a TOML file (docs/FORMATS.md). A key that is unknown, missing, given twice or out of range throws
// Error(bad_input) with file and line. Left out: name is the file's stem, mass is 1, cutoff, truncation and images are
// PairModel's; fractions are equal and come for all species or none.
AnyModel read_model_file(const std::filesystem::path& path);
// The text of such a file; in messages it is called `source`.
AnyModel read_model_text(const std::string& text, const std::string& source = "model text");

// Writes what read_model_file reads back as the same model, bit for bit; a model it would refuse throws Error(bad_input).
void write_model_file(std::ostream& out, const AnyModel& model);

}  // namespace lanescape
