#pragma once
// What a topology edit does to the arrays that have a column for each control vertex: columns are added past the
// end, a few old ones change. On the control solid itself (level 0) the states before and after an edit share their
// arrays, and this is applied and taken back in place, as the topology's delta is: an edit then costs what it
// touches, not what the solid holds.

#include <array>
#include <cstdint>
#include <vector>

#include "sculpt/document.h"
#include "subdiv/edit/edit.h"

namespace argil::sculpt {

struct ColumnChanges {
  struct Columns {
    Eigen::Matrix3Xd rest{3, 0}, positions{3, 0}, velocities{3, 0};  // [m], [m], [m/s]
    std::array<Eigen::VectorXd, k_field_count> fields;               // empty where they do not take part
  };
  Columns added;
  std::vector<std::uint32_t> changed;  // columns, ascending
  Columns before, after;               // of the changed

  bool empty() const { return added.rest.cols() == 0 && changed.empty(); }
};

/// What `edit`, already made, does to the arrays of `state`, which are still as before. New vertices are at rest;
/// values of fields (only with `with_fields`: where they are at the control vertices) are blended and kept within
/// their sources' range. Cost O(placed vertices, log).
[[nodiscard]] ColumnChanges column_changes(const State& state, const subdiv::Edit& edit,
                                           std::size_t vertex_capacity, bool with_fields);

/// In place, whoever shares the arrays.
void apply(const State& state, const ColumnChanges& changes);
void take_back(const State& state, const ColumnChanges& changes);

}  // namespace argil::sculpt
