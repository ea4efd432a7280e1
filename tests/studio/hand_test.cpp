// A device other than the mouse in the window: its first button makes a stroke which is a line of the session, what
// is felt comes back through the servo, and one that cannot be had or falls silent leaves the mouse.

#include <gtest/gtest.h>

#include "io/file_bytes.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "tools/studio/offscreen.h"

namespace argil::studio {
namespace {

namespace fs = std::filesystem;

OffscreenOptions options(const char* name) {
  OffscreenOptions result;
  result.width = 960;
  result.height = 640;
  result.card = false;
  result.bench.out = fs::path(testing::TempDir()) / "studio_hand" / name;
  fs::remove_all(result.bench.out);
  return result;
}

/// Goes to a place in its own frame, presses, draws upwards, lets go; and notes what force it was given.
class DrawingDevice : public sculpt::Device {
 public:
  DrawingDevice(const Eigen::Vector3d& from, const Eigen::Vector3d& by) : from_(from), by_(by) {}

  sculpt::DeviceCapabilities capabilities() const override {
    sculpt::DeviceCapabilities can;
    can.actuated_axes = 3;
    can.max_force = 5;
    can.workspace_low.setConstant(-0.1);
    can.workspace_high.setConstant(0.1);
    return can;
  }
  sculpt::DeviceSample exchange(const sculpt::ForceCommand& command, sculpt::Tick tick) override {
    const Eigen::Vector3d force = force_at(command, tick);
    largest_ = std::max(largest_, force.norm());
    if (ticks_ > 120 && ticks_ < 280) along_ += force.dot(by_.normalized());
    ++ticks_;
    sculpt::DeviceSample sample;
    const double share = std::clamp((static_cast<double>(ticks_) - 100) / 200, 0.0, 1.0);
    sample.pose.position = from_ + share * by_;
    sample.buttons = ticks_ > 60 && ticks_ < 320 ? 1U : 0U;
    sample.pressure = pressure_;
    sample.tick = tick;
    sample.mode = silent_ ? sculpt::DeviceMode::closed : sculpt::DeviceMode::force;
    return sample;
  }

  double largest_ = 0, along_ = 0, pressure_ = 1;
  bool silent_ = false;

