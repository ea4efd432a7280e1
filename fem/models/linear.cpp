#include "fem/models/packet_tangent.h"
#include "fem/parallel.h"

namespace argil::fem {
namespace {

class Linear final : public ForceModel {
 public:
  Linear(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes)
      : packets_(std::make_shared<ElementPackets>(blocks, static_cast<std::size_t>(rest_nodes.cols()))),
        rest_nodes_(rest_nodes) {}

  std::string_view name() const override { return "linear"; }
  Promises promises() const override {
    Promises promises;
    promises.conserves_momentum = false;  // moments vanish at rest only
    promises.rotation_invariant = false;
    promises.largest_rotation = 0.05;  // strain of a rigid rotation: 1 − cos ≈ 1e-3
    return promises;
  }

  double energy(const Eigen::Matrix3Xd& x) const override {
    const Eigen::Matrix3Xd displacements = x - rest_nodes_;
    Eigen::Matrix3Xd product;
    tangent(x, Projection::none)->stiffness_product(displacements, product);
    return 0.5 * parallel_sum(static_cast<std::size_t>(x.cols()), 1024, [&](std::size_t i) {
             const auto c = static_cast<Eigen::Index>(i);
             return displacements(0, c) * product(0, c) + displacements(1, c) * product(1, c) +
                    displacements(2, c) * product(2, c);
           });
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    tangent(x, Projection::none)->stiffness_product(x - rest_nodes_, forces);
    forces = -forces;
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd&, Projection) const override {
    auto result = std::make_unique<PacketTangent>(packets_, memory_);
    packets_->for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      linear_tangent(packets_->arguments(block, nullptr, result->entries(), nullptr), begin, end);
    });
    return result;
  }

 private:
  std::shared_ptr<const ElementPackets> packets_;
  std::shared_ptr<PacketMemory> memory_ = std::make_shared<PacketMemory>();
  Eigen::Matrix3Xd rest_nodes_;
};

}  // namespace

std::unique_ptr<ForceModel> make_linear(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes) {
  return std::make_unique<Linear>(blocks, rest_nodes);
}

}  // namespace argil::fem
