#include "sculpt/haptics/contact_model.h"

#include <algorithm>
#include <cassert>

namespace argil::sculpt {

Eigen::Vector3d contact_force(const ContactModel& model, const Eigen::Vector3d& position) {
  assert(model.plane_count <= ContactModel::k_max_planes);
  Eigen::Vector3d force = model.force + model.derivative * (position - model.point);
  for (std::size_t i = 0; i < model.plane_count; ++i) {
    const ContactPlane& plane = model.planes[i];
    const double depth = plane.offset - plane.normal.dot(position);
    if (depth > 0) force += plane.stiffness * depth * plane.normal;
  }
  return force;
}

}  // namespace argil::sculpt
