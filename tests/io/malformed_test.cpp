// Malformed files and what each must be told: the code, the place and a part of the message.

#include <gmock/gmock.h>

#include <set>

#include "io/volume_mesh.h"
#include "subdiv/error.h"

namespace argil::io {
namespace {

struct Malformed {
  const char* file;
  ErrorCode code;
  const char* place;    // after the file's name
  const char* message;  // a part of it
};
constexpr Malformed k_malformed[] = {
    {"after_the_end.mesh", ErrorCode::bad_input, ":13:1", "expected nothing more, found \"garbage\""},
    {"after_the_end.vtu", ErrorCode::bad_input, ":15:11", "expected nothing after </VTKFile>"},
    {"appended_beyond.vtu", ErrorCode::bad_input, ":6:2", "the offset 99 is beyond the 5 bytes of appended data"},
    {"bad_base64.vtu", ErrorCode::bad_input, ":6:2", "expected base64 text, found the character code 42"},
    {"binary_cut_short.vtk", ErrorCode::bad_input, ":5:10", "expected 2 × 3 values, but only 5 bytes are left"},
    {"binary_nan.vtk", ErrorCode::bad_input, ": byte 89", "expected a finite number, found nan"},
    {"cell_list_too_short.vtk", ErrorCode::bad_input, ":11:9", "CELLS says 2 cells, but its 5 numbers end after 1"},
    {"curved.mesh", ErrorCode::unsupported, ":9:1", "the section TetrahedraP2 is not held; convert it"},
    {"cut_short.mesh", ErrorCode::bad_input, ":4:1",
     "the 21 bytes left in the file can hold, found 4; was it cut short?"},
    {"damaged_zlib.vtu", ErrorCode::bad_input, ":6:2", "compressed block 0 is damaged or not of 96 bytes"},
    {"entity_bomb.vtu", ErrorCode::bad_input, ":2:1", "expected plain XML, found a document type"},
    {"face_stream.vtk", ErrorCode::bad_input, ":11:30",
     "polyhedron 0: a face is longer than what is left of the cell"},
    {"field_of_wrong_length.vtk", ErrorCode::bad_input, ":16:10", "the array \"height\" has 3 tuples; expected 4"},
    {"flat.mesh", ErrorCode::unsupported, ":2:11", "the mesh is flat (Dimension 2)"},
    {"huge_count.mesh", ErrorCode::bad_input, ":4:1",
     "the 13 bytes left in the file can hold, found 1000000000000"},
    {"huge_count.vtu", ErrorCode::bad_input, ":6:2",
     "expected 1000000000000 × 3 numbers, more than the array can hold"},
    {"negative_vertex.vtk", ErrorCode::bad_input, ":11:9",
     "expected a vertex below 4 (the number of points), found -3"},
    {"newer_version.vtk", ErrorCode::unsupported, ":1:24", "version 6.0 is not held; expected 2.0 to 5.1"},
    {"no_cells.mesh", ErrorCode::bad_input, ":12:1", "the mesh has no solid cells"},
    {"no_faces.vtu", ErrorCode::bad_input, ":8:2", "expected an array named faceoffsets, found none"},
    {"not_a_number.mesh", ErrorCode::bad_input, ":7:3", "expected a coordinate that is finite, found \"nan\""},
    {"not_vtk.vtk", ErrorCode::bad_input, ":1:1",
     "expected a first line \"# vtk DataFile Version ...\", found \"solid\""},
    {"offset_beyond.vtu", ErrorCode::bad_input, ":9:2", "expected 400 × 1 numbers, more than the array can hold"},
    {"overflowing_count.mesh", ErrorCode::bad_input, ":4:1",
     "expected a number of vertices from 0 to 9223372036854775807, found \"99999999999999999999\""},
    {"polydata.vtk", ErrorCode::unsupported, ":4:9",
     "the data set \"POLYDATA\" is not held; convert it to UNSTRUCTURED_GRID"},
    {"quadratic.vtk", ErrorCode::unsupported, ":13:1",
     "cell 0 is a quadratic hexahedron (VTK type 25); convert it"},
    {"surface.vtk", ErrorCode::unsupported, ":15:1",
     "cell 1 is a triangle (VTK type 5); remove the cells that are not solid"},
    {"too_few_points.vtu", ErrorCode::bad_input, ":6:2", "expected 4 × 3 numbers, more than the array can hold"},
    {"unclosed_element.vtu", ErrorCode::bad_input, ":7:3", "expected well-formed XML: Start-end tags mismatch"},
    {"unknown_compressor.vtu", ErrorCode::unsupported, ":2:86",
     "expected compressor=\"vtkZLibDataCompressor\", found \"vtkLZ4DataCompressor\""},
    {"unknown_section.mesh", ErrorCode::bad_input, ":9:1", "found \"Tetrahedrons\""},
    {"vertex_out_of_range.mesh", ErrorCode::bad_input, ":11:7", "expected a vertex from 1 to 4, found \"5\""},
    {"word_for_number.mesh", ErrorCode::bad_input, ":7:3", "expected a coordinate, found \"1,5\""},
    {"not_gmsh.msh", ErrorCode::bad_input, ":1:1", "expected $MeshFormat, found \"gmsh\""},
    {"version_4_0.msh", ErrorCode::unsupported, ":2:1", "version \"4.0\" is not held; expected 4.1 or 2.2"},
    {"huge_count.msh", ErrorCode::bad_input, ":5:3", "found 1000000000000; was it cut short?"},
    {"unknown_node.msh", ErrorCode::bad_input, ":19:9", "expected a node of $Nodes, found 5"},
    {"twice_a_node.msh", ErrorCode::bad_input, ":14:5", "two nodes have the tag 3; renumber one"},
    {"curved.msh", ErrorCode::unsupported, ":13:3", "a tetrahedron of 10 nodes (Gmsh type 11) is not held"},
    {"unknown_type.msh", ErrorCode::unsupported, ":18:5", "the element type 99 is unknown"},
    {"block_of_another_size.msh", ErrorCode::bad_input, ":14:5",
     "the blocks have 1 nodes fewer than the section says"},
    {"no_end.msh", ErrorCode::bad_input, ":16:1", "expected $EndPeriodic behind it; was the file cut short?"},
    {"data_lacking.msh", ErrorCode::bad_input, ":23:1", "the data \"height\" lack 1 of the nodes"},
    {"binary_cut_short.msh", ErrorCode::bad_input, ":6:1", "that the 25 bytes left in the file can hold, found 1"},
    {"binary_nan.msh", ErrorCode::bad_input, ": byte 61", "expected a coordinate that is finite, found nan"},
    {"byte_order.msh", ErrorCode::bad_input, ": byte 20", "expected the number 1 in 4 bytes"},
    {"include.inp", ErrorCode::unsupported, ":2:1", "*INCLUDE is not held"},
    {"curved.inp", ErrorCode::unsupported, ":6:16", "the curved element C3D10 is not held; convert it"},
    {"unknown_type.inp", ErrorCode::unsupported, ":6:16", "the element type \"C3D8X\" is unknown"},
    {"two_instances.inp", ErrorCode::unsupported, ":4:1", "a second *INSTANCE is not held"},
    {"unknown_node.inp", ErrorCode::bad_input, ":7:1", "element 1: there is no node 9"},
    {"too_few_corners.inp", ErrorCode::bad_input, ":8:1", "expected 4 corners for element 1, found 3"},
    {"too_many_corners.inp", ErrorCode::bad_input, ":7:16", "element 1 has 4 corners, found one more"},
    {"twice_a_node.inp", ErrorCode::bad_input, ":6:1", "node 1 stands twice"},
    {"not_a_number.inp", ErrorCode::bad_input, ":3:4", "expected a coordinate that is finite, found \"1.x\""},
    {"unknown_set.inp", ErrorCode::bad_input, ":9:4",
     "expected a number or the name of a set before this one, found \"legs\""},
    {"huge_range.inp", ErrorCode::bad_input, ":9:1", "the range has 1000000000000 numbers, more than there are"},
    {"no_type.inp", ErrorCode::bad_input, ":6:1", "expected a TYPE for *ELEMENT"},
    {"no_cells.inp", ErrorCode::bad_input, ":6:1", "the file has no solid cells"},
    {"text_first.inp", ErrorCode::bad_input, ":1:1", "expected a keyword such as *HEADING or *NODE"},
    {"not_ovm.ovm", ErrorCode::bad_input, ":1:1", "expected a first line \"OVM ASCII\", found \"OFF\""},
    {"binary.ovm", ErrorCode::unsupported, ":1:5", "the binary form is not held"},
    {"huge_count.ovm", ErrorCode::bad_input, ":3:1", "found 1000000000000; was it cut short?"},
    {"vertex_out_of_range.ovm", ErrorCode::bad_input, ":15:3", "expected a vertex from 0 to 3, found \"4\""},
    {"open_face.ovm", ErrorCode::bad_input, ":18:7",
     "face 0: expected a half-edge that starts at vertex 2, where the one before ends, found one from 0"},
    {"half_face_out_of_range.ovm", ErrorCode::bad_input, ":24:9", "expected a half-face from 0 to 7, found \"8\""},
    {"half_face_twice.ovm", ErrorCode::bad_input, ":24:9", "the half-face 5 belongs to a polyhedron already"},
    {"two_corners.ovm", ErrorCode::bad_input, ":18:1", "expected at least 3 half-edges of a face"},
    {"no_polyhedra.ovm", ErrorCode::bad_input, ":23:1", "the file has no polyhedra"},
    {"unknown_property.ovm", ErrorCode::unsupported, ":25:7", "properties of \"matrix\" are not held"},
    {"property_cut_short.ovm", ErrorCode::bad_input, ":25:14", "expected 4 × 1 values, but only 4 bytes are left"},
};

std::filesystem::path folder() {
  return std::filesystem::path(ARGIL_TESTS_DIR) / "io" / "malformed";
}

TEST(Malformed, EachFileIsRefusedWithItsPlaceAndReason) {
  for (const Malformed& expected : k_malformed) {
    SCOPED_TRACE(expected.file);
    const auto path = folder() / expected.file;
    try {
      (void)read_volume_mesh(path);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), expected.code);
      EXPECT_EQ(error.where(), path.string() + expected.place);
      EXPECT_THAT(error.what(), testing::HasSubstr(expected.message));
    }
  }
}

TEST(Malformed, NoFileIsForgotten) {
  std::set<std::string> files, listed;
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    files.insert(entry.path().filename().string());
  for (const Malformed& expected : k_malformed) listed.insert(expected.file);
  EXPECT_EQ(files, listed);
}

}  // namespace
}  // namespace argil::io
