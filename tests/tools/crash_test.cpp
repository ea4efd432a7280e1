// A program that is killed at any moment of a long editing session loses no command that it had finished.
// ARGIL_KILLS asks for more than the few of every day.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <sstream>

#include "process.h"

namespace argil::tests {
namespace {

// Edits of every kind, with their undos and redos; no line may fail.
std::string long_session() {
  std::string text = "argil 1\nnew box 3 3 3\n";
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  for (int i = 0; i < 80; ++i) {
    text += fmt::format("select faces where {} > {:.3f}\n", "xyz"[random() % 3], number(0.2, 0.9));
    switch (random() % 6) {
      case 0:
      case 1:
        text += fmt::format("extrude {:.3f} scale {:.3f}\n", number(0.05, 0.2), number(0.8, 1.1));
        text += random() % 2 ? "undo\nredo\nundo\n" : "undo\n";
        break;
      case 2:
        text += fmt::format("move {:.4f} {:.4f} {:.4f}\n", number(-0.01, 0.01), number(-0.01, 0.01),
                            number(-0.01, 0.01));
        break;
      case 3:
        text += fmt::format("select cells as kept{} where x + y > {:.3f}\n", i, number(0.5, 1.2));
        break;
      case 4:
        text += fmt::format("select edges angle 40\nsharpen {}\n", random() % 2 ? 10 : 0);
        break;
      default:
        text += fmt::format("peak {:.3f} where z > {:.3f} and x < {:.3f}\n", number(0.1, 0.2), number(0.9, 0.95),
                            number(0.4, 0.9));
        text += random() % 3 ? "undo\n" : "";
    }
    if (i % 40 == 39) text += "levels 1\nset density 300 + 100*x\npin where z < 0.01\nlevels 0\n";
  }
  return text;
}

TEST(Crash, EveryFinishedCommandIsRestored) {
  const TemporaryFolder folder;
  folder.write("edits.argil", long_session());
  const Finished whole =
      run_argil({"replay", "edits.argil", "--out", "whole", "--quiet", "--hash-trace", "trace"}, folder.path());
  ASSERT_EQ(whole.status, 0) << whole.err;
  std::vector<std::string> hashes;  // after each command
  std::istringstream trace(read_bytes(folder / "trace"));
  for (std::string line; std::getline(trace, line);) hashes.push_back(line.substr(line.rfind(' ') + 1));
  const std::string journal = read_bytes(folder / "whole/journal.argil");

  const char* asked = std::getenv("ARGIL_KILLS");
  const int kills = asked ? std::atoi(asked) : 4;
  std::mt19937 random(11);
  int killed = 0, commands = 0;
  for (int i = 0; i < kills; ++i) {
    std::filesystem::remove_all(folder / "out");
    killed += run_and_kill(ARGIL_PROGRAM, {"replay", "edits.argil", "--out", "out", "--quiet"}, folder.path(),
                           folder / "out/journal.argil", random() % journal.size(), random() % 3000000)
                  ? 1
                  : 0;
    const std::string left = read_bytes(folder / "out/journal.argil");
    ASSERT_TRUE(journal.starts_with(left));
    const auto finished = static_cast<std::size_t>(std::count(left.begin(), left.end(), '\n'));
    if (finished < 2) continue;  // its first line names the version
    std::filesystem::remove_all(folder / "restored");
    const Finished restored =
        run_argil({"restore", "out/journal.argil", "--out", "restored", "--quiet"}, folder.path());
    ASSERT_EQ(restored.status, 0) << restored.err;
    EXPECT_EQ(read_json(folder / "restored/summary.json")["state_hash"], hashes.at(finished - 2));
    commands += static_cast<int>(finished) - 1;
  }
  std::printf("%d of %d programs killed, %d commands restored\n", killed, kills, commands);
  EXPECT_GT(killed, kills / 2);
}

TEST(Crash, AHalfWrittenLastLineIsLeftOut) {
  const TemporaryFolder folder;
  folder.write("journal.argil", "argil 1\nnew box 2 2 2\nextrude 0.1 whe");
  const Finished restored = run_argil({"restore", "journal.argil", "--out", "restored"}, folder.path());
  EXPECT_EQ(restored.status, 0);
  EXPECT_NE(restored.err.find("extrude 0.1 whe"), std::string::npos);
  EXPECT_EQ(read_bytes(folder / "restored/journal.argil"), "argil 1\nnew box 2 2 2\n");
}

TEST(Crash, AJournalThatIsThereIsKeptBesideTheNewOne) {
  const TemporaryFolder folder;
  folder.write("one.argil", "argil 1\nnew box 2 2 2\n");
  folder.write("two.argil", "argil 1\nnew box 1 1 1\n");
  EXPECT_EQ(run_argil({"replay", "one.argil", "--out", "out"}, folder.path()).status, 0);
  EXPECT_EQ(run_argil({"replay", "two.argil", "--out", "out"}, folder.path()).status, 0);
  EXPECT_EQ(read_bytes(folder / "out/journal.previous.argil"), "argil 1\nnew box 2 2 2\n");
}

}  // namespace
}  // namespace argil::tests
