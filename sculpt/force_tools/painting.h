#pragma once
// Strokes that paint: stiffness, mass, damping, pins, along the way of the device while the body moves on. A stroke
// paints each place once, by the largest weight that any part of its way gave it, so that what it leaves does not
// depend on the length of steps or the speed of the hand. Position and velocity are kept, but for what is pinned.

#include <optional>
#include <string_view>

#include "sculpt/document.h"
#include "sculpt/force_tools/force_tool.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

/// paint_stiffness paint_mass paint_damping paint_mask pin_brush.
[[nodiscard]] bool is_painting_tool(std::string_view name);

/// The mask is painted where it already is; all others it protects from.
[[nodiscard]] Masks masks_of(std::string_view tool);

class Painting {
 public:
  /// Inverted it divides by the factor, or draws towards the initial value; pin_brush then releases. paint_mask
  /// draws towards 1, or the tool's value; inverted towards 0.
  /// @throws Error (bad_input) for a value that the field cannot have, or if nothing of the body is within the
  /// radius.
  Painting(const Document& document, const Tool& tool, const Eigen::Vector3d& at, const GripOptions& options);

  /// Notes what is within the radius of the straight way between two poses (of the surface and inside), weighted by
  /// falloff, pressure and what the mask leaves; the radius is that of the poses' size. Cost O(nodes of the finest
  /// level).
  void note(const Document& document, const StrokePose& from, const StrokePose& to);
  /// Gives the body what is noted; but if `at` [m] is said, only where that is a quarter of the radius from where
  /// it was when this was done last, as new materials cost a new factor of the stiffness.
  void apply(Document& document, const std::optional<Eigen::Vector3d>& at = std::nullopt);

  /// "young_modulus painted on 12 nodes".
  [[nodiscard]] std::string report() const;

 private:
  void apply_field(Document& document) const;
  void apply_pins(Document& document) const;

  Tool tool_;
  bool invert_;
  std::optional<FieldName> field_;      // none: pins
  std::shared_ptr<const Fields> base_;  // before the stroke
  Eigen::VectorXd largest_;             // weights so far, per node; of pins, per control point
  std::vector<std::uint8_t> pinned_;    // before the stroke, per control point
  bool noted_ = false;                  // what has not been applied
  std::optional<Eigen::Vector3d> applied_at_;
};

}  // namespace argil::sculpt
