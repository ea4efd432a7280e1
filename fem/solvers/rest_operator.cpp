#include "fem/solvers/rest_operator.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "fem/solvers/block_accumulator.h"

namespace argil::fem {

void ElementReduction::gather(std::span<const std::uint32_t> nodes) {
  columns.clear();
  for (const std::uint32_t node : nodes) {
    const auto row = rows_.row(node);
    columns.insert(columns.end(), row.columns.begin(), row.columns.end());
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  for (std::size_t c = 0; c < columns.size(); ++c) local_[columns[c]] = static_cast<std::uint32_t>(c);
  weights.setZero(static_cast<Eigen::Index>(nodes.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const auto row = rows_.row(nodes[a]);
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      weights(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(local_[row.columns[e]])) = row.weights[e];
  }
}

namespace {

constexpr std::array<std::array<int, 2>, 6> k_axis_pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 0}, {2, 0}, {2, 1}}};

subdiv::Stencils named_rows(const subdiv::Stencils& rows, const std::vector<std::uint8_t>& named) {
  subdiv::Stencils result;
  result.column_count = rows.column_count;
  for (std::size_t i = 0; i < rows.row_count(); ++i) {
    if (named[i]) {
      const auto row = rows.row(i);
      result.columns.insert(result.columns.end(), row.columns.begin(), row.columns.end());
      result.weights.insert(result.weights.end(), row.weights.begin(), row.weights.end());
    }
    result.offsets.push_back(result.columns.size());
  }
  return result;
}

}  // namespace

RestOperator rest_operator(const System& system, bool with_stiffness) {
  assert(system.rest_nodes != nullptr);
  const std::size_t control_points = system.rows->column_count;
  RestOperator result;
  result.touched.assign(control_points, 0);
  result.diagonal.assign(control_points, Eigen::Matrix3d::Zero());
  std::vector<std::uint8_t> named(system.rows->row_count(), 0);

  ElementReduction element(*system.rows);
  BlockAccumulator blocks(3);
  std::array<Eigen::MatrixXd, 6> reduced;
  Eigen::MatrixXd component, product;
  const auto tangent = system.model->tangent(*system.rest_nodes, Projection::none);
  tangent->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    for (const std::uint32_t node : nodes) named[node] = 1;
    element.gather(nodes);
    const auto n = static_cast<Eigen::Index>(nodes.size());
    component.resize(n, n);
    const auto columns = static_cast<Eigen::Index>(element.columns.size());
    // A acts alike on the three axes, so the product is taken for the six distinct pairs of axes.
    for (std::size_t pair = 0; pair < 6; ++pair) {
      const auto [r, s] = k_axis_pairs[pair];
      for (Eigen::Index b = 0; b < n; ++b)
        for (Eigen::Index a = 0; a < n; ++a) component(a, b) = stiffness(3 * a + r, 3 * b + s);
      product.noalias() = component * element.weights;
      if (with_stiffness) {
        reduced[pair].noalias() = element.weights.transpose() * product;
      } else {
        reduced[pair].setZero(columns, columns);
        for (Eigen::Index i = 0; i < columns; ++i) reduced[pair](i, i) = element.weights.col(i).dot(product.col(i));
      }
    }
    for (Eigen::Index j = 0; j < columns; ++j) {
      const std::uint32_t column = element.columns[static_cast<std::size_t>(j)];
      result.touched[column] = 1;
      for (Eigen::Index i = j; i < (with_stiffness ? columns : j + 1); ++i) {
        Eigen::Matrix3d block;
        for (std::size_t pair = 0; pair < 6; ++pair) {
          const auto [r, s] = k_axis_pairs[pair];
          block(r, s) = reduced[pair](i, j);
          block(s, r) = reduced[pair](j, i);
        }
        if (i == j) result.diagonal[column] += block;
        if (!with_stiffness) continue;
        double* sum = blocks.block(element.columns[static_cast<std::size_t>(i)], column);
        for (int k = 0; k < 9; ++k) sum[k] += block.data()[k];
      }
    }
  });
  if (with_stiffness) result.stiffness = blocks.matrix(control_points);
  result.rows = named_rows(*system.rows, named);
  result.rows_transposed = subdiv::transpose(result.rows);
  return result;
}

}  // namespace argil::fem
