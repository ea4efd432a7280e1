#pragma once
// The tangent of the corotational model: per quadrature point a rotation, a twist matrix and Lamé's
// constants (corotational_kernels.h), independent of later changes of state and material.

#include <memory>
#include <vector>

#include "fem/models/element_packets.h"
#include "fem/models/force_model.h"
#include "fem/models/packet_memory.h"

namespace argil::fem {

/// Its results are written through working memory of its own: one call at a time.
class PacketTangent final : public Tangent {
 public:
  PacketTangent(std::shared_ptr<const ElementPackets> packets, std::shared_ptr<PacketMemory> memory);
  ~PacketTangent() override;

  /// For the model that fills it: per-point entries over all blocks.
  FourDoubles* entries() { return entries_.data(); }

  void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const override;
  void element_tangents(const Visit& visit) const override;

 private:
  std::shared_ptr<const ElementPackets> packets_;
  std::shared_ptr<PacketMemory> memory_;
  mutable std::vector<FourDoubles> entries_, slots_;
};

}  // namespace argil::fem
