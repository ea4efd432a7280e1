// Series of files, read back and compared with what the session was at their times.

#include "sculpt/recording.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>

#include "io/surface.h"
#include "io/volume_mesh.h"
#include "sculpt/export.h"
#include "subdiv/cell_lists.h"
#include "tests/io/glb_frames.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> k_swing{"new box 3 1 1 size 0.3 0.1 0.1", "levels 1", "set young_modulus 1e4",
                                       "pin where x < 0.01", "gravity 0 0 -9.81"};

/// What the surface was at each time that the simulation came to.
struct Seen {
  std::map<double, io::SurfaceMesh> surfaces;
  void operator()(const Document& document) {
    surfaces[document.state().motion->time] =
        surface_mesh(document.refinement().solid(), document.surface_nodes(document.positions()));
  }
  const io::SurfaceMesh& at(double time) const {
    const auto found = surfaces.lower_bound(time - 1e-9);
    return found->second;
  }
};

class Recorded : public testing::Test {
 protected:
  Recorded() : test_({}, options(seen_)) {
    test_.run(k_swing);
    seen_(test_.document());
  }
  static SessionOptions options(Seen& seen) {
    SessionOptions options;
    options.write_journal = false;
    options.stepped = [&](const Document& document) { seen(document); };
    return options;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(test_.folder().path()))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  /// Time and file of each frame of a collection.
  std::vector<std::pair<double, std::string>> collection(const std::string& name) const {
    pugi::xml_document xml;
    EXPECT_TRUE(xml.load_string(test_.folder().text_of(name).c_str()));
    std::vector<std::pair<double, std::string>> frames;
    EXPECT_STREQ(xml.child("VTKFile").attribute("type").value(), "Collection");
    for (const pugi::xml_node& set : xml.child("VTKFile").child("Collection").children("DataSet"))
      frames.emplace_back(set.attribute("timestep").as_double(), set.attribute("file").value());
    return frames;
  }

  Seen seen_;
  TestSession test_;
};

TEST_F(Recorded, VolumeMeshesWithTheirTimes) {
  test_.run({"record swing.pvd every 2", "step 5 dt 0.01", "record stop", "step"});
  const auto frames = collection("swing.pvd");
  ASSERT_EQ(frames.size(), 3U);  // at 0, 0.02 and 0.04 s
  EXPECT_THAT(files(), ElementsAre("swing.pvd", "swing_0000.vtu", "swing_0001.vtu", "swing_0002.vtu"));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(frames[i].first, 0.02 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(frames[i].second, fmt::format("swing_{:04}.vtu", i));
    const io::VolumeMesh mesh = io::read_volume_mesh(test_.folder().path() / frames[i].second);
    // Every point of the surface is one of the mesh, in doubles.
    const io::SurfaceMesh& surface = seen_.at(frames[i].first);
    for (Eigen::Index v = 0; v < surface.positions.cols(); ++v) {
      double nearest = 1;
      for (Eigen::Index p = 0; p < mesh.cells.positions.cols(); ++p)
        nearest = std::min(nearest, (mesh.cells.positions.col(p) - surface.positions.col(v)).norm());
      EXPECT_EQ(nearest, 0);
    }
    EXPECT_FALSE(mesh.point_fields.empty());
  }
}

