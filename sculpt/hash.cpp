#include "sculpt/hash.h"

#include <bit>

namespace argil::sculpt {

namespace {

std::uint64_t canonical_bits(double value) {
  if (value == 0) return 0;
  if (value != value) return 0x7ff8000000000000ULL;
  return std::bit_cast<std::uint64_t>(value);
}

}  // namespace

void Hash::add_bytes(std::uint64_t value, int count) {
  std::uint64_t state = state_;
  for (int byte = 0; byte < count; ++byte) {
    state ^= (value >> (8 * byte)) & 0xffU;
    state *= 0x100000001b3ULL;
  }
  state_ = state;
}

Hash& Hash::add(std::uint64_t value) {
  add_bytes(value, 8);
  return *this;
}

Hash& Hash::add(double value) {
  return add(canonical_bits(value));
}

Hash& Hash::add(std::string_view text) {
  add(std::uint64_t{text.size()});
  for (const char c : text) add_bytes(static_cast<unsigned char>(c), 1);
  return *this;
}

Hash& Hash::add(std::span<const double> values) {
  add(std::uint64_t{values.size()});
  for (const double value : values) add(value);
  return *this;
}

Hash& Hash::add(std::span<const std::uint32_t> values) {
  add(std::uint64_t{values.size()});
  for (const std::uint32_t value : values) add_bytes(value, 4);
  return *this;
}

Hash& Hash::add(std::span<const std::uint8_t> values) {
  add(std::uint64_t{values.size()});
  for (const std::uint8_t value : values) add_bytes(value, 1);
  return *this;
}

}  // namespace argil::sculpt
