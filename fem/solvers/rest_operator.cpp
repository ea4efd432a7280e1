#include "fem/solvers/rest_operator.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "fem/parallel.h"
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

constexpr std::size_t k_elements_between = 256;  // two words of progress
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

/// Elements that follow each other, summed into one reduced matrix while they name few enough control points: cells
/// that come from one control cell share theirs, and Aᵀ (Σ K A) costs less than Σ Aᵀ K A.
class Group {
 public:
  explicit Group(const subdiv::Stencils& rows) : reduction_(rows), number_(rows.row_count(), 0) {}

  bool empty() const { return elements_.empty(); }
  bool takes(std::size_t nodes) const { return nodes_.size() + nodes <= k_group_nodes; }
  void add(std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    Element& element = elements_.emplace_back();
    for (const std::uint32_t node : nodes) {
      if (number_[node] == 0) {
        nodes_.push_back(node);
        number_[node] = static_cast<std::uint32_t>(nodes_.size());
      }
      element.nodes.push_back(number_[node] - 1);
    }
    element.stiffness = stiffness;
  }
  void clear() {
    for (const std::uint32_t node : nodes_) number_[node] = 0;
    nodes_.clear();
    elements_.clear();
  }

  /// Touches nothing but this group.
  void reduce(bool with_stiffness) {
    reduction_.gather(nodes_);
    const Eigen::MatrixXd& weights = reduction_.weights;  // group nodes x columns
    // A acts alike on the three axes, so the product is taken for the six distinct pairs of axes.
    for (std::size_t pair = 0; pair < k_axis_pairs.size(); ++pair) {
      multiply_elements(pair);
      // The diagonal is summed by itself, so that its bits are the same with and without the rest.
      diagonal_[pair].resize(weights.cols());
      for (Eigen::Index i = 0; i < weights.cols(); ++i) diagonal_[pair][i] = weights.col(i).dot(product_.col(i));
      if (with_stiffness) reduced_[pair].noalias() = weights.transpose() * product_;
    }
  }

  const std::vector<std::uint32_t>& columns() const { return reduction_.columns; }
  Eigen::Matrix3d diagonal(Eigen::Index i) const {
    Eigen::Matrix3d result;
    for (std::size_t pair = 0; pair < k_axis_pairs.size(); ++pair) {
      const auto [r, s] = k_axis_pairs[pair];
      result(r, s) = result(s, r) = diagonal_[pair][i];
    }
    return result;
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

 private:
  static constexpr std::size_t k_group_nodes = 160;
  struct Element {
    std::vector<std::uint32_t> nodes;  // numbers in the group
    Eigen::MatrixXd stiffness;
  };

  /// product_ = the group's stiffness between two axes times the weights, element by element.
  void multiply_elements(std::size_t pair) {
    const auto [r, s] = k_axis_pairs[pair];
    const Eigen::MatrixXd& weights = reduction_.weights;
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

  ElementReduction reduction_;
  std::vector<std::uint32_t> number_;  // per node, its number in the group + 1
  std::vector<std::uint32_t> nodes_;
  std::vector<Element> elements_;
  std::array<Eigen::MatrixXd, 6> reduced_;
  std::array<Eigen::VectorXd, 6> diagonal_;
  Eigen::MatrixXd component_, element_weights_, element_product_, product_;
};

/// Groups are reduced some at a time in parallel and added in their order.
class GroupedReduction {
 public:
  GroupedReduction(const subdiv::Stencils& rows, bool with_stiffness, RestOperator& result)
      : column_count_(rows.column_count),
        with_stiffness_(with_stiffness),
        result_(result),
        groups_(k_groups_at_once, Group(rows)) {}

  void add(std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    if (!groups_[open_].empty() && !groups_[open_].takes(nodes.size()) && ++open_ == groups_.size()) flush();
    groups_[open_].add(nodes, stiffness);
  }

  void flush() {
    parallel_for(groups_.size(), 1, [&](std::size_t g) {
      if (!groups_[g].empty()) groups_[g].reduce(with_stiffness_);
    });
    for (Group& group : groups_) {
      if (group.empty()) continue;
      sum(group);
      group.clear();
    }
    open_ = 0;
  }

  Eigen::SparseMatrix<double> stiffness() const { return blocks_.matrix(column_count_); }

 private:
  static constexpr std::size_t k_groups_at_once = 16;

  void sum(const Group& group) {
    const std::vector<std::uint32_t>& columns = group.columns();
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const std::uint32_t column = columns[j];
      result_.touched[column] = 1;
      result_.diagonal[column] += group.diagonal(static_cast<Eigen::Index>(j));
      if (!with_stiffness_) continue;
      for (std::size_t i = j; i < columns.size(); ++i) {
        const Eigen::Matrix3d values = group.block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        double* entry = blocks_.block(columns[i], column);
        for (int k = 0; k < 9; ++k) entry[k] += values.data()[k];
      }
    }
  }

  std::size_t column_count_;
  bool with_stiffness_;
  RestOperator& result_;
  std::vector<Group> groups_;
  std::size_t open_ = 0;
  BlockAccumulator blocks_{3};
};

}  // namespace

RestOperator reduce_elements(const subdiv::Stencils& rows, const ElementSource& source, bool with_stiffness) {
  RestOperator result;
  result.touched.assign(rows.column_count, 0);
  result.diagonal.assign(rows.column_count, Eigen::Matrix3d::Zero());
  std::vector<std::uint8_t> named(rows.row_count(), 0);
  GroupedReduction groups(rows, with_stiffness, result);
  source([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
    for (const std::uint32_t node : nodes) named[node] = 1;
    groups.add(nodes, stiffness);
  });
  groups.flush();
  if (with_stiffness) result.stiffness = groups.stiffness();
  result.rows = named_rows(rows, named);
  result.rows_transposed = subdiv::transpose(result.rows);
  return result;
}

RestOperator rest_operator(const System& system, bool with_stiffness, const Progress& progress) {
  assert(system.rest_nodes != nullptr);
  const ForceModel& model = system.rest_model ? *system.rest_model : *system.model;
  const auto tangent = model.tangent(*system.rest_nodes, Projection::none);
  std::size_t count = 0, done = 0;
  for (const ElementBlock& block : system.blocks) count += block.element_count();
  return reduce_elements(
      *system.rows,
      [&](const Tangent::Visit& visit) {
        tangent->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
          if (done++ % k_elements_between == 0)
            progress.at(std::min(1.0, static_cast<double>(done) / static_cast<double>(count)));
          visit(nodes, stiffness);
        });
      },
      with_stiffness);
}

void add_scaled(RestOperator& to, const RestOperator& other, double factor) {
  assert(to.diagonal.size() == other.diagonal.size());
  for (std::size_t i = 0; i < to.diagonal.size(); ++i) to.diagonal[i] += factor * other.diagonal[i];
  if (to.stiffness.size() > 0 && other.stiffness.size() > 0) to.stiffness += factor * other.stiffness;
}

}  // namespace argil::fem
