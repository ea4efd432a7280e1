#include "io/gltf_animation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>

#include "io/file_bytes.h"
#include "io/gltf.h"
#include "subdiv/error.h"
#include "tests/io/glb_frames.h"
#include "tests/io/scratch.h"

namespace argil::io {
namespace {

SurfaceMesh cube() {
  SurfaceMesh mesh;
  mesh.positions.resize(3, 8);
  for (int v = 0; v < 8; ++v) mesh.positions.col(v) = Eigen::Vector3d(v & 1, v >> 1 & 1, v >> 2 & 1);
  mesh.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  mesh.offsets = {0, 4, 8, 12, 16, 20, 24};
  return mesh;
}

SurfaceMesh turned(double angle) {
  SurfaceMesh mesh = cube();
  mesh.positions =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix() * mesh.positions;
  return mesh;
}

class Animated : public testing::Test {
 protected:
  Animated() : folder_(test::scratch(fmt::format("animation_{}", getpid()))), path_(folder_ / "turn.glb") {
    std::filesystem::create_directories(folder_);
  }
  ~Animated() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_, path_;
};

TEST_F(Animated, ShowsEveryFrameAtItsTimeAndTheMeanBetween) {
  GltfAnimation animation(path_);
  const std::vector<double> times{2, 2.5, 3.25, 3.5};
  for (const double time : times) animation.add(turned(time - 2), {}, time);
  animation.finish();
  const GlbFrames glb = read_glb_frames(read_file(path_));
  ASSERT_EQ(glb.times.size(), 4U);
  const auto& first = glb.document["meshes"][0];
  EXPECT_EQ(first["weights"].size(), 3U);
  EXPECT_EQ(first["extras"]["targetNames"].size(), 3U);
  // A cube's corners are split by its creases: three points each, in the order of the corners that come first.
  const SurfaceMesh still = cube();
  for (std::size_t frame = 0; frame < 4; ++frame) {
    EXPECT_EQ(glb.times[frame], times[frame] - 2);
    const Eigen::Matrix3Xd found = glb.at("POSITION", times[frame] - 2),
                           normals = glb.at("NORMAL", times[frame] - 2);
    ASSERT_EQ(found.cols(), 24);
    const Eigen::Matrix3Xd wanted = turned(times[frame] - 2).positions;
    for (Eigen::Index i = 0; i < 24; ++i) {
      // Single precision of a position and of a difference, both below 4 in size.
      EXPECT_LT((found.col(i) - wanted.col(still.corners[static_cast<std::size_t>(i)])).norm(), 1e-6);
      EXPECT_NEAR(normals.col(i).norm(), 1, 1e-6);
    }
    // Normals are those of the turned faces.
    for (std::size_t face = 0; face < 6; ++face) {
      const auto corner = [&](std::size_t c) {
        return Eigen::Vector3d(found.col(static_cast<Eigen::Index>(4 * face + c)));
      };
      const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
      EXPECT_LT((normal - normals.col(static_cast<Eigen::Index>(4 * face))).norm(), 1e-5);
    }
  }
  const Eigen::Matrix3Xd half = glb.at("POSITION", 0.25),
                         mean = 0.5 * (glb.at("POSITION", 0) + glb.at("POSITION", 0.5));
  EXPECT_LT((half - mean).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Animated, OfOneFrameIsTheSurfaceThatStands) {
  GltfAnimation animation(path_);
  animation.add(cube(), {}, 0);
  animation.finish();
  EXPECT_EQ(read_file(path_), glb_bytes(cube(), {}));
}

TEST_F(Animated, ForgetsFramesThatAreTakenBackAndLeavesOneFile) {
  GltfAnimation animation(path_), once(folder_ / "once.glb");
  for (const double time : {0.0, 1.0, 2.0, 3.0}) animation.add(turned(time), {}, time);
  animation.keep(2);
  animation.add(turned(0.5), {}, 1.5);
  for (const auto& [angle, time] : {std::pair(0.0, 0.0), std::pair(1.0, 1.0), std::pair(0.5, 1.5)})
    once.add(turned(angle), {}, time);
  animation.finish();
  once.finish();
  EXPECT_EQ(read_file(path_), read_file(folder_ / "once.glb"));
  animation.keep(0);
  animation.add(turned(1), {}, 9);  // begins anew
  animation.finish();
  EXPECT_EQ(read_file(path_), glb_bytes(turned(1), {}));
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_EQ(entry.path().extension(), ".glb") << entry.path();
}

TEST_F(Animated, RefusesTooManyFramesAndNumbersOutOfRange) {
  EXPECT_THROW(GltfAnimation(folder_ / "no folder" / "turn.glb"), Error);
  GltfAnimation animation(path_);
  SurfaceMesh small;
  small.positions = Eigen::Matrix3d::Identity();
  small.corners = {0, 1, 2};
  small.offsets = {0, 3};
  for (std::size_t frame = 0; frame < k_gltf_most_frames; ++frame)
    animation.add(small, {}, static_cast<double>(frame));
  EXPECT_THROW(animation.add(small, {}, 1e6), Error);
  EXPECT_EQ(animation.frames(), k_gltf_most_frames);
  animation.keep(5);
  small.positions *= 1e39;
  EXPECT_THROW(animation.add(small, {}, 1e6), Error);
  EXPECT_EQ(animation.frames(), 5U);
}

TEST_F(Animated, NeverReplacesAFileByAPartOfOne) {
  write_file(path_, "old");
  EXPECT_THROW(write_file(path_,
                          [](const std::function<void(std::string_view)>& write) {
                            write("a part");
                            throw Error(ErrorCode::bad_input, "the rest is lost");
                          }),
               Error);
  EXPECT_EQ(read_file(path_), "old");
  write_file(path_, [](const std::function<void(std::string_view)>& write) {
    write("a part");
    write("");
    write(" and the rest");
  });
  EXPECT_EQ(read_file(path_), "a part and the rest");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()), 1);
}

}  // namespace
}  // namespace argil::io
