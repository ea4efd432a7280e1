#include "sculpt/line_samples.h"

#include <fmt/format.h>

#include <algorithm>

#include "fem/measure/cell_tetrahedra.h"
#include "fem/measure/tetrahedron_grid.h"
#include "sculpt/document_loads.h"
#include "sculpt/shown_fields.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

// Fields end at the facets between the vertices of the finest level, bodies at the surfaces of their elements: a
// point between both takes the values of the next tetrahedron on.
constexpr double k_slack = 2;

SampledLine table_of(const Eigen::Matrix3Xd& rest, const Eigen::Matrix3Xd& displacements) {
  SampledLine line;
  SampledColumn distance{"distance", "m", "distance along the line", {}};
  const double length = (rest.col(rest.cols() - 1) - rest.col(0)).norm();
  for (Eigen::Index i = 0; i < rest.cols(); ++i)
    distance.values.push_back(static_cast<double>(i) * length / static_cast<double>(rest.cols() - 1));
  line.columns.push_back(std::move(distance));
  const auto add = [&](const std::string& name, const std::string& title, const auto& row) {
    SampledColumn column{name, "m", title, {}};
    for (Eigen::Index i = 0; i < row.size(); ++i) column.values.push_back(row[i]);
    line.columns.push_back(std::move(column));
  };
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    add(std::string(1, "xyz"[axis]), fmt::format("{} at rest", "xyz"[axis]), rest.row(axis));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    add(fmt::format("displacement_{}", "xyz"[axis]), fmt::format("displacement along {}", "xyz"[axis]),
        displacements.row(axis));
  return line;
}

void add_fields(SampledLine& line, const Document& document, const Eigen::Matrix3Xd& points,
                std::span<const std::string> names, const ReferenceShape* reference) {
  const fem::CellTetrahedra cut = fem::cell_tetrahedra(document.refinement().solid());
  const Eigen::Matrix3Xd rest =
      document.state().level == 0 ? document.rest() : document.surface_nodes(document.rest());
  const fem::TetrahedronGrid grid(subdiv::apply(cut.points, rest), cut.corners);
  std::vector<fem::TetrahedronPoint> places;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto place = grid.locate(points.col(i), k_slack);
    if (!place)
      throw Error(ErrorCode::bad_input,
                  fmt::format("({:g}, {:g}, {:g}) is beyond the cells that fields are shown in; shorten the line",
                              points(0, i), points(1, i), points(2, i)));
    places.push_back(*place);
  }
  for (const std::string& name : names) {
    const ShownField field = shown_field(document, name, reference);
    const Eigen::VectorXd values = subdiv::apply(cut.points, field.values);
    SampledColumn column{name, field.unit, field.title, {}};
    for (const fem::TetrahedronPoint& place : places) {
      double value = 0;
      for (std::size_t k = 0; k < 4; ++k) value += place.weights[k] * values[cut.corners[place.tetrahedron][k]];
      column.values.push_back(value);
    }
    line.columns.push_back(std::move(column));
  }
}

}  // namespace

const SampledColumn* SampledLine::column(const std::string& wanted) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == wanted; });
  return found == columns.end() ? nullptr : &*found;
}

Eigen::Matrix3Xd points_between(const std::array<Eigen::Vector3d, 2>& ends, int count) {
  if (ends[0] == ends[1])
    throw Error(ErrorCode::bad_input,
                fmt::format("expected a line between two points, found ({0:g}, {1:g}, {2:g}) at both ends; give "
                            "another end, as in `from 0 0.05 0.05 to 0.4 0.05 0.05`",
                            ends[0].x(), ends[0].y(), ends[0].z()));
  if (count < 2)
    throw Error(ErrorCode::bad_input, fmt::format("a line has 2 points at least, not {}; 41 are usual", count));
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) = (static_cast<double>(count - 1 - i) * ends[0] + static_cast<double>(i) * ends[1]) / (count - 1);
  return points;
}

SampledLine sample_line(const Document& document, const std::array<Eigen::Vector3d, 2>& ends, int count,
                        std::span<const std::string> fields, const ReferenceShape* reference) {
  const Eigen::Matrix3Xd points = points_between(ends, count);
  const std::vector<std::string> known = shown_field_names();
  for (const std::string& name : fields)
    if (std::find(known.begin(), known.end(), name) == known.end())
      (void)shown_field(document, name, reference);  // says which there are
  Eigen::Matrix3Xd displacements(3, count);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const fem::PointStencil stencil = material_point(document, points.col(i)).stencil;
    displacements.col(i) = fem::position(stencil, document.positions()) - fem::position(stencil, document.rest());
  }
  SampledLine line = table_of(points, displacements);
  if (!fields.empty()) add_fields(line, document, points, fields, reference);
  return line;
}

SampledLine sample_line(const ReferenceShape& solution, const std::array<Eigen::Vector3d, 2>& ends, int count) {
  if (!solution.at_common_points())
    throw Error(ErrorCode::bad_input,
                "the file has no displacements to sample; it must be a volume mesh with a point field displacement "
                "of three components, as `save` writes .vtu and .vtk");
  const Eigen::Matrix3Xd points = points_between(ends, count);
  return table_of(points, solution.positions(points) - points);
}

std::string table_text(const SampledLine& line) {
  std::string text;
  for (const SampledColumn& column : line.columns) {
    const bool plain = column.unit.empty() || column.unit == "%";
    text +=
        fmt::format("{}{}{}{}", text.empty() ? "" : ",", column.name, plain ? "" : "_", plain ? "" : column.unit);
  }
  text += '\n';
  for (std::size_t i = 0; i < line.columns.front().values.size(); ++i) {
    for (std::size_t c = 0; c < line.columns.size(); ++c)
      text += fmt::format("{}{}", c == 0 ? "" : ",", line.columns[c].values[i]);
    text += '\n';
  }
  return text;
}

}  // namespace argil::sculpt
