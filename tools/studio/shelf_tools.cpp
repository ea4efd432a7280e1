// Of desk.h: the tools of the shelf.

#include <algorithm>

#include "sculpt/command.h"
#include "tools/studio/desk.h"

namespace argil::studio {

namespace {

const std::vector<ShelfTool>& known_tools() {
  using enum ToolKind;
  static const std::vector<ShelfTool> tools{
      {force, "pull", "Pull", "pulls", "Draws what it touches by a spring; towards the solid it pushes",
       icons::hand},
      {force, "grab", "Grab", "takes along", "Takes what it touches along, as it is", icons::grab},
      {force, "inflate", "Inflate", "inflates", "Presses outwards from within; inverted it deflates",
       icons::expand},
      {force, "twist", "Twist", "twists", "Turns what it touches; move the pointer sideways", icons::twist},
      {force, "pinch", "Pinch", "pinches", "Draws what it touches together; inverted it spreads", icons::pinch},
      {force, "smooth", "Smooth", "smooths", "Draws each point to the mean of its surroundings", icons::drop},
      {paint, "paint_stiffness", "Paint stiffness", "stiffens", "Makes clay stiffer; inverted softer", icons::brush,
       "young_modulus"},
      {paint, "paint_mass", "Paint mass", "makes heavy", "Makes clay denser; inverted lighter", icons::balance,
       "density"},
      {paint, "paint_damping", "Paint damping", "damps", "Makes motion die out faster; inverted slower",
       icons::damping, "damping"},
      {mask, "paint_mask", "Mask", "masks", "Protects clay from all other tools; inverted it takes the mask away",
       icons::layers},
      {pin, "pin_brush", "Pin", "pins", "Holds control points where they are; inverted lets go", icons::pin},
      {curve, "", "Curve", "lays a curve",
       "Clicks lay a curve on the clay, Enter finishes it; then its handles draw the clay", icons::branch},
      {extrude, "", "Extrude", "draws a face out", "Draws a face of the control solid out into a new cell",
       icons::cube},
      {probe, "probe", "Probe", "feels", "Touches without changing, and reads how stiff it feels", icons::probe},
  };
  return tools;
}

bool is_there(const ShelfTool& tool) {
  if (*tool.name == '\0') return true;
  for (const sculpt::Command& command : sculpt::command_table())
    if (command.name == "tool") {
      const auto& choices = command.parameters.front().choices;
      return std::find(choices.begin(), choices.end(), tool.name) != choices.end();
    }
  return false;
}

}  // namespace

const std::vector<ShelfTool>& shelf_tools() {
  static const std::vector<ShelfTool> tools = [] {
    std::vector<ShelfTool> there;
    for (const ShelfTool& tool : known_tools())
      if (is_there(tool)) there.push_back(tool);
    return there;
  }();
  return tools;
}

}  // namespace argil::studio
