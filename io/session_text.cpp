#include "io/session_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "subdiv/error.h"

namespace argil::io {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (static_cast<unsigned char>(c) >= 0x80U);
}

/// Bytes of the UTF-8 character that starts at text[i]; 0 if it is overlong, a surrogate, out of range or cut off.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
  };
  const auto continues = [&](std::size_t k) { return (byte(k) & 0xc0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return continues(1) ? 2 : 0;
  if (first >= 0xe0 && first <= 0xef) {
    if (!continues(1) || !continues(2)) return 0;
    const bool overlong = first == 0xe0 && byte(1) < 0xa0;
    const bool surrogate = first == 0xed && byte(1) >= 0xa0;
    return overlong || surrogate ? 0 : 3;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    if (!continues(1) || !continues(2) || !continues(3)) return 0;
    const bool overlong = first == 0xf0 && byte(1) < 0x90;
    const bool too_large = first == 0xf4 && byte(1) >= 0x90;
    return overlong || too_large ? 0 : 4;
  }
  return 0;
}

/// 1 + the characters (not continuation bytes) before `offset`.
int column_of(std::string_view text, std::size_t offset) {
  int column = 1;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0U) != 0x80U) ++column;
  return column;
}

class Lexer {
 public:
  Lexer(std::string_view text, const std::string& file, int line) : text_(text), file_(file), line_(line) {}

  /// Arguments; after the word `where`, an expression. Sets `end` to where the comment or the text ends.
  std::vector<Token> arguments() {
    std::vector<Token> tokens;
    while (skip_blanks()) {
      tokens.push_back(text_[at_] == '"' ? string() : piece());
      const Token& last = tokens.back();
      if (last.kind == TokenKind::word && last.text == "where") {
        for (Token& token : expression(at_, false)) tokens.push_back(std::move(token));
        break;
      }
    }
    return tokens;
  }

  /// An expression from `offset`, to the end or before the word `where`.
  std::vector<Token> expression(std::size_t offset, bool stop_at_where) {
    at_ = offset;
    std::vector<Token> tokens;
    while (skip_blanks()) {
      const std::size_t start = at_;
      Token token = operand_or_symbol();
      if (stop_at_where && token.kind == TokenKind::word && token.text == "where") {
        at_ = start;
        break;
      }
      tokens.push_back(std::move(token));
    }
    return tokens;
  }

