#include "subdiv/edit/split_cells.h"

#include <algorithm>
#include <map>

#include "subdiv/edit/cuts.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

class Splitter {
 public:
  explicit Splitter(Transaction& transaction) : t_(transaction) {}

  Edit run(const std::vector<CellId>& cells) {
    // Edges, faces and cells in ascending order each, so that ids do not depend on the order of the cells.
    for (const CellId c : cells)
      for (const EdgeId e : cell_edges(solid(), c)) cuts_.edges[e];
    for (const CellId c : cells)
      for (const FaceUseId use : solid().cell_face_uses(c)) middles_[face_of(use)];
    for (auto& [e, middle] : cuts_.edges) middle = add_mean(t_, solid().edge_vertices(e), edit_);
    for (auto& [f, middle] : middles_) {
      middle = add_mean(t_, solid().face_vertices(f), edit_);
      cuts_.faces[f] = quadrilaterals(loop_with_cuts(solid(), cuts_, f), middle);
    }
    for (const CellId c : cells) cuts_.cells[c] = corner_cells(c);
    for (const auto& [cell, parts] : apply_cuts(t_, cuts_, edit_))
      edit_.next_cells.insert(edit_.next_cells.end(), parts.begin(), parts.end());
    return std::move(edit_);
  }

 private:
  const Solid& solid() const { return t_.solid(); }

  // One at each corner, from a loop of corners and edge points in turn.
  static std::vector<Loop> quadrilaterals(const Loop& loop, VertexId middle) {
    std::vector<Loop> result;
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; i += 2) result.push_back({loop[i], loop[i + 1], middle, loop[(i + n - 1) % n]});
    return result;
  }

  std::vector<std::vector<Loop>> corner_cells(CellId cell) {
    const VertexId centre = add_mean(t_, cell_vertices(solid(), cell), edit_);
    std::map<VertexId, std::vector<Loop>> corners;
    // Middles of the faces on either side of an edge from a corner to its point.
    std::map<std::pair<VertexId, VertexId>, VertexId> left, right;
    for (const FaceUseId use : solid().cell_face_uses(cell)) {
      Loop loop = loop_with_cuts(solid(), cuts_, face_of(use));
      if (is_back(use)) std::reverse(loop.begin() + 1, loop.end());
      const VertexId middle = middles_.at(face_of(use));
      for (const Loop& outer : quadrilaterals(loop, middle)) {
        corners[outer[0]].push_back(outer);
        left[{outer[0], outer[1]}] = middle;
        right[{outer[0], outer[3]}] = middle;
      }
    }
    for (const auto& [spoke, middle] : left)
      corners[spoke.first].push_back({middle, spoke.second, right.at(spoke), centre});
    std::vector<std::vector<Loop>> result;
    for (auto& [v, loops] : corners) result.push_back(std::move(loops));
    return result;
  }

  Transaction& t_;
  Edit edit_;
  Cuts cuts_;
  std::map<FaceId, VertexId> middles_;
};

}  // namespace

Edit split_cells(Transaction& transaction, std::span<const CellId> cells) {
  return Splitter(transaction).run(checked(transaction.solid(), cells));
}

}  // namespace argil::subdiv