TEST_F(Recorded, NumberedSurfacesBySimulatedSeconds) {
  test_.run({"record swing.obj fps 25", "step 12 dt 1/60", "record swing.obj stop"});
  // Frames at 0.04, 0.08, … come with the steps of 3/60, 5/60, 8/60, 10/60 and 12/60 s.
  const double times[] = {0, 3.0 / 60, 5.0 / 60, 8.0 / 60, 10.0 / 60, 12.0 / 60};
  EXPECT_EQ(files().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const io::SurfaceMesh mesh = io::read_surface(test_.folder().path() / fmt::format("swing_{:04}.obj", i));
    const io::SurfaceMesh& wanted = seen_.at(times[i]);
    EXPECT_EQ(mesh.corners, wanted.corners);
    EXPECT_LT((mesh.positions - wanted.positions).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST_F(Recorded, OneAnimatedSurface) {
  test_.run({"step 3 dt 1/60", "record swing.glb", "step 10"});
  test_->end_recordings();
  const io::GlbFrames glb = io::read_glb_frames(test_.folder().text_of("swing.glb"));
  ASSERT_EQ(glb.times.size(), 11U);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_NEAR(glb.times[i], static_cast<double>(i) / 60, 1e-7);
    const Eigen::Matrix3Xd found = glb.at("POSITION", glb.times[i]);
    const io::SurfaceMesh& wanted = seen_.at((3.0 + static_cast<double>(i)) / 60);
    // Points are vertices, split at creases, of which this soft body may have none at first.
    ASSERT_GE(found.cols(), wanted.positions.cols());
    for (Eigen::Index p = 0; p < found.cols(); ++p) {
      double nearest = 1;
      for (Eigen::Index v = 0; v < wanted.positions.cols(); ++v)
        nearest = std::min(nearest, (found.col(p) - wanted.positions.col(v)).norm());
      EXPECT_LT(nearest, 1e-7);  // single precision of 0.3 m
    }
  }
  EXPECT_THAT(files(), ElementsAre("swing.glb"));
}

TEST_F(Recorded, WithoutWhatUndoTakesBack) {
  test_.run({"record a.pvd", "record a.glb", "record a.obj", "step 3 dt 0.01", "step 4", "undo", "gravity 0 0 5",
             "step 2", "step 1", "undo", "record stop"});
  const auto frames = collection("a.pvd");
  ASSERT_EQ(frames.size(), 6U);  // 0 … 0.05 s
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_NEAR(frames[i].first, 0.01 * static_cast<double>(i), 1e-12);
  EXPECT_EQ(files().size(), 1U + 1 + 6 + 6);
  const io::GlbFrames glb = io::read_glb_frames(test_.folder().text_of("a.glb"));
  EXPECT_EQ(glb.times.size(), 6U);
  const io::SurfaceMesh last = io::read_surface(test_.folder().path() / "a_0005.obj");
  const io::SurfaceMesh now = surface_mesh(test_.document().refinement().solid(),
                                           test_.document().surface_nodes(test_.document().positions()));
  EXPECT_LT((last.positions - now.positions).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(Recorded, AsTextWithTheSessionThatEnds) {
  TestSession run;
  std::string text = "argil 1\n";
  for (const std::string& line : k_swing) text += line + "\n";
  run->run_text(text + "record \"a & b.pvd\"\nrecord b.glb\nstep 2 dt 0.01\n", "run");
  EXPECT_TRUE(std::filesystem::exists(run.folder().path() / "b.glb"));
  EXPECT_THAT(run.folder().text_of("a & b.pvd"), HasSubstr("file=\"a &amp; b_0002.vtu\""));
  EXPECT_TRUE(run->recordings().empty());
}

TEST_F(Recorded, WhileTheSolidKeepsItsShapeOfCells) {
  test_.run({"record a.glb", "record a.pvd", "step 2 dt 0.01", "levels 2", "step 2", "record stop"});
  EXPECT_EQ(io::read_glb_frames(test_.folder().text_of("a.glb")).times.size(), 3U);
  EXPECT_EQ(collection("a.pvd").size(), 5U);
}

TEST_F(Recorded, SaysWhatIsWrong) {
  test_.run({"record a.glb"});
  for (const auto& [line, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"record", "record wants a file"},
           {"record a.glb", "is being recorded"},
           {"record a.stl", "expected a name that ends in .pvd"},
           {"record ../a.obj", "climbs out"},
           {"record b.obj every 2 fps 3", "leave out every or fps"},
           {"record b.obj every 0", "must lie between"},
           {"record b.glb stop", "is not being recorded; did you mean `a.glb`"},
           {"record a.glb stop fps 2", "has no pace"},
       })
    EXPECT_THAT(test_.fault_of(line).what(), HasSubstr(message)) << line;
  test_.run({"record stop"});
  EXPECT_THAT(test_.fault_of("record stop").what(), HasSubstr("nothing is being recorded"));
}

TEST(FrameClock, CountsByStepsOrSeconds) {
  FrameClock steps({3, 0}, 0);
  std::vector<long> due;
  for (int i = 1; i <= 7; ++i) due.push_back(steps.due(i * 0.1));
  EXPECT_THAT(due, ElementsAre(0, 0, 1, 0, 0, 1, 0));
  FrameClock seconds({1, 30}, 1);
  double time = 1;
  long count = 0;
  for (int i = 0; i < 600; ++i) count += seconds.due(time += 1.0 / 60);  // whose sum is not exact
  EXPECT_EQ(count, 300);
  EXPECT_EQ(seconds.due(time + 1), 30);  // a step as long as thirty
  EXPECT_EQ(seconds.due(time), 0);
  EXPECT_EQ(seconds.due(time + 0.1), 3);
}

}  // namespace
}  // namespace argil::sculpt
