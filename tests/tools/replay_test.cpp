// `argil replay` and `argil diff`, run as a user runs them: the summary, the promises about hashes, where files go.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/tools/process.h"
#include "tests/tools/small_session.h"

namespace argil::tests {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class Replay : public testing::Test {
 protected:
  Replay() { folder_.write("small.argil", small_session()); }
  Finished argil(const std::vector<std::string>& arguments) { return run_argil(arguments, folder_.path()); }
  /// Replays into the folder `out` and reads the summary.
  json summary(const std::string& session, const std::string& out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"replay", session, "--out", out, "--quiet"});
    const Finished finished = argil(more);
    EXPECT_EQ(finished.status, 0) << finished.err;
    return read_json(folder_ / out / "summary.json");
  }
  TemporaryFolder folder_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string with_line(const std::string& text, std::size_t number, const std::string& line) {
  std::string changed;
  const auto lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) changed += (i + 1 == number ? line : lines[i]) + "\n";
  return changed;
}

TEST_F(Replay, SummaryHoldsWhatAProgramMayRead) {
  const Finished finished = argil({"replay", "small.argil", "--json", "--threads", "2"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  const json found = json::parse(finished.out);
  EXPECT_EQ(found, read_json(folder_ / "out/small/summary.json"));
  EXPECT_EQ(found["version"], ARGIL_VERSION);
  EXPECT_EQ(found["steps"], 6 + 3);  // 100 ticks hold six sixtieths of a second
  EXPECT_EQ(found["space"], "default");
  EXPECT_EQ(found["threads"], 2);
  EXPECT_EQ(found["state_hash"].get<std::string>().size(), 16U);
  // Six hexahedra give eight cells each; the pyramid gives four hexahedra and its apex's cell of eight faces, which
  // eight pyramids fill.
  const json &cells = found["cells"], &elements = found["elements"];
  EXPECT_EQ(cells["regular"].get<int>() + cells["extraordinary"].get<int>() + cells["irregular"].get<int>(), 53);
  EXPECT_EQ(cells["irregular"], 1);
  EXPECT_EQ(cells["regular_published"], 0);
  EXPECT_EQ(elements, json({{"cubic", 0}, {"linear", 52}, {"pyramid", 8}}));
  EXPECT_TRUE(found["unknowns"].is_number_integer());
  EXPECT_GT(found["unknowns"], 0);
  EXPECT_GT(found["solver_iterations"], 9);
  EXPECT_GT(found["energy"], 0);
  EXPECT_NEAR(found["mass"].get<double>(), 1000 * found["volume"].get<double>(), 5e-2);
  const json& ms = found["ms_per_step"];
  EXPECT_GE(ms["p99"], ms["median"]);
  double parts = 0;
  for (const char* part : {"forces", "tangent", "solve", "line_search", "other"}) parts += ms[part].get<double>();
  EXPECT_NEAR(parts, ms["mean"], 1e-9 * parts);
  EXPECT_EQ(found["measures"][0]["name"], "pin_motion");
  EXPECT_EQ(found["expectations"], json({{"checked", 1}, {"failed", 0}}));
}

TEST_F(Replay, AFailedExpectationGivesStatusOneWithItsPlace) {
  folder_.write("off.argil",
                "argil 1\nnew box size 1 2 3\nexpect volume 5 within 1%\nexpect volume above 5\nsave a.obj\n");
  const Finished finished = argil({"replay", "off.argil"});
  EXPECT_EQ(finished.status, 1);
  EXPECT_THAT(finished.err, HasSubstr("off.argil:3:1: expected volume 5 within 1% m^3, found 6 m^3"));
  EXPECT_THAT(finished.err, testing::Not(HasSubstr("off.argil:4")));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/off/a.obj"));  // the session goes on
  EXPECT_EQ(read_json(folder_ / "out/off/summary.json")["expectations"], json({{"checked", 2}, {"failed", 1}}));
}

TEST_F(Replay, AnyNumberOfThreadsGivesTheSameBitsAtEveryStep) {
  for (const char* space : {"default", "cubic"}) {
    const std::string set = std::string("space=") + space;
    const json one = summary("small.argil", "one", {"--threads", "1", "--hash-trace", "one.trace", "--set", set});
    const json two = summary("small.argil", "two", {"--threads", "2", "--hash-trace", "two.trace", "--set", set});
    EXPECT_EQ(one["space"], space);
    EXPECT_EQ(one["state_hash"], two["state_hash"]);
    const std::string trace = read_bytes(folder_ / "one.trace");
    EXPECT_EQ(trace, read_bytes(folder_ / "two.trace"));
    EXPECT_GT(lines_of(trace).size(), 20U);
    EXPECT_EQ(argil({"diff", "one.trace", "two.trace"}).status, 0);
  }
}

TEST_F(Replay, TracesAStepARowAndRefusesToOverwriteTheSession) {
  (void)summary("small.argil", "out", {"--trace", "steps.csv"});
  const auto lines = lines_of(read_bytes(folder_ / "steps.csv"));
  ASSERT_EQ(lines.size(), 1U + 9);  // as many steps as the summary counts
  EXPECT_TRUE(lines[0].starts_with("step,line,time_s,kinetic_J,elastic_J,"));
  EXPECT_TRUE(lines[9].starts_with("9,"));
  const Finished refused = argil({"replay", "small.argil", "--trace", "small.argil"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--trace"));
}

TEST_F(Replay, UndoOfEverythingAndRedoLeavesTheStateAsItWas) {
  std::string again = small_session();
  again += "undo all\nredo all\nundo 2\nredo 2\n";
  folder_.write("again.argil", again);
  EXPECT_EQ(summary("again.argil", "a")["state_hash"], summary("small.argil", "b")["state_hash"]);
}

TEST_F(Replay, ItsJournalReplaysToTheSameState) {
  const json recorded = summary("small.argil", "first", {"--set", "space=cubic", "--set", "set=young_modulus 1e4"});
  const json replayed = summary("first/journal.argil", "second");
  EXPECT_EQ(recorded["state_hash"], replayed["state_hash"]);
}

TEST_F(Replay, DiffNamesTheFirstCommandAndStepThatDiffer) {
  const std::string session = small_session();
  const auto lines = lines_of(session);
  const auto stroke = static_cast<std::size_t>(
      std::find_if(lines.begin(), lines.end(), [](const std::string& line) { return line.starts_with("stroke"); }) -
      lines.begin() + 1);
  // The device is at the same place at its first tick only: one step passes, in which both have been apart already.
  folder_.write("other.argil",
                with_line(session, stroke, "stroke from 0.05 0.05 0.2 to 0.1 0.05 0.2501 ticks 100"));
  (void)summary("small.argil", "a", {"--hash-trace", "a.trace"});
  (void)summary("other.argil", "b", {"--hash-trace", "b.trace"});
  const Finished finished = argil({"diff", "a.trace", "b.trace", "--json"});
  EXPECT_EQ(finished.status, 1);
  const json found = json::parse(finished.out);
  EXPECT_EQ(found["same"], false);
  EXPECT_EQ(found["line"], stroke);
  EXPECT_EQ(found["command"], "step");
  EXPECT_EQ(found["step"], 1);
  EXPECT_THAT(argil({"diff", "a.trace", "b.trace"}).out,
              HasSubstr(fmt::format("'step' in line {}, step 1", stroke)));
  // A trace that ends early differs where it ends.
  const std::string trace = read_bytes(folder_ / "a.trace");
  folder_.write("short.trace", trace.substr(0, trace.find('\n') + 1));
  EXPECT_EQ(argil({"diff", "short.trace", "a.trace"}).status, 1);
  EXPECT_THAT(argil({"diff", "short.trace", "a.trace"}).out, HasSubstr("short.trace: the trace has ended"));
}

TEST_F(Replay, UntilStopsInTheStateOfThatStep) {
  (void)summary("small.argil", "all", {"--hash-trace", "trace"});
  for (const int until : {1, 4, 7}) {  // in the stroke, and after it
    const json found = summary("small.argil", "some", {"--until", std::to_string(until)});
    EXPECT_EQ(found["steps"], until);
    EXPECT_THAT(read_bytes(folder_ / "trace"),
                HasSubstr(fmt::format(" step {} {}\n", until, found["state_hash"].get<std::string>())));
  }
}

TEST_F(Replay, WritesBeneathItsOutFolderAndNowhereElse) {
  const std::string session = small_session() + "save deep/er/a.vtu\nsave b.obj\nrender c.png size 40 30\n";
  folder_.write("small.argil", session);
  (void)summary("small.argil", "results/here");
  EXPECT_THAT(folder_.files(),
              ElementsAre("results/here/b.obj", "results/here/c.png", "results/here/deep/er/a.vtu",
                          "results/here/journal.argil", "results/here/summary.json", "small.argil"));
  std::filesystem::remove_all(folder_ / "results");
  (void)argil({"replay", "small.argil", "--no-pictures"});
  EXPECT_THAT(folder_.files(), ElementsAre("out/small/b.obj", "out/small/deep/er/a.vtu", "out/small/journal.argil",
                                           "out/small/summary.json", "small.argil"));
}

TEST_F(Replay, SetStandsInForCommandsOfTheSession) {
  EXPECT_EQ(summary("small.argil", "a", {"--set", "levels=2"})["levels"], 2);
  const json cubic = summary("small.argil", "b", {"--set", "space=cubic", "--set", "levels=2"});
  EXPECT_EQ(cubic["space"], "cubic");
  EXPECT_GT(cubic["elements"]["cubic"], 0);
  EXPECT_GT(cubic["elements"]["pyramid"], 0);
}

TEST_F(Replay, SharpEdgesMakeEveryCellOfABlockRegular) {
  folder_.write("sharp.argil",
                "argil 1\nnew box 12 12 12\nselect edges angle 30\nsharpen 10\nspace cubic split 0\n");
  const json found = summary("sharp.argil", "out");
  EXPECT_EQ(found["cells"],
            json({{"regular", 1728}, {"regular_published", 1000}, {"extraordinary", 0}, {"irregular", 0}}));
  EXPECT_EQ(found["elements"], json({{"cubic", 1728}, {"linear", 0}, {"pyramid", 0}}));
}

TEST_F(Replay, LinesMayEndAsOtherSystemsEndThemAndTheLastOneNotAtAll) {
  const std::string session = "argil 1\nnew box 2 2 2\nlevels 1\nsave a.obj";
  folder_.write("unix.argil", session);
  std::string other = "\xef\xbb\xbf";
  for (const char c : session) other += c == '\n' ? std::string("\r\n") : std::string(1, c);
  folder_.write("dos.argil", other);
  EXPECT_EQ(summary("unix.argil", "a")["state_hash"], summary("dos.argil", "b")["state_hash"]);
  EXPECT_EQ(read_bytes(folder_ / "a/a.obj"), read_bytes(folder_ / "b/a.obj"));
}

}  // namespace
}  // namespace argil::tests
