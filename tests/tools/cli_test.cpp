// The subcommands that work on meshes, run as a user runs them, on meshes whose answers are known in closed form.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "io/image.h"
#include "io/volume_mesh.h"
#include "tests/tools/mesh_files.h"
#include "tests/tools/process.h"

namespace argil::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// Sums over a few cells at coordinates of size 1: a few hundred roundings.
constexpr double k_rounding = 1e-13;

class Cli : public ArgilCalls {};

std::vector<Corner> obj_vertices(const std::filesystem::path& path) {
  std::vector<Corner> vertices;
  std::istringstream lines(read_bytes(path));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    Corner p{};
    if (words >> kind && kind == "v" && words >> p[0] >> p[1] >> p[2]) vertices.push_back(p);
  }
  return vertices;
}

TEST_F(Cli, VersionAndHelpOfEverySubcommandEndWell) {
  const Finished version = argil({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "argil " ARGIL_VERSION "\n");
  const Finished overview = argil({"--help"});
  EXPECT_EQ(overview.status, 0);
  for (const char* name : {"replay", "diff", "info", "refine", "elements", "convert", "render", "help"}) {
    EXPECT_THAT(overview.out, HasSubstr(name));
    const Finished help = argil({name, "--help"});
    EXPECT_EQ(help.status, 0) << name;
    EXPECT_THAT(help.out, HasSubstr("--help")) << name;
    EXPECT_TRUE(help.err.empty()) << help.err;
  }
  for (const char* option : {"--out", "--threads", "--until", "--hash-trace", "--set", "--json", "--max-cells"})
    EXPECT_THAT(argil({"replay", "--help"}).out, HasSubstr(option));
}

TEST_F(Cli, HelpListsEverySessionCommandAndExplainsEach) {
  const Finished overview = argil({"help"});
  EXPECT_EQ(overview.status, 0);
  for (const char* name : {"new",   "open",   "select", "extrude", "move",    "sharpen", "levels", "space",
                           "set",   "paint",  "pin",    "gravity", "force",   "tool",    "stroke", "step",
                           "solve", "commit", "undo",   "redo",    "measure", "expect",  "save",   "render"}) {
    EXPECT_THAT(overview.out, HasSubstr("  " + std::string(name) + " "));
    const Finished help = argil({"help", name});
    EXPECT_EQ(help.status, 0) << name;
    EXPECT_THAT(help.out, HasSubstr("\nExample:\n  ")) << name;
    EXPECT_THAT(help.out, HasSubstr("\n  " + std::string(name))) << name;
  }
}

TEST_F(Cli, InfoOfABoxIsThatOfClosedForms) {
  folder_.write("box.mesh", cube_grid(2, 3, 4, 0.5));
  const json found = answer({"info", "box.mesh", "--json"});
  EXPECT_EQ(found["vertices"], 3 * 4 * 5);
  EXPECT_EQ(found["edges"], 2 * 4 * 5 + 3 * 3 * 5 + 3 * 4 * 4);
  EXPECT_EQ(found["faces"], 3 * 3 * 4 + 2 * 4 * 4 + 2 * 3 * 5);
  EXPECT_EQ(found["cells"], 24);
  EXPECT_EQ(found["boundary_faces"], 2 * (2 * 3 + 3 * 4 + 2 * 4));
  EXPECT_EQ(found["components"], 1);
  EXPECT_EQ(found["boundary_genus"], 0);
  EXPECT_EQ(found["cell_types"], json({{"hexahedron", 24}}));
  EXPECT_EQ(found["interior_edge_valences"], json({{"4", 2 * 2 * 3 + 3 * 1 * 3 + 4 * 1 * 2}}));
  EXPECT_NEAR(found["min_scaled_jacobian"], 1, k_rounding);
  EXPECT_NEAR(found["min_jacobian"], 1, k_rounding);
  EXPECT_EQ(found["inverted_cells"], 0);
  EXPECT_NEAR(found["volume"], 3, k_rounding);
  const double size[] = {1, 1.5, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found["centre"][i], size[i] / 2, k_rounding);
    const double a = size[(i + 1) % 3], b = size[(i + 2) % 3];
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(found["inertia"][i][j], i == j ? 3 * (a * a + b * b) / 12 : 0, k_rounding);
  }
}

