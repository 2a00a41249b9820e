#include "core/thread_team.hpp"

#include <algorithm>
#include <thread>

#include "core/parallel.hpp"

namespace lanescape {
namespace {

// A wait that is short where all threads run, and leaves the processor to others where they do not.
class Wait {
 public:
  void once() {
    if (++times_ > longest_spin) return std::this_thread::yield();
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }

 private:
  static constexpr int longest_spin = 2000;
  int times_ = 0;
};

}  // namespace

ThreadTeam::ThreadTeam(int threads) : threads_(std::clamp(threads, 1, static_cast<int>(blocks))) {}

void ThreadTeam::run(const std::function<void()>& program) {
  if (threads_ == 1 || is_running_) return program();
  is_running_ = true;
  has_ended_ = false;
  struct End {
    ThreadTeam& team;
    ~End() {
      team.is_running_ = false;
      team.has_ended_ = true;
    }
  };
  for_each_part(threads_, [&](int thread) {
    if (thread > 0) return help(thread);
    const End end{*this};
    program();
  });
}

void ThreadTeam::for_each(const std::function<void(std::size_t)>& body, Taking taking) {
  if (threads_ == 1) {
    for (std::size_t block = 0; block < blocks; ++block) body(block);
    return;
  }
  if (!is_running_) return run([&] { for_each(body, taking); });
  body_ = &body;
  left_.store(blocks, std::memory_order_relaxed);
  const Loop loop{loop_.load(std::memory_order_relaxed).number + 1, taking};
  loop_.store(loop, std::memory_order_release);
  work(0, loop);
  for (Wait wait; left_.load(std::memory_order_acquire) > 0;) wait.once();
  if (has_failed_) rethrow_failure();
}

void ThreadTeam::help(int thread) {
  Loop seen = loop_.load(std::memory_order_acquire);
  work(thread, seen);
  for (Wait wait; !has_ended_.load(std::memory_order_acquire); wait.once()) {
    const Loop loop = loop_.load(std::memory_order_acquire);
    if (loop.number == seen.number) continue;
    work(thread, seen = loop);
    wait = Wait();
  }
}

void ThreadTeam::work(int thread, Loop loop) {
  for (int turn = 0; turn < threads_; ++turn) {
    const int owner = (thread + turn) % threads_;
    const std::size_t begin = part_begin(blocks, owner, threads_), end = part_begin(blocks, owner + 1, threads_);
    if (loop.taking == Taking::own_blocks)
      do_blocks(begin, end, loop.number);
    else  // those of others from the last on, which their owner comes to last
      for (std::size_t k = begin, back = end - 1; k < end; ++k, --back)
        do_blocks(turn == 0 ? k : back, (turn == 0 ? k : back) + 1, loop.number);
  }
}

// Nothing, where a thread has taken these before: a thread that comes late finds none left of a loop that has ended.
void ThreadTeam::do_blocks(std::size_t begin, std::size_t end, std::uint32_t loop) {
  std::uint32_t before = loop - 1;
  if (begun_[begin].load(std::memory_order_relaxed) != before ||
      !begun_[begin].compare_exchange_strong(before, loop, std::memory_order_acquire))
    return;
  for (std::size_t block = begin; block < end; ++block) {
    begun_[block].store(loop, std::memory_order_relaxed);
    try {
      (*body_)(block);
    } catch (...) {
      failures_[block] = std::current_exception();
      has_failed_ = true;
    }
  }
  left_.fetch_sub(end - begin, std::memory_order_release);
}

void ThreadTeam::rethrow_failure() {
  has_failed_ = false;
  std::exception_ptr first;
  for (std::exception_ptr& failure : failures_) {
    if (failure && !first) first = failure;
    failure = nullptr;
  }
  std::rethrow_exception(first);
}

}  // namespace lanescape
