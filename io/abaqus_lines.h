#pragma once
// The lines of an Abaqus input file: keyword lines with their parameters, data lines with their fields.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_cursor.h"

namespace argil::io {

struct AbaqusField {
  std::string_view text;  // without blanks around it
  std::size_t offset = 0;
};

class AbaqusLines {
 public:
  AbaqusLines(std::string_view text, std::string_view name) : text_(text), places_(text, name) {}

  /// Goes on to the next line that is neither empty nor a comment; false at the end.
  bool next();
  bool is_keyword() const { return keyword_; }
  /// Of a data line. An empty last field, behind a comma, is left out.
  const std::vector<AbaqusField>& fields() const { return fields_; }
  /// Whether a comma ends the line.
  bool ends_with_comma() const { return comma_; }

  /// Of a keyword line: its name in capitals without the asterisk, and the value of a parameter (by its name in
  /// capitals): absent, or empty where it has none.
  const std::string& keyword() const { return name_; }
  const AbaqusField* parameter(std::string_view name) const;

  std::int64_t integer(const AbaqusField& field, std::string_view expected) const;
  double number(const AbaqusField& field, std::string_view expected) const;

  std::size_t offset() const { return line_; }
  [[noreturn]] void fail(std::size_t offset, const std::string& message,
                         ErrorCode code = ErrorCode::bad_input) const {
    throw Error(code, message, places_.where(offset));
  }

 private:
  struct Parameter {
    std::string name;
    AbaqusField value;
  };
  bool take_line();
  void split();
  void read_keyword();

  std::string_view text_;
  TextCursor places_;
  std::vector<AbaqusField> fields_;
  std::vector<Parameter> parameters_;
  std::string name_;
  std::size_t at_ = 0, line_ = 0, end_ = 0;
  bool keyword_ = false, comma_ = false;
};

/// ASCII letters as capitals.
[[nodiscard]] std::string in_capitals(std::string_view word);

}  // namespace argil::io
