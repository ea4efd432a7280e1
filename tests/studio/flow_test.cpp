// The way of samples/studio/clay.txt, from a new box to a saved and reopened session: one hash, and the pictures
// that docs/studio.md shows. ARGIL_UPDATE_REFERENCES=1 in the environment writes those anew; look at them before
// committing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "io/file_bytes.h"
#include "io/image.h"
#include "sculpt/session.h"
#include "tools/studio/script.h"

namespace argil::studio {
namespace {

namespace fs = std::filesystem;

/// Share of pixels that differ by more than `far` of 255 in a colour.
double far_share(const io::Image& a, const io::Image& b, int far) {
  if (a.width != b.width || a.height != b.height) return 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 3 < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.rgba[i + c] - b.rgba[i + c]));
    count += most > far ? 1 : 0;
  }
  return static_cast<double>(count) / (static_cast<double>(a.rgba.size()) / 4);
}

TEST(FlowSlow, FromABoxToASavedSessionWithOneHash) {
  const fs::path out = fs::path(testing::TempDir()) / "studio_flow";
  fs::remove_all(out);
  OffscreenOptions options;
  options.bench.out = options.bench.save_root = out;
  Offscreen window(options);
  const fs::path script = fs::path(ARGIL_SAMPLES_DIR) / "studio" / "clay.txt";
  std::vector<std::string> hashes;
  const ScriptResult result = run_script(io::read_file(script), script.string(), window, out,
                                         [&](const std::string& line) { hashes.push_back(line); });
  EXPECT_EQ(result.failed, 0);
  EXPECT_EQ(result.pictures, 5);
  // Pulled; painted inside; three undone; one redone; reopened.
  ASSERT_EQ(hashes.size(), 5U);
  EXPECT_NE(hashes[1], hashes[0]);
  EXPECT_NE(hashes[2], hashes[0]);
  EXPECT_EQ(hashes[3], hashes[0]);  // of the three, the stroke that pulled came back
  EXPECT_EQ(hashes[4], hashes[3]);

  sculpt::SessionOptions replay;
  replay.out = out / "replayed";
  sculpt::Session session(replay);
  session.run_text(io::read_file(out / "clay.argil"), "clay.argil");
  EXPECT_EQ(session.document().state_hash(), window.workshop().bench().session().document().state_hash());

  const char* const wish = std::getenv("ARGIL_UPDATE_REFERENCES");
  const fs::path shown = fs::path(ARGIL_SOURCE_DIR) / "docs" / "pictures";
  for (const char* name : {"clay_1_extruded.png", "clay_2_pulled.png", "clay_3_painted.png", "clay_4_inside.png"}) {
    if (wish != nullptr && std::string(wish) == "1")
      fs::copy_file(out / name, shown / name, fs::copy_options::overwrite_existing);
    // Letters and edges differ by a pixel between versions of fonts and of Mesa.
    EXPECT_LT(far_share(io::read_png(out / name), io::read_png(shown / name), 48), 0.02) << name;
  }
}

}  // namespace
}  // namespace argil::studio
