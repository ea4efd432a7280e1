// The readers of surfaces against files of another hand, what they refuse, and how much memory they take.

#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "io/file_bytes.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "live_bytes.h"
#include "subdiv/error.h"
#include "surface_encoders.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

double volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t i = 1; i + 1 < mesh.face(f).size(); ++i)
      sum += mesh.positions.col(mesh.face(f)[0])
                 .dot(mesh.positions.col(mesh.face(f)[i]).cross(mesh.positions.col(mesh.face(f)[i + 1]))) /
             6;
  return sum;
}

void expect_same(const SurfaceMesh& found, const SurfaceMesh& expected) {
  EXPECT_EQ(found.positions, expected.positions);
  EXPECT_EQ(found.offsets, expected.offsets);
  EXPECT_EQ(found.corners, expected.corners);
}

TEST(SurfaceReader, FilesOfAnotherHandHoldTheCube) {
  const SurfaceMesh cube = test::cube();
  expect_same(read_obj(test::crowded_obj(), "a"), cube);
  expect_same(read_off(test::coloured_off(), "a"), cube);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const bool windows : {false, true})
      expect_same(read_ply(test::crowded_ply(cube, format, windows), "a"), cube);
  for (const bool capitals : {false, true}) {
    const SurfaceMesh read = read_stl(test::ascii_stl(cube, capitals), "a");
    EXPECT_EQ(read.positions.cols(), 8);
    EXPECT_EQ(read.face_count(), 12U);
    EXPECT_NEAR(volume(read), 1, 1e-15);
    EXPECT_TRUE(check_surface(read).closed_manifold());
  }
}

TEST(SurfaceReader, WhatIsWrittenComesBack) {
  SurfaceMesh mesh = test::cube();
  mesh.positions.col(6) << 1.0 / 3, 5e-324, -1.7976931348623157e308;
  expect_same(read_obj(obj_text(mesh), "a"), mesh);
  expect_same(read_off(off_text(mesh), "a"), mesh);
  expect_same(read_ply(ply_bytes(mesh), "a"), mesh);
  std::string named = stl_bytes(test::cube());
  for (const char* head : {"Argil", "solid"}) {  // many binary files begin like a text
    named.replace(0, 5, head);
    EXPECT_NEAR(volume(read_stl(named, "a")), 1, 1e-15);
  }
}

TEST(SurfaceReader, FacesMayComeBeforeTheVerticesOfPlyAndObj) {
  const SurfaceMesh obj = read_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a");
  EXPECT_THAT(obj.corners, testing::ElementsAre(0U, 1U, 2U));
  const SurfaceMesh ply = read_ply(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\nproperty "
      "int "
      "x\nproperty int y\nproperty int z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
      "a");
  EXPECT_EQ(ply.positions(0, 1), 1);
}

struct Refused {
  SurfaceMesh (*read)(std::string_view, std::string_view);
  std::string text, where, message;
  ErrorCode code = ErrorCode::bad_input;
};

