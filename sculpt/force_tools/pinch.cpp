#include "sculpt/force_tools/patch_modes.h"
#include "sculpt/force_tools/tool_table.h"

namespace argil::sculpt {

namespace {

class Pinch : public ForceTool {
 public:
  Pinch(const Document& document, const Tool& tool, const StrokePose& first, const GripOptions& options)
      : tool_(tool),
        options_(options),
        patch_(touch_patch(document, tool, first.position, options.inside)),
        middle_(middle_of(patch_.touched)),
        held_{first.position} {}

  void follow(const StrokePose& pose, const Document& document) override {
    if (!wants_new_hold(tool_, held_, pose)) return;
    held_ = pose;
    const LaidTool laid = laid_tool(document, tool_, held_, options_.inside);
    touches_ = !touched(document, laid.tool, laid.at, options_.inside).empty();
    if (!touches_) return;
    patch_ = touch_patch(document, laid.tool, laid.at, options_.inside);
    middle_ = middle_of(patch_.touched);
  }

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    if (!touches_) return {};
    const Eigen::Matrix3Xd vectors = mode_vectors(patch_.modes, positions);
    Eigen::Matrix3Xd forces(3, vectors.cols());
    for (Eigen::Index a = 0; a < vectors.cols(); ++a) {
      const double length = vectors.col(a).norm(), at_hold = patch_.modes.at_hold.col(a).norm();
      // Along the modes themselves, so that there is no moment either.
      const double way = !options_.invert ? -1 : length > 0 ? 2 * at_hold / length - 1 : 0;
      forces.col(a) = pose.pressure * patch_.touched.share * tool_.strength * way * vectors.col(a);
    }
    return mode_loads(patch_, vectors, forces, patch_.touched.share * tool_.strength, tool_.largest_force);
  }

  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override {
    return fem::position(middle_, positions);
  }

 private:
  Tool tool_;
  GripOptions options_;
  TouchedPatch patch_;
  fem::PointStencil middle_;
  StrokePose held_;  // where it took hold
  bool touches_ = true;
};

}  // namespace

std::unique_ptr<ForceTool> take_pinch(const Document& document, const Tool& tool, const StrokePose& first,
                                      const GripOptions& options) {
  return std::make_unique<Pinch>(document, tool, first, options);
}

}  // namespace argil::sculpt
