// The armchair (issue 2): what makes it a test of the whole, and that its two spaces and its painted legs do what
// they should.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/process.h"

namespace argil::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

double measured(const json& summary, const std::string& name) {
  for (const json& record : summary["measures"])
    if (record["name"] == name) return record["value"];
  ADD_FAILURE() << "the session does not measure " << name;
  return NAN;
}

class ArmchairSlow : public testing::Test {
 protected:
  // The session up to its first `commit`: all that is measured.
  ArmchairSlow() {
    const std::string whole = read_bytes(fs::path(ARGIL_SAMPLES_DIR) / "armchair.argil");
    folder_.write("begun.argil", whole.substr(0, whole.find("\ncommit")) + "\n");
  }
  json replay(const std::string& session, const std::string& set, int most_status = 0) {
    const Finished finished =
        run_argil({"replay", session, "--out", "out", "--quiet", "--no-pictures", "--set", set}, folder_.path());
    EXPECT_LE(finished.status, most_status) << finished.err;
    return read_json(folder_ / "out/summary.json");
  }
  TemporaryFolder folder_;
};

TEST_F(ArmchairSlow, SpacesAgreeAndPaintedLegsAreStiff) {
  const json standard = replay("begun.argil", "space=default");
  EXPECT_GE(standard["control_cells"], 60);
  EXPECT_GT(standard["cells"]["irregular"], 0);
  const json& elements = standard["elements"];
  EXPECT_EQ(elements["cubic"], 0);
  EXPECT_GT(elements["pyramid"], 0);
  EXPECT_GE(elements["linear"].get<int>() + elements["pyramid"].get<int>(), 3800);
  EXPECT_EQ(measured(standard, "pin_motion"), 0);

  const json cubic = replay((fs::path(ARGIL_SAMPLES_DIR) / "armchair.argil").string(), "space=cubic");
  EXPECT_GT(cubic["elements"]["cubic"], 0);
  EXPECT_GT(cubic["elements"]["pyramid"], 0);
  EXPECT_EQ(cubic["unknowns"], standard["unknowns"]);
  EXPECT_EQ(measured(cubic, "pin_motion"), 0);
  const double y = measured(standard, "tip_y"), z = measured(standard, "tip_z");
  const double size = std::hypot(y, z);
  EXPECT_GT(size, 0.05);  // [m]: the back leans visibly
  EXPECT_LE(std::hypot(measured(cubic, "tip_y") - y, measured(cubic, "tip_z") - z), 0.05 * size);

  const json soft = replay("begun.argil", "paint=young_modulus scale 1");
  EXPECT_GE(measured(soft, "leg_strain"), 5 * measured(standard, "leg_strain"));
}

}  // namespace
}  // namespace argil::tests
