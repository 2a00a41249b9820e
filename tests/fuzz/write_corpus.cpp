#include <cstdio>
#include <filesystem>
#include <fstream>

#include "targets.hpp"

// write_corpus TARGET FOLDER: the target's seeds as files, for libFuzzer to start from.
int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("write_corpus TARGET FOLDER\n", stderr), 2;
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const std::string& seed : lanescape::fuzz::find_target(argv[1]).seeds())
    std::ofstream(folder / ("seed-" + std::to_string(++number)), std::ios::binary) << seed;
  return 0;
}
