#pragma once
// VTK's XML unstructured grids (.vtu), one piece.
// Read: ascii, inline binary and appended (raw, base64) arrays, plain or zlib-compressed, either byte order, UInt32
// and UInt64 headers; polyhedra by faces and faceoffsets; numeric point and cell arrays. Passed over, as is usual:
// FieldData and InformationKey. Refused by name: other compressors, string arrays, kinds of cell that are not held,
// several pieces. Written: doubles, appended raw in this machine's byte order behind UInt64 headers, the same
// compressed by zlib in blocks, or ascii. Sets of points and cells are arrays of 0 and 1 named "set:NAME".

#include <string>
#include <string_view>

#include "io/volume_mesh.h"

namespace argil::io {

/// @throws Error (bad_input, unsupported), `where` is "name:line:column"; of a binary array that of its element.
[[nodiscard]] VolumeMesh read_vtu(std::string_view bytes, std::string_view name);

[[nodiscard]] std::string vtu_bytes(const VolumeMesh& mesh, const WriteOptions& options = {});

}  // namespace argil::io
