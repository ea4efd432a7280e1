#include "io/text_cursor.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace argil::io {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

// from_chars refuses a leading plus, which other writers print.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

TextCursor::TextCursor(std::string_view text, std::string_view file, char comment)
    : text_(text), file_(file), end_(text.size()), comment_(comment) {}

TextCursor::TextCursor(std::string_view text, std::string_view file, std::size_t begin, std::size_t end)
    : text_(text), file_(file), at_(begin), end_(end), word_at_(begin) {}

void TextCursor::skip_blanks() {
  while (at_ < end_) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (comment_ != 0 && text_[at_] == comment_) {
      while (at_ < end_ && text_[at_] != '\n') ++at_;
    } else {
      return;
    }
  }
}

bool TextCursor::at_end() {
  skip_blanks();
  return at_ == end_;
}

std::string_view TextCursor::peek() {
  skip_blanks();
  std::size_t stop = at_;
  while (stop < end_ && !is_blank(text_[stop]) && (comment_ == 0 || text_[stop] != comment_)) ++stop;
  return text_.substr(at_, stop - at_);
}

std::string_view TextCursor::word(std::string_view expected) {
  word_ = peek();
  word_at_ = at_;
  if (word_.empty()) mismatch(expected);
  at_ += word_.size();
  return word_;
}

void TextCursor::keyword(std::string_view keyword) {
  if (word(keyword) != keyword) mismatch(keyword);
}

double TextCursor::number(std::string_view expected) {
  const std::string_view digits = without_plus(word(expected));
  double value = 0;
  const auto [stop, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault == std::errc::result_out_of_range)
    fail(fmt::format("{} is outside the range of a double", in_quotes(word_)));
  if (fault != std::errc{} || stop != digits.data() + digits.size()) mismatch(expected);
  if (!std::isfinite(value)) fail(fmt::format("expected {} that is finite, found {}", expected, in_quotes(word_)));
  return value;
}

std::int64_t TextCursor::integer(std::string_view expected, std::int64_t least, std::int64_t most) {
  const std::string_view digits = without_plus(word(expected));
  std::int64_t value = 0;
  const auto [stop, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = stop == digits.data() + digits.size();
  if ((fault != std::errc{} && fault != std::errc::result_out_of_range) || !whole) mismatch(expected);
  if (fault != std::errc{} || value < least || value > most) {
    fail(fmt::format("expected {} from {} to {}, found {}", expected, least, most, in_quotes(word_)));
  }
  return value;
}

std::size_t TextCursor::count(std::string_view expected, std::size_t bytes_each) {
  const auto value = static_cast<std::size_t>(integer(expected, 0, INT64_MAX));
  // The last item needs no blank after it.
  if (value > (remaining() + 1) / bytes_each) {
    fail(fmt::format("expected {} that the {} bytes left in the file can hold, found {}; was it cut short?",
                     expected, remaining(), value));
  }
  return value;
}

bool TextCursor::more_on_line() {
  while (at_ < end_ && is_blank(text_[at_]) && text_[at_] != '\n') ++at_;
  return at_ < end_ && text_[at_] != '\n';
}

std::string_view TextCursor::rest_of_line() {
  std::size_t stop = text_.substr(0, end_).find('\n', at_);
  if (stop == std::string_view::npos) stop = end_;
  std::size_t begin = at_, last = stop;
  while (begin < last && is_blank(text_[begin])) ++begin;
  while (last > begin && is_blank(text_[last - 1])) --last;
  word_at_ = begin;
  word_ = text_.substr(begin, last - begin);
  at_ = stop == end_ ? end_ : stop + 1;
  return word_;
}

void TextCursor::end_of_line() {
  if (!rest_of_line().empty()) mismatch("the end of the line");
}

std::string_view TextCursor::bytes(std::size_t size, std::string_view expected) {
  if (size > remaining()) {
    throw Error(ErrorCode::bad_input,
                fmt::format("expected {} bytes of {}, found {} to the end of the file; was it cut short?", size,
                            expected, remaining()),
                fmt::format("{}: byte {}", file_, at_));
  }
  const std::string_view taken = text_.substr(at_, size);
  at_ += size;
  return taken;
}

void TextCursor::finish() {
  if (at_end()) return;
  word("nothing");
  mismatch("nothing more");
}

std::string TextCursor::where(std::size_t offset) const {
  std::size_t line = 1, start = 0;
  for (std::size_t i = 0; i < offset && i < text_.size(); ++i) {
    if (text_[i] == '\n') {
      ++line;
      start = i + 1;
    }
  }
  return fmt::format("{}:{}:{}", file_, line, offset - start + 1);
}

std::string TextCursor::where_word(std::size_t origin, std::size_t index) const {
  TextCursor again = *this;
  again.at_ = origin;
  for (std::size_t i = 0; i <= index && !again.at_end(); ++i) again.word("a number");
  return where(again.word_at_);
}

void TextCursor::fail(const std::string& message, ErrorCode code) const {
  throw Error(code, message, where(word_at_));
}

void TextCursor::mismatch(std::string_view expected) const {
  if (word_.empty()) fail(fmt::format("expected {}, found the end; was the file cut short?", expected));
  fail(fmt::format("expected {}, found {}", expected, in_quotes(word_)));
}

std::string in_quotes(std::string_view word) {
  std::string out = "\"";
  for (const char c : word.substr(0, 40)) out += (c >= ' ' && c <= '~') ? c : '?';
  return out + (word.size() > 40 ? "…\"" : "\"");
}

void append_number(std::string& text, double value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

}  // namespace argil::io
