#include "verification/host_kernel.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <lanescape/host_kernel.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <span>
#include <system_error>
#include <type_traits>

#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr unsigned seconds_per_case = 60;
// Doubles behind the forces that a kernel must leave alone: a vector of eight lanes on either side of the end.
constexpr std::size_t guard = 16;
constexpr double untouched = std::numeric_limits<double>::quiet_NaN();

// What the child says of one case.
struct Record {
  bool returned;
  int status;
  unsigned computed;
  double energy, virial;
  bool overrun;        // the guard was written to
  std::size_t forces;  // offset of its 3N and the guard
};

// Memory that parent and child share, zero at first.
template <class T>
class Shared {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Shared(std::size_t size) : size_(size), data_(map(size)) {}
  ~Shared() { munmap(data_, size_ * sizeof(T)); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  T& operator[](std::size_t k) { return data_[k]; }
  T* data() { return data_; }

 private:
  static T* map(std::size_t size) {
    void* memory = mmap(nullptr, size * sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  std::size_t size_;
  T* data_;
};

struct Exchange {
  Exchange(std::size_t cases, std::size_t forces) : records(cases), forces(forces), loaded(1), message(1024) {}
  Shared<Record> records;
  Shared<double> forces;
  Shared<bool> loaded;
  Shared<char> message;  // why it was not loaded
};

// The case as the interface has it, and the memory behind the pointers.
class Input {
 public:
  explicit Input(const PairCase& one)
      : positions_(one.configuration.positions), species_(one.configuration.species), numbers_(one.model.form_numbers) {
    const PairModel& model = one.model;
    for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) cutoff_.push_back(model.cutoff_of(ab));
    // Of empty vectors data() may be null.
    positions_.reserve(1);
    species_.reserve(1);
    numbers_.reserve(1);
    const auto& box = one.configuration.box.length;
    const auto& diameters = one.configuration.diameters;
    input = {sizeof(lanescape_kernel_input),
             one.name.c_str(),
             species_.size(),
             positions_.data(),
             species_.data(),
             {box[0], box[1], box[2]},
             model.species.size(),
             model.form->word,
             numbers_.size(),
             numbers_.data(),
             model.epsilon.data(),
             model.sigma.data(),
             cutoff_.data(),
             translate(model.truncation),
             translate(model.images),
             model.form->has_diameters ? diameters.data() : nullptr};
  }
  lanescape_kernel_input input;

 private:
  static int translate(ImageRule rule) {
    return rule == ImageRule::all ? LANESCAPE_KERNEL_ALL_IMAGES : LANESCAPE_KERNEL_MINIMUM_IMAGE;
  }
  static int translate(Truncation truncation) {
    switch (truncation) {
      case Truncation::shifted:
        return LANESCAPE_KERNEL_SHIFTED;
      case Truncation::plain:
        return LANESCAPE_KERNEL_PLAIN;
      case Truncation::tail:
        return LANESCAPE_KERNEL_TAIL;
      case Truncation::shifted_force:
        return LANESCAPE_KERNEL_SHIFTED_FORCE;
      case Truncation::smooth:
        return LANESCAPE_KERNEL_SMOOTH;
    }
    return LANESCAPE_KERNEL_SHIFTED;
  }

  std::vector<double> positions_;
  std::vector<int> species_;
  std::vector<double> numbers_, cutoff_;
};

lanescape_kernel* load(const std::filesystem::path& library, const std::string& symbol, Exchange& exchange) {
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = handle == nullptr ? nullptr : dlsym(handle, symbol.c_str());
  if (function != nullptr) return std::bit_cast<lanescape_kernel*>(function);
  const char* why = dlerror();
  const std::string message = handle == nullptr ? fmt::format("cannot be loaded as a shared library: {}", why)
                                                : fmt::format("has no function '{}': one with C linkage is needed", symbol);
  std::strncpy(exchange.message.data(), message.c_str(), 1023);
  return nullptr;
}

void call(lanescape_kernel* kernel, const PairCase& one, Exchange& exchange, std::size_t k) {
  Input input(one);
  Record& record = exchange.records[k];
  const std::span forces(&exchange.forces[record.forces], one.configuration.positions.size() + guard);
  std::fill(forces.begin(), forces.end(), untouched);
  lanescape_kernel_output output{sizeof output, LANESCAPE_KERNEL_ENERGY | LANESCAPE_KERNEL_FORCES | LANESCAPE_KERNEL_VIRIAL,
                                 untouched, forces.data(), untouched};
  alarm(seconds_per_case);
  const pid_t own = getpid();
  const int status = kernel(&input.input, &output);
  if (getpid() != own) _exit(0);  // a child that the kernel has made: it would go on with the cases, and its children too
  alarm(0);
  record.status = status;
  const auto changed = [](double x) { return std::bit_cast<std::uint64_t>(x) != std::bit_cast<std::uint64_t>(untouched); };
  record.overrun = std::any_of(forces.end() - guard, forces.end(), changed);
  record.computed = output.computed;
  record.energy = output.energy;
  record.virial = output.virial;
  record.returned = true;
}

[[noreturn]] void run_child(const std::filesystem::path& library, const std::string& symbol, const std::vector<PairCase>& cases,
                            Exchange& exchange, std::size_t first) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  for (const int number : {SIGINT, SIGTERM, SIGALRM}) std::signal(number, SIG_DFL);
  dup2(STDERR_FILENO, STDOUT_FILENO);  // stdout is for the report
  lanescape_kernel* kernel = load(library, symbol, exchange);
  exchange.loaded[0] = kernel != nullptr;
  for (std::size_t k = first; kernel != nullptr && k < cases.size(); ++k) call(kernel, cases[k], exchange, k);
  std::fflush(nullptr);
  _exit(0);
}

// How a process with cases ended, in the words of a message.
struct Ending {
  std::string words;
  bool out_of_time = false;
};

// How a child ended. Throws Error(interrupted) where somebody has interrupted it.
Ending wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  if (!WIFSIGNALED(status)) return {fmt::format("ended the process with exit status {}", WEXITSTATUS(status))};
  const int number = WTERMSIG(status);
  if (number == SIGINT || number == SIGTERM) throw Error(ErrorCode::interrupted, "interrupted: no result is printed");
  if (number == SIGALRM) return {fmt::format("did not return within {} s", seconds_per_case), true};
  return {fmt::format("crashed with {} ({})",
                      sigabbrev_np(number) == nullptr ? "a signal" : fmt::format("SIG{}", sigabbrev_np(number)),
                      strsignal(number))};
}

