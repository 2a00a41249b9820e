#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <random>

#include "targets.hpp"

// mutations SECONDS [TARGET [NUMBER]]: feeds the targets with mutations of their seeds, without libFuzzer and its compiler. A
// mutation follows from its number; a failure names it, and with NUMBER it is fed alone.
namespace {

using namespace lanescape::fuzz;

constexpr time_t longest_seconds = 10;  // of processor time, for one input
constexpr const char* tokens[] = {"nan", "inf", "-1", "0",    "1e999", "1e-999", "18446744073709551616", "\"", "[", "]", "\n", "=",
                                  " ",   "--",  "[[", "\xff", "T",     "1D+00"};

// What is fed at the moment, for the handler of signals.
const char* fed_target = "";
volatile std::uint64_t fed_number = 0;

void name_failure(int signal) {
  char line[160];
  const int length = std::snprintf(line, sizeof line, "mutations: %s, number %llu: signal %d\n", fed_target,
                                   static_cast<unsigned long long>(fed_number), signal);
  if (::write(STDERR_FILENO, line, static_cast<std::size_t>(length)) < 0) std::_Exit(1);
  std::_Exit(1);
}

void limit_time(time_t seconds) {
  const itimerval limit{{0, 0}, {seconds, 0}};
  ::setitimer(ITIMER_PROF, &limit, nullptr);
}

std::string mutated(const std::vector<std::string>& seeds, std::uint64_t number) {
  std::mt19937_64 random(number);
  std::string bytes = seeds[random() % seeds.size()];
  for (std::uint64_t left = random() % 6; left > 0; --left) {
    const std::size_t at = random() % (bytes.size() + 1), count = random() % (1 + std::min<std::size_t>(bytes.size() - at, 64));
    switch (random() % 7) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        break;
      case 1:
        if (at < bytes.size()) bytes[at] = static_cast<char>(random());
        break;
      case 2:
        bytes.erase(at, count);
        break;
      case 3:
        bytes.insert(at, bytes.substr(random() % (bytes.size() + 1), count));
        break;
      case 4:
        bytes.insert(at, tokens[random() % std::size(tokens)]);
        break;
      case 5: {
        const std::string& other = seeds[random() % seeds.size()];
        bytes = bytes.substr(0, at) + other.substr(random() % (other.size() + 1));
        break;
      }
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

void feed(const Target& target, const std::vector<std::string>& seeds, std::uint64_t number) {
  fed_target = target.name;
  fed_number = number;
  limit_time(longest_seconds);
  try {
    // The first numbers are the seeds themselves.
    target.feed(number < seeds.size() ? seeds[number] : mutated(seeds, number));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mutations: %s\n", error.what());
    name_failure(0);
  }
  limit_time(0);
}

void feed_for(double seconds, const Target& target) {
  const std::vector<std::string> seeds = target.seeds();
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t number = 0;
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds) feed(target, seeds, number++);
  std::printf("%s: %llu inputs\n", target.name, static_cast<unsigned long long>(number));
  if (number < seeds.size()) std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGPROF}) std::signal(signal, name_failure);
  if (argc < 2 || argc > 4) return std::fputs("mutations SECONDS [TARGET [NUMBER]]\n", stderr), 2;
  const double seconds = std::atof(argv[1]);
  if (argc == 4) {
    const Target& target = find_target(argv[2]);
    feed(target, target.seeds(), std::strtoull(argv[3], nullptr, 10));
  } else if (argc == 3) {
    feed_for(seconds, find_target(argv[2]));
  } else {
    for (const Target& target : all_targets()) feed_for(seconds / static_cast<double>(all_targets().size()), target);
  }
  return 0;
}
