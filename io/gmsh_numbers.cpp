#include "io/gmsh_numbers.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "io/number_type.h"

namespace argil::io {

std::uint64_t GmshNumbers::bits(std::size_t bytes, std::string_view expected) {
  at_ = cursor_.offset();
  last_binary_ = true;
  return decode_unsigned(cursor_.bytes(bytes, expected).data(), bytes, big_endian_);
}

std::int64_t GmshNumbers::checked(std::int64_t value, std::string_view expected, std::int64_t least,
                                  std::int64_t most) const {
  if (value < least || value > most)
    fail(fmt::format("expected {} from {} to {}, found {}", expected, least, most, value));
  return value;
}

std::int64_t GmshNumbers::integer(std::string_view expected, std::int64_t least, std::int64_t most) {
  last_binary_ = false;
  if (!binary_) return cursor_.integer(expected, least, most);
  return checked(static_cast<std::int32_t>(static_cast<std::uint32_t>(bits(4, expected))), expected, least, most);
}

std::int64_t GmshNumbers::long_integer(std::string_view expected, std::int64_t least, std::int64_t most) {
  last_binary_ = false;
  if (!binary_) return cursor_.integer(expected, least, most);
  return checked(static_cast<std::int64_t>(bits(8, expected)), expected, least, most);
}

double GmshNumbers::real(std::string_view expected) {
  last_binary_ = false;
  if (!binary_) return cursor_.number(expected);
  const auto value = std::bit_cast<double>(bits(8, expected));
  if (!std::isfinite(value)) fail(fmt::format("expected {} that is finite, found {}", expected, value));
  return value;
}

std::size_t GmshNumbers::count(std::string_view expected, std::size_t bytes_each, std::size_t words_each) {
  last_binary_ = false;
  if (!binary_) return cursor_.count(expected, 2 * words_each);
  const auto value = static_cast<std::size_t>(long_integer(expected, 0, std::numeric_limits<std::int64_t>::max()));
  if (value > cursor_.remaining() / bytes_each)
    fail(fmt::format("expected {} that the {} bytes left in the file can hold, found {}; was it cut short?",
                     expected, cursor_.remaining(), value));
  return value;
}

std::size_t GmshNumbers::text_count(std::string_view expected, std::size_t bytes_each, std::size_t words_each) {
  last_binary_ = false;
  const std::size_t value = cursor_.count(expected, binary_ ? bytes_each : 2 * words_each);
  if (binary_) cursor_.end_of_line();
  return value;
}

void GmshNumbers::fail(const std::string& message, ErrorCode code) const {
  if (!last_binary_) cursor_.fail(message, code);
  throw Error(code, message, fmt::format("{}: byte {}", cursor_.file(), at_));
}

}  // namespace argil::io
