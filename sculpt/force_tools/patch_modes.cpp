#include "sculpt/force_tools/patch_modes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

double product(const Eigen::VectorXd& weights, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) sum += weights[i] * a[i] * b[i];
  return sum;
}

// False if the points lie along a line or in one place (inside: in a plane).
bool make_modes(const Touched& touched, double radius, PatchModes& modes) {
  const Eigen::Index count = touched.weights.size();
  const Eigen::Vector3d right = rightwards(touched.normal);
  std::vector<Eigen::Vector3d> axes{right, touched.normal.cross(right)};
  if (touched.inside) axes.push_back(touched.normal);
  modes = {};
  modes.at_hold.resize(3, static_cast<Eigen::Index>(axes.size()));
  for (const Eigen::Vector3d& axis : axes) {
    Eigen::VectorXd shape(count);
    for (Eigen::Index i = 0; i < count; ++i) shape[i] = axis.dot(touched.positions.col(i) - touched.middle);
    for (const Eigen::VectorXd& before : modes.shapes) shape -= product(touched.weights, before, shape) * before;
    const double length = std::sqrt(product(touched.weights, shape, shape));
    if (!(length > 1e-3 * radius)) return false;
    shape /= length;
    std::vector<double> factors(static_cast<std::size_t>(count));
    for (Eigen::Index i = 0; i < count; ++i) factors[static_cast<std::size_t>(i)] = touched.weights[i] * shape[i];
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < count; ++i)
      vector += factors[static_cast<std::size_t>(i)] * (touched.positions.col(i) - touched.middle);
    modes.at_hold.col(static_cast<Eigen::Index>(modes.shapes.size())) = vector;
    modes.stencils.push_back(combination(touched.points, factors));
    modes.shapes.push_back(std::move(shape));
  }
  return true;
}

}  // namespace

TouchedPatch touch_patch(const Document& document, Tool tool, const Eigen::Vector3d& at, bool inside) {
  constexpr int k_widenings = 16;
  TouchedPatch patch;
  for (int i = 0; i < k_widenings; ++i, tool.radius *= 1.5) {
    patch.touched = touch(document, tool, at, inside);
    if (make_modes(patch.touched, tool.radius, patch.modes)) return patch;
  }
  throw Error(ErrorCode::bad_input, "the body is so thin under the tool that there is no patch of it to hold");
}

Eigen::Matrix3Xd mode_vectors(const PatchModes& modes, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd vectors(3, static_cast<Eigen::Index>(modes.stencils.size()));
  for (std::size_t a = 0; a < modes.stencils.size(); ++a)
    vectors.col(static_cast<Eigen::Index>(a)) = fem::position(modes.stencils[a], positions);
  return vectors;
}

Eigen::Vector3d mode_normal(const Eigen::Matrix3Xd& vectors) {
  const Eigen::Vector3d normal = vectors.col(0).cross(vectors.col(1));
  const double length = normal.norm();
  return length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
}

fem::Loads mode_loads(const TouchedPatch& patch, const Eigen::Matrix3Xd& vectors, const Eigen::Matrix3Xd& forces,
                      double stiffness, double limit) {
  const Eigen::VectorXd& weights = patch.touched.weights;
  double sizes = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (std::size_t a = 0; a < patch.modes.shapes.size(); ++a)
      force += patch.modes.shapes[a][i] * forces.col(static_cast<Eigen::Index>(a));
    sizes += weights[i] * force.norm();
  }
  const double share = sizes > limit ? limit / sizes : 1;
  fem::Loads loads;
  for (std::size_t a = 0; a < patch.modes.stencils.size(); ++a) {
    const auto c = static_cast<Eigen::Index>(a);
    const Eigen::Vector3d target = vectors.col(c) + (share / stiffness) * forces.col(c);
    loads.springs.push_back(fem::anchor_spring(patch.modes.stencils[a], target, stiffness));
  }
  return loads;
}

Eigen::Vector3d rightwards(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(normal);
  const double length = right.norm();
  constexpr double k_along_z = 1e-2;
  // Along z the right is taken as exactly perpendicular to the normal as elsewhere.
  if (length > k_along_z) return right / length;
  return Eigen::Vector3d::UnitY().cross(normal.z() > 0 ? normal : Eigen::Vector3d(-normal)).normalized();
}

}  // namespace argil::sculpt
