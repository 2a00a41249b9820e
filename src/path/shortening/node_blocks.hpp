#pragma once

#include <algorithm>
#include <cstddef>

#include "core/parallel.hpp"

namespace lanescape {

// The inner nodes of a path, shared among threads in a fixed number of blocks: what is kept per block, such as a landscape with its
// lists, does the same work in the same order on any number of threads.
class NodeBlocks {
 public:
  static constexpr std::size_t count = 16;

  // Of a path of `nodes` nodes, both ends among them.
  NodeBlocks(std::size_t nodes, int threads) : inner_(nodes < 2 ? 0 : nodes - 2), threads_(threads) {}

  // The first node of a block; of the block after the last, the node after the last.
  std::size_t begin(std::size_t block) const { return 1 + inner_ * block / count; }
  // body(block, first node, node after the last) of each block that is not empty.
  template <class Body>
  void for_each_block(const Body& body, Taking taking = Taking::one_block) const {
    const auto run_block = [&](std::size_t block) {
      if (begin(block) < begin(block + 1)) body(block, begin(block), begin(block + 1));
    };
    lanescape::for_each_block(threads_, count, run_block, taking);
  }
  // The same for the algebra of a few vectors per node.
  template <class Body>
  void for_each_short_block(const Body& body) const {
    for_each_block(body, Taking::own_blocks);
  }
  // body(node) of each inner node.
  template <class Body>
  void for_each_node(const Body& body) const {
    for_each_short_block([&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) body(k);
    });
  }
  // The sum over inner nodes of what body(node) returns, in the order of the blocks.
  template <class Body>
  double sum(const Body& body) const {
    double sums[count] = {};
    for_each_short_block([&](std::size_t block, std::size_t begin, std::size_t end) {
      double of_block = 0.0;
      for (std::size_t k = begin; k < end; ++k) of_block += body(k);
      sums[block] = of_block;
    });
    double total = 0.0;
    for (const double s : sums) total += s;
    return total;
  }
  template <class Body>
  double largest(const Body& body) const {
    double found[count] = {};
    for_each_short_block([&](std::size_t block, std::size_t begin, std::size_t end) {
      double of_block = 0.0;
      for (std::size_t k = begin; k < end; ++k) of_block = std::max(of_block, body(k));
      found[block] = of_block;
    });
    return *std::max_element(found, found + count);
  }
  int threads() const { return threads_; }

 private:
  std::size_t inner_;
  int threads_;
};

}  // namespace lanescape
