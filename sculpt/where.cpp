#include "sculpt/where.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "sculpt/near_names.h"
#include "subdiv/error.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

constexpr int k_max_depth = 200;
// A nested level leaves at most one value each of or, and, comparison, sum, product, power and call pending.
constexpr std::size_t k_max_stack = 7 * (k_max_depth + 1) + 1;

// Sine of 90·quarter + rest degrees, |rest| <= 45, so that multiples of 90 are exact.
double sine_of_degrees(double degrees, int more_quarters) {
  if (!std::isfinite(degrees)) return std::nan("");
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter) * (std::numbers::pi / 180);
  const unsigned turn = static_cast<unsigned>(quarter + more_quarters) & 3U;
  const double size = (turn & 1U) != 0 ? std::cos(rest) : std::sin(rest);
  return (turn & 2U) != 0 ? -size : size;
}

}  // namespace

class ExpressionParser {
 public:
  ExpressionParser(std::span<const io::Token> tokens, const io::SessionLine& line, const VariableTable& variables)
      : tokens_(tokens), line_(line), variables_(variables) {}

  Expression parse() {
    expression_.is_boolean_ = disjunction();
    if (at_ < tokens_.size())
      fail(at_, "expected an operator or the end of the expression (other arguments stand before `where`)");
    auto& used = expression_.variables_;
    subdiv::sort_unique(used);
    return std::move(expression_);
  }

 private:
  using Operation = Expression::Operation;

  std::string found(std::size_t at) const {
    return at < tokens_.size() ? fmt::format("`{}`", tokens_[at].text) : "the end of the line";
  }

  [[noreturn]] void fail_at(std::size_t at, const std::string& message) const {
    throw Error(ErrorCode::bad_input, message,
                at < tokens_.size() ? io::place_of(line_, tokens_[at]) : io::place_of_end(line_));
  }
  [[noreturn]] void fail(std::size_t at, const std::string& expected) const {
    fail_at(at, expected + ", found " + found(at));
  }

  bool next_is(io::TokenKind kind, std::string_view text) const {
    return at_ < tokens_.size() && tokens_[at_].kind == kind && tokens_[at_].text == text;
  }
  bool accept(io::TokenKind kind, std::string_view text) {
    const bool is = next_is(kind, text);
    if (is) ++at_;
    return is;
  }
  bool accept_symbol(std::string_view text) { return accept(io::TokenKind::symbol, text); }
  bool accept_word(std::string_view text) { return accept(io::TokenKind::word, text); }

  void emit(Operation operation, double number = 0, std::size_t slot = 0) {
    expression_.program_.push_back({operation, static_cast<std::uint32_t>(slot), number});
  }

  // Every rule returns whether what it parsed is a condition.

  void need_condition(bool is, std::size_t at, std::string_view of) const {
    if (!is) fail_at(at, fmt::format("expected a condition such as z < 0 beside `{}`, found a number", of));
  }
  void need_number(bool is_condition, std::size_t at, std::string_view of) const {
    if (is_condition)
      fail_at(at,
              fmt::format("expected a number beside `{}`, found a condition; use and, or, not for conditions", of));
  }

  bool disjunction() {
    const std::size_t start = at_;
    bool condition = conjunction();
    while (next_is(io::TokenKind::word, "or")) {
      need_condition(condition, start, "or");
      const std::size_t right = ++at_;
      need_condition(conjunction(), right, "or");
      emit(Operation::either);
    }
    return condition;
  }

  bool conjunction() {
    const std::size_t start = at_;
    bool condition = negation();
    while (next_is(io::TokenKind::word, "and")) {
      need_condition(condition, start, "and");
      const std::size_t right = ++at_;
      need_condition(negation(), right, "and");
      emit(Operation::both);
    }
    return condition;
  }

  bool negation() {
    bool negated = false, any = false;
    while (accept_word("not")) {
      negated = !negated;
      any = true;
    }
    const std::size_t start = at_;
    const bool condition = comparison();
    if (any) need_condition(condition, start, "not");
    if (negated) emit(Operation::opposite);
    return condition;
  }

  std::optional<Operation> comparison_operator() const {
    if (at_ >= tokens_.size() || tokens_[at_].kind != io::TokenKind::symbol) return std::nullopt;
    const std::string& text = tokens_[at_].text;
    if (text == "<") return Operation::less;
    if (text == "<=") return Operation::less_equal;
    if (text == ">") return Operation::greater;
    if (text == ">=") return Operation::greater_equal;
    if (text == "=") return Operation::equal;
    if (text == "!=") return Operation::not_equal;
    return std::nullopt;
  }

