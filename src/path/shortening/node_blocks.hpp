#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "core/parallel.hpp"

namespace lanescape {

// The inner nodes of a path, shared among threads in a fixed number of blocks: what is kept per block, such as a landscape with its
// lists, does the same work in the same order on any number of threads.
class NodeBlocks {
 public:
  static constexpr std::size_t count = 16;

  // Of a path of `nodes` nodes, both ends among them.
  NodeBlocks(std::size_t nodes, int threads)
      : inner_(nodes < 2 ? 0 : nodes - 2), threads_(std::clamp(threads, 1, static_cast<int>(count))) {}

  // body(block, first node, node after the last) of each block that is not empty. A thread takes the next block when it is done
  // with one.
  template <class Body>
  void for_each_block(const Body& body) const {
    std::atomic<std::size_t> next = 0;
    for_each_part(threads_, [&](int) {
      for (std::size_t block = next++; block < count; block = next++) {
        const std::size_t begin = 1 + inner_ * block / count, end = 1 + inner_ * (block + 1) / count;
        if (begin < end) body(block, begin, end);
      }
    });
  }
  // body(node) of each inner node.
  template <class Body>
  void for_each_node(const Body& body) const {
    for_each_block([&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) body(k);
    });
  }
  // The sum over inner nodes of what body(node) returns, in the order of the blocks.
  template <class Body>
  double sum(const Body& body) const {
    double sums[count] = {};
    for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) sums[block] += body(k);
    });
    double total = 0.0;
    for (const double s : sums) total += s;
    return total;
  }
  template <class Body>
  double largest(const Body& body) const {
    double found[count] = {};
    for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) found[block] = std::max(found[block], body(k));
    });
    return *std::max_element(found, found + count);
  }
  int threads() const { return threads_; }

 private:
  std::size_t inner_;
  int threads_;
};

}  // namespace lanescape
