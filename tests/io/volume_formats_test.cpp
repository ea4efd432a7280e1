#include "io/volume_formats.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "encoders.h"
#include "io/abaqus.h"
#include "io/file_bytes.h"
#include "io/gmsh.h"
#include "io/ovm.h"
#include "io/vtk.h"
#include "io/vtu.h"
#include "sample_meshes.h"
#include "subdiv/build.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

using subdiv::CellKind;
using testing::ElementsAre;
using testing::HasSubstr;

// The sample without its polyhedron, with coordinates, fields and overlapping sets that lose something in every
// shortcut.
VolumeMesh rich(bool polyhedron, bool face_sets, bool fields, int cell_components) {
  VolumeMesh mesh = test::every_kind();
  if (!polyhedron) {
    mesh.cells.kinds.pop_back();
    mesh.cells.offsets.pop_back();
    mesh.cells.connectivity.resize(mesh.cells.offsets.back());
  }
  mesh.cells.positions.col(16) << 1.0 / 3, 0.1, 5e-324;
  const auto points = static_cast<std::size_t>(mesh.cells.positions.cols());
  if (fields) {
    mesh.point_fields = {{"height", 1, test::awkward(points)}, {"a <b> & 100%25", 3, test::awkward(3 * points)}};
    const auto width = static_cast<std::size_t>(cell_components);
    mesh.cell_fields = {{"stress", cell_components, test::awkward(width * mesh.cells.cell_count())}};
  }
  mesh.sets = {{"foot", SetKind::points, {0, 3, 16}}, {"Wall", SetKind::points, {}}};
  mesh.sets[1].ids = {3, 4, 16};
  if (face_sets) {
    mesh.faces.corners = {0, 3, 2, 1, 1, 2, 9, 4, 5, 8};
    mesh.faces.offsets = {0, 4, 7, 10};
    mesh.sets.push_back({"foot", SetKind::faces, {0, 1}});
    mesh.sets.push_back({"top", SetKind::faces, {1, 2}});
  }
  mesh.sets.push_back({"left", SetKind::cells, {0, 1, 2}});
  mesh.sets.push_back({"right", SetKind::cells, {1, 3}});
  return mesh;
}

std::set<std::set<std::uint32_t>> faces_of(const VolumeMesh& mesh, const NamedSet& set) {
  std::set<std::set<std::uint32_t>> faces;
  for (const std::uint32_t face : set.ids)
    faces.emplace(mesh.faces.corners.begin() + static_cast<std::ptrdiff_t>(mesh.faces.offsets[face]),
                  mesh.faces.corners.begin() + static_cast<std::ptrdiff_t>(mesh.faces.offsets[face + 1]));
  return faces;
}

void expect_same_but_cells(const VolumeMesh& a, const VolumeMesh& b) {
  EXPECT_TRUE(test::same_bits(test::flat_positions(a), test::flat_positions(b)));
  for (const auto fields : {&VolumeMesh::point_fields, &VolumeMesh::cell_fields}) {
    ASSERT_EQ((a.*fields).size(), (b.*fields).size());
    for (std::size_t i = 0; i < (a.*fields).size(); ++i) {
      EXPECT_EQ((a.*fields)[i].name, (b.*fields)[i].name);
      EXPECT_EQ((a.*fields)[i].components, (b.*fields)[i].components);
      EXPECT_TRUE(test::same_bits((a.*fields)[i].values, (b.*fields)[i].values)) << (a.*fields)[i].name;
    }
  }
  ASSERT_EQ(a.sets.size(), b.sets.size());
  for (std::size_t i = 0; i < a.sets.size(); ++i) {
    EXPECT_EQ(a.sets[i].name, b.sets[i].name);
    ASSERT_EQ(a.sets[i].kind, b.sets[i].kind);
    if (a.sets[i].kind == SetKind::faces) {
      EXPECT_EQ(faces_of(a, a.sets[i]), faces_of(b, b.sets[i]));
    } else {
      EXPECT_EQ(a.sets[i].ids, b.sets[i].ids) << a.sets[i].name;
    }
  }
}

void expect_same(const VolumeMesh& a, const VolumeMesh& b) {
  expect_same_but_cells(a, b);
  EXPECT_EQ(a.cells.kinds, b.cells.kinds);
  EXPECT_EQ(a.cells.offsets, b.cells.offsets);
  EXPECT_EQ(a.cells.connectivity, b.cells.connectivity);
}

