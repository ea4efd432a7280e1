#include "fem/dynamics/rigid_modes.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <numeric>

#include "subdiv/error.h"

namespace argil::fem {

namespace {

using RigidMotion = Eigen::Matrix<double, 3, 6>;

/// Displacement at `point` of the translations and of the rotations about `centre`, these over `size`.
RigidMotion rigid_motion(const Eigen::Vector3d& point, const Eigen::Vector3d& centre, double size) {
  const Eigen::Vector3d r = (point - centre) / size;
  RigidMotion motion = RigidMotion::Zero();
  motion.leftCols<3>().setIdentity();
  motion.col(3) = Eigen::Vector3d(0, -r.z(), r.y());
  motion.col(4) = Eigen::Vector3d(r.z(), 0, -r.x());
  motion.col(5) = Eigen::Vector3d(-r.y(), r.x(), 0);
  return motion;
}

/// Part number of every control point, by what the mass matrix connects.
std::vector<std::size_t> parts(const Eigen::SparseMatrix<double>& mass) {
  std::vector<std::size_t> root(static_cast<std::size_t>(mass.cols()));
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (Eigen::Index c = 0; c < mass.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(mass, c); it; ++it) {
      const std::size_t a = find(static_cast<std::size_t>(c)), b = find(static_cast<std::size_t>(it.row()));
      root[std::max(a, b)] = std::min(a, b);
    }
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

}  // namespace

void check_rigid_motions(const System& system, const Loads& loads, const std::vector<std::uint8_t>& touched,
                         const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& forces) {
  const std::vector<std::size_t> part = parts(*system.mass);
  for (std::size_t root = 0; root < part.size(); ++root) {
    if (part[root] != root || !touched[root]) continue;
    Eigen::Vector3d low = positions.col(static_cast<Eigen::Index>(root)), high = low;
    for (std::size_t i = root; i < part.size(); ++i) {
      if (part[i] != root) continue;
      low = low.cwiseMin(positions.col(static_cast<Eigen::Index>(i)));
      high = high.cwiseMax(positions.col(static_cast<Eigen::Index>(i)));
    }
    const Eigen::Vector3d centre = 0.5 * (low + high);
    const double size = std::max((high - low).norm(), 1e-300);
    Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> push = Eigen::Matrix<double, 6, 1>::Zero();
    double total = 0;
    for (std::size_t i = root; i < part.size(); ++i) {
      if (part[i] != root) continue;
      const auto c = static_cast<Eigen::Index>(i);
      const RigidMotion motion = rigid_motion(positions.col(c), centre, size);
      if (system.fixed[i]) held += motion.transpose() * motion;
      push += motion.transpose() * forces.col(c);
      total += forces.col(c).norm();
    }
    for (const AnchorSpring& spring : loads.springs) {
      if (spring.stiffness <= 0 || spring.control_points.empty() || part[spring.control_points.front()] != root)
        continue;
      RigidMotion motion = RigidMotion::Zero();
      for (std::size_t e = 0; e < spring.control_points.size(); ++e)
        motion += spring.weights[e] *
                  rigid_motion(positions.col(static_cast<Eigen::Index>(spring.control_points[e])), centre, size);
      held += motion.transpose() * motion;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(held);
    int free_motions = 0;
    double pushed = 0;
    for (int m = 0; m < 6; ++m) {
      if (modes.eigenvalues()[m] > 1e-10 * std::max(1.0, modes.eigenvalues()[5])) continue;
      ++free_motions;
      pushed = std::max(pushed, std::abs(modes.eigenvectors().col(m).dot(push)));
    }
    if (free_motions == 0 || pushed <= 1e-9 * total) continue;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("Static equilibrium needs a body that is held against its loads, but {} of the 6 rigid "
                    "motions {} free and the load pushes along them. Pin at least three points that are not "
                    "on one line, or step in time instead.",
                    free_motions, free_motions == 1 ? "is" : "are"));
  }
}

}  // namespace argil::fem
