#include "sculpt/where.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "subdiv/error.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

const VariableTable k_variables = {{"x", "y", "z", "density", "boundary"}, {0, 0, 0, 0, 1}};
constexpr std::array<double, 5> k_values = {2, 3, -4, 300, 1};

Expression parse(const std::string& text) {
  const auto line = io::parse_session_line("set density " + text, "s.argil", 3);
  return Expression::parse(io::expression_tokens(line, 2), line, k_variables);
}

double value_of(const std::string& text) {
  return parse(text).evaluate(k_values);
}

Error fault_of(const std::string& text) {
  try {
    (void)parse(text);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "accepted: " << text;
  return {ErrorCode::bad_input, ""};
}

TEST(Where, ArithmeticBindsAsInMathematics) {
  EXPECT_EQ(value_of("300 + 10*x"), 320);
  EXPECT_EQ(value_of("2 - 3 - 4"), -5);
  EXPECT_EQ(value_of("24 / 4 / 2"), 3);
  EXPECT_EQ(value_of("-x^2"), -4);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_EQ(value_of("2^-1"), 0.5);
  EXPECT_EQ(value_of("2*-x"), -4);
  EXPECT_EQ(value_of("(2 + 3) * -(x - y)"), 5);
  EXPECT_EQ(value_of("50% * density"), 150);
  EXPECT_EQ(value_of("1/4"), 0.25);
}

TEST(Where, FunctionsTakeDegreesAndAreExactAtQuarters) {
  EXPECT_EQ(value_of("abs(z)"), 4);
  EXPECT_EQ(value_of("sqrt(x*8)"), 4);
  EXPECT_EQ(value_of("min(x, y, z)"), -4);
  EXPECT_EQ(value_of("max(x, min(y, 7))"), 3);
  EXPECT_EQ(value_of("sin(180)"), 0);
  EXPECT_EQ(value_of("sin(-90)"), -1);
  EXPECT_EQ(value_of("cos(90)"), 0);
  EXPECT_EQ(value_of("cos(360 * 1000 + 180)"), -1);
  for (int degrees = -725; degrees < 725; degrees += 7) {
    // The reduction and the library each err by one unit in the last place of values below 1, and the reference by
    // the rounding of its argument below 13 radians.
    const double radians = degrees * (std::acos(-1.0) / 180);
    EXPECT_NEAR(value_of(fmt::format("sin({})", degrees)), std::sin(radians), 4e-15) << degrees;
    EXPECT_NEAR(value_of(fmt::format("cos({})", degrees)), std::cos(radians), 4e-15) << degrees;
  }
}

TEST(Where, ConditionsCombine) {
  for (const char* text : {"z < 0", "x <= 2", "y > x", "y >= 3", "x = 2", "x != 3", "boundary", "z < 0 and x < 3",
                           "z > 0 or x < 3", "not z > 0", "not not boundary", "(x < 0 or y = 3) and not (z = 0)",
                           "x < 0 and y < 0 or boundary", "boundary or x < 0 and y < 0", "x + 1 < y * 2"})
    EXPECT_TRUE(parse(text).is_boolean() && parse(text).holds(k_values)) << text;
  for (const char* text :
       {"z > 0", "x != 2", "not boundary", "boundary and x < 0", "not z < 0 or x < 0", "not (boundary or x < 0)"})
    EXPECT_TRUE(parse(text).is_boolean() && !parse(text).holds(k_values)) << text;
  EXPECT_FALSE(parse("x + 1").is_boolean());
}

TEST(Where, NanNeverCompares) {
  for (const char* text :
       {"(0/0) < 1", "(0/0) >= 1", "(0/0) = (0/0)", "(0/0) != 1", "min((0/0), 1) < 2", "max(1, x*0/0) > 0"})
    EXPECT_FALSE(parse(text).holds(k_values)) << text;
  EXPECT_TRUE(std::isnan(value_of("sqrt(z)")));
  EXPECT_TRUE(std::isinf(value_of("x/0")));
  EXPECT_TRUE(std::isnan(value_of("sin(x/0)")));
}

TEST(Where, TellsWhichVariablesItReads) {
  EXPECT_THAT(parse("z + x*x + z").variables(), testing::ElementsAre(0, 2));
  EXPECT_TRUE(parse("1 + 2").variables().empty());
}

TEST(Where, FaultsNameTheirPlaceAndWhatToDo) {
  // Columns: the expression starts at 13.
  const std::vector<std::array<std::string, 3>> cases = {
      {"", "s.argil:3:12", "the end of the line"},
      {"1 +", "s.argil:3:16", "the end of the line"},
      {"x < y < 3", "s.argil:3:19", "a < b and b < c"},
      {"(x < y) < 3", "s.argil:3:13", "expected a number"},
      {"x and y", "s.argil:3:13", "condition"},
      {"x < 1 and y", "s.argil:3:23", "condition"},
      {"not x", "s.argil:3:17", "condition"},
      {"1 + boundary", "s.argil:3:17", "expected a number"},
      {"-boundary", "s.argil:3:13", "expected a number"},
      {"boundary = 1", "s.argil:3:13", "expected a number"},
      {"(1 + 2", "s.argil:3:19", "close the parenthesis"},
      {"1 2", "s.argil:3:15", "an operator"},
      {"1 + 2)", "s.argil:3:18", "an operator"},
      {"min(1)", "s.argil:3:13", "two or more"},
      {"abs(1, 2)", "s.argil:3:13", "one argument"},
      {"sin 3", "s.argil:3:17", "expected ("},
      {"min(1, x < 2)", "s.argil:3:20", "expected a number"},
      {"* 3", "s.argil:3:13", "expected a number, a name"},
      {"and", "s.argil:3:13", "expected a number, a name"},
      {"\"x\" + 1", "s.argil:3:13", "expected a number, a name"},
      {"densty * 2", "s.argil:3:13", "did you mean `density`?"},
      {"q", "s.argil:3:13", "names here: x y z density boundary"}};
  for (const auto& [text, place, message] : cases) {
    const Error error = fault_of(text);
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << text;
    EXPECT_EQ(error.where(), place) << text;
    EXPECT_THAT(error.what(), HasSubstr(message)) << text;
  }
}

TEST(Where, NestingIsBounded) {
  const auto nested = [](const std::string& open, int depth, const std::string& close) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += open;
    text += "1";
    for (int i = 0; i < depth; ++i) text += close;
    return text;
  };
  EXPECT_EQ(value_of(nested("(", 200, ")")), 1);
  EXPECT_THAT(fault_of(nested("(", 201, ")")).what(), HasSubstr("nesting"));
  EXPECT_THAT(fault_of(nested("(", 30000, "")).what(), HasSubstr("nesting"));
  EXPECT_THAT(fault_of(nested("2^", 30000, "")).what(), HasSubstr("nesting"));
  EXPECT_THAT(fault_of(nested("abs(", 10000, ")")).what(), HasSubstr("nesting"));
  EXPECT_EQ(value_of(nested("-", 30000, "")), 1);
  EXPECT_EQ(value_of(nested("1+", 30000, "")), 30001);
  // The deepest stack: every rule holds one value back on every level.
  EXPECT_EQ(value_of(nested("max(0, 0 + 1 * 1 ^ (", 66, "))")), 1);
}

