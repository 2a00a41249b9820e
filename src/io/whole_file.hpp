#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace lanescape {

// Files that end with a trailer of 32 bytes, by which they are known to be whole before a library parses them: parsers of HDF5 are
// not made for damaged files. HDF5 ignores what follows its data. docs/FORMATS.md has the layout. The checksum shows accidents; it
// is no signature.

// The trailer of a file with this content before it.
std::string trailer_of(std::string_view content);

// Why a file is not whole, as the end of a sentence about it; nothing where it is. Reads it once from beginning to end.
std::optional<std::string> fault_of_file(const std::filesystem::path& file);

}  // namespace lanescape
