#include "io/session_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "subdiv/error.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

std::vector<std::string> texts(const std::vector<Token>& tokens) {
  std::vector<std::string> all;
  for (const Token& token : tokens) all.push_back(token.text);
  return all;
}

Error fault_of(const std::string& session) {
  try {
    (void)parse_session(session, "chair.argil");
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "accepted: " << session;
  return {ErrorCode::bad_input, ""};
}

double number_of(const std::string& text) {
  const auto line = parse_session_line(text, "f", 1);
  EXPECT_EQ(line.tokens.size(), 1U) << text;
  EXPECT_EQ(line.tokens.at(0).kind, TokenKind::number) << text;
  return line.tokens.at(0).number;
}

TEST(SessionText, SplitsCommandsIntoTokensWithPlaces) {
  const auto lines =
      parse_session("# a chair\n\nargil 1\nnew box 4 0.5 # seat\r\n  save \"my \\\"chair\\\\.vtu\"\n", "f");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].number, 4);
  EXPECT_EQ(lines[0].text, "new box 4 0.5");
  EXPECT_THAT(texts(lines[0].tokens), testing::ElementsAre("new", "box", "4", "0.5"));
  EXPECT_EQ(lines[0].tokens[3].number, 0.5);
  EXPECT_EQ(lines[0].tokens[2].column, 9);
  EXPECT_EQ(lines[1].tokens[1].kind, TokenKind::string);
  EXPECT_EQ(lines[1].tokens[1].text, "my \"chair\\.vtu");
  EXPECT_EQ(place_of(lines[1], lines[1].tokens[1]), "f:5:8");
}

TEST(SessionText, ColumnsCountCharactersNotBytes) {
  const auto line = parse_session_line("save é€𝄞 now", "f", 7);
  EXPECT_EQ(line.tokens[2].column, 10);
  EXPECT_EQ(place_of_end(line), "f:7:13");
}

TEST(SessionText, NumbersAreDecimalsFractionsAndPercentages) {
  EXPECT_EQ(number_of("-0.5"), -0.5);
  EXPECT_EQ(number_of("+2e5"), 2e5);
  EXPECT_EQ(number_of(".5"), 0.5);
  EXPECT_EQ(number_of("1/60"), 1.0 / 60.0);
  EXPECT_EQ(number_of("-1/-4"), 0.25);
  EXPECT_EQ(number_of("1%"), 0.01);
  for (const char* word : {"inf", "nan", "0x10", "3d.vtu", "0.4.2", "1/", "1e", "-", "1/2/3", "1%%"})
    EXPECT_EQ(parse_session_line(word, "f", 1).tokens.at(0).kind, TokenKind::word) << word;
}

TEST(SessionText, NumbersDoNotDependOnTheLocale) {
  // Where the comma locale is not installed the test still holds, but shows nothing.
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(number_of("1.5"), 1.5);
  EXPECT_EQ(format_number(1.5), "1.5");
  std::setlocale(LC_ALL, before.c_str());
}

TEST(SessionText, AfterWhereTheLineIsAnExpression) {
  const auto line = parse_session_line("select faces where a/b<=-10% and(x!=1)#c", "f", 1);
  EXPECT_THAT(texts(line.tokens), testing::ElementsAre("select", "faces", "where", "a", "/", "b", "<=", "-", "10%",
                                                       "and", "(", "x", "!=", "1", ")"));
  EXPECT_EQ(line.tokens[8].number, 0.1);
  EXPECT_EQ(line.tokens[9].column, 30);
}

TEST(SessionText, AnArgumentCanBeReadAgainAsAnExpression) {
  const auto line = parse_session_line("set density 300+10*x where z < 0", "f", 1);
  EXPECT_THAT(texts(expression_tokens(line, 2)), testing::ElementsAre("300", "+", "10", "*", "x"));
  EXPECT_THAT(texts(expression_tokens(line, 4)), testing::ElementsAre("z", "<", "0"));
  EXPECT_EQ(expression_tokens(line, 2)[4].column, 20);
  EXPECT_TRUE(expression_tokens(line, 9).empty());
}

TEST(SessionText, FaultsNameTheirPlace) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"new box\n", "chair.argil:1:1", "argil 1"},
      {"argil\n", "chair.argil:1:1", "argil 1"},
      {"argil 2\n", "chair.argil:1:7", "version 1"},
      {"", "chair.argil:1:1", "no command"},
      {"argil 1\nsave \"a\n", "chair.argil:2:6", "closing"},
      {"argil 1\nsave \"a\\n\"\n", "chair.argil:2:8", "backslash"},
      {"argil 1\nsave \"a\"b\n", "chair.argil:2:9", "blank"},
      {"argil 1\nsave a\"b\"\n", "chair.argil:2:7", "blank"},
      {"argil 1\nstep 1/0\n", "chair.argil:2:6", "fraction"},
      {"argil 1\nstep 1e999\n", "chair.argil:2:6", "1e999"},
      {"argil 1\nstep 1e300/1e-300\n", "chair.argil:2:6", "finite"},
      {"argil 1\nsave \xff\n", "chair.argil:2:6", "UTF-8"},
      {"argil 1\nsave \xc0\xaf\n", "chair.argil:2:6", "UTF-8"},
      {"argil 1\nsave \xed\xa0\x80\n", "chair.argil:2:6", "UTF-8"},
      {"argil 1\nsave \xe2\x82\n", "chair.argil:2:6", "UTF-8"},
      {std::string("argil 1\nsave \0\n", 15), "chair.argil:2:6", "control"},
      {"argil 1\nselect faces where 2x < 1\n", "chair.argil:2:21", "write *"},
      {"argil 1\nselect faces where x == 1\n", "chair.argil:2:22", "write ="},
      {"argil 1\nselect faces where x & 1\n", "chair.argil:2:22", "'&'"},
      {"argil 1\nselect faces where x < 1.2.3\n", "chair.argil:2:27", "operator"}};
  for (const auto& [session, place, message] : cases) {
    const Error error = fault_of(session);
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << session;
    EXPECT_EQ(error.where(), place) << session;
    EXPECT_THAT(error.what(), HasSubstr(message)) << session;
  }
}

