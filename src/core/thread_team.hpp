#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace lanescape {

// What a thread takes from a loop at a time.
enum class Taking {
  one_block,  // balances work that differs
  own_blocks  // all that one thread owns, at the cost of one block: for loops of microseconds
};

// A thread and its helpers, which share the blocks of loops. Helpers are started once and kept; between loops they look for work
// during some microseconds, then sleep.
//
// Each member of the team does its own blocks first, always the same ones, which keeps their data in its cache; then, from the last
// one on, those that others have not begun. No loop waits for a member that is late and holds no block: a busy machine slows a
// program by no more than its share.
class ThreadTeam {
 public:
  // A team of the calling thread with at least this many members, itself included; with fewer where the system starts no more
  // threads. It lives until the thread ends.
  static ThreadTeam& of_this_thread(int members);
  // Whether the calling thread is inside a loop, or in a child that was forked after helpers had been started: it then works alone.
  static bool is_alone();

  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  // How many loops it has run.
  std::uint32_t loops() const { return loop_; }

  // body(block) for each block, in any order, on at most so many members. Rethrows the exception of the first block that throws,
  // once all have ended.
  void for_each(int members, std::size_t blocks, const std::function<void(std::size_t)>& body, Taking taking);

 private:
  // On a cache line of its own: who owns it changes it in every loop.
  struct alignas(64) Member {
    // The number of a loop in 32 bits; in 16 bits each the first of its portions that nobody has begun and the end of these.
    std::atomic<std::uint64_t> share{0};
    std::atomic<std::uint32_t> call{0};  // the last loop for which it was called
  };

  enum class End { first, last };

  explicit ThreadTeam(int members);
  void help(std::size_t member);
  void work(std::size_t member, std::uint32_t loop);
  // A portion of a member's share; none where all have been begun or the loop has ended.
  static std::optional<std::size_t> take(Member& member, std::uint32_t loop, End end);
  void do_portion(std::size_t member, std::size_t portion);
  void call_members(std::size_t members);

  std::vector<Member> members_;
  std::vector<std::thread> helpers_;
  std::atomic<bool> has_ended_ = false;
  // The loop that runs. Whoever has taken a portion may read it: until that portion ends it does not change.
  std::uint32_t loop_ = 0;
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::size_t blocks_ = 0, portions_ = 0, present_ = 0;
  std::mutex failing_;
  std::exception_ptr failure_;  // of the first block that has failed
  std::size_t failed_ = 0;
  alignas(64) std::atomic<std::uint32_t> left_ = 0;  // portions that have not ended
};

}  // namespace lanescape
