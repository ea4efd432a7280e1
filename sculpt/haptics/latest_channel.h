#pragma once
// The newest value from one thread to another, without locks: each side always owns one of three slots, and they
// swap through the third. Neither waits; the reader sees the newest whole value.

#include <array>
#include <atomic>

namespace argil::sculpt {

/// Of one writer and one reader.
template <class Value>
class LatestChannel {
 public:
  void publish(const Value& value) {
    slots_[writer_] = value;
    writer_ = between_.exchange(writer_ | k_fresh, std::memory_order_acq_rel) & k_slot;
  }

  /// The newest value, unchanged until the next call; null before the first.
  [[nodiscard]] const Value* latest() {
    if ((between_.load(std::memory_order_relaxed) & k_fresh) != 0) {
      reader_ = between_.exchange(reader_, std::memory_order_acq_rel) & k_slot;
      any_ = true;
    }
    return any_ ? &slots_[reader_] : nullptr;
  }

 private:
  static constexpr unsigned k_slot = 3, k_fresh = 4;

  std::array<Value, 3> slots_;
  std::atomic<unsigned> between_{1};  // slot that neither side owns; k_fresh if the reader has not seen it
  unsigned writer_ = 0, reader_ = 2;
  bool any_ = false;  // reader's
};

}  // namespace argil::sculpt
