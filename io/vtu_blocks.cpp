#include "io/vtu_blocks.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "io/number_type.h"

namespace argil::io {
namespace {

using Fault = std::function<void(const std::string&)>;

constexpr std::array<std::int8_t, 256> base64_values() {
  std::array<std::int8_t, 256> values{};
  for (auto& value : values) value = -1;
  constexpr std::string_view k_alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < k_alphabet.size(); ++i) {
    values[static_cast<unsigned char>(k_alphabet[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}
constexpr auto k_base64 = base64_values();

// Bytes out of raw or base64 text. A padded group ends a base64 stream; another may follow at a boundary of reads,
// which is how writers put a header before its data.
class Source {
 public:
  Source(std::string_view text, bool base64, const Fault& fault) : text_(text), base64_(base64), fault_(fault) {}

  /// At least as many bytes as could still be read.
  std::size_t bound() const {
    const std::size_t left = text_.size() - at_;
    return base64_ ? pending_.size() + left / 4 * 3 : left;
  }

  std::string read(std::size_t size) {
    if (size > bound()) {
      fault_(
          fmt::format("the array needs {} more bytes, found at most {}; was the file cut short?", size, bound()));
    }
    if (!base64_) {
      std::string bytes(text_.substr(at_, size));
      at_ += size;
      return bytes;
    }
    std::string bytes = std::move(pending_);
    pending_.clear();
    bytes.reserve(size + 2);
    bool padded = false;
    while (bytes.size() < size) {
      if (padded) fault_("base64 padding stands within an array");
      padded = read_group(bytes);
    }
    if (bytes.size() > size) {
      if (padded) fault_("the array holds more bytes than expected");
      pending_ = bytes.substr(size);
      bytes.resize(size);
    }
    return bytes;
  }

  std::size_t finish() {
    if (!pending_.empty()) fault_("the array holds more bytes than expected");
    return at_;
  }

 private:
  // Four characters to three bytes or, padded, fewer; true if padded.
  bool read_group(std::string& bytes) {
    std::uint32_t bits = 0;
    std::size_t digits = 0, padding = 0;
    while (digits + padding < 4) {
      if (at_ == text_.size()) fault_("base64 text ends within a group; was the file cut short?");
      const char c = text_[at_++];
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
      const int value = k_base64[static_cast<unsigned char>(c)];
      if (c == '=' && digits >= 2) {
        ++padding;
      } else if (value < 0 || padding > 0) {
        fault_(fmt::format("expected base64 text, found the character code {}", static_cast<unsigned char>(c)));
      } else {
        bits = bits << 6U | static_cast<std::uint32_t>(value);
        ++digits;
      }
    }
    bits <<= 6 * padding;
    for (std::size_t i = 0; i < 3 - padding; ++i) bytes += static_cast<char>(bits >> (16 - 8 * i) & 0xFFU);
    return padding > 0;
  }

  std::string_view text_;
  bool base64_;
  const Fault& fault_;
  std::size_t at_ = 0;
  std::string pending_;
};

std::string inflate_blocks(Source& source, const VtuEncoding& encoding, std::size_t size, const Fault& fault) {
  const auto word = [&](const std::string& bytes, std::size_t i) {
    return decode_unsigned(bytes.data() + i * encoding.header_bytes, encoding.header_bytes, encoding.big_endian);
  };
  const std::string first = source.read(3 * encoding.header_bytes);
  const std::uint64_t blocks = word(first, 0), block_size = word(first, 1), last_size = word(first, 2);
  if (blocks > source.bound() / encoding.header_bytes) fault(fmt::format("{} compressed blocks cannot be", blocks));
  if (blocks == 0) {
    if (size > 0) fault(fmt::format("expected {} bytes, found no compressed block", size));
    return {};
  }
  const std::uint64_t last = last_size == 0 ? block_size : last_size;
  // Checked without the product overflowing.
  const bool fits = blocks == 1 ? last == size
                                : block_size > 0 && last <= size && (size - last) / block_size == blocks - 1 &&
                                      (size - last) % block_size == 0;
  if (!fits) {
    fault(fmt::format("expected {} bytes, found {} blocks of {} and a last one of {}", size, blocks, block_size,
                      last));
  }
  const std::string sizes = source.read(blocks * encoding.header_bytes);
  std::uint64_t packed_total = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t packed = word(sizes, b);
    if (packed > source.bound() - packed_total)
      fault("the compressed blocks are longer than the file; was it cut short?");
    packed_total += packed;
  }
  if (size / k_deflate_growth > packed_total) {
    fault(fmt::format("{} bytes cannot be packed into {}", size, packed_total));
  }
  std::string bytes(size, '\0');
  std::size_t at = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::string packed = source.read(word(sizes, b));
    uLongf got = b + 1 == blocks ? last : block_size;
    const uLongf expected = got;
    uLong used = packed.size();
    const int status = uncompress2(reinterpret_cast<Bytef*>(bytes.data() + at), &got,
                                   reinterpret_cast<const Bytef*>(packed.data()), &used);
    if (status != Z_OK || got != expected || used != packed.size()) {
      fault(fmt::format("compressed block {} is damaged or not of {} bytes", b, expected));
    }
    at += expected;
  }
  return bytes;
}

}  // namespace

VtuBlock decode_vtu_block(std::string_view text, const VtuEncoding& encoding, std::size_t size,
                          const Fault& fault) {
  Source source(text, encoding.base64, fault);
  VtuBlock block;
  if (encoding.compressed) {
    block.bytes = inflate_blocks(source, encoding, size, fault);
  } else {
    const std::string header = source.read(encoding.header_bytes);
    const std::uint64_t found = decode_unsigned(header.data(), encoding.header_bytes, encoding.big_endian);
    if (found != size) fault(fmt::format("expected {} bytes, found an array of {}", size, found));
    block.bytes = source.read(size);
  }
  block.consumed = source.finish();
  return block;
}

}  // namespace argil::io
