#include "sculpt/force_tools/curve.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sculpt/force_tools/point_springs.h"
#include "sculpt/force_tools/touched.h"
#include "subdiv/error.h"

namespace argil::sculpt {

HandleCurve::HandleCurve(std::vector<Eigen::Vector3d> through)
    : through_(std::move(through)), degree_(static_cast<int>(std::min<std::size_t>(through_.size(), 4)) - 1) {
  const std::size_t count = through_.size();
  if (count < 2)
    throw Error(ErrorCode::bad_input, fmt::format("a curve goes through at least two points, found {}", count));
  for (std::size_t i = 1; i < count; ++i)
    if (through_[i] == through_[i - 1])
      throw Error(ErrorCode::bad_input,
                  fmt::format("points {} and {} of the curve are the same; leave out one of them", i, i + 1));
  const auto degree = static_cast<std::size_t>(degree_);
  const std::size_t spans = count - degree;
  knots_.assign(degree, 0.0);
  for (std::size_t i = 0; i <= spans; ++i) knots_.push_back(static_cast<double>(i));
  knots_.insert(knots_.end(), degree, static_cast<double>(spans));
  Eigen::MatrixXd collocation(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    collocation.row(static_cast<Eigen::Index>(i)) = basis(parameter_of(i)).transpose();
  control_from_handles_ = collocation.partialPivLu().inverse();
}

double HandleCurve::parameter_of(std::size_t handle) const {
  double sum = 0;
  for (int k = 1; k <= degree_; ++k) sum += knots_[handle + static_cast<std::size_t>(k)];
  return sum / degree_;
}

// Cox and de Boor.
Eigen::VectorXd HandleCurve::basis(double t) const {
  const std::size_t count = through_.size(), degree = static_cast<std::size_t>(degree_);
  std::size_t span = degree;
  while (span + 1 < count && t >= knots_[span + 1]) ++span;
  std::vector<double> values(degree + 1, 0.0);
  values[0] = 1;
  for (std::size_t d = 1; d <= degree; ++d) {
    double carried = 0;
    for (std::size_t k = 0; k < d; ++k) {
      const double low = knots_[span + 1 + k - d], high = knots_[span + 1 + k];
      const double part = values[k] / (high - low);
      values[k] = carried + (high - t) * part;
      carried = (t - low) * part;
    }
    values[d] = carried;
  }
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k <= degree; ++k) result[static_cast<Eigen::Index>(span - degree + k)] = values[k];
  return result;
}

Eigen::VectorXd HandleCurve::influences(double t) const {
  return control_from_handles_.transpose() * basis(std::clamp(t, 0.0, end()));
}

Eigen::Vector3d HandleCurve::point(double t) const {
  const Eigen::VectorXd weights = influences(t);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < through_.size(); ++i) sum += weights[static_cast<Eigen::Index>(i)] * through_[i];
  return sum;
}

namespace {

/// The curve laid on the boundary, as a polyline.
struct LaidCurve {
  std::vector<double> parameters;
  std::vector<Eigen::Vector3d> points;

  struct Nearest {
    double distance = 1e300, parameter = 0;
  };
  Nearest nearest(const Eigen::Vector3d& to) const {
    Nearest best;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Eigen::Vector3d way = points[i + 1] - points[i];
      const double length_squared = way.squaredNorm();
      const double s = length_squared > 0 ? std::clamp((to - points[i]).dot(way) / length_squared, 0.0, 1.0) : 0.0;
      const double distance = (points[i] + s * way - to).norm();
      if (distance < best.distance) best = {distance, (1 - s) * parameters[i] + s * parameters[i + 1]};
    }
    return best;
  }
};

class CurveGrip : public ForceTool {
 public:
  CurveGrip(const Document& document, const Tool& tool, const HandleCurve& curve, std::size_t handle,
            const StrokePose& first)
      : first_(first), strength_(tool.strength), limit_(tool.largest_force) {
    constexpr int k_pieces = 16;  // of a span: the curve leaves its polyline by 1/256 of its sag
    static_cast<void>(touch(document, tool, curve.handle(handle), false));
    LaidCurve laid;
    const int pieces = k_pieces * static_cast<int>(std::lround(curve.end()));
    std::vector<Eigen::Vector3d> places;
    for (int i = 0; i <= pieces; ++i) {
      laid.parameters.push_back(curve.end() * i / pieces);
      places.push_back(curve.point(laid.parameters.back()));
    }
    laid.points = nearest_on_surface(document, places);
    touched_ = touched_near(document, tool, [&](const Eigen::Vector3d& x) { return laid.nearest(x).distance; });
    if (touched_.masked) refuse_masked();
    if (touched_.empty())
      throw Error(ErrorCode::bad_input,
                  fmt::format("the curve holds no part of the surface with a radius of {:g} m; "
                              "make the radius larger or refine the solid: levels 1",
                              tool.radius));
    strength_ *= touched_.share;
    middle_ = middle_of(touched_);
    influence_.resize(touched_.weights.size());
    for (Eigen::Index i = 0; i < influence_.size(); ++i) {
      influence_[i] =
          curve.influences(laid.nearest(touched_.positions.col(i)).parameter)[static_cast<Eigen::Index>(handle)];
      felt_stiffness_ += strength_ * touched_.weights[i] * influence_[i] * influence_[i];
    }
  }

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    const Eigen::Vector3d way = pose.position - first_.position;
    Eigen::Matrix3Xd targets = touched_.positions;
    for (Eigen::Index i = 0; i < targets.cols(); ++i) targets.col(i) += influence_[i] * way;
    return point_springs(touched_, positions, targets, strength_, pose.pressure, limit_);
  }

  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override {
    return fem::position(middle_, positions);
  }

  // The handle feels what works on its way: each point's force by its influence.
  Felt felt(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    Felt felt;
    const std::vector<fem::AnchorSpring> springs = loads(pose, positions).springs;
    for (std::size_t i = 0; i < springs.size(); ++i)
      felt.force -= influence_[static_cast<Eigen::Index>(i)] * springs[i].stiffness *
                    (springs[i].target - fem::held_point(springs[i], positions));
    felt.derivative = -pose.pressure * felt_stiffness_ * Eigen::Matrix3d::Identity();
    return felt;
  }

 private:
  StrokePose first_;
  double strength_, limit_;
  Touched touched_;
  fem::PointStencil middle_;
  Eigen::VectorXd influence_;  // of the handle, per touched point
  double felt_stiffness_ = 0;  // [N/m]
};

}  // namespace

std::unique_ptr<ForceTool> take_curve(const Document& document, const Tool& tool, const HandleCurve& curve,
                                      std::size_t handle, const StrokePose& first) {
  if (handle >= curve.handle_count())
    throw Error(ErrorCode::bad_input,
                fmt::format("the curve has handles 1 to {}, not {}", curve.handle_count(), handle + 1));
  return std::make_unique<CurveGrip>(document, tool, curve, handle, first);
}

}  // namespace argil::sculpt
