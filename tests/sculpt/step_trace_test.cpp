#include "sculpt/step_trace.h"

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using Row = std::map<std::string, double>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

std::vector<Row> rows_of(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, step_trace_header());
  const auto names = split(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    const auto values = split(line);
    EXPECT_EQ(values.size(), names.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(values.size(), names.size()); ++i) {
      double value = NAN;
      const auto [end, failure] = std::from_chars(values[i].data(), values[i].data() + values[i].size(), value);
      EXPECT_TRUE(failure == std::errc{} && end == values[i].data() + values[i].size()) << values[i];
      rows.back()[names[i]] = value;
    }
  }
  return rows;
}

class TracedSession {
 public:
  explicit TracedSession(const std::vector<std::string>& lines) {
    SessionOptions options;
    options.step_trace = folder_.path() / "trace.csv";
    TestSession session(lines, options);
    elastic = session.measure("elastic_energy");
    kinetic = session.measure("kinetic_energy");
    loads = session.measure("load_energy");
    reaction_z = session.measure("reaction_z");
    ratio = session.measure("min_volume_ratio");
    momentum_z = session.measure("momentum_z");
    mass = session.measure("mass");
  }
  std::vector<Row> rows() const { return rows_of(folder_.text_of("trace.csv")); }
  double elastic, kinetic, loads, reaction_z, ratio, momentum_z, mass;

 private:
  TestFolder folder_;
};

TEST(StepTrace, HasARowAStepWithTheNumbersThatMeasureGivesToTheLastBit) {
  const TracedSession session({"new box 4 1 1 size 0.4 0.1 0.1", "levels 1", "set young_modulus 1e4",
                               "pin where x < 0.001", "gravity 0 0 -9.81", "step 6", "step 1"});
  const auto rows = session.rows();
  ASSERT_EQ(rows.size(), 7U);
  const Row& last = rows.back();
  EXPECT_EQ(last.at("step"), 7);
  EXPECT_NEAR(last.at("time_s"), 7.0 / 60, 1e-15);
  EXPECT_EQ(last.at("elastic_J"), session.elastic);
  EXPECT_EQ(last.at("kinetic_J"), session.kinetic);
  EXPECT_EQ(last.at("loads_J"), session.loads);
  EXPECT_EQ(last.at("reaction_z_N"), session.reaction_z);
  EXPECT_EQ(last.at("min_volume_ratio"), session.ratio);
  EXPECT_EQ(last.at("momentum_z_Ns"), session.momentum_z);
  EXPECT_EQ(last.at("total_J"), session.kinetic + session.elastic + session.loads);
  EXPECT_LT(last.at("loads_J"), 0);  // it has come down
  EXPECT_GE(last.at("newton_iterations"), 1);
  EXPECT_GE(last.at("linear_iterations"), 1);
  EXPECT_EQ(last.at("step_ms"), 0);  // no clock runs
}

TEST(StepTrace, ABodyThatFallsFreelyGainsTheMomentumOfItsWeight) {
  const TracedSession session({"new box 2 1 1 size 0.2 0.1 0.1", "levels 1", "gravity 0 0 -9.81", "step 5"});
  for (const Row& row : session.rows()) {
    // Both implicit Euler and BDF2 integrate a constant force exactly; the solver stops at 1e-4.
    EXPECT_NEAR(row.at("momentum_z_Ns"), -session.mass * 9.81 * row.at("time_s"), 1e-3 * session.mass);
    EXPECT_NEAR(row.at("momentum_x_Ns"), 0, 1e-6 * session.mass);
    EXPECT_EQ(row.at("reaction_z_N"), 0);
    EXPECT_NEAR(row.at("min_volume_ratio"), 1, 1e-3);
  }
}

TEST(StepTrace, SaysWhatTheToolApplies) {
  SessionOptions options;
  const TestFolder folder;
  options.step_trace = folder.path() / "trace.csv";
  TestSession session({"new box 4 4 1 size 0.4 0.4 0.1", "levels 1", "pin where z < 0.001",
                       "tool pull radius 0.1 strength 40", "stroke from 0.2 0.2 0.1 to 0.2 0.2 0.2 ticks 100"},
                      options);
  const auto rows = rows_of(folder.text_of("trace.csv"));
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_GT(rows.back().at("tool_force_z_N"), 0);
  EXPECT_GT(rows.back().at("springs_J"), 0);
  EXPECT_LT(rows.back().at("reaction_z_N"), 0);  // the pins hold against it
}

TEST(StepTrace, RefusesAFileThatCannotBeWritten) {
  SessionOptions options;
  options.step_trace = "/nowhere/at/all/trace.csv";
  EXPECT_THROW(TestSession({}, options), Error);
}

}  // namespace
}  // namespace argil::sculpt
