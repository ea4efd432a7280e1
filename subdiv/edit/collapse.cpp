#include "subdiv/edit/collapse.h"

#include <fmt/format.h>

#include <algorithm>

#include "subdiv/edit/identify.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::subdiv {

namespace {

using Pairs = std::vector<std::pair<VertexId, VertexId>>;

// How little a vertex may move: 3 anchored, 2 a corner, 1 on a crease, 0 free.
int firmness(const Solid& solid, VertexId v, const std::vector<VertexId>& anchors) {
  if (std::binary_search(anchors.begin(), anchors.end(), v)) return 3;
  int sharp = 0;
  solid.for_each_edge(v, [&](EdgeId e) { sharp += solid.edge_sharpness(e) > 0 ? 1 : 0; });
  if (solid.vertex_sharpness(v) > 0 || sharp >= 3) return 2;
  return sharp > 0 ? 1 : 0;
}

PlacedVertex placed(const Solid& solid, const Joined& group, const std::vector<VertexId>& anchors) {
  int firmest = 0;
  for (const VertexId v : group) firmest = std::max(firmest, firmness(solid, v, anchors));
  PlacedVertex result{group[0], {}};
  for (const VertexId v : group)
    if (firmness(solid, v, anchors) == firmest) result.sources.emplace_back(v, 0.0);
  for (auto& [source, weight] : result.sources) weight = 1.0 / static_cast<double>(result.sources.size());
  return result;
}

template <class IdType>
void check(const Solid& solid, std::span<const IdType> ids, const char* kind) {
  if (ids.empty())
    throw Error(ErrorCode::bad_input, fmt::format("expected {}s to collapse, found none; select some first", kind));
  for (const IdType id : ids)
    if (!solid.is_live(id))
      throw Error(ErrorCode::not_found, fmt::format("there is no {} {}; select {}s again", kind, id.value, kind),
                  fmt::format("{} {}", kind, id.value));
}

Edit collapse_pairs(Transaction& transaction, const Pairs& pairs, std::span<const VertexId> anchors) {
  const Solid& solid = transaction.solid();
  std::vector<VertexId> firm(anchors.begin(), anchors.end());
  std::sort(firm.begin(), firm.end());
  const auto groups = joined(pairs);
  Edit edit;
  for (const Joined& group : groups) edit.placed.push_back(placed(solid, group, firm));
  identify(transaction, groups, Flattening::allowed, edit);
  if (solid.cell_count() == 0)
    throw Error(ErrorCode::bad_topology,
                "every cell would collapse, and nothing would be left; choose fewer elements");
  std::erase_if(edit.placed, [&](const PlacedVertex& p) { return !solid.is_live(p.vertex); });
  for (const PlacedVertex& p : edit.placed) edit.next_vertices.push_back(p.vertex);
  return edit;
}

}  // namespace

Edit collapse(Transaction& transaction, std::span<const EdgeId> edges, std::span<const VertexId> anchors) {
  const Solid& solid = transaction.solid();
  check(solid, edges, "edge");
  Pairs pairs;
  for (const EdgeId e : edges) pairs.emplace_back(solid.edge_vertices(e)[0], solid.edge_vertices(e)[1]);
  return collapse_pairs(transaction, pairs, anchors);
}

Edit collapse(Transaction& transaction, std::span<const FaceId> faces, std::span<const VertexId> anchors) {
  const Solid& solid = transaction.solid();
  check(solid, faces, "face");
  Pairs pairs;
  for (const FaceId f : faces)
    for (const VertexId v : solid.face_vertices(f).subspan(1)) pairs.emplace_back(solid.face_vertices(f)[0], v);
  return collapse_pairs(transaction, pairs, anchors);
}

Edit collapse(Transaction& transaction, std::span<const CellId> cells, std::span<const VertexId> anchors) {
  const Solid& solid = transaction.solid();
  check(solid, cells, "cell");
  Pairs pairs;
  for (const CellId c : cells) {
    const auto vertices = cell_vertices(solid, c);
    for (const VertexId v : vertices)
      if (v != vertices[0]) pairs.emplace_back(vertices[0], v);
  }
  return collapse_pairs(transaction, pairs, anchors);
}

}  // namespace argil::subdiv
