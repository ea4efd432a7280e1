// A studio that is killed at any moment: the next window offers what was done, every finished stroke of it, and no
// file is damaged. ARGIL_KILLS asks for more than the few of every day.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <sstream>

#include "process.h"

namespace argil::tests {
namespace {

constexpr int k_strokes = 8;

/// Strokes with what belongs to a session between them; after each the state is told.
std::string long_script() {
  std::string text = "size 960 640\nwait 2\n";
  for (int i = 0; i < k_strokes; ++i) {
    text += fmt::format("key {}\n", i % 3 == 2 ? "7" : i % 3 == 1 ? "2" : "1");
    text += fmt::format("drag {0} {1} {2} {3} 6\nwait 2\nprint hash\n", 380 + 15 * (i % 4), 230 + 9 * (i % 3),
                        400 + 10 * i, 190 + 5 * i);
    if (i % 4 == 3) text += "key Ctrl-Z\nwait 2\nprint hash\nkey Ctrl-Shift-Z\nwait 2\nprint hash\n";
  }
  return text;
}

std::vector<std::string> hashes_of(const std::string& said) {
  std::vector<std::string> hashes;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("hash ")) hashes.push_back(line.substr(5));
  return hashes;
}

TEST(StudioCrashSlow, EveryFinishedStrokeComesBack) {
  const TemporaryFolder folder;
  folder.write("long.txt", long_script());
  folder.write("back.txt", "size 960 640\nwait 2\nclick \"Bring back\"\nwait 2\nprint hash\nexpect unsaved 0\n");
  const Finished whole = run_argil({"studio", "--script", "long.txt", "--out", "whole"}, folder.path());
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::vector<std::string> hashes = hashes_of(whole.out);
  ASSERT_EQ(hashes.size(), k_strokes + 2U * (k_strokes / 4));
  const std::string journal = read_bytes(folder / "whole/journal.argil");

  const char* asked = std::getenv("ARGIL_KILLS");
  const int kills = asked ? std::atoi(asked) : 3;
  std::mt19937 random(23);
  int killed = 0, offered = 0;
  for (int i = 0; i < kills; ++i) {
    std::filesystem::remove_all(folder / "out");
    killed += run_and_kill(ARGIL_PROGRAM, {"studio", "--script", "long.txt", "--out", "out"}, folder.path(),
                           folder / "out/journal.argil", random() % journal.size(), random() % 400000000)
                  ? 1
                  : 0;
    const std::string left = read_bytes(folder / "out/journal.argil");
    ASSERT_TRUE(journal.starts_with(left)) << left;
    // What a replay of the whole lines gives is what comes back.
    std::string lines = left.substr(0, left.rfind('\n') + 1);
    folder.write("left.argil", lines);
    std::filesystem::remove_all(folder / "replayed");
    ASSERT_EQ(run_argil({"replay", "left.argil", "--out", "replayed", "--quiet"}, folder.path()).status, 0);
    const std::string expected = read_json(folder / "replayed/summary.json")["state_hash"];
    const auto strokes = [](const std::string& text) {
      int count = 0;
      for (std::size_t at = 0; (at = text.find("\nstroke ", at)) != std::string::npos; ++at) ++count;
      return count;
    };
    const Finished back = run_argil({"studio", "--script", "back.txt", "--out", "out"}, folder.path());
    if (back.status != 0) {
      // Nothing had been done but the block: there is nothing to offer.
      EXPECT_EQ(strokes(lines), 0) << back.err;
      EXPECT_NE(back.err.find("Bring back"), std::string::npos) << back.err;
      continue;
    }
    ++offered;
    EXPECT_EQ(hashes_of(back.out).at(0), expected);
  }
  std::printf("%d of %d studios killed, %d had work, all of it came back\n", killed, kills, offered);
  EXPECT_GT(killed, kills / 2);
}

}  // namespace
}  // namespace argil::tests
