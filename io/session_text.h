#pragma once
// The text of a session (SESSION.md, "Grammar"), split into lines of tokens with positions. It knows no command:
// the command table gives tokens their types. Numbers never depend on the locale, text must be UTF-8, and every
// fault is an Error (bad_input) whose place is "file:line:column".

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argil::io {

inline constexpr std::size_t k_max_session_line = 4UL * 1024 * 1024;    // bytes; half an hour of a stroke
inline constexpr std::size_t k_max_session_file = 64UL * 1024 * 1024;   // bytes
inline constexpr std::size_t k_max_session_tokens = 2UL * 1000 * 1000;  // 64 bytes each
inline constexpr std::string_view k_session_header = "argil 1";         // first line of every session

enum class TokenKind { word, string, number, symbol };

struct Token {
  TokenKind kind = TokenKind::word;
  std::string text;        // word and symbol as written, number as written, string without quotes and escapes
  double number = 0;       // of a number: "1/60" and "1%" are already worked out
  int line = 0;            // from 1
  int column = 0;          // from 1, in characters, not bytes
  std::size_t offset = 0;  // of its first byte in the line
};

/// One line that holds a command. After the word `where` the tokens are those of an expression.
struct SessionLine {
  std::string file;  // as named to parse_session
  int number = 0;    // from 1
  std::string text;  // without comment and line end
  std::vector<Token> tokens;
};

/// All commands of a session, the version line left out.
/// @throws Error (bad_input) at the first fault, also where the first line is not `argil 1`; (limit_exceeded)
/// beyond the sizes above. Cost O(bytes).
[[nodiscard]] std::vector<SessionLine> parse_session(std::string_view text, const std::string& file_name);

/// The same, from disk. @throws also Error (not_found) if the file cannot be read.
[[nodiscard]] std::vector<SessionLine> read_session(const std::filesystem::path& path);

/// One line, as typed into the window: no version is expected; no tokens if it is blank or a comment.
[[nodiscard]] SessionLine parse_session_line(std::string_view text, const std::string& file_name, int line_number);

/// Reads the text from token `first` to the word `where` or the end of the line again, as an expression: numbers,
/// names and the symbols < <= > >= = != + - * / ^ ( ) and comma, so that `a/b` divides. For arguments that are
/// formulas, as in `set density 300 + 10*x where z < 0`.
[[nodiscard]] std::vector<Token> expression_tokens(const SessionLine& line, std::size_t first);

/// "file:line:column" of a token, and of the end of the line.
[[nodiscard]] std::string place_of(const SessionLine& line, const Token& token);
[[nodiscard]] std::string place_of_end(const SessionLine& line);

/// The text as an argument: unchanged where it reads back as a word, else in quotes.
/// @throws Error (bad_input) for control characters and text that is not UTF-8, which a session cannot hold.
[[nodiscard]] std::string quote(const std::string& text);

/// The shortest decimal that reads back as the same bits. @throws Error (bad_input) if not finite.
[[nodiscard]] std::string format_number(double number);

/// Tokens as a line that parses to the same kinds, texts and numbers (numbers are written by format_number).
[[nodiscard]] std::string format_line(std::span<const Token> tokens);

}  // namespace argil::io
