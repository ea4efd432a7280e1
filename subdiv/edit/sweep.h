#pragma once
// Where what `extrude` grows stands: along a vector, along the normals of the vertices, or along a path, with a
// taper and a twist that build up on the way.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

struct Sweep {
  enum class Way { vector, normals, path };
  Way way = Way::vector;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  // of the far end from the near one [m]
  double distance = 0;                               // along the normals [m]
  std::vector<Eigen::Vector3d> path;  // where the middle of the faces goes from where it is [m]; corners are mitred
  bool curve = false;                 // through the points by a centripetal Catmull–Rom curve
  int steps = 1;     // rings of cells; along a path at least one for each leg, unless it is a curve
  double scale = 1;  // size of the far end against the near one
  double twist = 0;  // of the far end against the near one, right-handed about the way [rad]
};

/// Extrudes (extrude.h) and places. Taper and twist are about the middle of each patch, the faces connected through
/// shared vertices, so that four legs taper each about its own axis; a path moves all the faces about their common
/// middle, and turns them with it by parallel transport from their mean normal. Along normals, vertices keep the
/// distance to the planes of their faces where there are at most three, else in the mean square by area.
/// Caps and their edges descend from the faces extruded and theirs; `next_faces` are the caps.
/// @throws Error before anything is changed: as `extrude`; (bad_input) for a path without points, with one twice in
/// a row, that turns straight back, or with more legs than steps; (bad_geometry) where faces have no common normal
/// but one is needed. Cost O(new corners).
[[nodiscard]] Edit sweep(Transaction& transaction, const Eigen::Matrix3Xd& rest, std::span<const FaceId> faces,
                         const Sweep& how);

}  // namespace argil::subdiv
