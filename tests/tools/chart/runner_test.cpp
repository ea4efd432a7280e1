#include "tools/chart/runner.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/chart/chart.h"

namespace argil::chart {
namespace {

/// Lists cut down to what runs in no time.
Lists small_lists() {
  Lists lists = chosen(all_lists(), {{"cantilever", "released_bar"},
                                     {"corotational", "linear"},
                                     {"default", "nodes"},
                                     {"bdf2", "implicit_euler"}});
  for (Problem& problem : lists.problems) {
    problem.resolutions = {1};
    problem.time_steps = {1.0 / 60};
  }
  std::erase_if(lists.models,
                [](const ModelRow& row) { return row.choice.formulation != fem::Formulation::plain; });
  return lists;
}

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("argil_chart_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

Row made_up(std::uint64_t key) {
  Row row;
  row.key = key;
  row.problem = "cantilever";
  row.model = "linear";
  row.formulation = "plain";
  row.space = "default";
  row.resolution = 2;
  row.unknowns = 216;
  row.elements = 32;
  row.error = 0.1 + 0.2;  // needs all its digits
  row.signed_error = -1.0 / 3;
  row.ms = 1e-7;
  row.threads = 2;
  row.version = "0.1.0";
  row.commit = "0123456789ab-dirty";
  row.message = "a \"quoted\" word, a comma\nand a line";
  row.state_hash = 0xffffffffffffffffULL;
  return row;
}

TEST(ChartTable, KeepsEveryDigitAndWord) {
  const Row row = made_up(17);
  const ReadTable read = parse_table(csv_header() + "\n" + csv_line(row) + "\n");
  ASSERT_EQ(read.rows.size(), 1U);
  const Row& again = read.rows[0];
  EXPECT_EQ(again.key, row.key);
  EXPECT_EQ(again.error, row.error);
  EXPECT_EQ(again.signed_error, row.signed_error);
  EXPECT_EQ(again.ms, row.ms);
  EXPECT_EQ(again.commit, row.commit);
  EXPECT_TRUE(std::isnan(again.time_step));
  EXPECT_EQ(again.message, "a \"quoted\" word, a comma and a line");  // a row is a line
  EXPECT_EQ(again.state_hash, row.state_hash);
  EXPECT_EQ(csv_line(again), csv_line(parse_table(csv_header() + "\n" + csv_line(again) + "\n").rows[0]));
}

TEST(ChartTable, RefusesWhatItDidNotWriteAndNamesTheLine) {
  EXPECT_THROW(static_cast<void>(parse_table("a,b,c\n")), Error);
  try {
    static_cast<void>(parse_table(csv_header() + "\n" + csv_line(made_up(1)) + "\nnonsense\n"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "line 3");
    EXPECT_THAT(error.what(), testing::HasSubstr("columns"));
  }
}

TEST(ChartTable, CutsOffALineThatWasNotWrittenToItsEnd) {
  const auto path = fresh_folder("cut") / "chart.csv";
  const std::string whole = csv_header() + "\n" + csv_line(made_up(1)) + "\n";
  const std::string next = csv_line(made_up(2));
  for (std::size_t length = 0; length <= next.size(); length += 7) {
    io::write_file(path, whole + next.substr(0, length));
    {
      Table table(path);
      ASSERT_EQ(table.rows().size(), 1U) << length;
      table.add(made_up(3));
    }
    EXPECT_EQ(io::read_file(path), whole + csv_line(made_up(3)) + "\n") << length;
  }
}

TEST(ChartRunner, GoesOnWhereItWasKilledWithoutRepeating) {
  const auto folder = fresh_folder("resume");
  const Lists lists = small_lists();
  const auto runs = plan(lists, Breadth::usual);
  ASSERT_GT(runs.size(), 8U);
  Setting setting;
  setting.repeats = 1;
  {
    Table table(folder / "chart.csv");
    std::size_t asked = 0;
    setting.stopped = [&] { return ++asked > 40; };  // somewhere in the midst of a run
    EXPECT_THROW(execute(runs, setting, table, {}), Stopped);
    EXPECT_GT(table.rows().size(), 0U);
    EXPECT_LT(table.rows().size(), runs.size());
  }
  // As a kill would leave it: the last line half written.
  const std::string text = io::read_file(folder / "chart.csv");
  io::write_file(folder / "chart.csv", text.substr(0, text.size() - 9));
  setting.stopped = {};
  std::size_t started = 0;
  std::size_t had = 0;
  {
    Table table(folder / "chart.csv");
    had = table.rows().size();
    execute(runs, setting, table, [&](std::size_t, const chart::Run&, const Row* row) { started += row ? 0 : 1; });
  }
  EXPECT_EQ(had + started, runs.size());
  const ReadTable read = parse_table(io::read_file(folder / "chart.csv"));
  std::set<std::uint64_t> keys;
  for (const Row& row : read.rows) {
    keys.insert(row.key);
    EXPECT_EQ(row.status, Status::ok) << row.method() << ": " << row.message;
  }
  EXPECT_EQ(read.rows.size(), runs.size());
  EXPECT_EQ(keys.size(), runs.size());
  Table table(folder / "chart.csv");
  execute(runs, setting, table, [](std::size_t, const chart::Run& run, const Row*) { FAIL() << run.label(); });
}

/// A model whose forces are a tenth too large.
class TooStiff : public fem::ForceModel {
 public:
  explicit TooStiff(std::unique_ptr<fem::ForceModel> right) : right_(std::move(right)) {}
  std::string_view name() const override { return right_->name(); }
  fem::Promises promises() const override {
    fem::Promises promises = right_->promises();
    promises.has_energy = false;  // else the line search would find out
    return promises;
  }
  double energy(const Eigen::Matrix3Xd& x) const override { return right_->energy(x); }
  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    right_->forces(x, forces);
    forces *= 1.1;
  }
  std::unique_ptr<fem::Tangent> tangent(const Eigen::Matrix3Xd& x, fem::Projection projection) const override {
    return right_->tangent(x, projection);
  }

 private:
  std::unique_ptr<fem::ForceModel> right_;
};

TEST(ChartRunner, BreakingOneMethodMovesExactlyItsRows) {
  Lists lists = small_lists();
  const auto run_all = [&](const std::string& name) {
    Table table(fresh_folder(name) / "chart.csv");
    Setting setting;
    setting.repeats = 1;
    execute(plan(lists, Breadth::usual), setting, table, {});
    return table.rows();
  };
  const std::vector<Row> right = run_all("right");
  ASSERT_EQ(lists.models[1].name(), "linear");
  lists.models[1].make = [make = lists.models[1].make](std::span<const fem::ElementBlock> blocks,
                                                       const Eigen::Matrix3Xd& rest_nodes) {
    return std::make_unique<TooStiff>(make(blocks, rest_nodes));
  };
  const std::vector<Row> wrong = run_all("wrong");
  ASSERT_EQ(right.size(), wrong.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_EQ(right[i].key, wrong[i].key);
    if (right[i].model == "linear") {
      ++moved;
      EXPECT_GT(std::abs(right[i].error - wrong[i].error), 1e-3) << right[i].method();
      EXPECT_NE(right[i].state_hash, wrong[i].state_hash);
    } else {
      EXPECT_EQ(right[i].error, wrong[i].error) << right[i].method();  // the same bits
      EXPECT_EQ(right[i].state_hash, wrong[i].state_hash);
    }
  }
  EXPECT_GT(moved, 2U);
  EXPECT_LT(moved, right.size());
}

TEST(ChartRunner, RefusalsAndFailuresAreRows) {
  Lists lists = small_lists();
  const std::vector<Problem> problems = lists.problems;
  Setting setting;
  setting.repeats = 1;
  lists.models[0].make = [](std::span<const fem::ElementBlock>,
                            const Eigen::Matrix3Xd&) -> std::unique_ptr<fem::ForceModel> {
    throw Error(ErrorCode::unsupported, "not in hexahedra");
  };
  const chart::Run refused{&lists.problems[0], &lists.models[0], &lists.spaces[0], nullptr, 1, 0};
  Row row = execute(refused, setting);
  EXPECT_EQ(row.status, Status::refused);
  EXPECT_EQ(row.message, "not in hexahedra");
  EXPECT_TRUE(std::isnan(row.error));

  // Started a hundred bars' lengths away, it has left all bounds.
  Problem& bar = lists.problems[1];
  bar.start = [](Body& body) { body.state.velocities.row(1).setConstant(1e6); };
  bar.held = {};
  const chart::Run diverged{&bar, &lists.models[1], &lists.spaces[0], &lists.integrators[0], 1, 1.0 / 60};
  row = execute(diverged, setting);
  EXPECT_EQ(row.status, Status::diverged);
  EXPECT_TRUE(std::isnan(row.error));
}

TEST(ChartRunner, StopsAtTheLimitAndSparesTheFinerRuns) {
  Lists lists = small_lists();
  lists.problems[0].resolutions = {1, 2, 4};
  lists.problems.resize(1);
  lists.models.resize(1);
  lists.spaces.resize(1);
  Setting setting;
  static double time = 0;
  setting.clock = [] { return time += 1; };  // every look at it takes a second
  setting.seconds_a_run = 3;
  setting.repeats = 1;
  Table table(fresh_folder("limit") / "chart.csv");
  execute(plan(lists, Breadth::usual), setting, table, {});
  ASSERT_EQ(table.rows().size(), 3U);
  for (const Row& row : table.rows()) EXPECT_EQ(row.status, Status::over_time);
  EXPECT_EQ(table.rows()[2].message, "a coarser one went over time");
}

TEST(ChartRunner, QuickIsPartOfUsualAndUsualOfAll) {
  const Lists lists = all_lists();
  const auto keys = [&](Breadth breadth) {
    std::set<std::uint64_t> set;
    const auto runs = plan(lists, breadth);
    for (const chart::Run& run : runs) set.insert(key_of(run, {}));
    EXPECT_EQ(set.size(), runs.size());
    return set;
  };
  const auto quick = keys(Breadth::quick), usual = keys(Breadth::usual), all = keys(Breadth::all);
  EXPECT_TRUE(std::includes(usual.begin(), usual.end(), quick.begin(), quick.end()));
  EXPECT_TRUE(std::includes(all.begin(), all.end(), usual.begin(), usual.end()));
  EXPECT_LT(quick.size(), usual.size());
}

TEST(ChartChoice, NamesThatAreNotThereAreRefusedWithThoseThatAre) {
  try {
    static_cast<void>(chosen(all_lists(), {{"cantilver"}, {}, {}, {}}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean `cantilever`"));
    EXPECT_THAT(error.what(), testing::HasSubstr("twist_90"));
  }
  EXPECT_EQ(chosen(all_lists(), {{}, {"linear"}, {"cubic"}, {}}).spaces.size(), 1U);
}

}  // namespace
}  // namespace argil::chart