TEST_F(Cli, InfoOfARingOfCellsFindsItsHole) {
  folder_.write("ring.mesh", ring());
  const json found = answer({"info", "ring.mesh", "--json"});
  EXPECT_EQ(found["cells"], 8);
  EXPECT_EQ(found["boundary_faces"], 8 + 8 + 12 + 4);
  EXPECT_EQ(found["components"], 1);
  EXPECT_EQ(found["boundary_genus"], 1);
  EXPECT_EQ(found["interior_edge_valences"], json::object());
  EXPECT_NEAR(found["volume"], 8, k_rounding);
  // A plate 3 × 3 × 1 less the cube in its middle.
  const double square = 9.0 * 9 / 12 - 1.0 / 12, height = 8.0 / 12;
  EXPECT_NEAR(found["inertia"][0][0], square + height, k_rounding * 10);
  EXPECT_NEAR(found["inertia"][2][2], 2 * square, k_rounding * 10);
}

TEST_F(Cli, InfoOfTetrahedraThatShareAVertexFindsTwoComponents) {
  const std::vector<Corner> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  folder_.write("tets.mesh", medit(corners, "Tetrahedra", {{0, 1, 2, 3}, {0, 5, 4, 6}}));
  const json found = answer({"info", "tets.mesh", "--json"});
  EXPECT_EQ(found["vertices"], 7);
  EXPECT_EQ(found["edges"], 12);
  EXPECT_EQ(found["faces"], 8);
  EXPECT_EQ(found["boundary_faces"], 8);
  EXPECT_EQ(found["components"], 2);
  EXPECT_EQ(found["cell_types"], json({{"tetrahedron", 2}}));
  EXPECT_TRUE(found["min_scaled_jacobian"].is_null());  // there are no hexahedra
  EXPECT_NEAR(found["volume"], 1.0 / 3, k_rounding);
  // About the origin ∫x² = 1/60 and ∫xy = 1/120 in each, and the second is the mirror image of the first.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found["centre"][i], 0, k_rounding);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(found["inertia"][i][j], i == j ? 4.0 / 60 : -2.0 / 120, k_rounding);
  }
}

TEST_F(Cli, InfoReportsACellThatIsInsideOut) {
  const std::vector<Corner> corners{{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},
                                    {0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}};
  folder_.write("mirrored.mesh", medit(corners, "Hexahedra", {{0, 1, 2, 3, 4, 5, 6, 7}}));
  const json found = answer({"info", "mirrored.mesh", "--json"});
  EXPECT_EQ(found["inverted_cells"], 1);
  EXPECT_LT(found["min_scaled_jacobian"], 0);
  EXPECT_NEAR(found["volume"], -1, k_rounding);
}

TEST_F(Cli, ElementsCountsTheCellsOfThePaper) {
  folder_.write("three.mesh", cube_grid(3, 3, 3));
  const json three = answer({"elements", "three.mesh", "--levels", "2", "--json"});
  EXPECT_EQ(three["cells"]["regular_published"], 1000);
  EXPECT_EQ(three["cells"]["regular"], 1600);
  EXPECT_EQ(three["cells"]["extraordinary"], 128);  // beside the smooth edges and corners of the block
  EXPECT_EQ(three["cells"]["irregular"], 0);
  EXPECT_EQ(three["elements"], json({{"cubic", 0}, {"linear", 1728}, {"pyramid", 0}}));
  EXPECT_EQ(three["unknowns"], 3 * 64);
  folder_.write("twelve.mesh", cube_grid(12, 12, 12));
  const json twelve = answer({"elements", "twelve.mesh", "--levels", "0", "--json"});
  EXPECT_EQ(twelve["cells"]["regular_published"], 1000);
  EXPECT_EQ(twelve["cells"]["regular"], 1600);
  const json cubic =
      answer({"elements", "twelve.mesh", "--levels", "0", "--space", "cubic", "--split", "0", "--json"});
  EXPECT_EQ(cubic["elements"], json({{"cubic", 1600}, {"linear", 128}, {"pyramid", 0}}));
}

