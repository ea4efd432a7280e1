#include "sculpt/column_changes.h"

#include <algorithm>
#include <cassert>

namespace argil::sculpt {

namespace {

using Columns = ColumnChanges::Columns;
using subdiv::PlacedVertex;

Eigen::Index column(subdiv::VertexId v) {
  return static_cast<Eigen::Index>(v.index());
}

// States hold their arrays as constants; the one exception is made here.
struct Arrays {
  explicit Arrays(const State& state)
      : rest(const_cast<Eigen::Matrix3Xd&>(*state.rest)),
        motion(const_cast<fem::BodyState&>(*state.motion)),
        fields(const_cast<Fields&>(*state.fields)) {}
  Eigen::Matrix3Xd& rest;
  fem::BodyState& motion;
  Fields& fields;
};

// Calls visit(array, column block of it) for every array that takes part.
template <class ColumnsType, class Visit>
void for_each_array(Arrays& arrays, ColumnsType& columns, Visit visit) {
  visit(arrays.rest, columns.rest);
  visit(arrays.motion.positions, columns.positions);
  visit(arrays.motion.velocities, columns.velocities);
  if (columns.fields[0].size() == 0) return;
  for (std::size_t f = 0; f < columns.fields.size(); ++f) visit(arrays.fields.values[f], columns.fields[f]);
}

void append(Eigen::Matrix3Xd& array, const Eigen::Matrix3Xd& added) {
  array.conservativeResize(3, array.cols() + added.cols());
  array.rightCols(added.cols()) = added;
}
void append(Eigen::VectorXd& array, const Eigen::VectorXd& added) {
  array.conservativeResize(array.size() + added.size());
  array.tail(added.size()) = added;
}
void drop(Eigen::Matrix3Xd& array, const Eigen::Matrix3Xd& added) {
  array.conservativeResize(3, array.cols() - added.cols());
}
void drop(Eigen::VectorXd& array, const Eigen::VectorXd& added) {
  array.conservativeResize(array.size() - added.size());
}
void assign(Eigen::Matrix3Xd& array, const Eigen::Matrix3Xd& values, const std::vector<std::uint32_t>& at) {
  for (std::size_t i = 0; i < at.size(); ++i) array.col(at[i]) = values.col(static_cast<Eigen::Index>(i));
}
void assign(Eigen::VectorXd& array, const Eigen::VectorXd& values, const std::vector<std::uint32_t>& at) {
  for (std::size_t i = 0; i < at.size(); ++i) array[at[i]] = values[static_cast<Eigen::Index>(i)];
}

Columns empty_columns(Eigen::Index count, bool with_fields) {
  Columns columns;
  columns.rest.setZero(3, count);
  columns.positions.setZero(3, count);
  columns.velocities.setZero(3, count);
  if (with_fields)
    for (std::size_t f = 0; f < columns.fields.size(); ++f)
      columns.fields[f].setConstant(count, field_table()[f].initial);
  return columns;
}

void place(const State& state, const PlacedVertex& placed, Columns& columns, Eigen::Index at) {
  Eigen::Vector3d rest = Eigen::Vector3d::Zero(), present = rest;
  for (const auto& [source, weight] : placed.sources) {
    rest += weight * state.rest->col(column(source));
    present += weight * state.motion->positions.col(column(source));
  }
  columns.rest.col(at) = placed.linear * rest + placed.offset;
  columns.positions.col(at) = placed.linear * present + placed.offset;
  for (std::size_t f = 0; f < columns.fields.size(); ++f) {
    if (columns.fields[f].size() == 0 || placed.sources.empty()) continue;
    const Eigen::VectorXd& values = state.fields->values[f];
    double sum = 0, low = values[column(placed.sources[0].first)], high = low;
    for (const auto& [source, weight] : placed.sources) {
      const double value = values[column(source)];
      sum += weight * value;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    columns.fields[f][at] = std::clamp(sum, low, high);
  }
}

}  // namespace

ColumnChanges column_changes(const State& state, const subdiv::Edit& edit, std::size_t vertex_capacity,
                             bool with_fields) {
  const Eigen::Index old_count = state.rest->cols();
  ColumnChanges changes;
  changes.added = empty_columns(static_cast<Eigen::Index>(vertex_capacity) - old_count, with_fields);
  std::vector<const PlacedVertex*> moved;
  for (const PlacedVertex& placed : edit.placed) {
    if (column(placed.vertex) >= old_count)
      place(state, placed, changes.added, column(placed.vertex) - old_count);
    else
      moved.push_back(&placed);
  }
  std::stable_sort(moved.begin(), moved.end(), [](const auto* a, const auto* b) { return a->vertex < b->vertex; });
  const auto moved_count = static_cast<Eigen::Index>(moved.size());
  changes.before = changes.after = empty_columns(moved_count, with_fields);
  for (Eigen::Index i = 0; i < moved_count; ++i) {
    const subdiv::VertexId v = moved[static_cast<std::size_t>(i)]->vertex;
    changes.changed.push_back(v.value);
    place(state, {v, {{v, 1.0}}}, changes.before, i);
    changes.before.velocities.col(i) = changes.after.velocities.col(i) = state.motion->velocities.col(column(v));
    place(state, *moved[static_cast<std::size_t>(i)], changes.after, i);
  }
  return changes;
}

void apply(const State& state, const ColumnChanges& changes) {
  Arrays arrays(state);
  for_each_array(arrays, changes.added, [](auto& array, const auto& columns) { append(array, columns); });
  for_each_array(arrays, changes.after,
                 [&](auto& array, const auto& columns) { assign(array, columns, changes.changed); });
}

void take_back(const State& state, const ColumnChanges& changes) {
  Arrays arrays(state);
  for_each_array(arrays, changes.before,
                 [&](auto& array, const auto& columns) { assign(array, columns, changes.changed); });
  for_each_array(arrays, changes.added, [](auto& array, const auto& columns) { drop(array, columns); });
}

}  // namespace argil::sculpt
