#pragma once
// A strict reader of words and numbers in a text that knows where it is: every complaint carries file:line:column.
// Numbers are independent of the locale, must fill their word, and must be finite and in range.

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "subdiv/error.h"

namespace argil::io {

class TextCursor {
 public:
  /// Reads text[begin, end); `comment`, if not 0, starts a comment that ends with its line. Both views must outlive
  /// the cursor; positions count from the start of `text`.
  TextCursor(std::string_view text, std::string_view file, char comment = 0);
  TextCursor(std::string_view text, std::string_view file, std::size_t begin, std::size_t end);

  /// Skips blanks; true if nothing is left.
  [[nodiscard]] bool at_end();
  /// Next word without taking it; empty at the end.
  [[nodiscard]] std::string_view peek();
  /// Takes a word. `expected` is for the message if there is none.
  std::string_view word(std::string_view expected);
  /// Takes a word that must be `keyword`.
  void keyword(std::string_view keyword);
  double number(std::string_view expected);
  std::int64_t integer(std::string_view expected, std::int64_t least, std::int64_t most);
  /// A number of items of which each needs at least `bytes_each` bytes of what is left, so that it can be trusted
  /// for an allocation.
  std::size_t count(std::string_view expected, std::size_t bytes_each);
  /// True if a word follows on this line.
  [[nodiscard]] bool more_on_line();
  /// Takes what is left of this line, without the line's end and surrounding blanks.
  std::string_view rest_of_line();
  /// Takes the end of the line, which must follow but for blanks: what comes next may be binary.
  void end_of_line();
  /// Takes `size` bytes as they are.
  std::string_view bytes(std::size_t size, std::string_view expected);
  /// Fails unless only blanks are left.
  void finish();

  std::size_t offset() const { return at_; }
  std::size_t remaining() const { return end_ - at_; }
  std::string_view file() const { return file_; }
  /// Where the word or number last taken starts.
  std::size_t word_offset() const { return word_at_; }
  /// "file:line:column" of a position; columns count bytes. Cost O(offset).
  std::string where(std::size_t offset) const;
  /// "file:line:column" of word `index` counted from `origin`. Cost O(offset).
  std::string where_word(std::size_t origin, std::size_t index) const;
  /// @throws Error (code) at the word last taken.
  [[noreturn]] void fail(const std::string& message, ErrorCode code = ErrorCode::bad_input) const;
  /// @throws Error (bad_input) "expected …, found …" at the word last taken.
  [[noreturn]] void mismatch(std::string_view expected) const;

 private:
  void skip_blanks();

  std::string_view text_, file_, word_;
  std::size_t at_ = 0, end_ = 0, word_at_ = 0;
  char comment_ = 0;
};

/// What a message may quote of a file: short, and free of control characters.
[[nodiscard]] std::string in_quotes(std::string_view word);
/// Appends the shortest decimal that reads back as the same double.
void append_number(std::string& text, double value);
/// Appends a formatted line with its end.
template <class... Args>
void append_line(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  text += '\n';
}

}  // namespace argil::io