const std::string k_ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty ";
const std::string k_faces = "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST(SurfaceReader, WhatIsMalformedIsRefusedAtItsPlace) {
  std::string long_stl = stl_bytes(test::cube()) + "x", bad_stl = stl_bytes(test::cube());
  bad_stl[84 + 12 + 3] = 0x7f;
  bad_stl[84 + 12 + 2] = static_cast<char>(0xc0);
  const Refused refused[] = {
      {read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "a:4:7", "from 1 to 3, found 4"},
      {read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "a:4:7", "counts back"},
      {read_obj, "v 0 0 0\nf 1 1 0\n", "a:2:7", "counted from 1"},
      {read_obj, "v 0 0\n", "a:1:5", "three coordinates"},
      {read_obj, "v 0 0 nan\n", "a:1:7", "finite"},
      {read_obj, "v 0 0 0\nf 1 1\n", "a:2:5", "at least three corners"},
      {read_obj, "v 0 0 0\nf 1/2/3/4 1 1\n", "a:2:3", "7/1/1"},
      {read_obj, "v 0 0 0\n", "a:2:1", "expected faces"},
      {read_obj, "v 0 0 0\ncstype bezier\n", "a:2:1", "cstype", ErrorCode::unsupported},
      {read_obj, "hello\n", "a:1:1", "hello"},
      {read_ply, "plyx\n", "a:1:1", "expected ply"},
      {read_ply, "ply\nformat ascii 2.0\n", "a:2:14", "1.0"},
      {read_ply, k_ply + k_faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a:13:7", "from 0 to 2, found 3"},
      {read_ply, k_ply + k_faces + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "a:13:1", "at least three"},
      {read_ply, k_ply + k_faces + "0 0 0\n1 0 0\n0 1 0\n300 0 1\n", "a:13:1", "found 300"},
      {read_ply, k_ply + "float w\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n", "a:3:16",
       "cut short"},
      {read_ply,
       "ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty float x\nelement face "
       "1\nend_header\n0\n",
       "a:3:16", "cut short"},
      {read_ply, "ply\nformat ascii 1.0\nelement vertex 3\nelement tristrips 1\nend_header\n", "a:5:11", "strips",
       ErrorCode::unsupported},
      {read_stl, long_stl, "a: byte 80", "found 685"},
      {read_stl, bad_stl, "a: byte 96", "finite"},
      {read_stl, "solid\nfacet normal 0 0 0 outer loop\nvertex 0 0\nendloop\n", "a:4:1", "coordinate"},
      {read_stl, "hello", "a: byte 0", "84 bytes"},
      {read_off, "OFF BINARY\n", "a:1:5", "binary OFF", ErrorCode::unsupported},
      {read_off, "4OFF\n", "a:1:1", "three dimensions", ErrorCode::unsupported},
      {read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a:6:7", "from 0 to 2"},
      {read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 9 9 9 9 9\n", "a:6:17", "the end of the line"},
      {read_off, "OFF\n3 99 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a:2:3", "cut short"},
  };
  for (const Refused& row : refused) {
    try {
      (void)row.read(row.text, "a");
      ADD_FAILURE() << "accepted:\n" << row.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), row.where) << row.text << error.what();
      EXPECT_THAT(error.what(), HasSubstr(row.message)) << row.text;
      EXPECT_EQ(error.code(), row.code) << error.what();
    }
  }
  EXPECT_THROW((void)read_surface("a.step"), Error);
  EXPECT_THROW((void)read_surface("a.glb"), Error);
  EXPECT_THROW((void)read_surface("there_is_none.obj"), Error);
}

TEST(SurfaceReader, MemoryGrowsWithTheFile) {
  if (!test::counts_bytes()) GTEST_SKIP() << "bytes are not counted in this build";
  SurfaceMesh sheet;  // small numbers: the least text a vertex
  const std::uint32_t n = 200;
  sheet.positions.resize(3, n * n);
  for (Eigen::Index v = 0; v < n * n; ++v) sheet.positions.col(v) << v / n % 10, v % n % 10, 0;
  for (std::uint32_t i = 0; i + 1 < n; ++i)
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      for (const std::uint32_t v : {n * i + j, n * i + j + 1, n * i + n + j + 1}) sheet.corners.push_back(v);
      sheet.offsets.push_back(sheet.corners.size());
    }
  const auto factor = [](SurfaceMesh (*read)(std::string_view, std::string_view), const std::string& bytes) {
    test::start_counting();
    const SurfaceMesh mesh = read(bytes, "a");
    return static_cast<double>(test::peak_bytes()) / static_cast<double>(bytes.size());
  };
  // The bound that the fuzz holds small files to; vectors may double when they grow.
  for (const double found :
       {factor(read_obj, obj_text(sheet)), factor(read_off, off_text(sheet)), factor(read_ply, ply_bytes(sheet)),
        factor(read_stl, stl_bytes(sheet)), factor(read_ply, test::crowded_ply(sheet, "ascii"))}) {
    EXPECT_LT(found, 24);
    std::printf("%.1f bytes a byte\n", found);
  }
}

