#include "subdiv/stencils.h"

#include <cassert>

#include "subdiv/refinement_step.h"
#include "subdiv/row_assembly.h"

namespace argil::subdiv {

namespace {

constexpr std::size_t k_rows_per_task = 1024;

}  // namespace

void Stencils::append(std::span<const std::uint32_t> row_columns, std::span<const double> row_weights) {
  assert(row_columns.size() == row_weights.size());
  columns.insert(columns.end(), row_columns.begin(), row_columns.end());
  weights.insert(weights.end(), row_weights.begin(), row_weights.end());
  offsets.push_back(columns.size());
}

void Stencils::append(const Stencils& other) {
  assert(other.column_count == column_count);
  const std::size_t first = columns.size();
  columns.insert(columns.end(), other.columns.begin(), other.columns.end());
  weights.insert(weights.end(), other.weights.begin(), other.weights.end());
  for (std::size_t i = 1; i < other.offsets.size(); ++i) offsets.push_back(first + other.offsets[i]);
}

Stencils Stencils::identity(std::size_t n) {
  Stencils result;
  result.column_count = n;
  result.offsets.resize(n + 1);
  result.columns.resize(n);
  result.weights.assign(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    result.columns[i] = static_cast<std::uint32_t>(i);
    result.offsets[i + 1] = i + 1;
  }
  return result;
}

Eigen::Matrix3Xd apply(const Stencils& stencils, const Eigen::Matrix3Xd& values) {
  assert(static_cast<std::size_t>(values.cols()) == stencils.column_count);
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(stencils.row_count()));
  parallel_for(stencils.row_count(), k_rows_per_task, [&](std::size_t i) {
    double x = 0, y = 0, z = 0;
    for (std::size_t j = stencils.offsets[i]; j < stencils.offsets[i + 1]; ++j) {
      const double* value = values.data() + 3 * std::size_t{stencils.columns[j]};
      x += stencils.weights[j] * value[0];
      y += stencils.weights[j] * value[1];
      z += stencils.weights[j] * value[2];
    }
    double* to = result.data() + 3 * i;
    to[0] = x;
    to[1] = y;
    to[2] = z;
  });
  return result;
}

Eigen::VectorXd apply(const Stencils& stencils, const Eigen::VectorXd& values) {
  assert(static_cast<std::size_t>(values.size()) == stencils.column_count);
  Eigen::VectorXd result(static_cast<Eigen::Index>(stencils.row_count()));
  parallel_for(stencils.row_count(), k_rows_per_task, [&](std::size_t i) {
    double sum = 0;
    for (std::size_t j = stencils.offsets[i]; j < stencils.offsets[i + 1]; ++j)
      sum += stencils.weights[j] * values.data()[stencils.columns[j]];
    result.data()[i] = sum;
  });
  return result;
}

Stencils compose(const Stencils& fine, const Stencils& coarse) {
  return compose(fine, coarse, {});
}

Stencils compose(const Stencils& fine, const Stencils& coarse, const Progress& progress) {
  assert(fine.column_count == coarse.row_count());
  return assemble_rows(
      fine.row_count(), coarse.column_count,
      [&](std::size_t i, RowBuilder& row) {
        const StencilRow from = fine.row(i);
        for (std::size_t j = 0; j < from.columns.size(); ++j) row.add(coarse.row(from.columns[j]), from.weights[j]);
      },
      progress);
}

Stencils transpose(const Stencils& stencils) {
  Stencils result;
  result.column_count = stencils.row_count();
  result.offsets.assign(stencils.column_count + 1, 0);
  for (const std::uint32_t column : stencils.columns) ++result.offsets[column + 1];
  for (std::size_t i = 0; i < stencils.column_count; ++i) result.offsets[i + 1] += result.offsets[i];
  result.columns.resize(stencils.columns.size());
  result.weights.resize(stencils.weights.size());
  std::vector<std::size_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (std::size_t i = 0; i < stencils.row_count(); ++i)
    for (std::size_t j = stencils.offsets[i]; j < stencils.offsets[i + 1]; ++j) {
      const std::size_t to = next[stencils.columns[j]]++;
      result.columns[to] = static_cast<std::uint32_t>(i);
      result.weights[to] = stencils.weights[j];
    }
  return result;
}

}  // namespace argil::subdiv
