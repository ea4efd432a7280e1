#pragma once
// Expressions of a session (SESSION.md, "Grammar"): the condition after `where`, and formulas such as 300 + 10*x.
// Text is parsed once into a flat program for a stack, with names resolved to slots; evaluating touches no text and
// allocates nothing.
//
//   or < and < not < comparison (one, not chained) < + - < * / < unary - < ^ (from the right) < call, ( ), name,
//   number functions: abs sqrt sin cos (of degrees, exact at multiples of 90), min max (of two or more)

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/session_text.h"

namespace argil::sculpt {

/// The names that an expression may use; the value of names[i] is handed to `evaluate` in slot i.
struct VariableTable {
  std::vector<std::string> names;
  std::vector<std::uint8_t> boolean;  // 1 = true or false, as `boundary`; may be shorter: the rest are numbers
};

class Expression {
 public:
  /// @throws Error (bad_input) with the place, for anything that is not one expression, mixes numbers and
  /// conditions, chains comparisons, nests deeper than 200, or uses an unknown name (the message lists near ones
  /// and all). `tokens` as after `where` or from io::expression_tokens; `line` gives the places.
  static Expression parse(std::span<const io::Token> tokens, const io::SessionLine& line,
                          const VariableTable& variables);

  /// values[slot] for at least the slots in variables(); booleans are 0 or 1. Comparisons with NaN are false, and a
  /// numeric result may be infinite or NaN (1/0): the caller must refuse it where it matters.
  [[nodiscard]] double evaluate(std::span<const double> values) const;
  [[nodiscard]] bool holds(std::span<const double> values) const { return evaluate(values) != 0; }

  /// A condition, rather than a number.
  bool is_boolean() const { return is_boolean_; }

  /// Slots that the expression reads, ascending: the others need not be computed.
  const std::vector<std::size_t>& variables() const { return variables_; }

 private:
  friend class ExpressionParser;

  enum class Operation : std::uint8_t {
    number,
    variable,
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    absolute,
    square_root,
    sine,
    cosine,
    smaller,
    larger,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    both,
    either,
    opposite
  };
  struct Instruction {
    Operation operation;
    std::uint32_t slot;  // of a variable
    double number;       // of a number
  };

  std::vector<Instruction> program_;
  std::vector<std::size_t> variables_;
  bool is_boolean_ = false;
};

/// The condition after the word `where` in a line. @throws as Expression::parse, and if there is no `where` or it
/// is followed by a number instead of a condition.
[[nodiscard]] Expression parse_where(const io::SessionLine& line, const VariableTable& variables);

}  // namespace argil::sculpt
