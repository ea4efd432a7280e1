#include "sculpt/force_tools/tool_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sculpt/force_tools/pull.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

std::unique_ptr<ForceTool> take_pull(const Document& document, const Tool& tool, const StrokePose& first,
                                     const GripOptions& options) {
  return std::make_unique<PullGrip>(document, tool, first.position, options);
}

constexpr std::array k_tools{
    ToolKind{"pull", "a spring from the device to the middle of what it touched; a stroke into the solid pushes",
             &take_pull},
    ToolKind{"grab", "what it touched follows the device as one patch and turns with it", &take_grab},
    ToolKind{"inflate", "pressure, strength / radius, along the normals; inverted it deflates", &take_inflate},
    ToolKind{"twist",
             "a pure moment about the normal, from the device's turn or its way to the right: a radius for a "
             "radian",
             &take_twist},
    ToolKind{"pinch", "draws together towards the device along the surface; inverted it spreads", &take_pinch},
    ToolKind{"smooth", "draws each point to the mean of its surroundings, slowly; inverted it sharpens",
             &take_smooth},
    ToolKind{"paint_stiffness", "paints young_modulus along the way, inside the solid as well", nullptr},
    ToolKind{"paint_mass", "paints density", nullptr},
    ToolKind{"paint_damping", "paints damping", nullptr},
    ToolKind{"paint_mask", "protects from all other tools, wholly or to `value`; inverted it takes the mask away",
             nullptr},
    ToolKind{"pin_brush", "pins control points; inverted it releases", nullptr},
    ToolKind{"probe", "touches without changing anything, and reads how stiff the body feels", nullptr},
};

}  // namespace

std::span<const ToolKind> tool_table() {
  return k_tools;
}

const ToolKind& tool_by_name(std::string_view name) {
  const auto found =
      std::find_if(k_tools.begin(), k_tools.end(), [&](const ToolKind& kind) { return kind.name == name; });
  if (found != k_tools.end()) return *found;
  std::string names;
  for (const ToolKind& kind : k_tools) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a tool; tools are {}", name, names));
}

}  // namespace argil::sculpt
