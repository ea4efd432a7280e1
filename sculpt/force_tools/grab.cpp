#include "sculpt/force_tools/point_springs.h"
#include "sculpt/force_tools/tool_table.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

namespace {

class Grab : public ForceTool {
 public:
  Grab(const Document& document, const Tool& tool, const StrokePose& first, const GripOptions& options)
      : touched_(touch(document, tool, first.position, options.inside)),
        middle_(middle_of(touched_)),
        first_(first),
        strength_(touched_.share * tool.strength),
        limit_(tool.largest_force),
        invert_(options.invert) {}

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    const Eigen::Quaterniond turned = pose.orientation * first_.orientation.conjugate();
    const Eigen::Matrix3d turn = (invert_ ? turned.conjugate() : turned).toRotationMatrix();
    const Eigen::Vector3d device = invert_ ? Eigen::Vector3d(2 * first_.position - pose.position) : pose.position;
    Eigen::Matrix3Xd targets(3, touched_.positions.cols());
    for (Eigen::Index i = 0; i < targets.cols(); ++i)
      targets.col(i) = device + turn * (touched_.positions.col(i) - first_.position);
    return point_springs(touched_, positions, targets, strength_, pose.pressure, limit_);
  }

  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override {
    return fem::position(middle_, positions);
  }

  double stiffness() const override { return strength_; }

 private:
  Touched touched_;
  fem::PointStencil middle_;
  StrokePose first_;
  double strength_, limit_;
  bool invert_;
};

}  // namespace

std::unique_ptr<ForceTool> take_grab(const Document& document, const Tool& tool, const StrokePose& first,
                                     const GripOptions& options) {
  return std::make_unique<Grab>(document, tool, first, options);
}

}  // namespace argil::sculpt
