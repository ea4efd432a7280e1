#pragma once
// The binary arrays of VTU files: base64 or raw, plain or as zlib-compressed blocks, each behind its header.

#include <functional>
#include <string>
#include <string_view>

namespace argil::io {

/// Deflate grows data at most so many times.
constexpr std::size_t k_deflate_growth = 1032;

struct VtuEncoding {
  bool base64 = false;
  bool compressed = false;
  bool big_endian = false;
  std::size_t header_bytes = 4;  // 4 or 8
};

struct VtuBlock {
  std::string bytes;
  std::size_t consumed = 0;  // of the text, from its start
};

/// Decodes the array of exactly `size` bytes that starts `text`. Nothing is allocated that the text could not fill.
/// `fault` is called with what is wrong and must throw.
[[nodiscard]] VtuBlock decode_vtu_block(std::string_view text, const VtuEncoding& encoding, std::size_t size,
                                        const std::function<void(const std::string&)>& fault);

}  // namespace argil::io