  bool comparison() {
    const std::size_t start = at_;
    const bool left = sum();
    const auto operation = comparison_operator();
    if (!operation) return left;
    const std::string& symbol = tokens_[at_].text;
    need_number(left, start, symbol);
    const std::size_t right = ++at_;
    need_number(sum(), right, symbol);
    emit(*operation);
    if (comparison_operator())
      fail_at(at_, fmt::format("expected one comparison, found a second, `{}`; write a < b and b < c",
                               tokens_[at_].text));
    return true;
  }

  bool sum() {
    const std::size_t start = at_;
    const bool condition = product();
    while (next_is(io::TokenKind::symbol, "+") || next_is(io::TokenKind::symbol, "-")) {
      const std::string& symbol = tokens_[at_].text;
      need_number(condition, start, symbol);
      const std::size_t right = ++at_;
      need_number(product(), right, symbol);
      emit(symbol == "+" ? Operation::add : Operation::subtract);
    }
    return condition;
  }

  bool product() {
    const std::size_t start = at_;
    const bool condition = signed_power();
    while (next_is(io::TokenKind::symbol, "*") || next_is(io::TokenKind::symbol, "/")) {
      const std::string& symbol = tokens_[at_].text;
      need_number(condition, start, symbol);
      const std::size_t right = ++at_;
      need_number(signed_power(), right, symbol);
      emit(symbol == "*" ? Operation::multiply : Operation::divide);
    }
    return condition;
  }

  bool signed_power() {
    bool negative = false, any = false;
    const std::size_t start = at_;
    while (next_is(io::TokenKind::symbol, "-") || next_is(io::TokenKind::symbol, "+")) {
      negative = negative != (tokens_[at_].text == "-");
      any = true;
      ++at_;
    }
    const bool condition = power();
    if (any) need_number(condition, start, tokens_[start].text);
    if (negative) emit(Operation::negate);
    return condition;
  }

  bool power() {
    const std::size_t start = at_;
    const bool condition = primary();
    if (!accept_symbol("^")) return condition;
    need_number(condition, start, "^");
    const std::size_t right = at_;
    enter(right);  // a ^ b ^ c nests to the right
    need_number(signed_power(), right, "^");
    --depth_;
    emit(Operation::power);
    return false;
  }

  void enter(std::size_t at) {
    if (++depth_ > k_max_depth)
      fail_at(at,
              fmt::format("expected at most {} levels of nesting, found more; split the expression", k_max_depth));
  }

  bool primary() {
    const std::size_t start = at_;
    if (accept_symbol("(")) {
      enter(start);
      const bool condition = disjunction();
      --depth_;
      if (!accept_symbol(")")) fail(at_, "expected ) to close the parenthesis");
      return condition;
    }
    if (start >= tokens_.size() || tokens_[start].kind == io::TokenKind::symbol ||
        tokens_[start].kind == io::TokenKind::string)
      fail(start, "expected a number, a name, a function or (");
    ++at_;
    const io::Token& token = tokens_[start];
    if (token.kind == io::TokenKind::number) {
      emit(Operation::number, token.number);
      return false;
    }
    for (const char* reserved : {"and", "or", "not", "where"})
      if (token.text == reserved) fail(start, "expected a number, a name, a function or (");
    for (const Function& function : k_functions)
      if (token.text == function.name) {
        call(function, start);
        return false;
      }
    return variable(start);
  }

  struct Function {
    std::string_view name;
    Operation operation;
    bool takes_many;
  };
  static constexpr std::array<Function, 6> k_functions = {{{"abs", Operation::absolute, false},
                                                           {"sqrt", Operation::square_root, false},
                                                           {"sin", Operation::sine, false},
                                                           {"cos", Operation::cosine, false},
                                                           {"min", Operation::smaller, true},
                                                           {"max", Operation::larger, true}}};

  void call(const Function& function, std::size_t start) {
    if (!accept_symbol("(")) fail(at_, fmt::format("expected ( after {}", function.name));
    enter(start);
    std::size_t count = 0;
    do {
      const std::size_t argument = at_;
      need_number(disjunction(), argument, function.name);
      if (++count > 1 && function.takes_many) emit(function.operation);
    } while (accept_symbol(","));
    --depth_;
    if (!accept_symbol(")")) fail(at_, fmt::format("expected ) or , after an argument of {}", function.name));
    if (function.takes_many ? count < 2 : count != 1)
      fail_at(start,
              fmt::format("expected {} of {}, found {}",
                          function.takes_many ? "two or more arguments" : "one argument", function.name, count));
    if (!function.takes_many) emit(function.operation);
  }

