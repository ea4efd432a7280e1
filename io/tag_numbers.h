#pragma once
// Tags that a file gives its nodes or cells (positive, in any order, with gaps) to the numbers that we give them.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace argil::io {

class TagNumbers {
 public:
  static constexpr std::uint32_t k_none = std::numeric_limits<std::uint32_t>::max();

  /// False if the tag is there already. Tags that are not far beyond their count lie in an array, the others in a
  /// tree, so that memory is O(tags) whatever they are. Cost O(log n).
  bool add(std::int64_t tag, std::uint32_t number) {
    ++count_;
    const auto index = static_cast<std::uint64_t>(tag);
    if (index >= 8 * (count_ + 64)) return find(tag) ? false : sparse_.emplace(tag, number).second;
    if (index >= dense_.size()) dense_.resize(std::max<std::size_t>(index + 1, dense_.size() * 3 / 2), k_none);
    if (dense_[index] != k_none || sparse_.contains(tag)) return false;
    dense_[index] = number;
    return true;
  }
  std::optional<std::uint32_t> find(std::int64_t tag) const {
    const auto index = static_cast<std::uint64_t>(tag);
    if (index < dense_.size() && dense_[index] != k_none) return dense_[index];
    if (sparse_.empty()) return std::nullopt;
    const auto found = sparse_.find(tag);
    return found == sparse_.end() ? std::nullopt : std::optional(found->second);
  }
  std::size_t size() const { return count_; }

 private:
  std::vector<std::uint32_t> dense_;
  std::map<std::int64_t, std::uint32_t> sparse_;
  std::size_t count_ = 0;
};

}  // namespace argil::io
