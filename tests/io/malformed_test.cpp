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
