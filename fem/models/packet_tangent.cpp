#include "fem/models/packet_tangent.h"

namespace argil::fem {

PacketTangent::PacketTangent(std::shared_ptr<const ElementPackets> packets, std::shared_ptr<PacketMemory> memory)
    : packets_(std::move(packets)),
      memory_(std::move(memory)),
      entries_(memory_->take(packets_->point_packet_count() * k_tangent_entries)),
      slots_(memory_->take(packets_->slot_count())) {}

PacketTangent::~PacketTangent() {
  memory_->give_back(std::move(entries_));
  memory_->give_back(std::move(slots_));
}

void PacketTangent::stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const {
  packets_->for_packets([&](std::size_t block, std::size_t begin, std::size_t end) {
    PacketArguments arguments = packets_->arguments(block, slots_.data(), entries_.data(), nullptr);
    arguments.x = dx.data();
    packets_->kernels(block).product(arguments, begin, end);
  });
  packets_->gather(slots_.data(), result);
}

void PacketTangent::element_tangents(const Visit& visit) const {
  for (std::size_t block = 0; block < packets_->block_count(); ++block) {
    const PacketArguments arguments = packets_->arguments(block, nullptr, entries_.data(), nullptr);
    visit_packets(*packets_, block, visit, [&](std::size_t packet, FourDoubles* stiffness) {
      packet_stiffness(arguments, packet, stiffness);
    });
  }
}

}  // namespace argil::fem
