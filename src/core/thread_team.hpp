#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>

namespace lanescape {

// What a thread takes from a loop at a time.
enum class Taking : std::uint32_t {
  one_block,  // balances work that differs
  own_blocks  // all that one thread owns, at the cost of one block: for loops of microseconds
};

// Threads that stay at hand while one of them runs a program with many short loops. A loop has a fixed number of blocks. Each
// thread does its own blocks first, always the same ones, which keeps their data in its cache; then those that others have not
// begun. No loop waits for a thread that is late and holds no block: a busy machine slows a program by no more than its share.
class ThreadTeam {
 public:
  static constexpr std::size_t blocks = 16;

  explicit ThreadTeam(int threads);

  int threads() const { return threads_; }
  // Calls program() on this thread; for_each() within it, from this thread only, uses all of them. Rethrows its exception.
  void run(const std::function<void()>& program);
  // body(block) for each block, in any order and on any thread. Rethrows the exception of the first block that throws, once all
  // have ended. Outside run() the threads are started for this one loop.
  void for_each(const std::function<void(std::size_t)>& body, Taking taking = Taking::one_block);

 private:
  // In eight bytes, which threads read as one.
  struct Loop {
    std::uint32_t number = 0;
    Taking taking = Taking::one_block;
  };
  void help(int thread);
  void work(int thread, Loop loop);
  void do_blocks(std::size_t begin, std::size_t end, std::uint32_t loop);
  void rethrow_failure();

  int threads_;
  bool is_running_ = false;
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::array<std::exception_ptr, blocks> failures_;
  std::atomic<bool> has_failed_ = false, has_ended_ = false;
  // Each on cache lines of its own: all threads read the first while they wait.
  alignas(64) std::atomic<Loop> loop_{};                                // that runs
  alignas(64) std::atomic<std::size_t> left_ = 0;                       // blocks of it that have not ended
  alignas(64) std::array<std::atomic<std::uint32_t>, blocks> begun_{};  // the last loop for which a thread took this block
};

}  // namespace lanescape
