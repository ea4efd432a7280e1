#pragma once
// What a body does along a straight line of its rest shape, such as the axis of a bar (papers/001, Fig. 5a): a
// table of points with their displacements and the fields that are asked for, of the document or of a solution in a
// file.

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "sculpt/document.h"
#include "sculpt/reference_shape.h"

namespace argil::sculpt {

struct SampledColumn {
  std::string name, unit, title;
  std::vector<double> values;  // fields in the unit "%" are shares
};
/// Columns distance (from the first end, along the line at rest), x, y, z (at rest), displacement_x, _y, _z, then
/// the fields.
struct SampledLine {
  std::string name;
  std::vector<SampledColumn> columns;
  /// Null where there is none of that name.
  [[nodiscard]] const SampledColumn* column(const std::string& name) const;
};

/// `count` points in equal steps from end to end. @throws Error (bad_input) for ends that are the same point or
/// fewer than 2 points.
[[nodiscard]] Eigen::Matrix3Xd points_between(const std::array<Eigen::Vector3d, 2>& ends, int count);

/// Displacements are those of the elements that hold the points, by their shape functions; fields (shown_fields.h)
/// are linear in the tetrahedra that the cells of the finest level are cut into (cell_tetrahedra.h). Both are exact
/// where they are linear in space. `reference` is for the field `error`.
/// @throws Error (bad_input) naming a point outside of the body, (not_found) a field that is not there.
/// Cost O(count · elements), and O(cells) with fields.
[[nodiscard]] SampledLine sample_line(const Document& document, const std::array<Eigen::Vector3d, 2>& ends,
                                      int count, std::span<const std::string> fields,
                                      const ReferenceShape* reference = nullptr);
/// Displacements of a solution in a file, linear in the tetrahedra of its cells.
/// @throws Error (bad_input) for a file without displacements, or naming a point outside.
[[nodiscard]] SampledLine sample_line(const ReferenceShape& solution, const std::array<Eigen::Vector3d, 2>& ends,
                                      int count);

/// As CSV: a header of names, each with its unit after an underscore if it has one; numbers are the shortest that
/// read back as the same double, in no locale.
[[nodiscard]] std::string table_text(const SampledLine& line);

}  // namespace argil::sculpt
