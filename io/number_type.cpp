#include "io/number_type.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

namespace argil::io {
namespace {

constexpr std::int64_t k_exact = std::int64_t{1} << 53;

std::int64_t sign_extended(std::uint64_t bits, std::size_t bytes) {
  const auto unused = static_cast<unsigned>(64 - 8 * bytes);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

}  // namespace

std::uint64_t decode_unsigned(const char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t from = big_endian ? i : size - 1 - i;
    bits = (bits << 8U) | static_cast<unsigned char>(bytes[from]);
  }
  return bits;
}

std::vector<std::int64_t> decode_integers(std::string_view bytes, NumberType type, bool big_endian,
                                          const NumberFault& fault) {
  if (type.kind == NumberType::Kind::floating)
    fault(0, "expected numbers of an integer type, found a floating one");
  std::vector<std::int64_t> values(bytes.size() / type.bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t bits = decode_unsigned(bytes.data() + i * type.bytes, type.bytes, big_endian);
    if (type.kind == NumberType::Kind::signed_integer) {
      values[i] = sign_extended(bits, type.bytes);
    } else if (bits > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
      fault(i, fmt::format("expected an integer below 2^63, found {}", bits));
    } else {
      values[i] = static_cast<std::int64_t>(bits);
    }
  }
  return values;
}

std::vector<double> decode_doubles(std::string_view bytes, NumberType type, bool big_endian,
                                   const NumberFault& fault) {
  std::vector<double> values(bytes.size() / type.bytes);
  if (type.kind != NumberType::Kind::floating) {
    const auto integers = decode_integers(bytes, type, big_endian, fault);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (integers[i] > k_exact || integers[i] < -k_exact) {
        fault(i, fmt::format("{} has more digits than a double holds", integers[i]));
      }
      values[i] = static_cast<double>(integers[i]);
    }
    return values;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t bits = decode_unsigned(bytes.data() + i * type.bytes, type.bytes, big_endian);
    values[i] = type.bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                                : std::bit_cast<double>(bits);
    if (!std::isfinite(values[i])) fault(i, fmt::format("expected a finite number, found {}", values[i]));
  }
  return values;
}

}  // namespace argil::io