template <class Action>
Error error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "expected an argil::Error";
  return {ErrorCode::bad_input, ""};
}

TEST(VolumeFormats, EveryEncodingAndVersionBringsEveryBitBack) {
  for (const Encoding encoding : {Encoding::usual, Encoding::ascii, Encoding::binary}) {
    SCOPED_TRACE(word(encoding));
    const VolumeMesh all = rich(true, false, true, 6);
    expect_same(read_vtu(vtu_bytes(all, {encoding}), "t"), all);
    expect_same(read_vtk(vtk_text(all, {encoding}), "t"), all);
    const VolumeMesh gmsh = rich(false, true, true, 9);
    for (const char* version : {"4.1", "2.2"})
      expect_same(read_gmsh(gmsh_bytes(gmsh, {encoding, version}), "t"), gmsh);
  }
  const VolumeMesh all = rich(true, false, true, 6);
  expect_same(read_vtu(vtu_bytes(all, {Encoding::compressed}), "t"), all);
  const VolumeMesh abaqus = rich(false, false, false, 1);
  expect_same(read_abaqus(abaqus_text(abaqus), "t"), abaqus);
}

TEST(VolumeFormats, AsciiIsTextAndCompressedIsSmaller) {
  const VolumeMesh mesh = rich(true, false, true, 6);
  const auto is_text = [](const std::string& bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
  };
  EXPECT_TRUE(is_text(vtu_bytes(mesh, {Encoding::ascii})));
  EXPECT_FALSE(is_text(vtu_bytes(mesh, {Encoding::binary})));
  EXPECT_TRUE(is_text(vtk_text(mesh, {Encoding::ascii})));
  EXPECT_FALSE(is_text(vtk_text(mesh, {Encoding::binary})));
  const VolumeMesh gmsh = rich(false, true, true, 9);
  for (const char* version : {"4.1", "2.2"}) {
    EXPECT_TRUE(is_text(gmsh_bytes(gmsh, {Encoding::ascii, version})));
    EXPECT_FALSE(is_text(gmsh_bytes(gmsh, {Encoding::binary, version})));
    EXPECT_THAT(gmsh_bytes(gmsh, {Encoding::binary, version}), HasSubstr(std::string(version) + " 1 8\n"));
  }
  VolumeMesh flat = mesh;
  flat.point_fields = {{"zero", 3, std::vector<double>(51, 0)}, {"one", 9, std::vector<double>(153, 1)}};
  EXPECT_LT(vtu_bytes(flat, {Encoding::compressed}).size(), vtu_bytes(flat, {Encoding::binary}).size());
}

// Corners of named kinds may start elsewhere, so the solids are compared: faces with their cells on either side.
TEST(VolumeFormats, AMixedMeshComesBackFromOvmAsTheSameSolid) {
  const VolumeMesh mesh = rich(true, true, true, 3);
  const VolumeMesh back = read_ovm(ovm_text(mesh), "t");
  expect_same_but_cells(mesh, back);
  EXPECT_EQ(back.cells.kinds, mesh.cells.kinds);
  const auto a = subdiv::build(mesh.cells), b = subdiv::build(back.cells);
  EXPECT_EQ(a.point_from_vertex, b.point_from_vertex);
  EXPECT_EQ(a.solid.face_count(), b.solid.face_count());
  for (const subdiv::FaceId f : a.solid.faces()) {
    const auto found = b.solid.find_face(a.solid.face_vertices(f));
    ASSERT_TRUE(found);
    const auto owners = [](const subdiv::Solid& solid, subdiv::FaceId face) {
      return std::set{solid.owner(subdiv::face_use(face, false)), solid.owner(subdiv::face_use(face, true))};
    };
    EXPECT_EQ(owners(a.solid, f), owners(b.solid, *found));
  }
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_NEAR(test::volume(back.cells, c), test::every_kind_volumes()[c], 1e-14);
}

