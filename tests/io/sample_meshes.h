#pragma once
// A small solid with every kind of cell glued face to face, its known volumes, and an independent volume function.

#include <Eigen/Dense>
#include <bit>
#include <cstdint>
#include <vector>

#include "io/volume_mesh.h"

namespace argil::io::test {

/// A unit cube; a pyramid on it (1/3); a wedge at its side (1/2); a tetrahedron between those two (1/6); a
/// pentagonal prism as a polyhedron at the other side (5/4).
inline VolumeMesh every_kind() {
  using subdiv::CellKind;
  VolumeMesh mesh;
  mesh.cells.positions.resize(3, 17);
  mesh.cells.positions << 0, 1, 1, 0, 0, 1, 1, 0, 0.5, 2, 2, -1, -1.5, -1, -1, -1.5, -1,  //
      0, 0, 1, 1, 0, 0, 1, 1, 0.5, 0.5, 0.5, 0, 0.5, 1, 0, 0.5, 1,                        //
      0, 0, 0, 0, 1, 1, 1, 1, 2, 0, 1, 0, 0, 0, 1, 1, 1;
  const auto add = [&](CellKind kind, std::vector<std::uint32_t> numbers) {
    mesh.cells.kinds.push_back(kind);
    mesh.cells.connectivity.insert(mesh.cells.connectivity.end(), numbers.begin(), numbers.end());
    mesh.cells.offsets.push_back(mesh.cells.connectivity.size());
  };
  add(CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  add(CellKind::pyramid, {4, 5, 6, 7, 8});
  add(CellKind::wedge, {1, 2, 9, 5, 6, 10});
  add(CellKind::tetrahedron, {5, 10, 6, 8});
  add(CellKind::polyhedron, {7, 5,  0,  11, 12, 13, 3,  5,  4,  7, 16, 15, 14, 4,  0, 3,  7, 4, 4,
                             3, 13, 16, 7,  4,  13, 12, 15, 16, 4, 12, 11, 14, 15, 4, 11, 0, 4, 14});
  return mesh;
}

inline std::vector<double> every_kind_volumes() {
  return {1, 1.0 / 3, 0.5, 1.0 / 6, 1.25};
}

/// Values that lose bits in every shortcut: thirds, a subnormal, minus zero, the largest double.
inline std::vector<double> awkward(std::size_t count) {
  const double list[] = {
      1.0 / 3, 0.1, -0.0, 5e-324, 1.7976931348623157e308, -2.2250738585072014e-308, 123456789.123456789};
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = list[i % 7] * (i < 7 ? 1.0 : 0.5);
  return values;
}

inline void add_fields(VolumeMesh& mesh) {
  const auto points = static_cast<std::size_t>(mesh.cells.positions.cols());
  mesh.point_fields = {{"height", 1, awkward(points)}, {"a <b> & \"c\" 100%25", 3, awkward(3 * points)}};
  mesh.cell_fields = {{"stress", 6, awkward(6 * mesh.cells.cell_count())}};
}

/// The cells of one kind alone.
inline VolumeMesh only(const VolumeMesh& mesh, subdiv::CellKind kind) {
  VolumeMesh out;
  out.cells.positions = mesh.cells.positions;
  for (std::size_t c = 0; c < mesh.cells.cell_count(); ++c) {
    if (mesh.cells.kinds[c] != kind) continue;
    out.cells.kinds.push_back(kind);
    const auto at = mesh.cells.connectivity.begin();
    out.cells.connectivity.insert(out.cells.connectivity.end(),
                                  at + static_cast<std::ptrdiff_t>(mesh.cells.offsets[c]),
                                  at + static_cast<std::ptrdiff_t>(mesh.cells.offsets[c + 1]));
    out.cells.offsets.push_back(out.cells.connectivity.size());
  }
  return out;
}

/// Signed volume of a cell from the definition of VTK's cells, by tetrahedra (a, b, c, d) with d on the side that
/// the counter-clockwise triangle a b c faces.
inline double volume(const subdiv::CellLists& cells, std::size_t cell) {
  const std::uint32_t* v = cells.connectivity.data() + cells.offsets[cell];
  const auto tetrahedron = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    Eigen::Matrix3d edges;
    edges << cells.positions.col(b) - cells.positions.col(a), cells.positions.col(c) - cells.positions.col(a),
        cells.positions.col(d) - cells.positions.col(a);
    return edges.determinant() / 6;
  };
  switch (cells.kinds[cell]) {
    case subdiv::CellKind::tetrahedron:
      return tetrahedron(v[0], v[1], v[2], v[3]);
    case subdiv::CellKind::pyramid:
      return tetrahedron(v[0], v[1], v[2], v[4]) + tetrahedron(v[0], v[2], v[3], v[4]);
    case subdiv::CellKind::wedge:  // its first triangle faces away from the second
      return tetrahedron(v[0], v[2], v[1], v[4]) + tetrahedron(v[0], v[2], v[4], v[5]) +
             tetrahedron(v[0], v[5], v[4], v[3]);
    case subdiv::CellKind::hexahedron:
      return tetrahedron(v[0], v[1], v[3], v[4]) + tetrahedron(v[1], v[2], v[3], v[6]) +
             tetrahedron(v[4], v[6], v[5], v[1]) + tetrahedron(v[4], v[7], v[6], v[3]) +
             tetrahedron(v[1], v[3], v[4], v[6]);
    case subdiv::CellKind::polyhedron:
      break;
  }
  double sum = 0;
  const std::uint32_t apex = v[2];
  const std::uint32_t* face = v + 1;
  for (std::uint32_t f = 0; f < v[0]; ++f) {
    for (std::uint32_t i = 2; i < face[0]; ++i) sum -= tetrahedron(face[1], face[i], face[i + 1], apex);
    face += 1 + face[0];
  }
  return sum;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

}  // namespace argil::io::test
