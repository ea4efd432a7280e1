#include "fem/measure/quality.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "fem/elements/element_kind.h"
#include "fem/measure/strain.h"
#include "fem/parallel.h"
#include "subdiv/build.h"
#include "subdiv/neighbourhood.h"
#include "subdiv/radial_edge.h"

namespace argil::fem {

namespace {

using namespace subdiv;

// The smallest value over their mean; −1 if the mean is not positive.
double worst_ratio(double smallest, double sum, std::size_t count) {
  return sum > 0 ? smallest * static_cast<double>(count) / sum : -1;
}

double hexahedron(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId cell) {
  const ElementKind& kind = trilinear_hexahedron();
  Eigen::Matrix<double, 3, 8> nodes;
  const auto box = box_vertices(solid, cell);
  for (std::size_t a = 0; a < 8; ++a)
    nodes.col(static_cast<Eigen::Index>(a)) = positions.col(static_cast<Eigen::Index>(box[a].index()));
  double smallest = std::numeric_limits<double>::max(), sum = 0;
  for (int q = 0; q < kind.point_count; ++q) {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) {
      const double* gradient = &kind.gradients[static_cast<std::size_t>((q * 8 + a) * 3)];
      jacobian += nodes.col(a) * Eigen::Map<const Eigen::RowVector3d>(gradient);
    }
    const double determinant = jacobian.determinant();
    smallest = std::min(smallest, determinant);
    sum += determinant;
  }
  return worst_ratio(smallest, sum, 8);
}

double polyhedron(const Solid& solid, const Eigen::Matrix3Xd& positions, CellId cell) {
  const auto at = [&](VertexId v) -> Eigen::Vector3d {
    return positions.col(static_cast<Eigen::Index>(v.index()));
  };
  const auto vertices = cell_vertices(solid, cell);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const VertexId v : vertices) middle += at(v) / static_cast<double>(vertices.size());
  double smallest = std::numeric_limits<double>::max(), sum = 0;
  std::size_t count = 0;
  for (const FaceUseId use : solid.cell_face_uses(cell)) {
    const auto loop = use_vertices(solid, use);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const VertexId v : loop) centre += at(v) / static_cast<double>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double volume =
          (at(loop[i]) - middle).cross(at(loop[(i + 1) % loop.size()]) - middle).dot(centre - middle);
      smallest = std::min(smallest, volume);
      sum += volume;
      ++count;
    }
  }
  return worst_ratio(smallest, sum, count);
}

}  // namespace

WorstJacobian min_relative_jacobian(const Solid& solid, const Eigen::Matrix3Xd& positions) {
  WorstJacobian worst{std::numeric_limits<double>::max(), CellId{}};
  for (const CellId c : solid.cells()) {
    const double value = cell_kind(solid, c) == CellKind::hexahedron ? hexahedron(solid, positions, c)
                                                                     : polyhedron(solid, positions, c);
    if (value < worst.value) worst = {value, c};
  }
  if (!worst.cell.valid()) worst.value = 1;
  return worst;
}

double min_volume_ratio(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes) {
  constexpr double k_none = std::numeric_limits<double>::max();
  double smallest = k_none;
  for (const ElementBlock& block : blocks) {
    std::vector<double> of_element(block.element_count(), k_none);
    parallel_for(block.element_count(), 64, [&](std::size_t element) {
      for (int point = 0; point < block.kind->point_count; ++point) {
        const std::size_t index = block.point_index(element, point);
        if (block.mu[index] == 0 && block.lambda[index] == 0) continue;
        of_element[element] =
            std::min(of_element[element], deformation_gradient(block, element, point, nodes).determinant());
      }
    });
    for (const double value : of_element) smallest = std::min(smallest, value);
  }
  return smallest == k_none ? 1 : smallest;
}

}  // namespace argil::fem