// Unit cube corners 1 to 8 and an apex 9 above: tetrahedron 1/6, hexahedron 1, prism 1/2 (its first triangle faces
// the second, as in Gmsh's and Abaqus' figures), pyramid 1/3.
constexpr const char* k_old_gmsh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
3 7 "body parts"
0 1 "tip"
$EndPhysicalNames
$Comments
anything
$EndComments
$Nodes
9
10 0 0 0
20 1 0 0
30 1 1 0
40 0 1 0
50 0 0 1
60 1 0 1
70 1 1 1
80 0 1 1
90 .5 .5 2
$EndNodes
$Elements
8
1 15 2 1 1 90
2 1 2 9 1 10 20
3 2 2 0 1 10 20 30
4 3 2 5 1 10 20 30 40
5 4 2 7 1 10 20 40 50
6 5 3 7 1 0 10 20 30 40 50 60 70 80
7 6 2 8 1 10 20 30 50 60 70
8 7 2 0 1 50 60 70 80 90
$EndElements
$ElementData
1
"stress"
1
0.0
3
0
1
4
5 0.5
6 1.5
7 2.5
8 3.5
$EndElementData
)";

TEST(Gmsh, ReadsItsOwnOrderOfCornersGroupsAndData) {
  const VolumeMesh mesh = read_gmsh(k_old_gmsh, "t");
  EXPECT_THAT(mesh.cells.kinds,
              ElementsAre(CellKind::tetrahedron, CellKind::hexahedron, CellKind::wedge, CellKind::pyramid));
  const double volumes[] = {1.0 / 6, 1, 0.5, 1.0 / 3};
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(test::volume(mesh.cells, c), volumes[c], 1e-14) << c;
  ASSERT_EQ(mesh.sets.size(), 4U);
  EXPECT_EQ(mesh.sets[0].name, "tip");
  EXPECT_THAT(mesh.sets[0].ids, ElementsAre(8));
  EXPECT_EQ(mesh.sets[1].name, "surface_5");
  EXPECT_THAT(mesh.faces.corners, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(mesh.sets[2].name, "body parts");
  EXPECT_THAT(mesh.sets[2].ids, ElementsAre(0, 1));
  EXPECT_EQ(mesh.sets[3].name, "volume_8");
  EXPECT_THAT(mesh.cell_fields[0].values, ElementsAre(0.5, 1.5, 2.5, 3.5));
  EXPECT_THAT(mesh.notes, ElementsAre("1 surface elements in no physical group and 1 lines were passed over"));
}

TEST(Gmsh, ReadsTheEntitiesOf41InAnyOrderOfTags) {
  const VolumeMesh mesh = read_gmsh(R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 2 "lump"
$EndPhysicalNames
$Entities
1 0 1 2
1 0 0 0 1 4
5 0 0 0 1 1 1 0 0
1 0 0 0 1 1 1 2 2 -3 0
2 0 0 0 1 1 1 0 1 5
$EndEntities
$Nodes
2 5 1 1000000000000
3 1 0 2
1000000000000
3
0 0 1
0 1 0
3 2 0 3
1
2
7
0 0 0
1 0 0
1 1 1
$EndNodes
$Elements
3 3 1 9
0 1 15 1
4 2
3 2 4 1
9 2 3 1000000000000 7
3 1 4 1
8 1 2 3 1000000000000
$EndElements
$Periodic
0
$EndPeriodic
)",
                                    "t");
  // Points by tag: 1, 2, 3, 7, 10^12.
  EXPECT_THAT(mesh.cells.connectivity, ElementsAre(0, 1, 2, 4, 1, 2, 4, 3));
  EXPECT_NEAR(test::volume(mesh.cells, 0), 1.0 / 6, 1e-14);
  ASSERT_EQ(mesh.sets.size(), 3U);
  EXPECT_EQ(mesh.sets[0].name, "point_4");
  EXPECT_THAT(mesh.sets[0].ids, ElementsAre(1));
  EXPECT_EQ(mesh.sets[1].name, "lump");
  EXPECT_THAT(mesh.sets[1].ids, ElementsAre(0));
  EXPECT_EQ(mesh.sets[2].name, "volume_3");
}

TEST(Gmsh, ReadsBigEndianBinary) {
  std::string file = "$MeshFormat\n2.2 1 8\n";
  const auto ints = [](std::vector<std::int32_t> values) { return test::bytes_of(values, true); };
  file += ints({1}) + "\n$EndMeshFormat\n$Nodes\n4\n";
  const double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int p = 0; p < 4; ++p)
    file += ints({p + 1}) + test::bytes_of(std::vector<double>(points[p], points[p] + 3), true);
  file += "\n$EndNodes\n$Elements\n1\n" + ints({4, 1, 2, 1, 0, 0, 1, 2, 3, 4}) + "\n$EndElements\n";
  const VolumeMesh mesh = read_gmsh(file, "t");
  EXPECT_NEAR(test::volume(mesh.cells, 0), 1.0 / 6, 1e-14);
}

