#include "fem/models/packet_tangent.h"

#include <algorithm>

#include "fem/parallel.h"

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
  // A few packets at a time in parallel, then their elements in order.
  constexpr std::size_t k_at_once = 16;
  for (std::size_t block = 0; block < packets_->block_count(); ++block) {
    const PacketArguments arguments = packets_->arguments(block, nullptr, entries_.data(), nullptr);
    const auto nodes = static_cast<std::size_t>(arguments.kind->node_count), size = 3 * nodes;
    std::vector<FourDoubles> matrices(k_at_once * size * size);
    Eigen::MatrixXd stiffness(size, size);
    const std::size_t packets = packets_->packet_count(block);
    for (std::size_t first = 0; first < packets; first += k_at_once) {
      const std::size_t last = std::min(first + k_at_once, packets);
      parallel_for(last - first, 1, [&](std::size_t i) {
        packet_stiffness(arguments, first + i, matrices.data() + i * size * size);
      });
      for (std::size_t element = first * k_lanes; element < std::min(last * k_lanes, arguments.element_count);
           ++element) {
        const FourDoubles* from = matrices.data() + (element / k_lanes - first) * size * size;
        double* to = stiffness.data();
        for (std::size_t i = 0; i < size * size; ++i) to[i] = from[i].values[element % k_lanes];
        visit({packets_->block(block).nodes.data() + element * nodes, nodes}, stiffness);
      }
    }
  }
}

}  // namespace argil::fem
