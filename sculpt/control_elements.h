#pragma once
// Which element of the control solid shows where on the refined one: what a hand points at on the surface, and what
// is masked with a selection, is named by the control elements that commands act on.

#include "subdiv/refinement.h"

namespace argil::sculpt {

/// Of each element of the finest level the control element that it lies on; invalid where it lies within a larger
/// one (an edge across a face, a face inside a cell).
struct ControlElements {
  subdiv::VertexData<subdiv::VertexId> vertex;
  subdiv::EdgeData<subdiv::EdgeId> edge;
  subdiv::FaceData<subdiv::FaceId> face;
  subdiv::CellData<subdiv::CellId> cell;  // always valid where the cell is live
};
/// Cost O(all levels).
[[nodiscard]] ControlElements control_elements(const subdiv::Refinement& refinement);

}  // namespace argil::sculpt