TEST(SessionText, SizesAreBounded) {
  const std::string longest = "save " + std::string(k_max_session_line - 5, 'a');
  EXPECT_EQ(parse_session("argil 1\n" + longest, "f").size(), 1U);
  EXPECT_EQ(fault_of("argil 1\n" + longest + "a").code(), ErrorCode::limit_exceeded);
  EXPECT_EQ(fault_of(std::string(k_max_session_file + 1, '\n')).code(), ErrorCode::limit_exceeded);
  std::string words = "argil 1\n";
  for (int line = 0; line < 200; ++line) {
    for (int word = 0; word < 25000; ++word) words += "a ";
    words += '\n';
  }
  EXPECT_EQ(fault_of(words).code(), ErrorCode::limit_exceeded);
}

TEST(SessionText, NumbersRoundTripInTheShortestForm) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(200000), "2e+05");
  for (const double x : {1.0 / 60, 5e-324, std::numeric_limits<double>::max(), 0.1 + 0.2})
    EXPECT_EQ(number_of(format_number(-x)), -x);
  EXPECT_TRUE(std::signbit(number_of(format_number(-0.0))));
  EXPECT_THROW((void)format_number(std::nan("")), Error);
}

TEST(SessionText, QuotedNamesReadBack) {
  for (const std::string name : {"chair.vtu", "my chair", "", "where", "12", "1/0", "a\"b\\c", "#1", "10*x", "é"}) {
    const auto line = parse_session_line("save " + quote(name), "f", 1);
    ASSERT_EQ(line.tokens.size(), 2U) << name;
    EXPECT_EQ(line.tokens[1].text, name);
    EXPECT_NE(line.tokens[1].kind, TokenKind::number) << name;
  }
  EXPECT_EQ(quote("chair.vtu"), "chair.vtu");
  EXPECT_EQ(quote("my chair"), "\"my chair\"");
  EXPECT_THROW((void)quote("two\nlines"), Error);
  EXPECT_THROW((void)quote("\xff"), Error);
}

TEST(SessionText, ALineWrittenBackIsTheSameCommand) {
  const auto line =
      parse_session_line("paint \"soft part\" scale 1/3 within 5% where -x^2 < 0.1 and boundary", "f", 1);
  const auto again = parse_session_line(format_line(line.tokens), "f", 1);
  ASSERT_EQ(again.tokens.size(), line.tokens.size());
  for (std::size_t i = 0; i < line.tokens.size(); ++i) {
    EXPECT_EQ(again.tokens[i].kind, line.tokens[i].kind) << i;
    if (line.tokens[i].kind == TokenKind::number)
      EXPECT_EQ(again.tokens[i].number, line.tokens[i].number);
    else
      EXPECT_EQ(again.tokens[i].text, line.tokens[i].text);
  }
}

TEST(SessionText, TenThousandMutationsGiveAnErrorOrCommandsThatReadBack) {
  const std::string session =
      "argil 1\n# chair\nnew box 4 4 1 size 0.6 0.6 1/10\nselect faces where z < 0.001 and (x < 15% or x > 0.45)\n"
      "save \"my \\\"chair\\\\.vtu\"\nset density 300+10*x\nexpect volume 3.12e-2 within 1% # \xc3\xa9\n";
  const std::string pieces = "\"\\#/%.eE+-<=!() \t\r\n09azé\xff\x01";
  std::mt19937 random(12345);  // its sequence is fixed by the standard
  int accepted = 0;
  for (int round = 0; round < 10000; ++round) {
    std::string text = session;
    for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
      const std::size_t at = 8 + random() % (text.size() - 8);
      switch (random() % 3) {
        case 0:
          text[at] = pieces[random() % pieces.size()];
          break;
        case 1:
          text.insert(at, 1, pieces[random() % pieces.size()]);
          break;
        default:
          text.erase(at, 1 + random() % 5);
      }
      if (text.size() < 20) break;
    }
    try {
      for (const SessionLine& line : parse_session(text, "f")) {
        const auto again = parse_session_line(format_line(line.tokens), "f", line.number);
        ASSERT_EQ(again.tokens.size(), line.tokens.size()) << line.text;
        for (std::size_t i = 0; i < line.tokens.size(); ++i) {
          ASSERT_EQ(again.tokens[i].kind, line.tokens[i].kind) << line.text;
          ASSERT_EQ(again.tokens[i].number, line.tokens[i].number) << line.text;
        }
        (void)expression_tokens(line, 1);
      }
      ++accepted;
    } catch (const Error& error) {
      EXPECT_TRUE(error.where().starts_with("f:")) << error.what();
    }
  }
  EXPECT_GT(accepted, 1000);  // else only the error paths were tried
  EXPECT_LT(accepted, 9000);
}

TEST(SessionText, ReadsFilesAndNamesThoseThatAreMissing) {
  const auto path = std::filesystem::path(testing::TempDir()) / "argil_session_text_test.argil";
  std::ofstream(path) << "\xef\xbb\xbf"
                      << "argil 1\nundo";
  EXPECT_EQ(read_session(path).at(0).tokens.at(0).text, "undo");
  std::filesystem::remove(path);
  try {
    (void)read_session(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_EQ(error.where(), path.string());
  }
  EXPECT_THROW((void)read_session(testing::TempDir()), Error);
}

}  // namespace
}  // namespace argil::io
