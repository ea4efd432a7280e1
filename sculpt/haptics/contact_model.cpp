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

void ContactChannel::publish(const ContactModel& model) {
  slots_[writer_] = model;
  writer_ = between_.exchange(writer_ | k_fresh, std::memory_order_acq_rel) & k_slot;
}

const ContactModel* ContactChannel::latest() {
  if ((between_.load(std::memory_order_relaxed) & k_fresh) != 0) {
    reader_ = between_.exchange(reader_, std::memory_order_acq_rel) & k_slot;
    any_ = true;
  }
  return any_ ? &slots_[reader_] : nullptr;
}

}  // namespace argil::sculpt
