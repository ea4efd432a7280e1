#include "tools/chart/session_chart.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/chart/chart.h"

namespace argil::chart {
namespace {

const char* const k_bar = R"(argil 1
new box 4 1 1 size 0.4 0.1 0.1
select edges angle 30
sharpen 10
levels 1
set young_modulus 1e5
pin where x < 1e-9
gravity 0 0 -9.81
step 4 dt 1/60
expect volume 17
render bar.png
step 2
)";

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("argil_session_chart_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

TEST(SessionChart, ReplaysWithOtherLevelsSpacesAndSteps) {
  const auto folder = fresh_folder("replay");
  const SessionFile session{folder / "bar.argil", k_bar};
  const Replayed own = replay(session, nullptr, 0, {}, folder);
  EXPECT_EQ(own.run.model, "corotational");
  EXPECT_EQ(own.run.space, "default");
  EXPECT_EQ(own.run.level, 1);
  EXPECT_EQ(own.steps, 6U);
  EXPECT_NEAR(own.simulated, 0.1, 1e-12);
  EXPECT_FALSE(std::filesystem::exists(folder / "bar.png"));

  SessionRun run = own.run;
  EXPECT_EQ(replay(session, &run, 0, {}, folder).state_hash, own.state_hash);
  run.level = 0;
  run.space = "cubic";
  run.substeps = 2;
  const Replayed other = replay(session, &run, 0, {}, folder);
  EXPECT_EQ(other.steps, 12U);
  EXPECT_NEAR(other.simulated, 0.1, 1e-12);
  EXPECT_NEAR(other.time_step, 1.0 / 120, 1e-15);
  EXPECT_EQ(other.elements, 4U);
  EXPECT_EQ(other.topology, own.topology);
  EXPECT_EQ(other.points.cols(), own.points.cols());
}

TEST(SessionChart, LevelsAreSetWhereTheSessionSetsNone) {
  const auto folder = fresh_folder("levels");
  const SessionFile session{folder / "bar.argil", replaced(k_bar, "levels 1\n", "")};
  SessionRun run = replay(session, nullptr, 0, {}, folder).run;
  EXPECT_EQ(run.level, 0);
  run.level = 1;
  const SessionFile with{folder / "bar.argil", k_bar};
  // The same solid, fields and loads, by a line at another place.
  EXPECT_EQ(replay(session, &run, 0, {}, folder).points, replay(with, nullptr, 0, {}, folder).points);
}

TEST(SessionChart, ErrorsAreThoseOfTheReplays) {
  const auto folder = fresh_folder("errors");
  const SessionFile session{folder / "bar.argil", k_bar};
  Choice choice;
  choice.models = {"linear"};
  choice.integrators = {"implicit_euler"};
  Table table(folder / "chart.csv");
  const Panel panel = chart_session(session, choice, {}, table, folder, {});
  ASSERT_FALSE(panel.rows.empty());
  EXPECT_TRUE(panel.in_motion);
  const auto error_of = [&](const std::string& method, const std::string& space, int level, double time_step) {
    for (const Row& row : panel.rows)
      if (row.method() == method && row.space == space && row.resolution == level &&
          std::abs(row.time_step - time_step) < 1e-12)
        return row.error;
    ADD_FAILURE() << method << ' ' << space << ' ' << level;
    return 0.0;
  };
  // A coarser level of the default space is farther from the next one, and halving the step of the first-order
  // integrator brings it nearer.
  EXPECT_GT(error_of("corotational, bdf2", "default", 0, 1.0 / 60),
            1.5 * error_of("corotational, bdf2", "default", 1, 1.0 / 60));
  EXPECT_GT(error_of("corotational, implicit_euler", "default", 1, 1.0 / 60),
            error_of("corotational, implicit_euler", "default", 1, 1.0 / 120));
  EXPECT_GT(error_of("corotational, implicit_euler", "default", 1, 1.0 / 60),
            error_of("corotational, bdf2", "default", 1, 1.0 / 60));
  for (const Row& row : panel.rows) {
    EXPECT_EQ(row.status, Status::ok) << row.method() << row.message;
    EXPECT_EQ(row.same_law, row.model == "corotational");
  }
  // Nothing is done twice.
  const std::size_t rows = table.rows().size();
  const Panel again = chart_session(session, choice, {}, table, folder, {});
  EXPECT_EQ(table.rows().size(), rows);
  EXPECT_EQ(again.rows.size(), panel.rows.size());
}

TEST(SessionChart, ASessionThatSimulatesNothingIsRefused) {
  const auto folder = fresh_folder("nothing");
  const SessionFile session{folder / "bar.argil", "argil 1\nnew box 2 2 2\n"};
  Table table(folder / "chart.csv");
  EXPECT_THROW(static_cast<void>(chart_session(session, {}, {}, table, folder, {})), Error);
}

}  // namespace
}  // namespace argil::chart
