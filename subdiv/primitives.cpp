#include "subdiv/primitives.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "subdiv/error.h"
#include "subdiv/transaction.h"

namespace argil::subdiv {

namespace {

void check_size(const Eigen::Vector3d& size) {
  for (int k = 0; k < 3; ++k)
    if (!(std::isfinite(size[k]) && size[k] > 0))
      throw Error(ErrorCode::bad_input,
                  fmt::format("the {} size is {}; expected a positive, finite length [m]", "xyz"[k], size[k]));
}

Built single_cell(CellKind kind, const Eigen::Vector3d& size,
                  std::initializer_list<std::array<double, 3>> unit_points) {
  check_size(size);
  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(unit_points.size()));
  std::uint32_t i = 0;
  for (const auto& p : unit_points) {
    lists.positions.col(i) = Eigen::Vector3d(p[0], p[1], p[2]).cwiseProduct(size);
    lists.connectivity.push_back(i++);
  }
  lists.kinds.push_back(kind);
  lists.offsets.push_back(lists.connectivity.size());
  return build(lists);
}

}  // namespace

Built box_grid(int nx, int ny, int nz, const Eigen::Vector3d& size) {
  for (const auto& [count, axis] : {std::pair{nx, 'x'}, {ny, 'y'}, {nz, 'z'}})
    if (count < 1)
      throw Error(ErrorCode::bad_input,
                  fmt::format("the number of cells along {} is {}; expected at least 1", axis, count));
  check_size(size);
  if (static_cast<double>(nx) * ny * nz > 1e8)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("a grid of {} x {} x {} cells is beyond the 1e8 that a solid holds; ask for fewer", nx,
                            ny, nz));
  const auto vertex = [&](int i, int j, int k) {
    return static_cast<std::uint32_t>((static_cast<std::size_t>(k) * (ny + 1) + j) * (nx + 1) + i);
  };
  CellLists lists;
  lists.positions.resize(3, static_cast<Eigen::Index>(vertex(nx, ny, nz)) + 1);
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        lists.positions.col(vertex(i, j, k)) =
            Eigen::Vector3d(size.x() * i / nx, size.y() * j / ny, size.z() * k / nz);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        for (const std::uint32_t v :
             {vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i, j + 1, k),
              vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)})
          lists.connectivity.push_back(v);
        lists.kinds.push_back(CellKind::hexahedron);
        lists.offsets.push_back(lists.connectivity.size());
      }
  return build(lists);
}

Built tetrahedron(const Eigen::Vector3d& size) {
  return single_cell(CellKind::tetrahedron, size, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

Built wedge(const Eigen::Vector3d& size) {
  return single_cell(CellKind::wedge, size, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}});
}

Built pyramid(const Eigen::Vector3d& size) {
  return single_cell(CellKind::pyramid, size, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}});
}

std::size_t sharpen_outline(Solid& solid) {
  std::size_t count = 0;
  Transaction transaction(solid);
  for (const EdgeId e : solid.edges())
    if (solid.edge_valence(e) == 2) {
      transaction.set_sharpness(e, k_infinitely_sharp);
      ++count;
    }
  (void)transaction.commit();
  return count;
}

}  // namespace argil::subdiv
