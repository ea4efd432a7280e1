#include "sculpt/force_tools/point_springs.h"

namespace argil::sculpt {

fem::Loads point_springs(const Touched& touched, const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& targets,
                         double strength, double pressure, double limit) {
  Eigen::Matrix3Xd from(3, targets.cols());
  double sizes = 0;
  for (Eigen::Index i = 0; i < targets.cols(); ++i) {
    from.col(i) = fem::position(touched.points[static_cast<std::size_t>(i)], positions);
    sizes += pressure * strength * touched.weights[i] * (targets.col(i) - from.col(i)).norm();
  }
  const double share = pressure * (sizes > limit ? limit / sizes : 1);
  fem::Loads loads;
  loads.springs.reserve(touched.points.size());
  for (Eigen::Index i = 0; i < targets.cols(); ++i)
    loads.springs.push_back(fem::anchor_spring(touched.points[static_cast<std::size_t>(i)],
                                               from.col(i) + share * (targets.col(i) - from.col(i)),
                                               strength * touched.weights[i]));
  return loads;
}

}  // namespace argil::sculpt
