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

namespace {

/// Sums elements that follow each other into one reduced matrix while they name few enough control points: cells
/// that come from one control cell share theirs, and Aᵀ (Σ K A) costs less than Σ Aᵀ K A.
class GroupedReduction {
 public:
  GroupedReduction(const subdiv::Stencils& rows, bool with_stiffness, RestOperator& result)
      : rows_(rows), with_stiffness_(with_stiffness), result_(result), group_(rows), number_(rows.row_count(), 0) {}

  void add(std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    if (group_nodes_.size() + nodes.size() > k_group_nodes) flush();
    Element& element = elements_.emplace_back();
    for (const std::uint32_t node : nodes) {
      if (number_[node] == 0) {
        group_nodes_.push_back(node);
        number_[node] = static_cast<std::uint32_t>(group_nodes_.size());
      }
      element.nodes.push_back(number_[node] - 1);
    }
    element.stiffness = stiffness;
  }

  void flush() {
    if (elements_.empty()) return;
    group_.gather(group_nodes_);
    const Eigen::MatrixXd& weights = group_.weights;  // group nodes x columns
    const auto columns = weights.cols();
    // A acts alike on the three axes, so the product is taken for the six distinct pairs of axes.
    for (std::size_t pair = 0; pair < k_axis_pairs.size(); ++pair) {
      multiply_elements(pair);
      if (with_stiffness_) {
        reduced_[pair].noalias() = weights.transpose() * product_;
      } else {
        reduced_[pair].setZero(columns, columns);
        for (Eigen::Index i = 0; i < columns; ++i) reduced_[pair](i, i) = weights.col(i).dot(product_.col(i));
      }
    }
    for (Eigen::Index j = 0; j < columns; ++j) {
      const std::uint32_t column = group_.columns[static_cast<std::size_t>(j)];
      result_.touched[column] = 1;
      result_.diagonal[column] += block(j, j);
      if (!with_stiffness_) continue;
      for (Eigen::Index i = j; i < columns; ++i) {
        const Eigen::Matrix3d values = block(i, j);
        double* sum = blocks_.block(group_.columns[static_cast<std::size_t>(i)], column);
        for (int k = 0; k < 9; ++k) sum[k] += values.data()[k];
      }
    }
    for (const std::uint32_t node : group_nodes_) number_[node] = 0;
    group_nodes_.clear();
    elements_.clear();
  }

  Eigen::SparseMatrix<double> stiffness() const { return blocks_.matrix(rows_.column_count); }

 private:
  static constexpr std::size_t k_group_nodes = 160;
  struct Element {
    std::vector<std::uint32_t> nodes;  // numbers in the group
    Eigen::MatrixXd stiffness;
  };

  /// product_ = the group's stiffness between two axes times the weights, element by element.
  void multiply_elements(std::size_t pair) {
    const auto [r, s] = k_axis_pairs[pair];
    const Eigen::MatrixXd& weights = group_.weights;
    product_.setZero(weights.rows(), weights.cols());
    for (const Element& element : elements_) {
      const auto n = static_cast<Eigen::Index>(element.nodes.size());
      component_.resize(n, n);
      element_weights_.resize(n, weights.cols());
      for (Eigen::Index b = 0; b < n; ++b) {
        element_weights_.row(b) = weights.row(element.nodes[static_cast<std::size_t>(b)]);
        for (Eigen::Index a = 0; a < n; ++a) component_(a, b) = element.stiffness(3 * a + r, 3 * b + s);
      }
      element_product_.noalias() = component_ * element_weights_;
      for (Eigen::Index a = 0; a < n; ++a)
        product_.row(element.nodes[static_cast<std::size_t>(a)]) += element_product_.row(a);
    }
  }

  Eigen::Matrix3d block(Eigen::Index i, Eigen::Index j) const {
    Eigen::Matrix3d result;
    for (std::size_t pair = 0; pair < k_axis_pairs.size(); ++pair) {
      const auto [r, s] = k_axis_pairs[pair];
      result(r, s) = reduced_[pair](i, j);
      result(s, r) = reduced_[pair](j, i);
    }
    return result;
  }

  const subdiv::Stencils& rows_;
  bool with_stiffness_;
  RestOperator& result_;
  ElementReduction group_;
  std::vector<std::uint32_t> number_;  // per node, its number in the group + 1
  std::vector<std::uint32_t> group_nodes_;
  std::vector<Element> elements_;
  std::array<Eigen::MatrixXd, 6> reduced_;
  Eigen::MatrixXd component_, element_weights_, element_product_, product_;
  BlockAccumulator blocks_{3};
};

}  // namespace

RestOperator rest_operator(const System& system, bool with_stiffness) {
  assert(system.rest_nodes != nullptr);
  RestOperator result;
  result.touched.assign(system.rows->column_count, 0);
  result.diagonal.assign(system.rows->column_count, Eigen::Matrix3d::Zero());
  std::vector<std::uint8_t> named(system.rows->row_count(), 0);
  GroupedReduction groups(*system.rows, with_stiffness, result);
  const auto tangent = system.model->tangent(*system.rest_nodes, Projection::none);
  tangent->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    for (const std::uint32_t node : nodes) named[node] = 1;
    groups.add(nodes, stiffness);
  });
  groups.flush();
  if (with_stiffness) result.stiffness = groups.stiffness();
  result.rows = named_rows(*system.rows, named);
  result.rows_transposed = subdiv::transpose(result.rows);
  return result;
}

}  // namespace argil::fem
