#include "tests/subdiv/cells.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace argil::subdiv::test {

CellLists dodecahedron() {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> corners;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) corners.emplace_back(a, b, c);
      corners.emplace_back(0, a / phi, b * phi);
      corners.emplace_back(a / phi, b * phi, 0);
      corners.emplace_back(b * phi, 0, a / phi);
    }
  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    lists.positions.col(static_cast<Eigen::Index>(i)) = corners[i] * phi / 2;
  std::vector<Loop> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0}) {
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        normal[(axis + 1) % 3] = a * phi;
        normal[(axis + 2) % 3] = b;
        Loop face;
        for (std::uint32_t i = 0; i < corners.size(); ++i)
          if (corners[i].dot(normal) > phi * phi - 1e-9) face.push_back(i);
        const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
        const auto angle = [&](std::uint32_t i) { return std::atan2(corners[i].dot(y), corners[i].dot(x)); };
        std::sort(face.begin(), face.end(), [&](auto i, auto j) { return angle(i) < angle(j); });
        faces.push_back(face);
      }
  add_polyhedron(lists, faces);
  return lists;
}

}  // namespace argil::subdiv::test
