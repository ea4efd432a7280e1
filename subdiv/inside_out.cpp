#include "subdiv/inside_out.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>

#include "subdiv/cell_kinds.h"

namespace argil::subdiv {
namespace {

// Six times the signed volume between a face and a point.
template <class Corner>
double face_volume(const Eigen::Matrix3Xd& positions, std::size_t corners, const Eigen::Vector3d& origin,
                   Corner corner) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners; ++i) middle += positions.col(corner(i));
  middle = middle / static_cast<double>(corners) - origin;
  double sum = 0;
  for (std::size_t i = 0; i < corners; ++i) {
    const Eigen::Vector3d a = positions.col(corner(i)) - origin,
                          b = positions.col(corner((i + 1) % corners)) - origin;
    sum += middle.dot(a.cross(b));
  }
  return sum;
}

double cell_volume(const CellLists& lists, std::size_t cell) {
  const std::uint32_t* numbers = lists.connectivity.data() + lists.offsets[cell];
  double sum = 0;
  if (lists.kinds[cell] == CellKind::polyhedron) {
    const Eigen::Vector3d origin = lists.positions.col(numbers[2]);
    const std::uint32_t* face = numbers + 1;
    for (std::uint32_t f = 0; f < numbers[0]; face += 1 + face[0], ++f)
      sum += face_volume(lists.positions, face[0], origin, [&](std::size_t i) { return face[1 + i]; });
    return sum;
  }
  const Eigen::Vector3d origin = lists.positions.col(numbers[0]);
  const auto table = face_table(lists.kinds[cell]);
  for (std::size_t at = 0; at < table.size(); at += 1 + table[at])
    sum +=
        face_volume(lists.positions, table[at], origin, [&](std::size_t i) { return numbers[table[at + 1 + i]]; });
  return sum;
}

}  // namespace

std::vector<std::size_t> inside_out_cells(const CellLists& lists) {
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < lists.cell_count(); ++c)
    if (cell_volume(lists, c) < 0) cells.push_back(c);
  return cells;
}

void turn_inside_out(CellLists& lists, std::size_t cell) {
  std::uint32_t* numbers = lists.connectivity.data() + lists.offsets[cell];
  switch (lists.kinds[cell]) {
    case CellKind::tetrahedron:
      std::swap(numbers[1], numbers[2]);
      return;
    case CellKind::pyramid:
      std::swap(numbers[1], numbers[3]);
      return;
    case CellKind::wedge:
      std::swap(numbers[1], numbers[2]);
      std::swap(numbers[4], numbers[5]);
      return;
    case CellKind::hexahedron:
      std::swap(numbers[1], numbers[3]);
      std::swap(numbers[5], numbers[7]);
      return;
    case CellKind::polyhedron:
      break;
  }
  std::uint32_t* face = numbers + 1;
  for (std::uint32_t f = 0; f < numbers[0]; face += 1 + face[0], ++f) std::reverse(face + 1, face + 1 + face[0]);
}

}  // namespace argil::subdiv
