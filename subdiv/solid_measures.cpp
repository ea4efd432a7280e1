#include "subdiv/solid_measures.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace argil::subdiv {

namespace {

Eigen::Vector3d at(const Eigen::Matrix3Xd& positions, VertexId v) {
  return positions.col(static_cast<Eigen::Index>(v.index()));
}

// Calls visit(a, b, c) for the outward triangles of the cell's fanned faces.
template <class Visit>
void for_each_triangle(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId cell, Visit visit) {
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = solid.face_vertices(face_of(use));
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const VertexId v : loop) mean += at(positions, v);
    mean /= static_cast<double>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      Eigen::Vector3d a = at(positions, loop[i]), b = at(positions, loop[(i + 1) % loop.size()]);
      if (is_back(use)) a.swap(b);
      visit(mean, a, b);
    }
  }
}

double triple(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

double unit_triple(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0 ? triple(a, b, c) / lengths : 0.0;
}

}  // namespace

double cell_volume(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId cell) {
  // Measured from a vertex of the cell: far from the origin the coordinates themselves would cancel badly.
  const Eigen::Vector3d origin = at(positions, solid.face_vertices(face_of(solid.cell_face_uses(cell)[0]))[0]);
  double six_volumes = 0;
  for_each_triangle(solid, positions, cell,
                    [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
                      six_volumes += triple(a - origin, b - origin, c - origin);
                    });
  return six_volumes / 6;
}

MassProperties mass_properties(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  MassProperties result;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (const VertexId v : solid.vertices()) origin += at(positions, v);
  if (solid.vertex_count() > 0) origin /= static_cast<double>(solid.vertex_count());
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // ∫ r dV about the origin chosen
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // ∫ r rᵀ dV
  for (const CellId cell : solid.cells())
    for_each_triangle(
        solid, positions, cell, [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
          // The tetrahedron of the triangle and the origin, exactly.
          const Eigen::Vector3d a = p - origin, b = q - origin, c = r - origin, sum = a + b + c;
          const double volume = triple(a, b, c) / 6;
          result.volume += volume;
          first += volume / 4 * sum;
          second +=
              volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
        });
  const Eigen::Vector3d offset =
      result.volume != 0 ? Eigen::Vector3d(first / result.volume) : Eigen::Vector3d::Zero();
  result.centre = origin + offset;
  second -= result.volume * offset * offset.transpose();
  result.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

double scaled_jacobian(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId hexahedron) {
  const auto vertices = vtk_vertices(solid, hexahedron);
  std::array<Eigen::Vector3d, 8> p;
  for (std::size_t i = 0; i < 8; ++i) p[i] = at(positions, vertices[i]);
  // At each corner its neighbours along u, v, w, taken right-handed.
  static constexpr int k_neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                             {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  const Eigen::Vector3d u = p[1] - p[0] + p[2] - p[3] + p[5] - p[4] + p[6] - p[7];
  const Eigen::Vector3d v = p[3] - p[0] + p[2] - p[1] + p[7] - p[4] + p[6] - p[5];
  const Eigen::Vector3d w = p[4] - p[0] + p[5] - p[1] + p[6] - p[2] + p[7] - p[3];
  double smallest = unit_triple(u, v, w);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto& n = k_neighbours[i];
    smallest = std::min(smallest, unit_triple(p[n[0]] - p[i], p[n[1]] - p[i], p[n[2]] - p[i]));
  }
  return smallest;
}

std::optional<WorstCell> min_scaled_jacobian(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  std::optional<WorstCell> worst;
  for (const CellId c : solid.cells()) {
    if (cell_kind(solid, c) != CellKind::hexahedron) continue;
    const double value = scaled_jacobian(solid, positions, c);
    if (!worst || value < worst->value) worst = WorstCell{c, value};
  }
  return worst;
}

InvertedCells inverted_cells(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  InvertedCells result;
  for (const CellId c : solid.cells()) {
    if (!(cell_volume(solid, positions, c) < 0)) continue;
    if (result.count++ == 0) result.first = c;
  }
  return result;
}

std::map<std::size_t, std::size_t> interior_edge_valences(const Solid& solid) {
  std::map<std::size_t, std::size_t> result;
  for (const EdgeId e : solid.edges())
    if (!solid.is_boundary(e)) ++result[solid.edge_valence(e)];
  return result;
}

std::array<std::size_t, 5> cell_kind_counts(const Solid& solid) {
  std::array<std::size_t, 5> result{};
  for (const CellId c : solid.cells()) ++result[static_cast<std::size_t>(cell_kind(solid, c))];
  return result;
}

}  // namespace argil::subdiv