  bool variable(std::size_t start) {
    const std::string& name = tokens_[start].text;
    const auto& names = variables_.names;
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) {
      std::vector<std::string> candidates = names;
      for (const Function& function : k_functions) candidates.emplace_back(function.name);
      fail_at(start, fmt::format("expected a known name, found `{}`{} (names here: {})", name,
                                 near_names_hint(name, candidates), fmt::join(names, " ")));
    }
    const auto slot = static_cast<std::size_t>(known - names.begin());
    emit(Operation::variable, 0, slot);
    expression_.variables_.push_back(slot);
    return slot < variables_.boolean.size() && variables_.boolean[slot] != 0;
  }

  std::span<const io::Token> tokens_;
  const io::SessionLine& line_;
  const VariableTable& variables_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Expression expression_;
};

Expression Expression::parse(std::span<const io::Token> tokens, const io::SessionLine& line,
                             const VariableTable& variables) {
  return ExpressionParser(tokens, line, variables).parse();
}

double Expression::evaluate(std::span<const double> values) const {
  std::array<double, k_max_stack> stack;
  std::size_t top = 0;  // values on the stack
  for (const Instruction& instruction : program_) {
    const auto fold = [&](auto combine) {
      stack[top - 2] = static_cast<double>(combine(stack[top - 2], stack[top - 1]));
      --top;
    };
    double& last = stack[top == 0 ? 0 : top - 1];
    switch (instruction.operation) {
      case Operation::number:
        assert(top < k_max_stack);
        stack[top++] = instruction.number;
        break;
      case Operation::variable:
        assert(top < k_max_stack && instruction.slot < values.size());
        stack[top++] = values[instruction.slot];
        break;
      case Operation::negate:
        last = -last;
        break;
      case Operation::absolute:
        last = std::abs(last);
        break;
      case Operation::square_root:
        last = std::sqrt(last);
        break;
      case Operation::sine:
        last = sine_of_degrees(last, 0);
        break;
      case Operation::cosine:
        last = sine_of_degrees(last, 1);
        break;
      case Operation::opposite:
        last = last == 0 ? 1 : 0;
        break;
      case Operation::add:
        fold([](double a, double b) { return a + b; });
        break;
      case Operation::subtract:
        fold([](double a, double b) { return a - b; });
        break;
      case Operation::multiply:
        fold([](double a, double b) { return a * b; });
        break;
      case Operation::divide:
        fold([](double a, double b) { return a / b; });
        break;
      case Operation::power:
        fold([](double a, double b) { return std::pow(a, b); });
        break;
      // NaN wins in either place, so that it cannot hide.
      case Operation::smaller:
        fold([](double a, double b) { return a < b || a != a ? a : b; });
        break;
      case Operation::larger:
        fold([](double a, double b) { return a > b || a != a ? a : b; });
        break;
      case Operation::less:
        fold([](double a, double b) { return a < b; });
        break;
      case Operation::less_equal:
        fold([](double a, double b) { return a <= b; });
        break;
      case Operation::greater:
        fold([](double a, double b) { return a > b; });
        break;
      case Operation::greater_equal:
        fold([](double a, double b) { return a >= b; });
        break;
      case Operation::equal:
        fold([](double a, double b) { return a == b; });
        break;
      case Operation::not_equal:
        fold([](double a, double b) { return a < b || a > b; });
        break;
      case Operation::both:
        fold([](double a, double b) { return a != 0 && b != 0; });
        break;
      case Operation::either:
        fold([](double a, double b) { return a != 0 || b != 0; });
        break;
    }
  }
  assert(top == 1);
  return stack[0];
}

Expression parse_where(const io::SessionLine& line, const VariableTable& variables) {
  const auto where = std::find_if(line.tokens.begin(), line.tokens.end(), [](const io::Token& token) {
    return token.kind == io::TokenKind::word && token.text == "where";
  });
  if (where == line.tokens.end())
    throw Error(ErrorCode::bad_input, "expected `where` and a condition, found the end of the line",
                io::place_of_end(line));
  const std::span<const io::Token> tokens(where + 1, line.tokens.end());
  Expression condition = Expression::parse(tokens, line, variables);
  if (!condition.is_boolean())
    throw Error(ErrorCode::bad_input, "expected a condition such as z < 0 after `where`, found a number",
                io::place_of(line, tokens[0]));
  return condition;
}

}  // namespace argil::sculpt
