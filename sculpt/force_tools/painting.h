#pragma once
// Strokes that paint: stiffness, mass, damping, pins, along the way of the device while the body moves on. A stroke
// paints each place once, by the largest weight that any part of its way gave it, so that what it leaves does not
// depend on the length of steps or the speed of the hand. Position and velocity are kept, but for what is pinned.

#include <optional>
#include <string_view>

#include "sculpt/document.h"
#include "sculpt/force_tools/force_tool.h"

namespace argil::sculpt {

/// paint_stiffness paint_mass paint_damping pin_brush.
[[nodiscard]] bool is_painting_tool(std::string_view name);

class Painting {
 public:
  /// Inverted it divides by the factor, or draws towards the initial value; pin_brush then releases.
  /// @throws Error (bad_input) for a value that the field cannot have, or if nothing of the body is within the
  /// radius.
  Painting(const Document& document, const Tool& tool, const Eigen::Vector3d& at, const GripOptions& options);

  /// Paints what is within the radius of the straight way between two poses (of its surface and inside), weighted
  /// by falloff, pressure and what the mask leaves. Cost O(nodes of the finest level), and what new materials cost.
  void paint(Document& document, const StrokePose& from, const StrokePose& to);

  /// "young_modulus painted on 12 nodes".
  [[nodiscard]] std::string report() const;

 private:
  Eigen::VectorXd weights_on(const Eigen::Matrix3Xd& places, const StrokePose& from, const StrokePose& to) const;
  void paint_field(Document& document, const Eigen::VectorXd& weights);
  void paint_pins(Document& document, const StrokePose& from, const StrokePose& to);

  Tool tool_;
  bool invert_;
  std::optional<FieldName> field_;      // none: pins
  std::shared_ptr<const Fields> base_;  // before the stroke
  Eigen::VectorXd largest_;             // weights so far, per node
  std::vector<std::uint8_t> touched_;   // per control point, of pins
};

}  // namespace argil::sculpt
