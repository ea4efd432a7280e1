#pragma once
// Arrays that a model keeps from one tangent to the next: fresh memory costs more, page by page, than what is
// computed into it.

#include <cstddef>
#include <mutex>
#include <vector>

#include "fem/models/lanes.h"

namespace argil::fem {

class PacketMemory {
 public:
  /// An array of this size with any content.
  [[nodiscard]] std::vector<FourDoubles> take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    for (std::vector<FourDoubles>& array : spare_)
      if (array.size() == size) {
        std::swap(array, spare_.back());
        std::vector<FourDoubles> result = std::move(spare_.back());
        spare_.pop_back();
        return result;
      }
    return std::vector<FourDoubles>(size);
  }
  void give_back(std::vector<FourDoubles> array) {
    const std::lock_guard lock(mutex_);
    if (spare_.size() < k_most) spare_.push_back(std::move(array));
  }

 private:
  static constexpr std::size_t k_most = 4;  // entries and slots of two tangents
  std::mutex mutex_;
  std::vector<std::vector<FourDoubles>> spare_;
};

}  // namespace argil::fem