TEST(SurfaceCheck, ACubeIsClosed) {
  const SurfaceReport report = check_surface(test::cube());
  EXPECT_TRUE(report.closed_manifold());
  EXPECT_EQ(report.component_count, 1U);
  EXPECT_EQ(report.findings(), "");
}

TEST(SurfaceCheck, EveryFaultIsNamed) {
  using Edge = SurfaceReport::Edge;
  SurfaceMesh open = test::cube();
  open.offsets.pop_back();  // without the triangle 3 4 7
  open.corners.resize(open.offsets.back());
  EXPECT_THAT(check_surface(open).open_edges, testing::ElementsAre(Edge{3, 4}, Edge{3, 7}, Edge{4, 7}));
  EXPECT_THAT(check_surface(open).findings(), HasSubstr("3 edges (the first from vertex 3 to 4)"));

  SurfaceMesh flipped = test::cube();
  std::swap(flipped.corners[24], flipped.corners[25]);
  EXPECT_THAT(check_surface(flipped).misoriented_edges, testing::ElementsAre(Edge{3, 4}, Edge{3, 7}, Edge{4, 7}));

  SurfaceMesh finned = test::cube();
  finned.corners.insert(finned.corners.end(), {3, 4, 1});
  finned.offsets.push_back(finned.corners.size());
  EXPECT_THAT(check_surface(finned).non_manifold_edges, testing::ElementsAre(Edge{3, 4}));
  EXPECT_THAT(check_surface(finned).open_edges, testing::ElementsAre(Edge{1, 3}, Edge{1, 4}));

  SurfaceMesh two = test::cube();  // another cube at its vertex 6, from 1 to 2
  const SurfaceMesh one = test::cube();
  two.positions.conservativeResize(3, 15);
  std::uint32_t next = 8;
  std::vector<std::uint32_t> number(8);
  for (Eigen::Index v = 0; v < 8; ++v) {
    number[static_cast<std::size_t>(v)] = v == 0 ? 6 : next++;
    two.positions.col(number[static_cast<std::size_t>(v)]) = one.positions.col(v) + Eigen::Vector3d(1, 1, 1);
  }
  for (std::size_t f = 0; f < one.face_count(); ++f) {
    for (const std::uint32_t v : one.face(f)) two.corners.push_back(number[v]);
    two.offsets.push_back(two.corners.size());
  }
  const SurfaceReport touching = check_surface(two);
  EXPECT_THAT(touching.non_manifold_vertices, testing::ElementsAre(6U));
  EXPECT_TRUE(touching.open_edges.empty());
  EXPECT_EQ(touching.component_count, 2U);
  EXPECT_FALSE(touching.closed_manifold());

  SurfaceMesh broken = test::cube();
  broken.corners[0] = 99;
  broken.corners[24] = broken.corners[25];
  broken.positions(1, 5) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(check_surface(broken).broken_faces, testing::ElementsAre(0U, 6U));
  EXPECT_THAT(check_surface(broken).infinite_vertices, testing::ElementsAre(5U));
}

TEST(SurfaceWeld, JoinsWhatIsWithinTheTolerance) {
  SurfaceMesh soup;
  soup.positions.resize(3, 6);
  soup.positions << 0, 1, 0, 1.0009, 1, -0.0005,  //
      0, 0, 1, 0, 1, 1.0005,                      //
      0, 0, -0.0, 0, 0, 0;
  soup.offsets = {0, 3, 6};
  soup.corners = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(weld(soup).positions.cols(), 6);
  const SurfaceMesh joined = weld(soup, 1e-3);
  EXPECT_THAT(joined.corners, testing::ElementsAre(0U, 1U, 2U, 1U, 3U, 2U));
  EXPECT_EQ(joined.positions.col(1), soup.positions.col(1));
  EXPECT_EQ(weld(soup, 8e-4).positions.cols(), 5);  // the pair at 1e-3·√½ alone
  EXPECT_EQ(weld(soup, 2).face_count(), 0U);        // all in one point
}

}  // namespace
}  // namespace argil::io
