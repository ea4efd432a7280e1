#include "sculpt/surface_look.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/export.h"
#include "sessions.h"

namespace argil::sculpt {
namespace {

TEST(SurfaceLook, SharpEdgesSplitNormalsWhereverTheyRun) {
  TestSession session({"new box 2 2 2 size 2 2 2", "select edges where z = 2 and x = 1", "sharpen", "levels 1"});
  const subdiv::Solid& solid = session.document().refinement().solid();
  const io::SurfaceLook look = surface_look(solid);
  const io::SurfaceMesh mesh = surface_mesh(solid, session.document().surface_nodes(session.document().rest()));
  ASSERT_EQ(look.sharp.size(), mesh.corners.size());
  // Two control edges become four, each a side of two faces.
  EXPECT_EQ(std::count(look.sharp.begin(), look.sharp.end(), 1), 8);
}

TEST(SurfaceLook, EverySurfaceFormatIsWrittenClosedAtEveryLevel) {
  TestSession session({"new box 2 2 1 size 2 2 1", "remove where x < 1 and y < 1 or x > 1 and y > 1", "levels 2"});
  for (const char* level : {"0", "1", "2"})
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.off"}) {
      session.run({std::string("save ") + name + " level " + level});
      const io::SurfaceReport report = check_surface(io::read_surface(session.folder().path() / name));
      EXPECT_TRUE(report.open_edges.empty() && report.misoriented_edges.empty()) << name << report.findings();
      // Copies of the vertices of the contact stand at one place, where STL joins them.
      EXPECT_EQ(report.closed_manifold(), name != std::string("a.stl")) << name << report.findings();
    }
  session.run({"save a.glb level 1", "save a.gltf"});
  EXPECT_EQ(session.folder().text_of("a.glb").substr(0, 4), "glTF");
}

TEST(SurfaceLook, AFieldColoursAGltfAndNothingElse) {
  TestSession session({"new box 2 2 2", "levels 1", "set density 100 + 100*x"});
  session.run({"save plain.gltf", "save coloured.gltf field density", "save coloured.glb field density"});
  EXPECT_EQ(session.folder().text_of("plain.gltf").find("COLOR_0"), std::string::npos);
  EXPECT_NE(session.folder().text_of("coloured.gltf").find("COLOR_0"), std::string::npos);
  EXPECT_EQ(session.fault_of("save a.obj field density").code(), ErrorCode::unsupported);
  EXPECT_EQ(session.fault_of("save a.glb level 0 field density").code(), ErrorCode::bad_input);
}

}  // namespace
}  // namespace argil::sculpt