HostResult result_of(const Record& record, const double* forces, std::size_t components) {
  using Kind = HostResult::Kind;
  if (record.status == LANESCAPE_KERNEL_DECLINED) return {Kind::declined};
  if (record.status != LANESCAPE_KERNEL_DONE)
    return {Kind::broken, fmt::format("returned {}: 0 (done) and 1 (declined) are allowed", record.status)};
  if (record.overrun) return {Kind::broken, fmt::format("wrote beyond the {} components of the forces", components)};
  HostResult result{Kind::given};
  if (record.computed & LANESCAPE_KERNEL_ENERGY) result.energy = record.energy;
  if (record.computed & LANESCAPE_KERNEL_FORCES) result.forces.emplace(forces, forces + components);
  if (record.computed & LANESCAPE_KERNEL_VIRIAL) result.virial = record.virial;
  return result;
}

// Runs the cases from `first` on in a new process. The number of the first case that it has not finished; how it ended is then its
// fault.
std::size_t run_from(std::size_t first, const std::filesystem::path& library, const std::string& symbol,
                     const std::vector<PairCase>& cases, Exchange& exchange, Ending& ending) {
  exchange.loaded[0] = false;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) run_child(library, symbol, cases, exchange, first);
  ending = wait_for(child);
  if (!exchange.loaded[0]) {
    const std::string why = exchange.message.data();
    throw_bad_input(
        fmt::format("{}: {}", library.string(), why.empty() ? "the library " + ending.words + " as it was loaded" : why));
  }
  std::size_t k = first;
  while (k < cases.size() && exchange.records[k].returned) ++k;
  return k;
}

}  // namespace

std::vector<HostResult> run_host_kernel(const std::filesystem::path& library, const std::string& symbol,
                                        const std::vector<PairCase>& cases) {
  if (!std::filesystem::exists(library)) throw_bad_input(fmt::format("{}: there is no such file", library.string()));
  std::size_t forces = 0;
  for (const PairCase& one : cases) forces += one.configuration.positions.size() + guard;
  Exchange exchange(std::max<std::size_t>(cases.size(), 1), std::max<std::size_t>(forces, 1));
  std::size_t offset = 0;
  for (std::size_t k = 0; k < cases.size(); offset += cases[k++].configuration.positions.size() + guard)
    exchange.records[k].forces = offset;

  constexpr int most_waits = 3;  // a kernel that never returns would take hours
  int waits = 0;
  std::vector<HostResult> results(cases.size());
  for (std::size_t first = 0; first < cases.size();) {
    Ending ending;
    // A path with a slash: dlopen would search the system's folders for a bare name.
    const std::size_t last = run_from(first, std::filesystem::absolute(library), symbol, cases, exchange, ending);
    for (std::size_t k = first; k < last; ++k)
      results[k] =
          result_of(exchange.records[k], &exchange.forces[exchange.records[k].forces], cases[k].configuration.positions.size());
    if (last < cases.size()) results[last] = {HostResult::Kind::broken, ending.words};
    first = last + 1;
    if (last < cases.size() && ending.out_of_time && ++waits == most_waits) {
      std::fill(results.begin() + static_cast<std::ptrdiff_t>(first), results.end(),
                HostResult{HostResult::Kind::broken, fmt::format("was not called: {} cases before it did not return", waits)});
      break;
    }
  }
  return results;
}

}  // namespace lanescape
