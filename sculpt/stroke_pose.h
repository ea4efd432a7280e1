#pragma once
// Where the device of a stroke is, in the world, and how hard it is pressed.

#include <Eigen/Geometry>

namespace argil::sculpt {

struct StrokePose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               // world [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // turns of the hand: twist, grab
  double pressure = 1;                                              // 0 … 1, scales the tool's force
  double size = 1;  // 0 … 1, share of the tool's radius, for tools that go over the body
};

}  // namespace argil::sculpt