  std::size_t end() const { return at_; }

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    throw Error(ErrorCode::bad_input, message, fmt::format("{}:{}:{}", file_, line_, column_at(offset)));
  }

  /// Refuses what is not UTF-8 and control characters other than tab.
  void check_characters() const {
    for (std::size_t i = 0; i < text_.size();) {
      const auto byte = static_cast<unsigned char>(text_[i]);
      if ((byte < 0x20 && byte != '\t') || byte == 0x7f)
        fail(i, fmt::format("expected text, found the control character 0x{:02x}; remove it", byte));
      const std::size_t length = utf8_length(text_, i);
      if (length == 0) fail(i, fmt::format("expected UTF-8, found byte 0x{:02x}; save the file as UTF-8", byte));
      i += length;
    }
  }

 private:
  bool skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_ < text_.size() && text_[at_] != '#';
  }

  // Tokens are met from left to right, so counting goes on from the last place asked for.
  int column_at(std::size_t offset) const {
    if (offset < counted_) return column_of(text_, offset);
    column_ += column_of(text_.substr(counted_), offset - counted_) - 1;
    counted_ = offset;
    return column_;
  }

  Token token(TokenKind kind, std::size_t start, std::string text, double number = 0) const {
    return {kind, std::move(text), number, line_, column_at(start), start};
  }

  Token string() {
    const std::size_t start = at_++;
    std::string value;
    for (;; ++at_) {
      if (at_ >= text_.size()) fail(start, "expected a closing \" on this line, found its end; close the string");
      char c = text_[at_];
      if (c == '"') break;
      if (c == '\\') {
        c = ++at_ < text_.size() ? text_[at_] : '\0';
        if (c != '"' && c != '\\')
          fail(at_ - 1, "expected \\\" or \\\\ after a backslash in a string; write \\\\ for one backslash");
      }
      value += c;
    }
    ++at_;
    if (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '#')
      fail(at_, "expected a blank after a string; put one between arguments");
    return token(TokenKind::string, start, std::move(value));
  }

  /// What stands between blanks: a number if all of it reads as one, else a word.
  Token piece() {
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '#') {
      if (text_[at_] == '"')
        fail(at_, "expected a blank before a string; put one, or write the whole name in quotes");
      ++at_;
    }
    const std::string_view text = text_.substr(start, at_ - start);
    double number = 0;
    if (whole_number(text, start, number)) return token(TokenKind::number, start, std::string(text), number);
    return token(TokenKind::word, start, std::string(text));
  }

  /// Reads [sign] decimal from the front of `text` and takes it off; false if there is none.
  bool take_decimal(std::string_view& text, std::size_t start, bool sign_allowed, double& number) const {
    const std::string_view whole = text;
    std::size_t i = 0;
    bool negative = false;
    if (sign_allowed && !text.empty() && (text[0] == '-' || text[0] == '+')) negative = text[i++] == '-';
    const bool starts =
        i < text.size() && (is_digit(text[i]) || (text[i] == '.' && i + 1 < text.size() && is_digit(text[i + 1])));
    if (!starts) return false;
    const char* const first = text.data() + i;
    const auto [last, status] = std::from_chars(first, text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(last - text.data()));
    if (status == std::errc::result_out_of_range)
      fail(start, fmt::format("expected a number between 5e-324 and 1.8e308 in size, found {}",
                              whole.substr(0, whole.size() - text.size())));
    if (negative) number = -number;
    return true;
  }

  bool whole_number(std::string_view text, std::size_t start, double& number) const {
    const std::string_view whole = text;
    if (!take_decimal(text, start, true, number)) return false;
    if (!text.empty() && text[0] == '/') {
      text.remove_prefix(1);
      double divisor = 0;
      if (!take_decimal(text, start, true, divisor)) return false;
      if (!text.empty() && text != "%") return false;
      if (divisor == 0) fail(start, fmt::format("expected a fraction of finite value, found {}", whole));
      number /= divisor;
    }
    if (text == "%") {
      text.remove_prefix(1);
      number /= 100;
    }
    if (!text.empty()) return false;
    if (!std::isfinite(number)) fail(start, fmt::format("expected a finite number, found {}", whole));
    return true;
  }

  Token operand_or_symbol() {
    const std::size_t start = at_;
    const char c = text_[start];
    if (c == '"') return string();
    if (is_letter(c)) {
      while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
      return token(TokenKind::word, start, std::string(text_.substr(start, at_ - start)));
    }
    std::string_view rest = text_.substr(start);
    double number = 0;
    if (take_decimal(rest, start, false, number)) {
      if (!rest.empty() && rest[0] == '%') {
        rest.remove_prefix(1);
        number /= 100;
      }
      at_ = text_.size() - rest.size();
      if (!rest.empty() && (is_letter(rest[0]) || is_digit(rest[0]) || rest[0] == '.'))
        fail(at_, fmt::format("expected an operator after the number {}; to multiply, write *",
                              text_.substr(start, at_ - start)));
      return token(TokenKind::number, start, std::string(text_.substr(start, at_ - start)), number);
    }
    const std::string_view two = rest.substr(0, 2);
    if (two == "<=" || two == ">=" || two == "!=") {
      at_ += 2;
      return token(TokenKind::symbol, start, std::string(two));
    }
    if (two == "==") fail(start, "expected one of < <= > >= = !=, found ==; write = to compare");
    if (two == "&&" || two == "||") fail(start, fmt::format("found {}; write `and` or `or`", two));
    if (std::string_view("<>=+-*/^(),").find(c) == std::string_view::npos)
      fail(start, fmt::format("expected a number, a name or one of < <= > >= = != + - * / ^ ( ) , found '{}'", c));
    ++at_;
    return token(TokenKind::symbol, start, std::string(1, c));
  }

  std::string_view text_;
  const std::string& file_;
  int line_;
  std::size_t at_ = 0;
  mutable std::size_t counted_ = 0;
  mutable int column_ = 1;
};

void check_version(const SessionLine& line) {
  const auto& tokens = line.tokens;
  const bool named = !tokens.empty() && tokens[0].kind == TokenKind::word && tokens[0].text == "argil";
  if (!named || tokens.size() != 2 || tokens[1].kind != TokenKind::number)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected `{}` as the first line of a session, found `{}`; put `{}` at the top",
                            k_session_header, line.text.substr(0, 60), k_session_header),
                place_of(line, tokens.at(0)));
  if (tokens[1].number != 1)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected version 1 of the session language, found {}; use a newer argil to replay it",
                            tokens[1].text),
                place_of(line, tokens[1]));
}

}  // namespace

