#include "fem/spectrum/pencil.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "fem/solvers/rest_operator.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr std::uint32_t k_not_free = 0xffffffff;
/// A pivot of the mass below this share of its diagonal is rounding.
constexpr double k_no_mass = 1e-12;

std::vector<std::uint32_t> numbers(const std::vector<std::uint32_t>& control_points, std::size_t count) {
  std::vector<std::uint32_t> result(count, k_not_free);
  for (std::size_t i = 0; i < control_points.size(); ++i) result[control_points[i]] = static_cast<std::uint32_t>(i);
  return result;
}

/// The rows and columns of a symmetric matrix of 1 x 1 blocks that are free, lower triangle.
Eigen::SparseMatrix<double> free_part(const Eigen::SparseMatrix<double>& matrix,
                                      const std::vector<std::uint32_t>& number, std::size_t free_count,
                                      int copies) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index c = 0; c < matrix.outerSize(); ++c) {
    const std::uint32_t column = number[static_cast<std::size_t>(c)];
    if (column == k_not_free) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, c); it; ++it) {
      const std::uint32_t row = number[static_cast<std::size_t>(it.row())];
      if (row == k_not_free || row < column) continue;
      for (int axis = 0; axis < copies; ++axis)
        entries.emplace_back(copies * static_cast<int>(row) + axis, copies * static_cast<int>(column) + axis,
                             it.value());
    }
  }
  const auto size = static_cast<Eigen::Index>(static_cast<std::size_t>(copies) * free_count);
  Eigen::SparseMatrix<double> result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void add_springs(std::span<const AnchorSpring> springs, const std::vector<std::uint32_t>& number,
                 Eigen::SparseMatrix<double>& stiffness) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const AnchorSpring& spring : springs)
    for (std::size_t a = 0; a < spring.control_points.size(); ++a)
      for (std::size_t b = 0; b < spring.control_points.size(); ++b) {
        const std::uint32_t row = number[spring.control_points[a]], column = number[spring.control_points[b]];
        if (row == k_not_free || column == k_not_free || row < column) continue;
        for (int axis = 0; axis < 3; ++axis)
          entries.emplace_back(3 * static_cast<int>(row) + axis, 3 * static_cast<int>(column) + axis,
                               spring.stiffness * spring.weights[a] * spring.weights[b]);
      }
  if (entries.empty()) return;
  Eigen::SparseMatrix<double> sum(stiffness.rows(), stiffness.cols());
  sum.setFromTriplets(entries.begin(), entries.end());
  stiffness += sum;
}

}  // namespace

std::vector<std::uint32_t> moving_control_points(const System& system) {
  std::vector<std::uint8_t> massive(system.rows->column_count, 0);
  for (Eigen::Index c = 0; c < system.mass->outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(*system.mass, c); it; ++it)
      if (it.row() == c && it.value() > 0) massive[static_cast<std::size_t>(c)] = 1;
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < massive.size(); ++i)
    if (massive[i] && !system.fixed[i]) result.push_back(static_cast<std::uint32_t>(i));
  if (result.empty())
    throw Error(ErrorCode::bad_input,
                "every control point is pinned, and what cannot move has no vibration; "
                "pin fewer of them");
  return result;
}

double pencil_bytes(const System& system) {
  // The pattern of the consistent mass is that of the stiffness: both couple what an element couples.
  double blocks = 0;
  for (Eigen::Index c = 0; c < system.mass->outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(*system.mass, c); it; ++it)
      if (it.row() >= c) ++blocks;
  // Nine numbers with their rows as they are summed, in the sum, and in the part that is free.
  return blocks * (9.0 * 8 + 3.0 * 8 + 2 * 9.0 * 12);
}

Pencil pencil(const System& system, std::span<const AnchorSpring> springs, const Eigen::Matrix3Xd& positions,
              double max_memory) {
  const double bytes = pencil_bytes(system);
  if (bytes > max_memory)
    throw Error(
        ErrorCode::limit_exceeded,
        fmt::format("the stiffness of {} control points may take {:.2g} GB, more than {:.2g}; use a coarser "
                    "control solid, or raise --max-memory",
                    system.rows->column_count, bytes * 1e-9, max_memory * 1e-9));
  Pencil result;
  result.control_points = moving_control_points(system);
  const std::size_t count = result.control_points.size();
  const auto number = numbers(result.control_points, system.rows->column_count);
  result.mass = free_part(*system.mass, number, count, 3);

  System linearised = system;
  const Eigen::Matrix3Xd now = nodes(system, positions);
  linearised.rest_nodes = &now;
  const RestOperator whole = rest_operator(linearised, true);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(whole.stiffness.nonZeros()));
  for (Eigen::Index c = 0; c < whole.stiffness.outerSize(); ++c) {
    const std::uint32_t column = number[static_cast<std::size_t>(c) / 3];
    if (column == k_not_free) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(whole.stiffness, c); it; ++it) {
      const std::uint32_t row = number[static_cast<std::size_t>(it.row()) / 3];
      if (row == k_not_free || it.row() < c) continue;
      entries.emplace_back(3 * static_cast<int>(row) + static_cast<int>(it.row() % 3),
                           3 * static_cast<int>(column) + static_cast<int>(c % 3), it.value());
    }
  }
  const auto size = static_cast<Eigen::Index>(3 * count);
  result.stiffness.resize(size, size);
  result.stiffness.setFromTriplets(entries.begin(), entries.end());
  add_springs(springs, number, result.stiffness);
  return result;
}

struct InverseMass::Factor {
  std::vector<std::uint32_t> control_points;
  std::size_t count = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
};

InverseMass::InverseMass(const Eigen::SparseMatrix<double>& mass, std::vector<std::uint32_t> control_points)
    : factor_(std::make_unique<Factor>()) {
  factor_->count = static_cast<std::size_t>(mass.cols());
  const auto number = numbers(control_points, factor_->count);
  const Eigen::SparseMatrix<double> part = free_part(mass, number, control_points.size(), 1);
  factor_->control_points = std::move(control_points);
  factor_->cholesky.compute(part);
  bool massive = factor_->cholesky.info() == Eigen::Success;
  if (massive) {
    const Eigen::VectorXd pivots = factor_->cholesky.vectorD();
    const Eigen::VectorXd diagonal = factor_->cholesky.permutationP() * Eigen::VectorXd(part.diagonal());
    for (Eigen::Index i = 0; i < pivots.size(); ++i) massive = massive && pivots[i] > k_no_mass * diagonal[i];
  }
  if (!massive)
    throw Error(
        ErrorCode::bad_geometry,
        "some motion of the control points moves no mass, so its frequency is not finite; a lone hexahedron "
        "has one: split the control solid once");
}
InverseMass::~InverseMass() = default;

void InverseMass::solve(const Eigen::Matrix3Xd& forces, Eigen::Matrix3Xd& result) const {
  Eigen::MatrixXd right(static_cast<Eigen::Index>(factor_->control_points.size()), 3);
  for (std::size_t i = 0; i < factor_->control_points.size(); ++i)
    right.row(static_cast<Eigen::Index>(i)) =
        forces.col(static_cast<Eigen::Index>(factor_->control_points[i])).transpose();
  const Eigen::MatrixXd solution = factor_->cholesky.solve(right);
  result.setZero(3, static_cast<Eigen::Index>(factor_->count));
  for (std::size_t i = 0; i < factor_->control_points.size(); ++i)
    result.col(static_cast<Eigen::Index>(factor_->control_points[i])) =
        solution.row(static_cast<Eigen::Index>(i)).transpose();
}

}  // namespace argil::fem
