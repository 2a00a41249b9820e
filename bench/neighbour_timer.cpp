// NeighbourFinder for bench/peers/neighbours.py: neighbour_timer FILE ISA, where FILE holds the edge of a cubic box, the cutoff
// and positions as doubles. Each line on stdin is a command, each answer a line:
//   time ORDER MEMBERS QUANTITIES AGE    sorted or any, full or half, letters of ijSDd, fresh or reused: the number of pairs and
//   the
//                                        processor time of a call [s]; the object of the last such call is kept for the next
//   pairs FILE                           writes i j Sx Sy Sz of all pairs, sorted, as 64-bit integers; their number

#include <lanescape/neighbours.hpp>

#include <array>
#include <cstdint>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <optional>
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
    if (command != "time" || !(words >> order >> members >> quantities >> age)) throw std::runtime_error(line + ": not a command");
    if (line != kept_for_ || age == "fresh") kept_.reset();
    kept_for_ = line;
    // Making an object is timed, destroying it is not: the arrays of other codes live on too.
    const double begin = processor_time();
    if (!kept_) kept_.emplace(options_of(order, members, quantities));
    const std::size_t count = kept_->find(input_.positions, input_.box).count;
    std::ostringstream text;
    text << count << ' ' << processor_time() - begin;
    return text.str();
  }

 private:
  NeighbourFinder::Options options_of(const std::string& order, const std::string& members, const std::string& quantities) const {
    const auto wanted = [&](char letter) { return quantities.find(letter) != std::string::npos; };
    return {.cutoffs = {input_.cutoff},
            .members = members == "half" ? NeighbourFinder::Members::half : NeighbourFinder::Members::full,
            .order = order == "any" ? NeighbourFinder::Order::any : NeighbourFinder::Order::sorted,
            .quantities = {.i = wanted('i'), .j = wanted('j'), .S = wanted('S'), .D = wanted('D'), .d = wanted('d')},
            .instruction_set = isa_};
  }

  static double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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
  std::string kept_for_;
  std::optional<NeighbourFinder> kept_;
};

}  // namespace

int main(int count, char** words) {
  try {
    if (count != 3) throw std::runtime_error("usage: neighbour_timer FILE ISA");
    Timer timer(read(words[1]), words[2]);
    for (std::string line; std::getline(std::cin, line);) std::cout << timer.answer(line) << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "neighbour_timer: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
