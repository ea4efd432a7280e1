#include "fem/models/element_packets.h"

#include <algorithm>
#include <cassert>

#include "fem/parallel.h"

namespace argil::fem {
namespace {

constexpr std::size_t k_lane_count = k_lanes;

std::size_t packets_of(const ElementBlock& block) {
  return (block.element_count() + k_lane_count - 1) / k_lane_count;
}

}  // namespace

ElementPackets::ElementPackets(std::span<const ElementBlock> blocks, std::size_t node_count)
    : node_count_(node_count), parts_(blocks.size()) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const ElementBlock& block = blocks[b];
    const std::size_t packets = packets_of(block);
    Part& part = parts_[b];
    part.block = &block;
    part.kernels = corotational_kernels(*block.kind);
    part.slot_begin = slot_count_;
    part.point_begin = point_packet_count_;
    part.packet_begin = all_packet_count_;
    slot_count_ += packets * static_cast<std::size_t>(block.kind->node_count) * 3;
    point_packet_count_ += packets * static_cast<std::size_t>(block.kind->point_count);
    all_packet_count_ += packets;
    pack(part);
    const std::size_t chunk = std::max<std::size_t>(1, 256 / static_cast<std::size_t>(block.kind->point_count));
    for (std::size_t begin = 0; begin < packets; begin += chunk)
      chunks_.push_back({b, begin, std::min(begin + chunk, packets)});
  }
  list_slots();
}

void ElementPackets::pack(Part& part) {
  const ElementBlock& block = *part.block;
  const std::size_t packets = packets_of(block), count = block.element_count();
  const auto nodes = static_cast<std::size_t>(block.kind->node_count);
  const auto points = static_cast<std::size_t>(block.kind->point_count);
  part.nodes.resize(packets * nodes * k_lane_count);
  part.jacobians.resize(packets * points * 9);
  part.volumes.resize(packets * points);
  parallel_for(packets, 64, [&](std::size_t packet) {
    for (std::size_t lane = 0; lane < k_lane_count; ++lane) {
      const std::size_t element = std::min(packet * k_lane_count + lane, count - 1);
      for (std::size_t n = 0; n < nodes; ++n)
        part.nodes[(packet * nodes + n) * k_lane_count + lane] = 3 * block.nodes[element * nodes + n];
      for (std::size_t p = 0; p < points; ++p) {
        const std::size_t from = element * points + p, to = packet * points + p;
        part.volumes[to].values[lane] = block.volumes[from];
        for (std::size_t i = 0; i < 9; ++i)
          part.jacobians[9 * to + i].values[lane] =
              block.inverse_rest_jacobians[from](static_cast<int>(i / 3), static_cast<int>(i % 3));
      }
    }
  });
}

void ElementPackets::list_slots() {
  slots_begin_.assign(node_count_ + 1, 0);
  for (const Part& part : parts_)
    for (const std::uint32_t node : part.block->nodes) ++slots_begin_[node + 1];
  for (std::size_t n = 0; n < node_count_; ++n) slots_begin_[n + 1] += slots_begin_[n];
  slots_.resize(slots_begin_.back());
  std::vector<std::size_t> next(slots_begin_.begin(), slots_begin_.end() - 1);
  for (const Part& part : parts_) {
    const auto nodes = static_cast<std::size_t>(part.block->kind->node_count);
    for (std::size_t i = 0; i < part.block->nodes.size(); ++i) {
      const std::size_t element = i / nodes, node = i % nodes;
      const std::size_t slot = part.slot_begin + (element / k_lane_count * nodes + node) * 3;
      slots_[next[part.block->nodes[i]]++] =
          static_cast<std::uint32_t>(slot * k_lane_count + element % k_lane_count);
    }
  }
}

std::size_t ElementPackets::packet_count(std::size_t b) const {
  return packets_of(*parts_[b].block);
}

PacketArguments ElementPackets::arguments(std::size_t b, FourDoubles* slots, FourDoubles* tangent,
                                          FourDoubles* energies) const {
  const Part& part = parts_[b];
  PacketArguments a;
  a.kind = part.block->kind;
  a.element_count = part.block->element_count();
  a.nodes = part.nodes.data();
  a.jacobians = part.jacobians.data();
  a.volumes = part.volumes.data();
  a.mu = part.block->mu.data();
  a.lambda = part.block->lambda.data();
  if (slots) a.slots = slots + part.slot_begin;
  if (tangent) a.tangent = tangent + part.point_begin * k_tangent_entries;
  if (energies) a.energies = energies + part.packet_begin;
  return a;
}

void ElementPackets::for_packets(const Body& body) const {
  parallel_for(chunks_.size(), 1, [&](std::size_t i) { body(chunks_[i].block, chunks_[i].begin, chunks_[i].end); });
}

double ElementPackets::sum(const FourDoubles* energies) const {
  double total = 0;
  for (const Part& part : parts_) {
    const FourDoubles* packets = energies + part.packet_begin;
    total += parallel_sum(part.block->element_count(), 4096, [&](std::size_t element) {
      return packets[element / k_lane_count].values[element % k_lane_count];
    });
  }
  return total;
}

void ElementPackets::gather(const FourDoubles* slots, Eigen::Matrix3Xd& result) const {
  result.resize(3, static_cast<Eigen::Index>(node_count_));
  const double* values = slots ? slots->values : nullptr;
  double* to = result.data();
  parallel_for(node_count_, 512, [&](std::size_t node) {
    double x = 0, y = 0, z = 0;
    for (std::size_t i = slots_begin_[node]; i < slots_begin_[node + 1]; ++i) {
      const double* slot = values + slots_[i];
      x += slot[0];
      y += slot[k_lanes];
      z += slot[2 * k_lanes];
    }
    to[3 * node] = x;
    to[3 * node + 1] = y;
    to[3 * node + 2] = z;
  });
}

void visit_packets(const ElementPackets& packets, std::size_t block, const Tangent::Visit& visit,
                   const std::function<void(std::size_t packet, FourDoubles* matrices)>& compute) {
  constexpr std::size_t k_at_once = 16;
  const ElementBlock& elements = packets.block(block);
  const auto nodes = static_cast<std::size_t>(elements.kind->node_count), size = 3 * nodes;
  std::vector<FourDoubles> matrices(k_at_once * size * size);
  Eigen::MatrixXd stiffness(size, size);
  const std::size_t count = packets.packet_count(block);
  for (std::size_t first = 0; first < count; first += k_at_once) {
    const std::size_t last = std::min(first + k_at_once, count);
    parallel_for(last - first, 1, [&](std::size_t i) { compute(first + i, matrices.data() + i * size * size); });
    for (std::size_t e = first * k_lane_count; e < std::min(last * k_lane_count, elements.element_count()); ++e) {
      const FourDoubles* from = matrices.data() + (e / k_lane_count - first) * size * size;
      double* to = stiffness.data();
      for (std::size_t i = 0; i < size * size; ++i) to[i] = from[i].values[e % k_lane_count];
      visit({elements.nodes.data() + e * nodes, nodes}, stiffness);
    }
  }
}

}  // namespace argil::fem