TEST(Gmsh, GroupsThatGrowBeyondTheFileAreRefused) {
  constexpr int k_many = 3000;
  std::string file = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 3000";
  for (int i = 1; i <= k_many; ++i) file += fmt::format(" {}", i);
  file += " 0\n$EndEntities\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
  file += "$Elements\n1 3000 1 3000\n3 1 4 3000\n";
  for (int i = 1; i <= k_many; ++i) file += fmt::format("{} 1 2 3 4\n", i);
  EXPECT_EQ(error_of([&] { (void)read_gmsh(file + "$EndElements\n", "t"); }).code(), ErrorCode::limit_exceeded);
}

TEST(Gmsh, RefusesCurvedCellsByName) {
  std::string file = k_old_gmsh;
  file.replace(file.find("5 4 2 7 1 10 20 40 50"), 21, "5 11 2 7 1 10 20 40 50 10 10 10 10 10 10");
  const Error curved = error_of([&] { (void)read_gmsh(file, "t"); });
  EXPECT_EQ(curved.code(), ErrorCode::unsupported);
  EXPECT_THAT(curved.what(), HasSubstr("tetrahedron of 10 nodes (Gmsh type 11)"));
  EXPECT_THAT(error_of([] { (void)gmsh_bytes(test::every_kind()); }).what(), HasSubstr("polyhedra"));
}

TEST(Abaqus, ReadsItsOwnOrderOfCornersAndEveryWayToNameASet) {
  const VolumeMesh mesh = read_abaqus(R"(** a comment
*Heading
 some, text
*Part, name=P
*node, nset=All
 1, 0., 0, 0
 2, 1.D0, 0
 3, 1, 1,
4,0,1,0
 5, 0, 0, 1
 6, 1, 0, 1
 7, 1, 1, 1
 8, 0, 1, 1
 9, .5, .5, 2
*Element, type=C3D8R,
  elset=brick
30, 1, 2, 3, 4,
 5, 6, 7, 8
*ELEMENT,TYPE=c3d6
20, 1, 2, 3, 5, 6, 7
*Element, type=C3D4, elset=Small
10, 1, 2, 4, 5
*Element, type=C3D5, elset=SMALL
40, 5, 6, 7, 8, 9
*Element, type=CPS4, elset=small
50, 1, 2, 3, 4
*Nset, nset=Low, generate
1, 7, 2
*Nset, nset=low
2
*Elset, elset=both, internal
 brick, small,
20
*Nset, nset=nothing
*End Part
*Material, name=M
*Elastic
1e5, 0.3
)",
                                      "t");
  EXPECT_THAT(mesh.cells.kinds,
              ElementsAre(CellKind::tetrahedron, CellKind::wedge, CellKind::hexahedron, CellKind::pyramid));
  const double volumes[] = {1.0 / 6, 0.5, 1, 1.0 / 3};
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(test::volume(mesh.cells, c), volumes[c], 1e-14) << c;
  std::vector<std::string> names;
  for (const NamedSet& set : mesh.sets) names.push_back(set.name);
  EXPECT_THAT(names, ElementsAre("All", "brick", "Small", "Low", "both", "nothing"));
  EXPECT_EQ(mesh.sets[0].ids.size(), 9U);
  EXPECT_THAT(mesh.sets[1].ids, ElementsAre(2));
  EXPECT_THAT(mesh.sets[2].ids, ElementsAre(0, 3));
  EXPECT_THAT(mesh.sets[3].ids, ElementsAre(0, 1, 2, 4, 6));
  EXPECT_THAT(mesh.sets[4].ids, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.notes, ElementsAre("1 elements that are not solid were passed over"));
}

