#include "io/abaqus_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace argil::io {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

std::string in_capitals(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = (c >= 'a' && c <= 'z') ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

// The next line that is neither empty nor a comment, without blanks around it, as [line_, end_).
bool AbaqusLines::take_line() {
  while (at_ < text_.size()) {
    std::size_t stop = text_.find('\n', at_);
    if (stop == std::string_view::npos) stop = text_.size();
    line_ = at_;
    end_ = stop;
    at_ = std::min(stop + 1, text_.size());
    while (line_ < end_ && is_blank(text_[line_])) ++line_;
    while (end_ > line_ && is_blank(text_[end_ - 1])) --end_;
    if (line_ < end_ && !text_.substr(line_, end_ - line_).starts_with("**")) return true;
  }
  line_ = end_ = text_.size();
  return false;
}

void AbaqusLines::split() {
  comma_ = text_[end_ - 1] == ',';
  for (std::size_t begin = line_; begin < end_;) {
    const std::size_t stop = std::min(text_.find(',', begin), end_);
    std::size_t first = begin, last = stop;
    while (first < last && is_blank(text_[first])) ++first;
    while (last > first && is_blank(text_[last - 1])) --last;
    fields_.push_back({text_.substr(first, last - first), first});
    begin = stop + 1;
  }
}

void AbaqusLines::read_keyword() {
  // A comma at the end goes on with the next line.
  const std::size_t first_line = line_;
  while (comma_ && take_line()) {
    if (text_[line_] == '*')
      fail(line_, "expected more parameters, since the line before ends with a comma, found a keyword");
    split();
  }
  line_ = first_line;
  name_ = in_capitals(fields_[0].text.substr(1));
  for (std::size_t i = 1; i < fields_.size(); ++i) {
    const std::string_view text = fields_[i].text;
    const std::size_t equals = std::min(text.find('='), text.size());
    std::size_t name_end = equals, value = std::min(equals + 1, text.size());
    while (name_end > 0 && is_blank(text[name_end - 1])) --name_end;
    while (value < text.size() && is_blank(text[value])) ++value;
    parameters_.push_back({in_capitals(text.substr(0, name_end)), {text.substr(value), fields_[i].offset + value}});
  }
}

bool AbaqusLines::next() {
  fields_.clear();
  parameters_.clear();
  name_.clear();
  keyword_ = false;
  if (!take_line()) return false;
  split();
  keyword_ = text_[line_] == '*';
  if (keyword_) read_keyword();
  return true;
}

const AbaqusField* AbaqusLines::parameter(std::string_view name) const {
  for (const Parameter& parameter : parameters_)
    if (parameter.name == name) return &parameter.value;
  return nullptr;
}

std::int64_t AbaqusLines::integer(const AbaqusField& field, std::string_view expected) const {
  const std::string_view digits = without_plus(field.text);
  std::int64_t value = 0;
  const auto [stop, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault != std::errc{} || stop != digits.data() + digits.size() || value < 1 || value >= std::int64_t{1} << 62)
    fail(field.offset, fmt::format("expected {}, found {}", expected, in_quotes(field.text)));
  return value;
}

double AbaqusLines::number(const AbaqusField& field, std::string_view expected) const {
  if (field.text.empty()) return 0;
  std::string digits(without_plus(field.text));
  for (char& c : digits)
    if (c == 'd' || c == 'D') c = 'e';  // of a Fortran double
  double value = 0;
  const auto [stop, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault != std::errc{} || stop != digits.data() + digits.size() || !std::isfinite(value))
    fail(field.offset, fmt::format("expected {} that is finite, found {}", expected, in_quotes(field.text)));
  return value;
}

}  // namespace argil::io
