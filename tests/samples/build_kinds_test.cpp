// SESSION.md, "Promises": the same hash in Debug and in Release. The other program is that of the build with the
// sanitizers, which tools/test makes first; alone, this test is skipped.

#include <gtest/gtest.h>

#include "tests/tools/process.h"
#include "tests/tools/small_session.h"

namespace argil::tests {
namespace {

TEST(BuildKinds, DebugAndReleaseGiveTheSameBitsAtEveryStep) {
  const std::filesystem::path other = ARGIL_SANITIZED_PROGRAM;
  if (!std::filesystem::exists(other)) GTEST_SKIP() << "there is no " << other;
  const TemporaryFolder folder;
  folder.write("small.argil", small_session());
  for (const char* space : {"space=default", "space=cubic"}) {
    std::string traces[2];
    for (const bool debug : {false, true}) {
      const Finished finished =
          run_program(debug ? other : std::filesystem::path(ARGIL_PROGRAM),
                      {"replay", "small.argil", "--out", "out", "--quiet", "--set", space, "--hash-trace", "trace"},
                      folder.path());
      ASSERT_EQ(finished.status, 0) << finished.err;
      traces[debug ? 1 : 0] = read_bytes(folder / "trace");
    }
    EXPECT_EQ(traces[0], traces[1]) << space;
  }
}

}  // namespace
}  // namespace argil::tests
