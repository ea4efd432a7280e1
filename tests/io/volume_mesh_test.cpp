#include "io/volume_mesh.h"

#include <gmock/gmock.h>

#include <set>

#include "encoders.h"
#include "io/file_bytes.h"
#include "io/medit.h"
#include "io/volume_formats.h"
#include "io/vtk.h"
#include "io/vtu.h"
#include "sample_meshes.h"
#include "subdiv/build.h"
#include "subdiv/error.h"
#include "tests/io/scratch.h"

namespace argil::io {
namespace {

using subdiv::CellKind;
using test::encode_vtk;
using test::every_kind;
using test::VtuEncoder;
using test::VtuStyle;

using test::scratch;

void expect_same_fields(const std::vector<NamedField>& a, const std::vector<NamedField>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_TRUE(test::same_bits(a[i].values, b[i].values)) << a[i].name;
  }
}

// A face set as the vertices of its faces: formats may number faces anew and turn their loops.
std::set<std::set<std::uint32_t>> faces_of(const VolumeMesh& mesh, const NamedSet& set) {
  std::set<std::set<std::uint32_t>> faces;
  for (const std::uint32_t face : set.ids)
    faces.emplace(mesh.faces.corners.begin() + static_cast<std::ptrdiff_t>(mesh.faces.offsets[face]),
                  mesh.faces.corners.begin() + static_cast<std::ptrdiff_t>(mesh.faces.offsets[face + 1]));
  return faces;
}

void expect_same_sets(const VolumeMesh& a, const VolumeMesh& b) {
  ASSERT_EQ(a.sets.size(), b.sets.size());
  for (std::size_t i = 0; i < a.sets.size(); ++i) {
    EXPECT_EQ(a.sets[i].name, b.sets[i].name);
    EXPECT_EQ(a.sets[i].kind, b.sets[i].kind);
    if (a.sets[i].kind == SetKind::faces) {
      EXPECT_EQ(faces_of(a, a.sets[i]), faces_of(b, b.sets[i]));
    } else {
      EXPECT_EQ(a.sets[i].ids, b.sets[i].ids) << a.sets[i].name;
    }
  }
}

void expect_same(const VolumeMesh& a, const VolumeMesh& b) {
  EXPECT_TRUE(test::same_bits(test::flat_positions(a), test::flat_positions(b)));
  EXPECT_EQ(a.cells.kinds, b.cells.kinds);
  EXPECT_EQ(a.cells.offsets, b.cells.offsets);
  EXPECT_EQ(a.cells.connectivity, b.cells.connectivity);
  expect_same_fields(a.point_fields, b.point_fields);
  expect_same_fields(a.cell_fields, b.cell_fields);
  expect_same_sets(a, b);
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

TEST(SampleMeshes, HaveTheVolumesTheyClaim) {
  const VolumeMesh mesh = every_kind();
  // Determinants of small numbers: a few rounding errors of 1e-16.
  for (std::size_t c = 0; c < mesh.cells.cell_count(); ++c) {
    EXPECT_NEAR(test::volume(mesh.cells, c), test::every_kind_volumes()[c], 1e-14) << c;
  }
  EXPECT_EQ(subdiv::build(mesh.cells).solid.cell_count(), 5U);
}

TEST(VolumeMesh, EveryKindOfCellComesBackExactlyFromEveryFormat) {
  VolumeMesh all = every_kind();
  all.cells.positions.col(16) << 1.0 / 3, 0.1, 5e-324;  // coordinates too keep every bit
  for (const auto kind :
       {CellKind::tetrahedron, CellKind::pyramid, CellKind::wedge, CellKind::hexahedron, CellKind::polyhedron}) {
    VolumeMesh mesh = test::only(all, kind);
    for (const char* name : {"kind.mesh", "kind.vtk", "kind.vtu", "kind.msh", "kind.inp"}) {
      if (kind == CellKind::polyhedron && !volume_format_of(name).polyhedra) continue;
      write_volume_mesh(scratch(name), mesh);
      expect_same(read_volume_mesh(scratch(name)), mesh);
    }
    test::add_fields(mesh);
    for (const char* name : {"fields.vtk", "fields.vtu"}) {
      write_volume_mesh(scratch(name), mesh);
      expect_same(read_volume_mesh(scratch(name)), mesh);
    }
  }
  test::add_fields(all);
  for (const char* name : {"all.vtk", "all.vtu"}) {
    write_volume_mesh(scratch(name), all);
    expect_same(read_volume_mesh(scratch(name)), all);
  }
}

TEST(VolumeMesh, WrongEndingsAndMissingFilesAreNamed) {
  const Error ending = error_of([] { (void)read_volume_mesh("model.step"); });
  EXPECT_EQ(ending.code(), ErrorCode::unsupported);
  EXPECT_THAT(ending.what(), testing::HasSubstr(".step"));
  const Error missing = error_of([] { (void)read_volume_mesh("/no/such/model.vtu"); });
  EXPECT_EQ(missing.code(), ErrorCode::not_found);
  EXPECT_EQ(missing.where(), "/no/such/model.vtu");
  const Error folder = error_of([] { write_volume_mesh("/no/such/model.vtu", every_kind()); });
  EXPECT_EQ(folder.code(), ErrorCode::bad_input);
  EXPECT_EQ(error_of([] { (void)read_volume_mesh(scratch("folder.vtu").parent_path() / "" / ".vtu"); }).code(),
            ErrorCode::unsupported);
}

TEST(VolumeMesh, WhatCannotBeHeldLeavesTheOldFileAndNothingElse) {
  const auto path = scratch("refused") / "keep.mesh";
  std::filesystem::remove_all(path.parent_path());
  std::filesystem::create_directories(path.parent_path());
  write_file(path, "old");
  VolumeMesh mesh = every_kind();
  Error error = error_of([&] { write_volume_mesh(path, mesh); });
  EXPECT_EQ(error.code(), ErrorCode::unsupported);
  EXPECT_THAT(error.what(), testing::HasSubstr("polyhedra"));
  EXPECT_EQ(error.where(), "cell 4");
  mesh = test::only(mesh, CellKind::hexahedron);
  mesh.cell_fields = {{"stress", 1, {1}}};
  error = error_of([&] { write_volume_mesh(path, mesh); });
  EXPECT_EQ(error.code(), ErrorCode::unsupported);
  EXPECT_THAT(error.what(), testing::HasSubstr("stress"));
  mesh.cell_fields = {{"reference", 1, {std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_EQ(error_of([&] { write_volume_mesh(path, mesh); }).code(), ErrorCode::bad_input);
  mesh.cell_fields.clear();
  mesh.cells.positions(0, 3) = std::numeric_limits<double>::infinity();
  error = error_of([&] { write_volume_mesh(path, mesh); });
  EXPECT_EQ(error.where(), "vertex 3");
  EXPECT_EQ(read_file(path), "old");
  const std::filesystem::directory_iterator files(path.parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(Medit, ReadsItsOwnOrderOfVerticesAndPassesOverSurfaces) {
  // The prism of MEDIT winds its first triangle towards the second, VTK's wedge away from it.
  const VolumeMesh mesh = read_medit(
      "MeshVersionFormatted 1 Dimension\n3\n# a comment\nVertices 8\n"
      "0 0 0 0  1 0 0 0  1 1 0 0  0 1 0 0  0 0 1 0  1 0 1 0  1 1 1 0  0 1 1 7\n"
      "Triangles 1\n1 2 3 9\nRidges 1 1\nNormals 1 0 0 1\nNormalAtVertices 1 1 1\nCorners 2 1 "
      "2\nAngleOfCornerBound 30\n"
      "Tetrahedra 1\n1 2 4 5 3\nPrisms 1\n1 2 3 5 6 7 0\nPyramids 1\n1 2 3 4 5 -4\nHexahedra 1\n1 2 3 4 5 6 7 8 "
      "0\nEnd\n",
      "m.mesh");
  EXPECT_THAT(mesh.cells.kinds, testing::ElementsAre(CellKind::tetrahedron, CellKind::wedge, CellKind::pyramid,
                                                     CellKind::hexahedron));
  const double volumes[] = {1.0 / 6, 0.5, 1.0 / 3, 1};
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(test::volume(mesh.cells, c), volumes[c], 1e-14) << c;
  ASSERT_EQ(mesh.cell_fields.size(), 1U);
  EXPECT_EQ(mesh.cell_fields[0].name, "reference");
  EXPECT_THAT(mesh.cell_fields[0].values, testing::ElementsAre(3, 0, -4, 0));
  EXPECT_EQ(mesh.point_fields[0].values[7], 7);
  // References survive.
  expect_same(read_medit(medit_text(test::only(mesh, CellKind::wedge)), "again"),
              test::only(mesh, CellKind::wedge));
  EXPECT_THAT(medit_text(mesh), testing::HasSubstr("Prisms\n1\n1 2 3 5 6 7 0\n"));
  EXPECT_THAT(medit_text(mesh), testing::HasSubstr("Tetrahedra\n1\n1 2 4 5 3\n"));
}

TEST(Vtk, ReadsAsciiAndBinaryClassicAndNewCells) {
  VolumeMesh mesh = every_kind();
  mesh.point_fields = {{"height", 1, test::awkward(17)}, {"displacement", 3, test::awkward(51)}};
  mesh.cell_fields = {{"stress", 6, test::awkward(30)}};
  for (const bool binary : {false, true}) {
    for (const bool version_5 : {false, true}) {
      expect_same(read_vtk(encode_vtk(mesh, binary, version_5), "t"), mesh);
    }
  }
}

TEST(Vtk, ReadsEveryAttributeAndAVoxelAsAHexahedron) {
  const VolumeMesh mesh = read_vtk(
      "# vtk DataFile Version 2.0\n\nascii\ndataset unstructured_grid\nFIELD FieldData 1\nTIME 1 1 double\n0.5\n"
      "POINTS 8 float\n0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES "
      "1\n11\n"
      "CELL_DATA 1\nSCALARS a%20b unsigned_char 2\nLOOKUP_TABLE t\n1 2\nLOOKUP_TABLE t 2\n0 0 0 1 1 1 1 1\n"
      "TENSORS T float\n1 2 3 4 5 6 7 8 9\nTEXTURE_COORDINATES u 2 float\n3 4\nNORMALS n float\n0 0 1\n"
      "GLOBAL_IDS g vtkIdType\n12\nCOLOR_SCALARS c 3\n0.5 0.25 1\n",
      "t");
  EXPECT_EQ(mesh.cells.kinds[0], CellKind::hexahedron);
  EXPECT_NEAR(test::volume(mesh.cells, 0), 1, 1e-14);
  std::vector<std::string> names;
  for (const auto& field : mesh.cell_fields) names.push_back(field.name);
  EXPECT_THAT(names, testing::ElementsAre("a b", "T", "u", "n", "g", "c"));
  EXPECT_THAT(mesh.cell_fields[0].values, testing::ElementsAre(1, 2));
  EXPECT_EQ(mesh.cell_fields[4].values[0], 12);
}

TEST(Vtu, ReadsEveryEncoding) {
  using Place = VtuStyle::Place;
  VolumeMesh mesh = every_kind();
  mesh.point_fields = {{"height", 1, test::awkward(17)}, {"displacement", 3, test::awkward(51)}};
  mesh.cell_fields = {{"stress", 6, test::awkward(30)}};
  for (const Place place : {Place::ascii, Place::inline_base64, Place::appended_raw, Place::appended_base64}) {
    for (int bits = 0; bits < 16; ++bits) {
      const VtuStyle style{place, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
      SCOPED_TRACE(fmt::format("place {}, bits {}", static_cast<int>(place), bits));
      expect_same(read_vtu(VtuEncoder(style).encode(mesh), "t"), mesh);
    }
  }
}

TEST(Vtu, AnArrayInWholeBlocksAndAnEmptyOneAreRead) {
  VtuStyle style{VtuStyle::Place::inline_base64, true};
  style.block = 17 * 3 * 8;  // the points fill one block exactly, so the last partial size is 0
  expect_same(read_vtu(VtuEncoder(style).encode(every_kind()), "t"), every_kind());
}

TEST(Vtu, ArraysThatShareAppendedDataCannotMultiplyIt) {
  VolumeMesh mesh = every_kind();
  mesh.point_fields = {{"stress", 9, std::vector<double>(17 * 9, 0.5)}};
  std::string file = VtuEncoder({VtuStyle::Place::appended_raw}).encode(mesh);
  const std::size_t begin = file.find("<DataArray"), end = file.find("/>", begin) + 2;
  std::string copies;
  for (int i = 0; i < 100; ++i) {
    std::string copy = file.substr(begin, end - begin);
    copies += copy.replace(copy.find("stress"), 6, fmt::format("s{}", i)) + "\n";
  }
  file.insert(end, copies);  // each copy claims 1224 bytes and is itself a tenth of that
  EXPECT_THAT(error_of([&] { (void)read_vtu(file, "t"); }).what(),
              testing::HasSubstr("more than the array can hold"));
}

TEST(Vtu, EmptyFacesOfAGridWithoutPolyhedraAreRead) {
  const VolumeMesh mesh = test::only(every_kind(), CellKind::hexahedron);
  std::string file = VtuEncoder({}).encode(mesh);
  file.insert(file.find("</Cells>"),
              "<DataArray type=\"Int64\" Name=\"faces\" format=\"ascii\"/>\n"
              "<DataArray type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\">-1</DataArray>\n");
  expect_same(read_vtu(file, "t"), mesh);
}

TEST(Vtu, AZipBombIsRefusedBeforeItIsUnpacked) {
  // 10¹² points are claimed, and a compressed header that agrees with them.
  const std::string file = fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">"
      "<UnstructuredGrid><Piece NumberOfPoints=\"1000000000000\" NumberOfCells=\"1\"><Points><DataArray "
      "type=\"Float64\" "
      "NumberOfComponents=\"3\" "
      "format=\"binary\">{}</DataArray></Points><Cells/></Piece></UnstructuredGrid></VTKFile>",
      test::base64(test::bytes_of(std::vector<std::uint64_t>{1, 24000000000000, 0, 100}, false)));
  EXPECT_THAT(error_of([&] { (void)read_vtu(file, "t"); }).what(),
              testing::HasSubstr("more than the array can hold"));
}

}  // namespace
}  // namespace argil::io