TEST(Where, RandomTokensGiveAnErrorOrAValue) {
  const std::array<std::string, 30> words = {
      "x", "y", "boundary", "1", "0.5", "2%", "+",   "-",  "*",   "/",   "^", "(",   ")",   "(",    ")",
      ",", "<", "<=",       ">", "=",   "!=", "and", "or", "not", "min", "(", "abs", "sin", "sqrt", "z"};
  std::mt19937 random(2024);  // its sequence is fixed by the standard
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = "where";
    for (unsigned count = 1 + random() % 9; count > 0; --count) text += ' ' + words[random() % words.size()];
    const auto line = io::parse_session_line(text, "f", 1);
    try {
      const auto expression = Expression::parse(std::span(line.tokens).subspan(1), line, k_variables);
      const double value = expression.evaluate(k_values);
      EXPECT_TRUE(!expression.is_boolean() || value == 0 || value == 1) << text;
      ++accepted;
    } catch (const Error& error) {
      EXPECT_TRUE(error.where().starts_with("f:1:")) << text;
    }
  }
  EXPECT_GT(accepted, 300);  // else only the error paths were tried
}

TEST(Where, ReadsTheConditionOfALine) {
  const auto line = io::parse_session_line("paint density 5 where z < 0 and boundary", "s.argil", 1);
  EXPECT_TRUE(parse_where(line, k_variables).holds(k_values));
  EXPECT_THROW((void)parse_where(io::parse_session_line("paint density 5", "s", 1), k_variables), Error);
  EXPECT_THROW((void)parse_where(io::parse_session_line("paint density 5 where 1 + 2", "s", 1), k_variables),
               Error);
  EXPECT_THROW((void)parse_where(io::parse_session_line("paint density 5 where", "s", 1), k_variables), Error);
}

}  // namespace
}  // namespace argil::sculpt