TEST_F(Cli, RefineGivesTheLimitPointsOfACube) {
  const std::vector<Corner> corners{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  folder_.write("cube.mesh", medit(corners, "Hexahedra", {{0, 1, 2, 3, 4, 5, 6, 7}}));
  struct Expected {
    const char* option;
    double corner, edge, face;
  };
  // REFERENCES.md §8; its edge figure is given to ten digits.
  for (const Expected& expected :
       {Expected{nullptr, 5.0 / 9, 0.75, 1}, Expected{"--limit", 0.5, 0.6095679012, 68.0 / 81}}) {
    std::vector<std::string> arguments{"refine", "cube.mesh", "fine.obj", "--levels", "1"};
    if (expected.option != nullptr) arguments.emplace_back(expected.option);
    const Finished finished = argil(arguments);
    ASSERT_EQ(finished.status, 0) << finished.err;
    const auto vertices = obj_vertices(folder_ / "fine.obj");
    ASSERT_EQ(vertices.size(), 26U);
    for (const Corner& p : vertices) {
      const auto zeros = std::count_if(p.begin(), p.end(), [](double x) { return std::abs(x) < 1e-12; });
      const double size = zeros == 0 ? expected.corner : zeros == 1 ? expected.edge : expected.face;
      for (const double x : p) EXPECT_NEAR(std::abs(x), std::abs(x) < 1e-12 ? 0 : size, 1e-10);
    }
  }
}

TEST_F(Cli, ConvertKeepsCoordinatesExactlyThroughEveryFormat) {
  folder_.write("a.mesh", cube_grid(2, 2, 1, 1.0 / 3));
  const std::vector<std::string> names{"a.mesh", "b.vtk", "c.vtu", "d.mesh"};
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    const Finished finished = argil({"convert", names[i], names[i + 1]});
    ASSERT_EQ(finished.status, 0) << finished.err;
    EXPECT_EQ(io::read_volume_mesh(folder_ / names[i + 1]).cells.positions,
              io::read_volume_mesh(folder_ / "a.mesh").cells.positions);
    EXPECT_EQ(argil({"info", names[i + 1], "--json"}).out, argil({"info", "a.mesh", "--json"}).out);
  }
  for (const char* surface : {"s.obj", "s.ply", "s.stl"}) EXPECT_EQ(argil({"convert", "c.vtu", surface}).status, 0);
  EXPECT_EQ(obj_vertices(folder_ / "s.obj").size(), 18U);
}

TEST_F(Cli, ConvertRefusesWhatAFormatCannotHold) {
  const std::vector<Corner> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  folder_.write("pyramid.mesh", medit(corners, "Pyramids", {{0, 1, 2, 3, 4}}));
  ASSERT_EQ(argil({"refine", "pyramid.mesh", "fine.vtu", "--levels", "1"}).status, 0);
  EXPECT_EQ(answer({"info", "fine.vtu", "--json"})["cell_types"], json({{"hexahedron", 4}, {"polyhedron", 1}}));
  EXPECT_EQ(argil({"convert", "fine.vtu", "fine.vtk"}).status, 0);
  const Finished refused = argil({"convert", "fine.vtu", "fine.mesh"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("polyhedra"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fine.mesh"));
}

TEST_F(Cli, RenderMakesAPictureWithoutADisplay) {
  folder_.write("models/ring.mesh", ring());
  const Finished finished =
      argil({"render", "models/ring.mesh", "pictures/ring.png", "--levels", "1", "--with", "size 120 90"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  const io::Image image = io::read_png(folder_ / "pictures/ring.png");
  EXPECT_EQ(image.width, 120);
  EXPECT_EQ(image.height, 90);
  // Clay in the middle of its ground: some pixels differ much from a corner.
  std::size_t different = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    if (std::abs(image.rgba[i] - image.rgba[0]) > 60) ++different;
  EXPECT_GT(different, 120U * 90U / 20);
  EXPECT_THAT(folder_.files(), testing::ElementsAre("models/ring.mesh", "pictures/ring.png"));
}

}  // namespace
}  // namespace argil::tests
