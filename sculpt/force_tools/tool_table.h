#pragma once
// The one table of tools that strokes use: name, what it does, how it takes hold. `tool`, `stroke`, the help and a
// window's shelf follow it.

#include <span>
#include <string_view>

#include "sculpt/force_tools/force_tool.h"

namespace argil::sculpt {

struct ToolKind {
  std::string_view name, summary;
  /// Null for tools that change fields or pins, or only feel (painting.h, probe.h).
  std::unique_ptr<ForceTool> (*take_hold)(const Document& document, const Tool& tool, const StrokePose& first,
                                          const GripOptions& options);
};
[[nodiscard]] std::span<const ToolKind> tool_table();
/// @throws Error (not_found) that lists the names.
[[nodiscard]] const ToolKind& tool_by_name(std::string_view name);

// Each in a file of its own. @throws Error (bad_input) if nothing is within the radius.

/// Every touched point follows the device as if the patch were a rigid body in the hand, turning with it; each is
/// held by a spring of its share of the strength. Inverted, way and turn count backwards.
[[nodiscard]] std::unique_ptr<ForceTool> take_grab(const Document& document, const Tool& tool,
                                                   const StrokePose& first, const GripOptions& options);
/// Pressure strength / radius [Pa], with falloff, along present normals of the surface around the device; inside
/// the solid an isotropic stress of that size. Follows the device over the surface. Inverted it sucks in.
[[nodiscard]] std::unique_ptr<ForceTool> take_inflate(const Document& document, const Tool& tool,
                                                      const StrokePose& first, const GripOptions& options);
/// A pure moment about the patch's present normal: a torsion spring of strength · ⟨r²⟩ [N m], r the distance of
/// touched points from their middle, from the patch's turn to the device's. The device turns by its orientation
/// about the normal, and by 1 radian for each radius that it is moved to the right (rightwards()).
[[nodiscard]] std::unique_ptr<ForceTool> take_twist(const Document& document, const Tool& tool,
                                                    const StrokePose& first, const GripOptions& options);
/// Draws the touched points together in the tangent plane (inside: from all sides), each by its share of strength
/// times its distance from their middle; no net force or moment. Follows the device. Inverted it spreads them, to
/// twice their size.
[[nodiscard]] std::unique_ptr<ForceTool> take_pinch(const Document& document, const Tool& tool,
                                                    const StrokePose& first, const GripOptions& options);
/// Drives each touched point along the normal to the mean of the surface within a radius of it, with the drag of a
/// viscous skin; no net force or moment. Flat regions are left alone, whatever their mesh. Follows the device.
/// Inverted it makes what stands out stand out twice as far. Inside, it smooths the displacement.
[[nodiscard]] std::unique_ptr<ForceTool> take_smooth(const Document& document, const Tool& tool,
                                                     const StrokePose& first, const GripOptions& options);

/// A tool that follows the device takes new hold where it has moved a quarter of its radius from where it took
/// hold, or has another size by a tenth.
[[nodiscard]] inline bool wants_new_hold(const Tool& tool, const StrokePose& held, const StrokePose& now) {
  return (now.position - held.position).norm() > tool.radius / 4 * now.size || std::abs(now.size - held.size) > 0.1;
}

}  // namespace argil::sculpt
