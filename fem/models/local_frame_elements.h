#pragma once
// The elements of the published local frame (METHODS §4): what they measure at rest, their displacements R, the
// frame in the middle of each cell and their stiffness matrices.

#include <memory>
#include <span>
#include <vector>

#include "fem/models/element_stiffness.h"
#include "fem/models/local_frame_operator.h"
#include "fem/models/node_sums.h"
#include "fem/parallel.h"

namespace argil::fem::local_frame {

/// One block: what R compares with, and the gradients in the middle of the cell.
struct Part {
  const ElementBlock* block = nullptr;
  std::size_t index = 0;  // of the block
  const LocalTopology* topology = nullptr;
  std::vector<double> rest_measures;        // [element * measure_count]
  std::vector<Eigen::Matrix3Xd> gradients;  // [element], ∂N/∂X in the middle

  std::size_t node_count() const { return static_cast<std::size_t>(block->kind->node_count); }
  std::size_t element_count() const { return block->element_count(); }
  std::size_t measure_count() const { return topology->measure_count(); }
  const std::uint32_t* nodes(std::size_t element) const { return block->nodes.data() + element * node_count(); }
};

/// Elements of all blocks, without their material.
class LocalFrames {
 public:
  LocalFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes);

  std::span<const Part> parts() const { return parts_; }
  std::size_t slot(const Part& part, std::size_t element) const { return 3 * sums.slot(part.index, element); }

  /// Calls body(part, element) for all elements, in parallel.
  template <class Body>
  void for_elements(const Body& body) const {
    for (const Part& part : parts_)
      parallel_for(part.element_count(), part.node_count() > 8 ? 1 : 32, [&](std::size_t e) { body(part, e); });
  }

  NodeSums sums;

 private:
  std::vector<Part> parts_;
};

/// The nodes of one element, at most 64.
struct Local {
  double values[192];
};
/// Of all nodes, those of one element.
void take(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& to);
/// R of the element at x (local_frame_operator.h).
void displacements(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x, Local& result);
void turn(const Eigen::Matrix3d& by, std::size_t nodes, Local& values);

/// Rotation of F in the middle of the cell, det = +1.
[[nodiscard]] Eigen::Matrix3d frame(const Part& part, std::size_t element, const Eigen::Matrix3Xd& x);

/// The elements, and their matrices with the material that the blocks have now: made anew where it was painted.
class CurrentFrames {
 public:
  /// @throws Error (unsupported) for kinds of elements without edges and angles to measure.
  CurrentFrames(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes, bool literal);

  const std::shared_ptr<const LocalFrames>& frames() const { return frames_; }
  const std::shared_ptr<const ElementStiffness>& stiffness();

 private:
  std::span<const ElementBlock> blocks_;
  Eigen::Matrix3Xd rest_nodes_;
  bool literal_;
  std::shared_ptr<const LocalFrames> frames_;
  std::shared_ptr<const ElementStiffness> stiffness_;
};

}  // namespace argil::fem::local_frame