SessionLine parse_session_line(std::string_view text, const std::string& file_name, int line_number) {
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  Lexer lexer(text, file_name, line_number);
  if (text.size() > k_max_session_line)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("expected a line of at most {} bytes, found {}; split the command", k_max_session_line,
                            text.size()),
                fmt::format("{}:{}:1", file_name, line_number));
  lexer.check_characters();
  SessionLine line;
  line.file = file_name;
  line.number = line_number;
  line.tokens = lexer.arguments();
  line.text = std::string(text.substr(0, lexer.end()));
  while (!line.text.empty() && is_blank(line.text.back())) line.text.pop_back();
  return line;
}

std::vector<SessionLine> parse_session(std::string_view text, const std::string& file_name) {
  if (text.size() > k_max_session_file)
    throw Error(
        ErrorCode::limit_exceeded,
        fmt::format("expected a session of at most {} bytes, found {}; split it", k_max_session_file, text.size()),
        file_name);
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);  // byte order mark
  std::vector<SessionLine> lines;
  std::size_t token_count = 0;
  bool versioned = false;
  int number = 1;
  for (std::size_t start = 0; start < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    SessionLine line = parse_session_line(text.substr(start, end - start), file_name, number);
    start = end + 1;
    if (line.tokens.empty()) continue;
    token_count += line.tokens.size();
    if (token_count > k_max_session_tokens)
      throw Error(ErrorCode::limit_exceeded,
                  fmt::format("expected a session of at most {} words, found more; split it", k_max_session_tokens),
                  place_of(line, line.tokens[0]));
    if (versioned) {
      lines.push_back(std::move(line));
      continue;
    }
    check_version(line);
    versioned = true;
  }
  if (!versioned)
    throw Error(ErrorCode::bad_input,
                fmt::format("expected `{}` as the first line of a session, found no command", k_session_header),
                file_name + ":1:1");
  return lines;
}

std::vector<SessionLine> read_session(const std::filesystem::path& path) {
  std::error_code failed;
  const bool regular = std::filesystem::is_regular_file(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (!regular || !file)
    throw Error(ErrorCode::not_found, "expected a session file that can be read, found none; check the path",
                path.string());
  // One byte more than allowed, so that a file which grows while it is read is refused too.
  std::string text(std::min<std::uintmax_t>(std::filesystem::file_size(path), k_max_session_file + 1), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_session(text, path.string());
}

std::vector<Token> expression_tokens(const SessionLine& line, std::size_t first) {
  if (first >= line.tokens.size()) return {};
  return Lexer(line.text, line.file, line.number).expression(line.tokens[first].offset, true);
}

std::string place_of(const SessionLine& line, const Token& token) {
  return fmt::format("{}:{}:{}", line.file, token.line, token.column);
}

std::string place_of_end(const SessionLine& line) {
  return fmt::format("{}:{}:{}", line.file, line.number, column_of(line.text, line.text.size()));
}

std::string quote(const std::string& text) {
  static const std::string place = "name";
  Lexer(text, place, 1).check_characters();
  bool plain = !text.empty() && text.find_first_of(" \t#\"") == std::string::npos && text != "where";
  if (plain) {
    try {
      plain = Lexer(text, place, 1).arguments().at(0).kind == TokenKind::word;
    } catch (const Error&) {
      plain = false;  // looks like a number that is out of range
    }
  }
  if (plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string format_number(double number) {
  if (!std::isfinite(number))
    throw Error(ErrorCode::bad_input, fmt::format("expected a finite number, found {}", number));
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  return {buffer, end};
}

std::string format_line(std::span<const Token> tokens) {
  std::string line;
  for (const Token& token : tokens) {
    if (!line.empty()) line += ' ';
    switch (token.kind) {
      case TokenKind::number:
        line += format_number(token.number);
        break;
      case TokenKind::string: {
        const std::string text = quote(token.text);
        line += text.front() == '"' ? text : '"' + text + '"';
        break;
      }
      default:
        line += token.text;
    }
  }
  return line;
}

}  // namespace argil::io