 private:
  Eigen::Vector3d from_, by_;
  long ticks_ = 0;
};

TEST(StudioHand, AStrokeOfADeviceIsALineThatReplays) {
  Offscreen window(options("stroke"));
  window.wait(2);
  // The workspace of ±0.1 m lies over a ball about the block; its top is above the middle of the device's frame.
  const Snapshot& now = window.now();
  const double radius = 0.75 * (now.high - now.low).norm(), scale = 2 * radius / 0.2;
  const double top = 0.5 * (now.high.z() - now.low.z()) / scale;
  const auto device = std::make_shared<DrawingDevice>(Eigen::Vector3d(0, 0, top), Eigen::Vector3d(0, 0, 0.02));
  window.workshop().use_device("drawing", device);
  const double high = now.high.z();
  const std::size_t depth = now.undo_depth;
  window.wait(40);
  ASSERT_TRUE(window.workshop().device());
  EXPECT_EQ(window.workshop().device()->name, "drawing");
  EXPECT_FALSE(window.now().stroke);
  EXPECT_GT(window.now().undo_depth, depth);
  EXPECT_GT(window.now().high.z(), high + 0.01);
  EXPECT_GT(device->largest_, 0.1);  // it was felt, within what the device can
  EXPECT_LE(device->largest_, 5);
  EXPECT_LT(device->along_, 0);  // the clay draws the hand back
  EXPECT_EQ(window.workshop().lines_run_in_frames(), 0);

  const std::uint64_t made = window.workshop().bench().session().document().state_hash();
  sculpt::SessionOptions replay;
  replay.out = options("replayed").bench.out;
  sculpt::Session session(replay);
  session.run_text(io::read_file(window.workshop().bench().session().journal_path()), "journal");
  EXPECT_EQ(session.document().state_hash(), made);
}

TEST(StudioHand, ThePressureOfADeviceCountsAsThatOfAPen) {
  const auto line = [](const char* name, PenScales scales) {
    Offscreen window(options(name));
    window.studio().desk().settings.pen = scales;
    window.wait(2);
    const Snapshot& now = window.now();
    const double top = 0.5 * (now.high.z() - now.low.z()) * 0.2 / (1.5 * (now.high - now.low).norm());
    const auto device = std::make_shared<DrawingDevice>(Eigen::Vector3d(0, 0, top), Eigen::Vector3d(0, 0, 0.02));
    device->pressure_ = 0.5;
    window.workshop().use_device("drawing", device);
    window.wait(40);
    const std::string journal = io::read_file(window.workshop().bench().session().journal_path());
    const std::size_t begin = journal.rfind("\nstroke path");
    return begin == journal.npos ? "" : journal.substr(begin + 1, journal.find('\n', begin + 1) - begin - 1);
  };
  EXPECT_NE(line("pressed", PenScales::strength).find(" pressures 0.5 0.5"), std::string::npos);
  EXPECT_NE(line("sized", PenScales::radius).find("0.5 scales radius"), std::string::npos);
  const std::string off = line("unpressed", PenScales::nothing);
  EXPECT_FALSE(off.empty());
  EXPECT_EQ(off.find("pressures"), std::string::npos);
}

TEST(StudioHand, AStrokeOfTheMouseIsItsOwn) {
  const auto drawn = [](const char* name, bool beside) {
    Offscreen window(options(name));
    if (beside)
      window.workshop().use_device(
          "far", std::make_shared<DrawingDevice>(Eigen::Vector3d(0.1, 0.1, 0.1), Eigen::Vector3d(-0.1, 0, 0)));
    window.wait(2);
    window.drag(430, 220, 440, 170, 12);
    window.wait(2);
    EXPECT_GT(window.now().undo_depth, 7U);
    return window.workshop().bench().session().document().state_hash();
  };
  EXPECT_EQ(drawn("mouse_beside", true), drawn("mouse_alone", false));
}

TEST(StudioHand, TheDeviceIsSeenFromWhereTheViewerStands) {
  const sculpt::WorldFromDevice mapping =
      mapping_over(sculpt::DeviceCapabilities{}, {1, 2, 3}, 0.5, Eigen::Vector3d(0, 1, -0.5));
  EXPECT_TRUE(mapping.position(Eigen::Vector3d::Zero()).isApprox(Eigen::Vector3d(1, 2, 3), 1e-12));
  EXPECT_TRUE(mapping.position(Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1.5, 2, 3), 1e-12));
  EXPECT_TRUE(mapping.position(Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(1, 2.5, 3), 1e-12));
  EXPECT_TRUE(mapping.position(Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 2, 3.5), 1e-12));
  EXPECT_TRUE(mapping_over(sculpt::DeviceCapabilities{}, {0, 0, 0}, 1, -Eigen::Vector3d::UnitZ())
                  .rotation.coeffs()
                  .allFinite());
}

TEST(StudioHand, OneThatFallsSilentLeavesTheMouse) {
  Offscreen window(options("silent"));
  const auto device = std::make_shared<DrawingDevice>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  device->silent_ = true;
  window.workshop().use_device("drawing", device);
  window.wait(10);
  EXPECT_TRUE(window.workshop().device());
  window.wait(130);
  EXPECT_FALSE(window.workshop().device());
  EXPECT_NE(window.now().messages.back().text.find("drawing does not answer"), std::string::npos);
}

TEST(StudioHand, TheDialogueListsThemAndSaysWhatIsMissing) {
  OffscreenOptions with = options("dialogue");
  const auto device = std::make_shared<DrawingDevice>(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  with.devices.list = [] {
    return std::vector<DeviceChoice>{{"mouse", "a mouse or pen", "always there", true},
                                     {"hand", "a hand", "is there", true},
                                     {"gamepad", "a gamepad", "none is plugged in", false}};
  };
  with.devices.open = [&](const std::string& name) -> std::shared_ptr<sculpt::Device> {
    if (name == "hand") return device;
    throw Error(ErrorCode::not_found, "there is no " + name);
  };
  Offscreen window(with);
  window.press("Ctrl-D");
  window.wait(3);
  EXPECT_EQ(window.studio().ui().find("Use gamepad"), nullptr);
  window.click("Use hand");
  window.wait(3);
  ASSERT_TRUE(window.workshop().device());
  EXPECT_EQ(window.workshop().device()->name, "hand");
  window.press("Ctrl-D");
  window.wait(3);
  window.click("Use mouse");
  window.wait(3);
  EXPECT_FALSE(window.workshop().device());
  window.workshop().use_device("network 1.2.3.4:5");
  window.wait(3);
  EXPECT_FALSE(window.workshop().device());
  EXPECT_NE(window.now().messages.back().text.find("the mouse sculpts"), std::string::npos);
}

}  // namespace
}  // namespace argil::studio
