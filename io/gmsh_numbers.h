#pragma once
// The numbers of a Gmsh file, whether they stand there as text or as bytes.

#include <cstdint>
#include <string>
#include <string_view>

#include "io/text_cursor.h"

namespace argil::io {

class GmshNumbers {
 public:
  explicit GmshNumbers(TextCursor& cursor) : cursor_(cursor) {}

  void set_binary(bool big_endian) {
    binary_ = true;
    big_endian_ = big_endian;
  }
  bool binary() const { return binary_; }

  /// In binary 4 bytes.
  std::int64_t integer(std::string_view expected, std::int64_t least, std::int64_t most);
  /// In binary 8 bytes, unsigned.
  std::int64_t long_integer(std::string_view expected, std::int64_t least, std::int64_t most);
  double real(std::string_view expected);
  /// A long integer that counts items of so many bytes each in binary, and so many words each in text.
  std::size_t count(std::string_view expected, std::size_t bytes_each, std::size_t words_each);
  /// A count that is text in either encoding (version 2.2), with the end of its line.
  std::size_t text_count(std::string_view expected, std::size_t bytes_each, std::size_t words_each);
  /// Takes the end of the line behind which bytes begin.
  void begin_block() {
    if (binary_) cursor_.end_of_line();
  }
  /// @throws Error at the number last taken.
  [[noreturn]] void fail(const std::string& message, ErrorCode code = ErrorCode::bad_input) const;

 private:
  std::uint64_t bits(std::size_t bytes, std::string_view expected);
  std::int64_t checked(std::int64_t value, std::string_view expected, std::int64_t least, std::int64_t most) const;

  TextCursor& cursor_;
  std::size_t at_ = 0;
  bool binary_ = false, big_endian_ = false, last_binary_ = false;
};

}  // namespace argil::io
