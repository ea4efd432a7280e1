#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "sculpt/force_tools/patch_modes.h"
#include "sculpt/force_tools/tool_table.h"

namespace argil::sculpt {

namespace {

// The angle that differs from it by whole turns and is nearest to another.
double unwrapped(double angle, double near) {
  constexpr double k_turn = 2 * std::numbers::pi;
  return angle + k_turn * std::round((near - angle) / k_turn);
}

Eigen::Matrix3d inertia(const Eigen::Matrix3Xd& vectors) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Eigen::Index a = 0; a < vectors.cols(); ++a) {
    const Eigen::Vector3d e = vectors.col(a);
    sum += e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose();
  }
  return sum;
}

class Twist : public ForceTool {
 public:
  Twist(const Document& document, const Tool& tool, const StrokePose& first, const GripOptions& options)
      : tool_(tool),
        patch_(touch_patch(document, tool, first.position, options.inside)),
        middle_(middle_of(patch_.touched)),
        first_(first),
        normal_(patch_.touched.normal),
        right_(right_of(normal_, options.mirror)),
        sense_(options.invert ? -1 : 1) {
    const Eigen::Vector3d axis = mode_normal(patch_.modes.at_hold);
    tool_.strength *= patch_.touched.share;
    torsion_ = tool_.strength * axis.dot(inertia(patch_.modes.at_hold) * axis);
  }

  void follow(const StrokePose& pose, const Document& document) override {
    turn_ = hand_turn(pose);
    body_turn_ = patch_turn(mode_vectors(patch_.modes, document.positions()));
  }

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    const Eigen::Matrix3Xd vectors = mode_vectors(patch_.modes, positions);
    const Eigen::Vector3d wanted = moment(pose, vectors) * mode_normal(vectors);
    const Eigen::Vector3d swirl = inertia(vectors).partialPivLu().solve(wanted);
    Eigen::Matrix3Xd forces(3, vectors.cols());
    for (Eigen::Index a = 0; a < vectors.cols(); ++a) forces.col(a) = swirl.cross(vectors.col(a));
    if (!forces.allFinite()) forces.setZero();  // the patch has collapsed to a line: there is no turn to give
    return mode_loads(patch_, vectors, forces, tool_.strength, tool_.largest_force);
  }

  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override {
    return fem::position(middle_, positions);
  }

  // The work of the moment is that of the way to the right.
  Felt felt(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    const double by_way = sense_ / tool_.radius;
    const double now = moment(pose, mode_vectors(patch_.modes, positions));
    return {-by_way * now * right_, -by_way * by_way * pose.pressure * torsion_ * (right_ * right_.transpose())};
  }

 private:
  // The mirror image of a turn goes the other way round.
  static Eigen::Vector3d right_of(Eigen::Vector3d normal, int mirror) {
    if (mirror < 0) return rightwards(normal);
    normal[mirror] *= -1;
    Eigen::Vector3d right = rightwards(normal);
    right[mirror] *= -1;
    return -right;
  }

  double hand_turn(const StrokePose& pose) const {
    const Eigen::Quaterniond turned = pose.orientation * first_.orientation.conjugate();
    return unwrapped(2 * std::atan2(turned.vec().dot(normal_), turned.w()), turn_);
  }

  // About the present normal, after the patch has been tilted back.
  double patch_turn(const Eigen::Matrix3Xd& vectors) const {
    const Eigen::Vector3d normal = mode_normal(vectors);
    const Eigen::Matrix3d tilt =
        Eigen::Quaterniond::FromTwoVectors(mode_normal(patch_.modes.at_hold), normal).toRotationMatrix();
    double sine = 0, cosine = 0;
    for (Eigen::Index a = 0; a < 2; ++a) {
      const Eigen::Vector3d before = tilt * patch_.modes.at_hold.col(a), now = vectors.col(a);
      sine += normal.dot(before.cross(now));
      cosine += before.dot(now);
    }
    return unwrapped(std::atan2(sine, cosine), body_turn_);
  }

  double moment(const StrokePose& pose, const Eigen::Matrix3Xd& vectors) const {
    const double way = right_.dot(pose.position - first_.position) / tool_.radius;
    return pose.pressure * torsion_ * (sense_ * (hand_turn(pose) + way) - patch_turn(vectors));
  }

  Tool tool_;
  TouchedPatch patch_;
  fem::PointStencil middle_;
  StrokePose first_;
  Eigen::Vector3d normal_, right_;
  double sense_, torsion_ = 0;       // ±1; [N m]
  double turn_ = 0, body_turn_ = 0;  // at the last step, whole turns counted
};

}  // namespace

std::unique_ptr<ForceTool> take_twist(const Document& document, const Tool& tool, const StrokePose& first,
                                      const GripOptions& options) {
  return std::make_unique<Twist>(document, tool, first, options);
}

}  // namespace argil::sculpt
