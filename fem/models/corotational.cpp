#include "fem/models/packet_tangent.h"

namespace argil::fem {
namespace {

class Corotational final : public ForceModel {
 public:
  Corotational(std::span<const ElementBlock> blocks, std::size_t node_count)
      : packets_(std::make_shared<ElementPackets>(blocks, node_count)) {}

  std::string_view name() const override { return "corotational"; }
  Promises promises() const override { return {}; }

  double energy(const Eigen::Matrix3Xd& x) const override {
    energies_.resize(packets_->all_packet_count());
    packets_->for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = packets_->arguments(block, nullptr, nullptr, energies_.data());
      arguments.x = x.data();
      packets_->kernels(block).energy(arguments, begin, end);
    });
    return packets_->sum(energies_.data());
  }

  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    slots_.resize(packets_->slot_count());
    packets_->for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = packets_->arguments(block, slots_.data(), nullptr, nullptr);
      arguments.x = x.data();
      packets_->kernels(block).forces(arguments, begin, end);
    });
    packets_->gather(slots_.data(), forces);
  }

  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    auto result = std::make_unique<PacketTangent>(packets_, memory_);
    packets_->for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
      PacketArguments arguments = packets_->arguments(block, nullptr, result->entries(), nullptr);
      arguments.x = x.data();
      arguments.clamp_twist = projection == Projection::positive_semidefinite;
      packets_->kernels(block).tangent(arguments, begin, end);
    });
    return result;
  }

 private:
  std::shared_ptr<const ElementPackets> packets_;
  std::shared_ptr<PacketMemory> memory_ = std::make_shared<PacketMemory>();
  mutable std::vector<FourDoubles> slots_, energies_;  // working memory: one call at a time
};

}  // namespace

std::unique_ptr<ForceModel> make_corotational(std::span<const ElementBlock> blocks,
                                              const Eigen::Matrix3Xd& rest_nodes) {
  return std::make_unique<Corotational>(blocks, static_cast<std::size_t>(rest_nodes.cols()));
}

}  // namespace argil::fem
