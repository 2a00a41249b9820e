#include "core/thread_team.hpp"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "core/float_environment.hpp"

namespace lanescape {
namespace {

// Between loops that follow each other; waking a thread that sleeps takes longer.
constexpr std::chrono::microseconds longest_look{10};
// Enough to balance any loop; a member's share of them fits 16 bits.
constexpr std::size_t portions_of_member = 256;

thread_local bool is_in_loop = false;

// A child that is forked has none of the threads of its parent.
std::atomic<bool> helpers_are_gone = false;

// The value of a word once it is another one. Sleeps after a while: a processor that looks in vain may be wanted by the very thread
// that is waited for.
std::uint32_t next_value(const std::atomic<std::uint32_t>& word, std::uint32_t seen) {
  constexpr int looks_between_clocks = 16;
  const auto start = std::chrono::steady_clock::now();
  do {
    for (int k = 0; k < looks_between_clocks; ++k) {
      if (const std::uint32_t value = word.load(std::memory_order_acquire); value != seen) return value;
#if defined(__x86_64__)
      __builtin_ia32_pause();
#endif
    }
  } while (std::chrono::steady_clock::now() - start < longest_look);
  word.wait(seen, std::memory_order_acquire);
  return word.load(std::memory_order_acquire);
}

// The first of n things in a share; the share after the last begins at n.
constexpr std::size_t share_begin(std::size_t n, std::size_t share, std::size_t shares) { return n * share / shares; }

// The team of a thread. Where helpers are gone it cannot end: nobody would be there to be waited for.
struct Keeper {
  std::unique_ptr<ThreadTeam> team;
  Keeper() = default;
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;
  ~Keeper() {
    [[maybe_unused]] static ThreadTeam* left_alone = nullptr;
    if (helpers_are_gone) left_alone = team.release();
  }
};

}  // namespace

bool ThreadTeam::is_alone() { return is_in_loop || helpers_are_gone; }

ThreadTeam& ThreadTeam::of_this_thread(int members) {
  [[maybe_unused]] static const int watched = pthread_atfork(nullptr, nullptr, [] { helpers_are_gone = true; });
  thread_local Keeper keeper;
  if (!keeper.team || keeper.team->members_.size() < static_cast<std::size_t>(members)) {
    keeper.team.reset();
    keeper.team.reset(new ThreadTeam(members));
  }
  return *keeper.team;
}

ThreadTeam::ThreadTeam(int members) : members_(static_cast<std::size_t>(members)) {
  try {
    for (std::size_t m = 1; m < members_.size(); ++m) helpers_.emplace_back([this, m] { help(m); });
  } catch (const std::system_error&) {  // no more threads: those that there are do all of the work
  }
}

ThreadTeam::~ThreadTeam() {
  has_ended_ = true;
  ++loop_;
  call_members(helpers_.size() + 1);
  for (std::thread& helper : helpers_) helper.join();
}

void ThreadTeam::call_members(std::size_t members) {
  for (std::size_t m = 1; m < members; ++m) {
    members_[m].call.store(loop_);
    members_[m].call.notify_one();
  }
}

void ThreadTeam::for_each(int members, std::size_t blocks, const std::function<void(std::size_t)>& body, Taking taking) {
  present_ = std::min({static_cast<std::size_t>(members), helpers_.size() + 1, blocks});
  body_ = &body;
  blocks_ = blocks;
  portions_ = taking == Taking::own_blocks ? present_ : std::min(blocks, portions_of_member * present_);
  ++loop_;
  left_.store(static_cast<std::uint32_t>(portions_), std::memory_order_relaxed);
  for (std::size_t m = 0; m < present_; ++m) {
    const std::size_t count = share_begin(portions_, m + 1, present_) - share_begin(portions_, m, present_);
    members_[m].share.store(std::uint64_t{loop_} << 32 | count, std::memory_order_release);
  }
  call_members(present_);
  work(0, loop_);
  for (std::uint32_t left = left_.load(std::memory_order_acquire); left > 0;) left = next_value(left_, left);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadTeam::help(std::size_t member) {
  for (std::uint32_t loop = 0;;) {
    loop = next_value(members_[member].call, loop);
    if (has_ended_) return;
    work(member, loop);
  }
}

void ThreadTeam::work(std::size_t member, std::uint32_t loop) {
  const FloatEnvironment environment;
  is_in_loop = true;
  std::uint32_t done = 0;
  for (std::size_t turn = 0; turn < members_.size(); ++turn) {
    const std::size_t owner = (member + turn) % members_.size();
    // From the last on those of others, who come to them last.
    while (const auto portion = take(members_[owner], loop, turn == 0 ? End::first : End::last)) {
      do_portion(owner, *portion);
      ++done;
    }
  }
  is_in_loop = false;
  if (done > 0 && left_.fetch_sub(done, std::memory_order_acq_rel) == done) left_.notify_one();
}

std::optional<std::size_t> ThreadTeam::take(Member& member, std::uint32_t loop, End end) {
  std::uint64_t share = member.share.load(std::memory_order_acquire);
  for (;;) {
    const std::size_t first = share >> 16 & 0xffff, last = share & 0xffff;
    if (share >> 32 != loop || first == last) return std::nullopt;
    const std::uint64_t next = end == End::first ? share + (1U << 16) : share - 1;
    if (member.share.compare_exchange_weak(share, next, std::memory_order_acq_rel, std::memory_order_acquire))
      return end == End::first ? first : last - 1;
  }
}

void ThreadTeam::do_portion(std::size_t member, std::size_t portion) {
  const std::size_t k = share_begin(portions_, member, present_) + portion;
  for (std::size_t block = share_begin(blocks_, k, portions_); block < share_begin(blocks_, k + 1, portions_); ++block) try {
      (*body_)(block);
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (failure_ && failed_ < block) continue;
      failed_ = block;
      failure_ = std::current_exception();
    }
}

}  // namespace lanescape
