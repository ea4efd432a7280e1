#pragma once
// What the tools are tried on: a block with sharp edges, held at its foot, and a brush that reaches a part of its
// top.

#include <string>
#include <vector>

#include "tests/sculpt/sessions.h"

namespace argil::sculpt {

inline std::vector<std::string> held_block(const std::string& space = "default") {
  return {"new box 3 3 2 size 0.3 0.3 0.2",
          "select edges angle 30",
          "sharpen",
          "levels 1",
          "space " + space,
          "pin where z < 0.01"};
}

inline Tool tool_of(const std::string& name) {
  Tool tool;
  tool.name = name;
  tool.radius = 0.09;
  tool.strength = 50;
  return tool;
}

}  // namespace argil::sculpt
