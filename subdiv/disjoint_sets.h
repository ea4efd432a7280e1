#pragma once
// Sets of the numbers 0 … n − 1 that are merged two by two; a set is named by its smallest member.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace argil::subdiv {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::uint32_t{0}); }
  /// The smallest member of the set of i. Cost O(log n) amortised.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::size_t count() const {
    std::size_t result = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) result += parent_[i] == i;
    return result;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace argil::subdiv
