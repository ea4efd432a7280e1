#pragma once
// What an edit leaves behind beside its delta: where what it made comes from, so that positions, fields, pins,
// loads and named sets can follow, and what the user would go on with.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "subdiv/transaction.h"

namespace argil::subdiv {

/// A vertex that is new, or stands elsewhere than before: linear · Σ weight · source + offset, of positions before
/// the edit. Fields take the blend alone. Sources were there before the edit (they may be gone after it); the
/// weights sum to 1.
struct PlacedVertex {
  VertexId vertex{};
  std::vector<std::pair<VertexId, double>> sources{};
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m]
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
};

template <class IdType>
struct Descent {
  IdType made, source;
};

struct Edit {
  /// Every new vertex, and every old one that moved. A new vertex of two sources or more belongs to a set, or is
  /// pinned, where all its sources are.
  std::vector<PlacedVertex> placed;
  std::vector<Descent<VertexId>> merged;  // {kept, gone}
  // What continues or is a part of an old one (which may live on too), and so stays in its sets.
  std::vector<Descent<EdgeId>> edges;
  std::vector<Descent<FaceId>> faces;
  std::vector<Descent<CellId>> cells;
  // To go on with; the first that is not empty becomes the selection.
  std::vector<FaceId> next_faces;
  std::vector<CellId> next_cells;
  std::vector<EdgeId> next_edges;
  std::vector<VertexId> next_vertices;
};

}  // namespace argil::subdiv
