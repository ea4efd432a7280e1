#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cstring>
#include <limits>

#include "io/file_bytes.h"
#include "io/surface.h"
#include "subdiv/error.h"
#include "tests/io/scratch.h"

namespace argil::io {
namespace {

using test::scratch;

// A square of side 2 in the plane z = 1/3 and a triangle on one side.
SurfaceMesh sample() {
  SurfaceMesh mesh;
  mesh.positions.resize(3, 5);
  mesh.positions << 0, 2, 2, 0, 3,  //
      0, 0, 2, 2, 1,                //
      1.0 / 3, 1.0 / 3, 1.0 / 3, 1.0 / 3, 0.1;
  mesh.offsets = {0, 4, 7};
  mesh.corners = {0, 1, 2, 3, 1, 4, 2};
  return mesh;
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(Surface, ObjCountsFromOneAndKeepsPolygonsAndDoubles) {
  write_surface(scratch("s.obj"), sample());
  EXPECT_EQ(read_file(scratch("s.obj")),
            "# Argil\nv 0 0 0.3333333333333333\nv 2 0 0.3333333333333333\nv 2 2 0.3333333333333333\n"
            "v 0 2 0.3333333333333333\nv 3 1 0.1\nf 1 2 3 4\nf 2 5 3\n");
}

TEST(Surface, PlyHoldsDoublesAndLists) {
  write_surface(scratch("s.ply"), sample());
  const std::string bytes = read_file(scratch("s.ply"));
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  EXPECT_THAT(bytes.substr(0, body), testing::HasSubstr("element vertex 5\nproperty double x"));
  EXPECT_THAT(bytes.substr(0, body), testing::HasSubstr("element face 2\nproperty list uchar uint vertex_indices"));
  ASSERT_EQ(bytes.size(), body + 5 * 24 + (1 + 16) + (1 + 12));
  EXPECT_EQ(at<double>(bytes, body + 16), 1.0 / 3);
  EXPECT_EQ(at<double>(bytes, body + 4 * 24), 3);
  EXPECT_EQ(bytes[body + 120], 4);
  EXPECT_EQ(at<std::uint32_t>(bytes, body + 121 + 12), 3U);
  EXPECT_EQ(bytes[body + 137], 3);
  EXPECT_EQ(at<std::uint32_t>(bytes, body + 138 + 4), 4U);
}

TEST(Surface, StlHoldsTheTrianglesOfAQuadrilateral) {
  write_surface(scratch("s.stl"), sample());
  const std::string bytes = read_file(scratch("s.stl"));
  ASSERT_EQ(bytes.size(), 84U + 3 * 50);
  EXPECT_EQ(at<std::uint32_t>(bytes, 80), 3U);
  EXPECT_EQ(at<float>(bytes, 84 + 8), 1.0F);  // normal of the square
  double area = 0;
  for (std::size_t t = 0; t < 2; ++t) {
    Eigen::Vector3d corner[3];
    for (std::size_t i = 0; i < 9; ++i)
      corner[i / 3][static_cast<int>(i % 3)] = at<float>(bytes, 84 + 50 * t + 12 + 4 * i);
    area += (corner[1] - corner[0]).cross(corner[2] - corner[0]).z() / 2;
  }
  EXPECT_EQ(area, 4.0);  // small integers: exact
}

TEST(Surface, WhatCannotBeHeldIsRefusedByName) {
  SurfaceMesh mesh = sample();
  mesh.positions(0, 0) = 1e39;
  EXPECT_THROW(write_surface(scratch("far.stl"), mesh), Error);
  EXPECT_FALSE(std::filesystem::exists(scratch("far.stl")));
  EXPECT_NO_THROW(write_surface(scratch("far.ply"), mesh));
  mesh.positions(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_surface(scratch("nan.obj"), mesh), Error);
  EXPECT_THROW(write_surface(scratch("s.step"), sample()), Error);
}

}  // namespace
}  // namespace argil::io
