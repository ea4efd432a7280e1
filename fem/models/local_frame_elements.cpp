#include "fem/models/local_frame_elements.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "fem/models/linear.h"
#include "subdiv/error.h"

namespace argil::fem::local_frame {
namespace {

/// A block as papers/004 integrates it: ∂x/∂u for the strain, over the unit cube.
ElementBlock in_cell_coordinates(const ElementBlock& block) {
  ElementBlock result = block;
  for (std::size_t e = 0; e < block.element_count(); ++e)
    for (int q = 0; q < block.kind->point_count; ++q) {
      const std::size_t i = block.point_index(e, q);
      result.inverse_rest_jacobians[i].setIdentity();
      result.volumes[i] = block.kind->weights[static_cast<std::size_t>(q)];
    }
  return result;
}

/// Equation 15: block (a, b) is diag over x of 2 Σ_s K(3a + s, 3b + x).
Eigen::MatrixXd printed_stiffness(const Eigen::MatrixXd& stiffness) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(stiffness.rows(), stiffness.cols());
  for (Eigen::Index a = 0; a < stiffness.rows(); a += 3)
    for (Eigen::Index column = 0; column < stiffness.cols(); ++column) {
      const Eigen::Index axis = column % 3;
      result(a + axis, column) = 2 * (stiffness(a, column) + stiffness(a + 1, column) + stiffness(a + 2, column));
    }
  return result;
}

FillMatrices fill_printed(const Eigen::Matrix3Xd& rest_nodes) {
  return [&rest_nodes](const ElementBlock& distinct, double* matrices) {
    const ElementBlock printed = in_cell_coordinates(distinct);
    make_linear({&printed, 1}, rest_nodes)
        ->tangent(rest_nodes, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
          const Eigen::MatrixXd k = printed_stiffness(stiffness);
          matrices = std::copy(k.data(), k.data() + k.size(), matrices);
        });
  };
}

void measure(Part& part, const Eigen::Matrix3Xd& rest_nodes) {
  const ElementBlock& block = *part.block;
  const std::size_t n = part.node_count(), count = block.element_count();
  part.rest_measures.resize(count * part.measure_count());
  part.gradients.resize(count);
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd in_cell;
  block.kind->evaluate({0.5, 0.5, 0.5}, shapes, in_cell);
  parallel_for(count, 32, [&](std::size_t e) {
    std::vector<double> x(3 * n);
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < n; ++a) {
      const Eigen::Vector3d at = rest_nodes.col(block.nodes[e * n + a]);
      for (int axis = 0; axis < 3; ++axis) {
        x[3 * a + static_cast<std::size_t>(axis)] = at[axis];
        jacobian.col(axis) += in_cell(axis, static_cast<Eigen::Index>(a)) * at;
      }
    }
    local_rest_measures(*part.topology, x.data(), part.rest_measures.data() + e * part.measure_count());
    part.gradients[e] = jacobian.inverse().transpose() * in_cell;
  });
}

}  // namespace

LocalFrames::LocalFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes)
    : sums(blocks, static_cast<std::size_t>(rest_nodes.cols())) {
  for (const ElementBlock& block : blocks) {
    Part part{&block, parts_.size(), &local_topology(*block.kind), {}, {}};
    measure(part, rest_nodes);
    parts_.push_back(std::move(part));
  }
}

void take(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& to) {
  const std::size_t n = part.node_count();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t axis = 0; axis < 3; ++axis)
      to.values[3 * a + axis] = x(static_cast<Eigen::Index>(axis), part.nodes(element)[a]);
}
void displacements(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& result) {
  Local at;
  take(part, element, x, at);
  local_displacements(*part.topology, part.block->kind->node_count,
                      part.rest_measures.data() + element * part.measure_count(), at.values, result.values);
}
void turn(const Eigen::Matrix3d& by, std::size_t nodes, Local& values) {
  for (std::size_t a = 0; a < nodes; ++a) {
    const Eigen::Vector3d v =
        by * Eigen::Vector3d(values.values[3 * a], values.values[3 * a + 1], values.values[3 * a + 2]);
    for (int axis = 0; axis < 3; ++axis) values.values[3 * a + static_cast<std::size_t>(axis)] = v[axis];
  }
}

Eigen::Matrix3d frame(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
  const std::size_t n = part.node_count();
  for (std::size_t a = 0; a < n; ++a)
    f += x.col(part.nodes(element)[a]) * part.gradients[element].col(static_cast<Eigen::Index>(a)).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

CurrentFrames::CurrentFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, bool literal)
    : blocks_(blocks), rest_nodes_(rest_nodes), literal_(literal) {
  for (const ElementBlock& block : blocks)
    if (block.kind != &trilinear_hexahedron() && block.kind != &bspline_hexahedron() && block.kind != &pyramid())
      throw Error(ErrorCode::unsupported,
                  fmt::format("the published local frame measures edges and angles of hexahedra and pyramids; a {} "
                              "has no such; choose another model",
                              block.kind->name));
  frames_ = std::make_shared<LocalFrames>(blocks, rest_nodes);
  (void)stiffness();
}

const std::shared_ptr<const ElementStiffness>& CurrentFrames::stiffness() {
  if (stiffness_ && stiffness_->is_current()) return stiffness_;
  stiffness_ = literal_ ? std::make_shared<ElementStiffness>(blocks_, rest_nodes_, fill_printed(rest_nodes_))
                        : std::make_shared<ElementStiffness>(blocks_, rest_nodes_, Formulation::plain);
  return stiffness_;
}

}  // namespace argil::fem::local_frame
