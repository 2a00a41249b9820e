// NeighbourFinder for bench/peers/neighbours.py: neighbour_timer FILE [ISA], where FILE holds the edge of a cubic box, the cutoff
// and positions as doubles. Each line on stdin is a command, each answer a line:
//   time ORDER MEMBERS QUANTITIES AGE REPETITIONS    sorted or any, full or half, letters of ijSDd, fresh or reused:
//                                                    number of pairs and shortest time of a call [s]
//   pairs FILE                                       writes i j Sx Sy Sz of all pairs, sorted, as 64-bit integers: their number

#include <lanescape/neighbours.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using lanescape::NeighbourFinder;

struct Input {
  std::array<double, 3> box{};
  double cutoff = 0.0;
  std::vector<double> positions;
};

Input read(const char* file) {
  std::ifstream stream(file, std::ios::binary);
  Input input;
  double edge = 0.0;
  const auto next = [&](double& x) -> bool { return static_cast<bool>(stream.read(reinterpret_cast<char*>(&x), sizeof x)); };
  if (!next(edge) || !next(input.cutoff)) throw std::runtime_error(std::string(file) + ": no edge and cutoff in it");
  input.box.fill(edge);
  for (double x = 0.0; next(x);) input.positions.push_back(x);
  return input;
}

class Timer {
 public:
  Timer(Input input, std::string isa) : input_(std::move(input)), isa_(std::move(isa)) {}

  std::string answer(const std::string& line) {
    std::istringstream words(line);
    std::string command, order, members, quantities, age;
    words >> command;
    if (command == "pairs") return write_pairs(words);
    int repetitions = 0;
    if (command != "time" || !(words >> order >> members >> quantities >> age >> repetitions))
      throw std::runtime_error(line + ": not a command");
    const NeighbourFinder::Options options = options_of(order, members, quantities);
    if (age == "fresh") return best(repetitions, [&] { return NeighbourFinder(options); });
    auto& kept = kept_.try_emplace(order + members + quantities, options).first->second;
    return best(repetitions, [&]() -> NeighbourFinder& { return kept; });
  }

 private:
  NeighbourFinder::Options options_of(const std::string& order, const std::string& members, const std::string& quantities) const {
    const auto wanted = [&](char letter) { return quantities.find(letter) != std::string::npos; };
    return {.cutoffs = {input_.cutoff},
            .members = members == "half" ? NeighbourFinder::Members::half : NeighbourFinder::Members::full,
            .order = order == "any" ? NeighbourFinder::Order::any : NeighbourFinder::Order::sorted,
            .quantities = {.i = wanted('i'), .j = wanted('j'), .S = wanted('S'), .D = wanted('D'), .d = wanted('d')},
            .isa = isa_};
  }

  // Making an object is timed, destroying it is not: the arrays of other codes live on too.
  template <class Make>
  std::string best(int repetitions, Make make) const {
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    for (int k = 0; k < repetitions; ++k) {
      const auto begin = std::chrono::steady_clock::now();
      auto&& finder = make();
      count = finder.find(input_.positions, input_.box).count;
      shortest = std::min(shortest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    std::ostringstream text;
    text << count << ' ' << shortest;
    return text.str();
  }

  std::string write_pairs(std::istream& words) const {
    std::string file;
    words >> file;
    NeighbourFinder finder(options_of("sorted", "full", "ijS"));
    const NeighbourFinder::Pairs pairs = finder.find(input_.positions, input_.box);
    std::ofstream stream(file, std::ios::binary);
    for (std::size_t k = 0; k < pairs.count; ++k) {
      const std::int64_t row[] = {pairs.i[k], pairs.j[k], pairs.S[3 * k], pairs.S[3 * k + 1], pairs.S[3 * k + 2]};
      stream.write(reinterpret_cast<const char*>(row), sizeof row);
    }
    if (!stream.flush()) throw std::runtime_error(file + ": cannot be written");
    return std::to_string(pairs.count);
  }

  Input input_;
  std::string isa_;
  std::map<std::string, NeighbourFinder> kept_;
};

}  // namespace

int main(int count, char** words) {
  try {
    if (count < 2 || count > 3) throw std::runtime_error("usage: neighbour_timer FILE [ISA]");
    Timer timer(read(words[1]), count > 2 ? words[2] : "auto");
    for (std::string line; std::getline(std::cin, line);) std::cout << timer.answer(line) << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "neighbour_timer: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
