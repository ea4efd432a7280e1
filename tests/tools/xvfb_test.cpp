// The window itself, on a virtual display with real X events; what it saved replays. Where there is no such display
// the test is passed over.

#include <gtest/gtest.h>

#include <cstdlib>

#include "process.h"

namespace argil::tests {
namespace {

TEST(XvfbSlow, AStrokeByRealEventsIsSavedAndReplays) {
  if (std::system("command -v xvfb-run >/dev/null && command -v xdotool >/dev/null") != 0)
    GTEST_SKIP() << "xvfb and xdotool are not installed";
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "out";
  const Finished drawn = run_program("/bin/sh",
                                     {"-c", "exec xvfb-run -a -s '-screen 0 1440x900x24' bash " ARGIL_SOURCE_DIR
                                            "/tests/tools/xvfb_strokes.sh " ARGIL_PROGRAM " " +
                                                out.string()},
                                     folder.path());
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const Finished replayed = run_argil({"replay", "out/saved.argil", "--out", "replayed"}, folder.path());
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  const Finished journal = run_argil({"replay", "out/journal.argil", "--out", "again"}, folder.path());
  ASSERT_EQ(journal.status, 0) << journal.err;
  EXPECT_EQ(read_json(folder / "replayed/summary.json")["state_hash"],
            read_json(folder / "again/summary.json")["state_hash"]);
  EXPECT_GT(read_json(folder / "replayed/summary.json")["steps"].get<int>(), 5);
}

}  // namespace
}  // namespace argil::tests
