#pragma once
// Element blocks laid out for the kernels: four elements side by side, and for each node of the table the list of
// slots that carry force to it. The slots of a node are summed in the order of blocks, elements and nodes, so
// that the sum does not depend on the number of threads.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "fem/element_block.h"
#include "fem/models/corotational_kernels.h"
#include "fem/models/force_model.h"

namespace argil::fem {

class ElementPackets {
 public:
  /// Takes nodes and rest geometry; material arrays are read from `blocks` at each call, so that they may change.
  /// `blocks` must outlive this.
  ElementPackets(std::span<const ElementBlock> blocks, std::size_t node_count);

  std::size_t block_count() const { return parts_.size(); }
  const ElementBlock& block(std::size_t b) const { return *parts_[b].block; }
  const CorotationalKernels& kernels(std::size_t b) const { return parts_[b].kernels; }
  std::size_t node_count() const { return node_count_; }
  std::size_t packet_count(std::size_t b) const;

  /// Arguments of block b with its own part of `slots`, `tangent`, `energies` (arrays over all blocks; may be
  /// null).
  PacketArguments arguments(std::size_t b, FourDoubles* slots, FourDoubles* tangent, FourDoubles* energies) const;
  std::size_t slot_count() const { return slot_count_; }  // FourDoubles
  std::size_t point_packet_count() const { return point_packet_count_; }
  std::size_t all_packet_count() const { return all_packet_count_; }

  /// Calls body(block, begin, end) over ranges of packets of all blocks, in parallel.
  using Body = std::function<void(std::size_t block, std::size_t begin_packet, std::size_t end_packet)>;
  void for_packets(const Body& body) const;

  /// Σ of the slots of each node, 3 x node_count.
  void gather(const FourDoubles* slots, Eigen::Matrix3Xd& result) const;
  /// Σ over all elements, one number each, in order.
  [[nodiscard]] double sum(const FourDoubles* energies) const;

 private:
  struct Part {
    const ElementBlock* block = nullptr;
    CorotationalKernels kernels;
    std::vector<std::uint32_t> nodes;
    std::vector<FourDoubles> jacobians, volumes;
    std::size_t slot_begin = 0, point_begin = 0, packet_begin = 0;
  };
  struct Chunk {
    std::size_t block, begin, end;  // packets
  };
  static void pack(Part& part);
  void list_slots();

  std::size_t node_count_ = 0, slot_count_ = 0, point_packet_count_ = 0, all_packet_count_ = 0;
  std::vector<Part> parts_;
  std::vector<Chunk> chunks_;
  std::vector<std::size_t> slots_begin_;  // [node], one more ends the last
  std::vector<std::uint32_t> slots_;      // in doubles, of the x-component; y and z stand 4 and 8 further
};

/// Visits the elements of a block in order: `compute(packet, matrices)` fills the four 3n×3n matrices of a packet,
/// a few packets at a time in parallel.
void visit_packets(const ElementPackets& packets, std::size_t block, const Tangent::Visit& visit,
                   const std::function<void(std::size_t packet, FourDoubles* matrices)>& compute);

}  // namespace argil::fem