TEST(Abaqus, SetsThatGrowBeyondTheFileAreRefused) {
  std::string file = "*NODE\n";
  for (int i = 1; i <= 2000; ++i) file += fmt::format("{},{}\n", i, i);
  file += "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n*NSET,NSET=A0\n1\n";
  file += "*NSET,NSET=A,GENERATE\n";
  for (int i = 0; i < 2000; ++i) file += "1,2000\n";
  EXPECT_EQ(error_of([&] { (void)read_abaqus(file, "t"); }).code(), ErrorCode::limit_exceeded);
}

// One tetrahedron; its half-faces have their normals inwards, as OpenVolumeMesh assumes.
TEST(Ovm, ReadsHalfFacesWithTheirNormalsInwardsAndProperties) {
  const VolumeMesh mesh = read_ovm(R"(OVM ASCII
Vertices
4
0 0 0
1 0 0
0 1 0
0 0 1
Edges
6
0 1
1 2
2 0
0 3
1 3
2 3
Faces
4
3 0 2 4
3 0 8 7
3 2 10 9
3 4 6 11
Polyhedra
1
4 0 3 5 7
VProp int "colour of it"
1
2
3
4
EProp double "crease"
0 0 0 0 0 1
VProp bool "set:base"
1
1
1
0
CProp vec3d "force"
1 2 3
)",
                                   "t");
  EXPECT_THAT(mesh.cells.kinds, ElementsAre(CellKind::tetrahedron));
  EXPECT_NEAR(test::volume(mesh.cells, 0), 1.0 / 6, 1e-14);
  ASSERT_EQ(mesh.point_fields.size(), 1U);
  EXPECT_EQ(mesh.point_fields[0].name, "colour of it");
  EXPECT_THAT(mesh.cell_fields[0].values, ElementsAre(1, 2, 3));
  EXPECT_THAT(mesh.sets[0].ids, ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.notes, ElementsAre("1 properties of edges, faces or the mesh were passed over"));
}

TEST(VolumeFormats, WhatAFormatCannotHoldIsNamedNotDropped) {
  const auto left_out = [](VolumeMesh mesh, const char* name) {
    std::string all;
    for (const std::string& note : leave_out_what_is_not_held(mesh, volume_format_of(name))) all += note + "\n";
    return all;
  };
  const VolumeMesh mesh = rich(false, true, true, 6);
  EXPECT_THAT(left_out(mesh, "a.mesh"),
              HasSubstr("the set 'foot' of points is left out: MEDIT has no sets of points"));
  EXPECT_THAT(left_out(mesh, "a.mesh"), HasSubstr("named 'height', 'a <b> & 100%25'"));
  EXPECT_THAT(left_out(mesh, "a.vtu"), HasSubstr("the set 'top' of faces is left out"));
  EXPECT_THAT(left_out(mesh, "a.vtu"), testing::Not(HasSubstr("height")));
  EXPECT_THAT(left_out(mesh, "a.msh"), HasSubstr("'stress'"));
  VolumeMesh named = rich(false, false, false, 1);
  named.sets = {{"leg", SetKind::points, {1}}, {"LEG", SetKind::points, {2}}, {"9 lives", SetKind::points, {3}}};
  EXPECT_THAT(left_out(named, "a.inp"), HasSubstr("'LEG' of points is left out"));
  EXPECT_THAT(left_out(named, "a.inp"), HasSubstr("'9 lives' of points is left out"));
  EXPECT_EQ(left_out(named, "a.msh"), "");
  EXPECT_EQ(error_of([&] { write_volume_mesh("never.inp", named); }).code(), ErrorCode::unsupported);
}

TEST(VolumeFormats, EncodingsAndVersionsThatAFormatLacksAreRefused) {
  const VolumeMesh mesh = rich(false, false, false, 1);
  EXPECT_THAT(error_of([&] { write_volume_mesh("never.inp", mesh, {Encoding::binary}); }).what(),
              HasSubstr("is not written binary"));
  EXPECT_THAT(error_of([&] {
                write_volume_mesh("never.msh", mesh, {Encoding::usual, "4.0"});
              }).what(),
              HasSubstr("expected 4.1 or 2.2"));
  EXPECT_FALSE(std::filesystem::exists("never.inp"));
}

TEST(VolumeFormats, TheTableInTheDocumentsIsTheTableOfTheProgram) {
  EXPECT_THAT(read_file(std::filesystem::path(ARGIL_SOURCE_DIR) / "docs" / "formats.md"),
              HasSubstr(volume_format_table(true)));
}

}  // namespace
}  // namespace argil::io
