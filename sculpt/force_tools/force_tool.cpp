#include "sculpt/force_tools/force_tool.h"

#include <fmt/format.h>

#include <algorithm>

#include "sculpt/force_tools/tool_table.h"
#include "subdiv/error.h"

namespace argil::sculpt {

fem::Wrench ForceTool::wrench(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const {
  return wrench_of(loads(pose, positions), positions);
}

fem::Wrench wrench_of(const fem::Loads& loads, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, positions.cols());
  if (loads.forces.cols() > 0) forces = loads.forces;
  fem::add_spring_forces(loads.springs, positions, forces);
  return fem::wrench(forces, positions);
}

std::unique_ptr<ForceTool> take_hold(const Document& document, const Tool& tool, const StrokePose& first,
                                     const GripOptions& options) {
  const ToolKind& kind = tool_by_name(tool.name);
  if (!kind.take_hold)
    throw Error(ErrorCode::not_found, fmt::format("'{}' is not a tool that gives force", tool.name));
  return kind.take_hold(document, tool, first, options);
}

double mirror_plane(const Document& document, int axis) {
  const subdiv::Solid& solid = document.solid();
  double low = 1e300, high = -1e300;
  for (const subdiv::VertexId v : solid.vertices()) {
    const double at = document.rest()(axis, static_cast<Eigen::Index>(v.index()));
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return 0.5 * (low + high);
}

StrokePose mirrored(const StrokePose& pose, int axis, double plane) {
  StrokePose image = pose;
  image.position[axis] = 2 * plane - pose.position[axis];
  // A turn about an axis is mirrored to the opposite turn about the mirrored axis.
  image.orientation.vec() = -pose.orientation.vec();
  image.orientation.vec()[axis] = pose.orientation.vec()[axis];
  return image;
}

void add_loads(fem::Loads& to, const fem::Loads& loads) {
  to.springs.insert(to.springs.end(), loads.springs.begin(), loads.springs.end());
  if (loads.forces.cols() == 0) return;
  if (to.forces.cols() == 0)
    to.forces = loads.forces;
  else
    to.forces += loads.forces;
}

}  // namespace argil::sculpt
