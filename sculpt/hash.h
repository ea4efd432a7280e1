#pragma once
// The state hash (SESSION.md, "Promises"): FNV-1a, 64 bits, over little-endian canonical values, streamed. The same
// values give the same hash on every machine; −0 counts as +0 and every NaN as one.

#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>

namespace argil::sculpt {

class Hash {
 public:
  Hash& add(std::uint64_t value);
  Hash& add(double value);
  /// The bytes, after their number, so that "ab","c" differs from "a","bc".
  Hash& add(std::string_view text);
  Hash& add(const char* text) { return add(std::string_view(text)); }
  /// The values, after their number.
  Hash& add(std::span<const double> values);
  Hash& add(std::span<const std::uint32_t> values);
  Hash& add(std::span<const std::uint8_t> values);
  /// Other integers would convert in silence to one of two kinds.
  template <std::integral T>
  requires(!std::same_as<T, std::uint64_t>) Hash& add(T) = delete;

  std::uint64_t value() const { return state_; }

 private:
  void add_bytes(std::uint64_t value, int count);

  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace argil::sculpt
