#pragma once
// Numbers as the binary parts of files hold them, and their way into doubles and 64-bit integers without loss.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace argil::io {

struct NumberType {
  enum class Kind : std::uint8_t { signed_integer, unsigned_integer, floating } kind = Kind::floating;
  std::size_t bytes = 8;
};

/// Called with the index of the number at fault; must throw.
using NumberFault = std::function<void(std::size_t index, const std::string& message)>;

/// `bytes` holds whole numbers of `type`. Non-finite values, and integers that a double cannot hold, are faults.
[[nodiscard]] std::vector<double> decode_doubles(std::string_view bytes, NumberType type, bool big_endian,
                                                 const NumberFault& fault);
/// The same as integers; numbers beyond 63 bits, and floating types, are faults.
[[nodiscard]] std::vector<std::int64_t> decode_integers(std::string_view bytes, NumberType type, bool big_endian,
                                                        const NumberFault& fault);
/// One unsigned integer of 4 or 8 bytes.
[[nodiscard]] std::uint64_t decode_unsigned(const char* bytes, std::size_t size, bool big_endian);

}  // namespace argil::io
